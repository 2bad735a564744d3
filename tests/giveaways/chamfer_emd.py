"""Which sentences would tell the answers of the questions in the chamfer_emd lesson, as patterns;
case does not matter.
"""

GIVEAWAYS = {
    "whose-row": (r"order of rows", r"only pairs by (row|index)", r"measures the (file|order)"),
    "blurred-home": (r"0\.5\d m", r"half a metre"),
    "predict-spread": (
        r"chamfer clumps",
        r"\d+ of 80 points on",
        r"on the nearer (half|side)",
        r"half of the mass is out of place",
        r"5\d % of (the left|its) mass",
    ),
    "predict-flip": (
        r"ranking flips",
        r"depends on the distance",
        r"C ?= ?0\.0039",
        r"nearer than the 5 % larger",
        r"to Chamfer this is closer",
    ),
    "predict-missing": (
        r"source to target(, | )?C? ?is 0\b",
        r"that side of Chamfer is 0",
        r"every source point lies on the target",
        r"cannot see what the source lacks",
    ),
    "predict-outlier": (
        r"Hausdorff is (that|\d+ times)",
        r"squares lean on",
        r"hardly notice",
    ),
}
