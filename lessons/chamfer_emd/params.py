"""The inputs of the lesson on distances between shapes."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

from workbench.data.point_sets import Shape
from workbench.knobs import Knob

Start = Literal["blob", "larger", "bunched", "bump", "part missing", "one outlier", "shuffled rows", "doubled points"]
Lowers = Literal["both sides", "source to target", "target to source"]


@dataclass(frozen=True)
class Params:
    """Two clouds, what the left flow lowers, and how far flows step."""

    shape: Annotated[Shape, Knob("The built-in target", label="Target")] = "ring"
    start: Annotated[Start, Knob("A blob, or the target after one change", label="Source")] = "blob"
    amount: Annotated[
        float,
        Knob("How much: blob, bump and outlier in metres; the others as a share, up to 1", 0, 3, step=0.001),
    ] = 0.3
    points: Annotated[
        int, Knob("Points of the target; an own cloud is thinned to them", 10, 200, label="Target points")
    ] = 80
    source_points: Annotated[int, Knob("Points of the source; 0 takes as many as the target has", 0, 200)] = 0
    lowers: Annotated[Lowers, Knob("Which sides of Chamfer the left flow lowers", label="Left flow lowers")] = (
        "both sides"
    )
    blur: Annotated[
        float, Knob("Regularisation of Sinkhorn's transport", 0.01, 2, unit="m", step=0.01, label="Sinkhorn blur")
    ] = 0.05
    near: Annotated[
        float, Knob("Up to here the F-score counts a point, and mass is not astray", 0.01, 0.5, unit="m", step=0.01)
    ] = 0.1
    longest_step: Annotated[
        float, Knob("No step moves the points farther than this", 0.01, 0.3, unit="m", step=0.01)
    ] = 0.06
    steps: Annotated[int, Knob("Steps of each flow, unless it ends before", 0, 150)] = 40
    target: Annotated[Path | None, Knob("Own target cloud: ply, pcd, obj, xyz, csv, npz; scaled to the picture")] = None
    source: Annotated[Path | None, Knob("Own source cloud, in the frame of the own target")] = None
    seed: Annotated[int, Knob("Which points of the blob, which order, which points of own clouds", 0, 99)] = 0
