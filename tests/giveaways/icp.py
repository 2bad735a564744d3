"""Which sentences would tell the answers of the questions in the icp lesson, as patterns; case does
not matter.
"""

GIVEAWAYS = {
    "how-many-now": (
        r"many (shallow )?(valleys|ones)",
        r"valley for every",
        r"one of them is deep",
    ),
    "predict-matches": (
        r"few matches are right",
        r"(only \d+ %|hardly any|few|none) of (them|the matches|these)",
        r"mostly wrong",
        r"\d+ % (at first|are right)",
        r"wrong (nearly|almost) everywhere",
    ),
    "where-it-rests": (r"another valley", r"\b9[45](\.6)?°"),
    "predict-far": (
        r"120°[^.]*(wrong|settled|lost)",
        r"(cost|RMSE) falls at every fit",
        r"nearest valley, not",
        r"home up to \d+°",
        r"converge[^.]*wrong",
    ),
    "predict-plane": (r"point-to-plane: few", r"\bsixth\b", r"far fewer iterations"),
    "best-share": (r"(keep|closest) (the closest )?(70|65) %", r"comes? home at (70|65) %"),
    "predict-vase": (
        r"turn is invisible",
        r"(arrow|turn) is (still )?90° off",
        r"fits at any turn",
        r"RMSE is as small as",
        r"no (data|point|method)[^.]*(could|can) tell",
    ),
}
