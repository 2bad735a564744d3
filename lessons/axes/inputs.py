"""The inputs of the lesson."""

from pathlib import Path
from typing import Literal

from workbench.data.framing import Up
from workbench.lesson import Gizmo, Params, knob


class Input(Params):
    """A shape scanned twice, what is wrong with the second scan, and how the two are aligned."""

    stage: Literal["space", "turn", "frames", "flat", "starts"] = knob(
        "space", "Two scans, one turn by hand, all frames, an outline, or four starts for ICP"
    )
    shape: Literal["rabbit", "box", "vase", "cube", "plate"] = knob(
        "rabbit", "What is scanned: lopsided, or with a symmetry of its own"
    )
    signs: Literal["none", "largest-entry", "third-moment"] = knob(
        "third-moment", "How each axis gets its sign"
    )
    turn: float = knob(
        130.0,
        "How far the second scan is turned away, about a slanting axis",
        0,
        180,
        unit="deg",
        step=1,
    )
    fresh: bool = knob(False, "The second scan has points of its own, not the same ones")
    points: int = knob(1500, "Points of each scan", 100, 20_000, step=100)
    noise: float = knob(
        0.0, "Noise of each coordinate (standard deviation)", 0, 0.2, unit="m", step=0.005
    )
    noisy: Literal["both", "target"] = knob("both", "Which scan has the noise")
    side: float = knob(
        0.6, "Middle side of the box or plate; its long one is 1 m", 0.4, 1, unit="m", step=0.01
    )
    density: int = knob(1, "How many times as dense the second scan is above its middle", 1, 5)
    seen: float = knob(1.0, "Share of the shape that the second scan saw", 0.3, 1, step=0.05)
    stray: tuple[float, float, float] = knob(
        (0.0, 0.0, 0.0),
        "Drag the handle out of the second scan: one stray point; none at the origin",
        -10,
        10,
        unit="m",
        by=Gizmo(0.3),
    )
    aside: float = knob(
        0.0, "How far behind the outline one more point lies; none at 0", 0, 3, unit="m", step=0.1
    )
    source: Path | None = knob(
        None, "Own cloud in place of the shape: ply, pcd, obj, xyz, csv, npz"
    )
    target: Path | None = knob(None, "Own first scan, onto which the own cloud is brought")
    truth: Path | None = knob(None, "Known pose of the own cloud in the first scan's frame")
    up: Up = knob("z", "Which axis of own clouds points up", of_files=True)
    seed: int = knob(0, "Which points are sampled", 0, 99)
