"""Which sentences would tell the answers of the questions in the learning lesson, as patterns; case
does not matter.
"""

GIVEAWAYS = {
    "predict-cut": (
        r"(errs|error|wrong)[^.]*half (a )?turn",
        r"(cut|jump)[^.]*\b180",
        r"±\s?180",
        r"worst[^.]*\b1[78]\d°",
    ),
    "predict-radius": (
        r"mean of all radii",
        r"(one|a) thin circle",
        r"radius (of )?(1|one)\b[^.]*(m|metre)",
        r"spread of 0\.00",
    ),
    "predict-stray": (
        r"by chance alone",
        r"\b(20|fifth)\b[^.]*(named|of the clouds)",
        r"stray point[^.]*(ruins|names? nothing)",
    ),
    "predict-views": (
        r"24[^.]*(matched|explained) (worse|less well)",
        r"more photographs[^.]*(worse|less)",
        r"two[^.]*match(es|ed)? better",
    ),
}
