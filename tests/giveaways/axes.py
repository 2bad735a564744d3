"""Which sentences would tell the answers of the questions in the lesson on axes, as patterns;
case does not matter.
"""

GIVEAWAYS = {
    "predict-rotations": (r"\b(8|eight) rotations", r"after (8|eight)\b", r"Rotation 8"),
    "predict-frames": (r"\b(4|four) (right-handed )?frames", r"(4|four) of (the )?(8|eight)"),
    "predict-signs": (
        r"\b(a quarter|one in four)\b",
        r"no better than chance",
        r"2\d % come home",
        r"of four frames",
    ),
    "second": (r"16[012]°", r"right angles?", r"perpendicular"),
    "one-stray": (r"179° from the truth", r"half a turn (off|away) by a stray"),
    "which-wins": (r"lowest RMSE (wins|is home)", r"frame 2 (is|comes) home"),
}
