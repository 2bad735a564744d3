"""Which sentences would tell the answers of the questions in the measures lesson, as patterns; case
does not matter.
"""

GIVEAWAYS = {
    "predict-walls": (
        r"1\.5 times",
        r"half as large again",
        r"walls? (area )?(never|do(es)? not) converge",
        r"3/2 of",
    ),
    "predict-tenth": (r"\b100 times", r"a hundred times", r"hundredfold"),
    "predict-hits": (
        r"(?<!,)\b2[345]\d hits",
        r"ten dimensions[^.]*(hardly|few|none)",
        r"quarter of a per cent",
    ),
    "predict-inscribed": (
        r"volume (loses|lacks|shrinks|falls) more",
        r"0\.86",
        r"volume[^.]*(larger|more)[^.]*than the area",
    ),
    "predict-lantern": (r"4\.9\d?", r"five times", r"lie almost level", r"not follow the area"),
}
