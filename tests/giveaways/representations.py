"""Which sentences would tell the answers of the representations lesson, as patterns; case does not
matter.
"""

GIVEAWAYS = {
    "predict-half": (
        r"\b(4|four)(\.\d)? times as (many|large)",
        r"×\s?4\b",
        r"surface meets four",
        r"four times the bytes",
    ),
    "predict-area": (
        r"\b(8|9)(\.\d)? % (more|too)",
        r"1\.0[89] times",
        r"area (never|does not)",
        r"stays? [^.]*too large",
    ),
    "predict-looked": (r"2\d of 16,000", r"about as many", r"log(arithm)? ", r"as many as before"),
    "predict-middle": (r"−\s?(0\.05|5 cm|50 mm)", r"(5 cm|50 mm) for"),
    "predict-weights": (
        r"nothing but rounding",
        r"\bexact(ly)?\b[^.]*(torus|circle)",
        r"runs? along a circle: ",
    ),
}
