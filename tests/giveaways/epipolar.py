"""Which sentences would tell the answers of the questions in the epipolar lesson, as patterns; case
does not matter.
"""

GIVEAWAYS = {
    "predict-four": (
        r"\b(only )?one of (the|these|them|four)[^.]*in front",
        r"(60 of 60|0, 0, 0)",
        r"the only (one|motion)",
    ),
    "predict-baseline": (r"\b2[12](\.\d)? cm", r"half the baseline[^.]*twice", r"doubles"),
    "predict-plane": (r"10\d°", r"on a plane[^.]*(random|anywhere|more than 20°)"),
    "predict-f": (
        r"lines (still )?fit as well",
        r"as well as ever",
        r"takes the error in",
        r"nothing in the pictures tells",
    ),
}
