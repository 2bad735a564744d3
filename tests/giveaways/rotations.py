"""Which sentences would tell the answers of the questions in the rotations lesson, as patterns;
case does not matter.
"""

GIVEAWAYS = {
    "lost-direction": (
        r"about (one|the same) (axis|line)",
        r"share (an|one) ax(is|le)",
        r"lo(st|ses?) (is )?(a|one) direction",
        r"two (independent )?directions",
        r"one direction (less|fewer|is lost)",
    ),
    "same-turn": (r"ZYX \(70, 30, 40\)[^.]*same", r"numbers are in reverse"),
    "sum-of-turns": (r"\b120°", r"a third of a whole turn"),
    "long-way": (r"long way", r"\b300°?"),
    "mean-heading": (r"\b340\b", r"their mean is 0°"),
    "mean-matrix": (
        r"nearly flat",
        r"(less than|under) 1 %",
        r"volume is 1 %",
        r"keeps (hardly|almost no)",
    ),
}
