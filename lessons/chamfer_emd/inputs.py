"""The inputs of the lesson."""

from pathlib import Path
from typing import Literal

from lessons.chamfer_emd.point_sets import Shape
from workbench.lesson import Gizmo, Params, knob

Start = Literal[
    "blob",
    "larger",
    "bunched",
    "bump",
    "part missing",
    "one outlier",
    "shuffled rows",
    "doubled points",
]
Lowers = Literal["both sides", "source to target", "target to source"]


class Input(Params):
    """Two clouds and what is asked of them: how they flow, or one thing turned by hand."""

    stage: Literal["flows", "twelve", "bunch", "far dot", "blur"] = knob(
        "flows", "Two flows; twelve dots; or a bunch, a far dot, a blur at all of their values"
    )
    shape: Shape = knob("ring", "The built-in target", label="Target")
    start: Start = knob("blob", "A blob, or the target after one change", label="Source")
    amount: float = knob(
        0.3,
        "How much: blob, bump and outlier in metres; the others as a share, up to 1",
        0,
        3,
        step=0.001,
    )
    points: int = knob(
        80, "Points of the target; an own cloud is thinned to them", 10, 200, label="Target points"
    )
    source_points: int = knob(0, "Points of the source; 0 takes as many as the target has", 0, 200)
    lowers: Lowers = knob(
        "both sides", "Which sides of Chamfer the left flow lowers", label="Left flow lowers"
    )
    blur: float = knob(
        0.05,
        "Regularisation of Sinkhorn's transport",
        0.01,
        2,
        unit="m",
        step=0.01,
        label="Sinkhorn blur",
    )
    near: float = knob(
        0.1,
        "Up to here the F-score counts a point, and mass is in its place",
        0.01,
        0.5,
        unit="m",
        step=0.01,
    )
    longest_step: float = knob(
        0.06, "No step moves the points farther than this", 0.01, 0.3, unit="m", step=0.01
    )
    steps: int = knob(40, "Steps of each flow, unless it ends before", 0, 150)
    dot: tuple[float, float] = knob(
        (0.0, 1.0),
        "Where the first of the twelve dots is: drag it",
        -1.6,
        1.6,
        unit="m",
        by=Gizmo(0.3),
    )
    shuffled: bool = knob(False, "Shuffle the rows of the twelve dots")
    target: Path | None = knob(
        None, "Own target cloud: ply, pcd, obj, xyz, csv, npz; scaled to the picture"
    )
    source: Path | None = knob(None, "Own source cloud, in the frame of the own target")
    seed: int = knob(0, "Which points of the blob, which order, which points of own clouds", 0, 99)
