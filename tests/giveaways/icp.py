"""Which sentences would tell the answers of the questions in the icp lesson, as patterns; case does
not matter.
"""

GIVEAWAYS = {
    "predict-matches": (
        r"few matches are right",
        r"(only \d+ %|hardly any|few|none) of (them|the matches|these)",
        r"mostly wrong",
        r"\d+ % (at first|are right)",
        r"wrong (nearly|almost) everywhere",
    ),
    "predict-far": (
        r"120°[^.]*(wrong|settled|lost)",
        r"(cost|RMSE) falls at every fit",
        r"nearest valley, not",
        r"home up to \d+°",
        r"converge[^.]*wrong",
    ),
    "predict-plane": (r"point-to-plane: few", r"\bsixth\b", r"far fewer iterations"),
    "predict-vase": (
        r"turn is invisible",
        r"(arrow|turn) is (still )?90° off",
        r"fits at any turn",
        r"RMSE is as small as",
        r"no (data|point|method)[^.]*(could|can) tell",
    ),
}
