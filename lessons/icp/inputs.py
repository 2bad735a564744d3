"""The inputs of the lesson."""

from pathlib import Path
from typing import Literal

from workbench.data.framing import Unit, Up
from workbench.lesson import Gizmo, Params, knob

BUILT_IN = ("shape", "start_angle", "start_shift", "overlap", "noise", "outliers", "points")


class Input(Params):
    """Two scans, a start, and how ICP matches and fits."""

    stage: Literal["space", "flat"] = knob(
        "space", "Scans in space, or the rabbit's outline, which only turns"
    )
    by: Literal["icp", "hand"] = knob("icp", "Who turns the outline")
    shape: Literal["rabbit", "vase", "corner", "lidar"] = knob(
        "rabbit", "Without symmetry, turning, sliding, or a street in a lidar's rings"
    )
    start_angle: float = knob(
        35.0,
        "How far the built-in source starts turned away",
        -180,
        180,
        unit="deg",
        step=1,
    )
    start_shift: float = knob(0.0, "How far it starts shifted along x", 0, 1, unit="m", step=0.01)
    fit: Literal["point-to-point", "point-to-plane", "similarity", "affine"] = knob(
        "point-to-point", "What each fit minimises, over which kind of motion"
    )
    gate: Literal["all", "trimmed", "max-distance", "3-medians"] = knob(
        "trimmed", "Which matches a fit may use"
    )
    keep: float = knob(0.9, "Share of the closest matches that trimming keeps", 0.3, 1, step=0.05)
    max_distance: float = knob(
        0.1,
        "Matches farther apart are refused; lidar and own scans count as 1.2 m wide",
        0.01,
        2,
        unit="m",
        step=0.01,
    )
    planes: Literal["spread", "all"] = knob(
        "spread", "All target points pull, or only where neighbours spread, not in a line"
    )
    overlap: float = knob(
        1.0, "Share of the built-in source that the target saw too", 0.4, 1, step=0.05
    )
    noise: float = knob(0.002, "Noise of each coordinate", 0, 0.03, unit="m", step=0.001)
    outliers: float = knob(0.0, "Share of source points that belong to nothing", 0, 0.5, step=0.05)
    points: int = knob(1500, "Points of each built-in scan but the lidar's", 200, 20_000, step=100)
    guess: tuple[float, float, float, float, float, float] = knob(
        (0.0,) * 6,
        "Initial guess beside the start: place (m) and rotation vector (rad)",
        -3.2,
        3.2,
        by=Gizmo(0.25),
    )
    target: Path | None = knob(None, "Own target scan: ply, pcd, obj, xyz, csv, npz")
    source: Path | None = knob(None, "Own source scan, moved onto the target")
    truth: Path | None = knob(
        None, "Known pose of the source in the target's frame: 4×4 or list of poses"
    )
    up: Up = knob("z", "Which axis of own scans points up", of_files=True)
    unit: Unit = knob("m", "Unit of the numbers in own files", of_files=True)
    thinning: Literal["voxel", "chance"] = knob(
        "voxel", "Lidar and own scans: both by the means of voxels, or the source by chance"
    )
    voxel: float = knob(
        0.2, "Edge of those voxels, of the target's longest extent", 0.1, 5, unit="%", step=0.1
    )
    own_points: int = knob(
        10_000, "At most so many points of a lidar or own source are used", 100, 50_000, step=100
    )
    seed: int = knob(0, "Which points are sampled", 0, 99)

    @property
    def changed(self) -> tuple[str, ...]:
        """The inputs of built-in scans that were changed though own scans are open."""
        if self.target is None:
            return ()
        return tuple(name for name in BUILT_IN if getattr(self, name) != getattr(Input, name))
