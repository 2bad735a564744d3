"""Which sentences would tell the answers of the questions in the transforms lesson, as patterns;
case does not matter.
"""

GIVEAWAYS = {
    "read-columns": (r"quarter turn to the left", r"turns? by \+?90° about z"),
    "which-order": (r"\b2(\.1\d?)? m (off|away|apart)", r"√2 · 1\.5"),
    "undo": (r"\b1\.97 m", r"misses by 1\.", r"turned back, but"),
    "sheared-volume": (
        r"shear\w* (keeps|preserves) (the )?volume",
        r"volume (stays|is kept|survives|does not|remains)",
        r"det (stays|is|=) 1\b",
    ),
    "apex": (r"meet at 2 m", r"\(0, 0, 2\)", r"run to one point"),
}
