"""Which sentences would tell the answers of the questions in the distances lesson, as patterns;
case does not matter.
"""

GIVEAWAYS = {
    "finer": (
        (
            r"(8|eight) neighbours[^.]*(stay|never|same|however fine|no better|do(es)? not"
            r" (shrink|fall|converge))"
        ),
        r"never converges?",
        r"however fine",
        r"sec\(",
        r"1\.08",
    ),
    "two-sigma": (r"\b86(\.\d)?\b", r"within 2[^.]*plane[^.]*\d\d %"),
    "twenty": (r"\b4\.2\d?\b", r"√n", r"\(n − 1\)"),
    "squares": (
        r"\b2[345](\.\d)? % (of|break)",
        r"a quarter of (all|the) triples",
        r"one (triple )?in four",
    ),
    "longer": (
        r"(three|four|4(\.\d)?) times (that|what)",
        r"long(er)?[^.]*(four|4(\.\d)?) times",
        r"too long a time[^.]*(wrong|worse)",
    ),
    "shortcut": (r"\b2\.[3-7]\d? m\b", r"less than half (of )?the way", r"a third of the way"),
}
