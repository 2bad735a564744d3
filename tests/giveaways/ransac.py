"""Which sentences would tell the answers of the questions in the ransac lesson, as patterns; case
does not matter.
"""

GIVEAWAYS = {
    "predict-needed": (r"\b3[45]\b[^.]*samples",),
    "predict-near-sample": (
        r"bad plane",
        r"hardly any of the others",
        r"under a tenth",
        r"reaches (hardly|few|\d+ %)",
        r"your sample: \d+ of",
    ),
    "predict-two-planes": (
        r"(is|returns|finds|gives) the wall",
        r"the largest wins",
        r"finds the largest, not",
        r"largest, not the right",
    ),
    "predict-size": (r"seven need", r"over fifty samples", r"larger samples are (not|no)"),
    "predict-huber": (r"in between", r"15 cm and 14 mm", r"Huber (is |ends )?1[34](\.\d)? mm"),
}

INNOCENT = {
    "predict-two-planes": r"beside a wall",  # the question's own words
}
"""What the rules would misread, left out of what they read."""
