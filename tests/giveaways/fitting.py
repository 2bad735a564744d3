"""Which sentences would tell the answers of the questions in the fitting lesson, as patterns; case
does not matter.
"""

GIVEAWAYS = {
    "predict-kasa": (
        r"45°[^.]*(0\.6|60 %|40 % (too )?small)",
        r"0\.60\b",
        r"Kåsa'?s?[^.]*(two thirds|60 %|0\.6\b)",
    ),
    "predict-end": (
        r"grows? (without|for ever)",
        r"(large|larger) and larger circle",
        r"becomes? a (straight )?line",
    ),
    "predict-iterations": (
        r"(sixth|6th|seventh|fifth) (iteration|step)",
        r"(six|twice as many|6) iterations",
    ),
    "predict-slope": (r"\b5[67](\.\d)?°", r"(three|3(\.\d)?) ?° (too )?(flat|less)"),
    "predict-alike": (
        r"(three|four|3\.\d|3|4) times (as wide|too narrow)",
        r"factor of (three|3\.\d|four)",
    ),
    "predict-tukey": (r"Tukey[^.]*(no nearer|worse than|farther)", r"15\d mm|0\.15\d m"),
}
