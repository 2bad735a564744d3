"""Which sentences would tell the answers of the questions in the coordinates lesson, as patterns;
case does not matter.
"""

GIVEAWAYS = {
    "predict-poles": (
        r"\b(a|one) third of the points",
        r"33(\.\d)? % of the points",
        r"two and a half times",
    ),
    "predict-way": (r"Tokyo[^.]*\d\d(\.\d)? %", r"\b(a fifth|19 %|18\.8 %) (more|longer)"),
    "predict-pan": (r"3,\d\d\d\s?°/s", r"thousands? (of )?(degrees|°)"),
    "predict-ball": (r"2 ?π²", r"19\.7"),
    "predict-mean": (
        r"(other|opposite) side of the (earth|world|globe)",
        r"16,\d\d\d km",
        r"antipode of",
    ),
}
