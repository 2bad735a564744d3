"""Which sentences would tell the answers of the questions in the graphs lesson, as patterns; case
does not matter.
"""

GIVEAWAYS = {
    "mutual": (
        r"\b2\d\d (components|pieces)",
        r"mutual[^.]*(falls apart|hundreds|many (pieces|components))",
        r"both (ends|must)[^.]*(hundreds|many (pieces|components))",
    ),
    "club-right": (r"(sign|vector|Fiedler)[^.]*3[0-4] of 34", r"all but two\b", r"not 2, 8"),
    "longer": (r"explode", r"grows without", r"blows? up[^-]", r"grows? at every step"),
    "volume": (r"\b6\d(\.\d)? %", r"a third of (its|the) volume", r"two thirds"),
    "sixty-four": (
        r"64[^.]*\b17\b",
        r"by chance alone",
        r"no better than",
        r"all (nodes|members) alike",
    ),
}

INNOCENT = {"volume": r"half way to the mean of its neighbours"}  # how far a vertex goes
"""What the rules would misread, left out of what they read."""
