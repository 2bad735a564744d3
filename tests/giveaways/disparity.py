"""Which sentences would tell the answers of the questions in the disparity lesson, as patterns;
case does not matter.
"""

GIVEAWAYS = {
    "quarter": (r"board at 20 m", r"1, 5,? (and )?20 m", r"20 m, true 4\.2"),
    "nearer": (r"20 m by", r"\b[45](\.0+)? m nearer", r"80 / 5", r"quadratic, not linear"),
    "single": (r"74(\.\d)? %", r"three quarters (of|are)"),
    "averages": (
        r"mean (of the depths|depth) is (further|larger|greater)",
        r"depths? averages? (too )?far",
    ),
    "baseline": (r"twice as (much|many)[^.]*hidden", r"half as (much|many)[^.]*hidden"),
    "window": (
        r"fattened edges",
        r"balls have grown",
        r"window across an edge",
        r"swallows? edges",
    ),
}

INNOCENT = {
    "nearer": r"A board 5 m away",  # where another question's board stands
    "baseline": r"twice the baseline",  # the question's own words, and a choice's
}
"""What the rules would misread, left out of what they read."""
