"""Which sentences would tell the answers of the questions in the curvature lesson, as patterns;
case does not matter.
"""

GIVEAWAYS = {
    "seven": (r"\bseven\b[^.]*overlap",),
    "inside": (r"gaps and overlaps (agree|are equal)", r"715[^.]*inside"),
    "which-rolled": (
        r"(tube|cylinder|paper)[^.]*K ?= ?0",
        r"unrolls? flat",
        r"each can be 0 without",
    ),
    "which-double": (r"falls? to a quarter", r"K[^.]{0,30}\bquarter"),
    "which-sides": (
        r"sign of K (is no|does not)",
        r"H, k.? and k.? change",
        r"those of H",
        r"H (changes|turns)[^.]*K does not",
    ),
    "which-finer": (
        r"finer does not help",
        r"\d+ % off at any",
        r"stays \d+ to \d+ %",
        r"\d+ % to \d+ %",
        r"stays? wrong",
    ),
    "which-sum": (r"\b4 ?π", r"\bfour π"),
}

INNOCENT = {
    # a letter that is a choice stands in every sentence
    "which-sides": r"H is half the normal's length",
}
"""What the rules would misread, left out of what they read."""
