"""Which sentences would tell the answers of the questions in the pinhole lesson, as patterns; case
does not matter.
"""

GIVEAWAYS = {
    "predict-dolly": (r"tower[^.]*(doubles|grows|larger|172)", r"97[^.]{0,20}172"),
    "predict-behind": (
        r"lands in the picture",
        r"pixel in the picture",
        r"has a pixel although",
        r"looks as valid",
    ),
    "predict-centre": (r"2\.00, [−-]4\.00, 2\.50",),
    "predict-rails": (
        r"does not know t\b",
        r"where the camera stands does not matter",
        r"translation is not in",
        r"vanishing point[^.]*(stays|does not move|keeps its place)",
        r"rails[^.]*(stays? where|do(es)? not move)",
    ),
    "through-the-middle": (
        r"through the middle[^.]*(straight|not bent|not at all)",
        r"radial (edges|lines) stay",
    ),
    "predict-crop": (r"\b49(\.\d+)?\b",),
}

INNOCENT = {
    "predict-rails": r"rails stay 1\.5 m apart",  # of the rails, not of where they seem to meet
}
"""What the rules would misread, left out of what they read."""
