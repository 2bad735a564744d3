"""Which sentences would tell the answers of the questions in the pose lesson, as patterns; case
does not matter.
"""

INNOCENT = {
    "predict-wrong": r"the noise is half a pixel",
    "predict-few": r"a tenth of the distance",  # no share of pictures
}
GIVEAWAYS = {
    "predict-solutions": (
        r"(mostly|usually|most (of them )?have|commonly|as a rule) two",
        r"two (solutions|cameras|places) (mostly|usually|as a rule)",
        r"(90|89) % ",
    ),
    "predict-wrong": (
        r"(third|two in five|40|4\d|37) ?% of (the|such) pictures",
        r"two in five",
        r"every third picture",
    ),
    "predict-samples": (r"\b29[0-9]\b samples", r"eight times as many"),
    "predict-few": (
        r"EPnP.{0,60}(is|turns|was) (\d+|one|two|a) .{0,20}(%|per cent|sixth|seventh)",
        r"every (fifth|sixth|seventh|eighth) (picture|time)",
    ),
    "predict-plane": (
        r"linear transform (of|on|in) a plane (means|gives) nothing",
        r"points (of|in) (a|one) plane.{0,60}(not determined|no answer|means nothing)",
    ),
}
