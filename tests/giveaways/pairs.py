"""Which sentences would tell the answers of the questions about pairs, as patterns; case does
not matter.
"""

GIVEAWAYS = {
    "how-many-valleys": (r"(one|a single) (valley|lowest|low)", r"nothing in between"),
    "predict-negated": (r"0\.7\d m",),
    "predict-product": (r"product (is|of)[^.]*0\.9", r"there and back[^.]*(less|below)"),
    "half-wrong": (
        r"mistakes[^.]*cancel",
        r"(few|1\.\d+) ?(degrees|°) off",
        r"partners need not be right",
    ),
}
