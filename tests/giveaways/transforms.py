"""Which sentences would tell the answers of the questions in the transforms lesson, as patterns;
case does not matter.
"""

GIVEAWAYS = {
    "which-order": (r"\b2(\.1\d?)? m (off|away|apart)", r"√2 · 1\.5"),
    "lost-direction": (
        r"about (one|the same) (axis|line)",
        r"share an axis",
        r"lo(st|ses?) (is )?(a|one) direction",
        r"two (independent )?directions",
        r"one direction (less|fewer|is lost)",
    ),
    "sheared-volume": (
        r"shear\w* (keeps|preserves) (the )?volume",
        r"volume (stays|is kept|survives|does not|remains)",
        r"det (stays|is|=) 1\b",
    ),
    "mean-heading": (r"long way", r"\b340\b", r"their mean is 0°"),
    "mean-matrix": (
        r"nearly flat",
        r"(less than|under) 1 %",
        r"volume is 1 %",
        r"keeps (hardly|almost no)",
    ),
}
