"""The inputs of the lesson."""

from pathlib import Path
from typing import Literal

from workbench.algorithms.registration.procrustes import Flip
from workbench.data.framing import Up
from workbench.lesson import Params, knob


class Input(Params):
    """Two scans whose points are paired, and what is wrong with them."""

    stage: Literal["space", "flat"] = knob(
        "space", "Clouds in space, or two outlines that a hand turns"
    )
    shape: Literal["rabbit", "box", "vase", "cube", "plate"] = knob("rabbit", "What is scanned")
    turn: float = knob(
        130.0,
        "How far the second scan is turned, about a slanting axis",
        0,
        180,
        unit="deg",
        step=1,
    )
    points: int = knob(1500, "Points of each scan", 100, 20_000, step=100)
    noise: float = knob(
        0.01, "Noise of each coordinate (standard deviation)", 0, 0.1, unit="m", step=0.005
    )
    noisy: Literal["both", "target"] = knob("both", "Which scan has the noise")
    scale: float = knob(
        1.0, "How many times as large the first scan is", 0.5, 2, unit="×", step=0.05
    )
    mirrored: bool = knob(False, "The second scan is a mirror image")
    flip: Flip = knob("least", "Which direction is flipped where the SVD gives a mirror image")
    wrong: float = knob(0.0, "How many of the pairs have a wrong partner", 0, 90, unit="%", step=10)
    mistakes: Literal["shuffled", "together"] = knob(
        "shuffled", "Wrong partners by chance, or all off to the same side"
    )
    pull: float = knob(
        0.0, "How far the highest band is pulled aside, outlines only", 0, 2, unit="m", step=0.05
    )
    side: float = knob(
        0.6, "Middle side of the box or plate; its long one is 1 m", 0.4, 1, unit="m", step=0.01
    )
    source: Path | None = knob(
        None, "Own cloud in place of the shape: ply, pcd, obj, xyz, csv, npz"
    )
    target: Path | None = knob(None, "Own first scan, row by row the partner of the own cloud")
    truth: Path | None = knob(None, "Known pose of the own cloud in the first scan's frame")
    up: Up = knob("z", "Which axis of own clouds points up", of_files=True)
    seed: int = knob(0, "Which points are sampled", 0, 99)
