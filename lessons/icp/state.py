"""The inputs, the two scans, and what one step holds."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from workbench.algorithms.registration import icp
from workbench.data.framing import Frame, Unit, Up
from workbench.geometry.motions import apply, exp_so3, turn_about
from workbench.geometry.motions.alignment import MotionError, motion_error
from workbench.knobs import Gizmo, Knob

Shape = Literal["rabbit", "vase", "corner", "lidar"]
Fit = Literal["point-to-point", "point-to-plane", "similarity", "affine"]
Thinning = Literal["voxel", "chance"]
Planes = Literal["spread", "all"]
GateName = Literal["all", "trimmed", "max-distance", "3-medians"]
HOME_DEGREES, HOME_SPACINGS = 5.0, 2.0
BUILT_IN = ("shape", "start_angle", "start_shift", "overlap", "noise", "outliers", "points")


@dataclass(frozen=True)
class Params:
    """Two scans, a start, and how ICP matches and fits."""

    shape: Annotated[
        Shape,
        Knob(
            "The built-in shape: without symmetry, turning, sliding, or a street in a lidar's rings"
        ),
    ] = "rabbit"
    start_angle: Annotated[
        float,
        Knob(
            "How far the built-in source starts turned away, about the vertical",
            0,
            180,
            unit="deg",
            step=1,
        ),
    ] = 35.0
    start_shift: Annotated[
        float, Knob("How far it starts shifted along x", 0, 1, unit="m", step=0.01)
    ] = 0.0
    fit: Annotated[Fit, Knob("What each fit minimises, over which kind of motion")] = (
        "point-to-point"
    )
    gate: Annotated[GateName, Knob("Which matches a fit may use")] = "trimmed"
    keep: Annotated[
        float,
        Knob(
            "Share of the closest matches that trimming keeps",
            0.3,
            1,
            step=0.05,
            needs={"gate": ("trimmed",)},
        ),
    ] = 0.9
    max_distance: Annotated[
        float,
        Knob(
            "Matches farther apart are refused; lidar and own scans count as 1.2 m wide",
            0.01,
            2,
            unit="m",
            step=0.01,
            needs={"gate": ("max-distance",)},
        ),
    ] = 0.1
    planes: Annotated[
        Planes,
        Knob(
            "Point-to-plane, lidar and own scans: all target points pull, or only where neighbours"
            " spread, not in a line",
            needs={"fit": ("point-to-plane",)},
        ),
    ] = "spread"
    overlap: Annotated[
        float,
        Knob(
            "Share of the built-in source that the target saw too; not the lidar's",
            0.4,
            1,
            step=0.05,
        ),
    ] = 1.0
    noise: Annotated[float, Knob("Noise of each coordinate", 0, 0.03, unit="m", step=0.001)] = 0.002
    outliers: Annotated[
        float, Knob("Share of source points that belong to nothing", 0, 0.5, step=0.05)
    ] = 0.0
    points: Annotated[
        int, Knob("Points of each built-in scan but the lidar's", 200, 20_000, step=100)
    ] = 1500
    guess: Annotated[
        tuple[float, float, float, float, float, float],
        Knob(
            "Initial guess beside the start: place (m) and rotation vector (rad)",
            -3.2,
            3.2,
            by=Gizmo(0.25),
        ),
    ] = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    target: Annotated[Path | None, Knob("Own target scan: ply, pcd, obj, xyz, csv, npz")] = None
    source: Annotated[Path | None, Knob("Own source scan, moved onto the target")] = None
    truth: Annotated[
        Path | None, Knob("Known pose of the source in the target's frame: 4×4 or list of poses")
    ] = None
    up: Annotated[Up, Knob("Which axis of own scans points up", of_files=True)] = "z"
    unit: Annotated[Unit, Knob("Unit of the numbers in own files", of_files=True)] = "m"
    thinning: Annotated[
        Thinning,
        Knob("Lidar and own scans: both by the means of voxels, or only the source, by chance"),
    ] = "voxel"
    voxel: Annotated[
        float,
        Knob(
            "Edge of those voxels, of the target's longest extent",
            0.1,
            5,
            unit="%",
            step=0.1,
            needs={"thinning": ("voxel",)},
        ),
    ] = 0.2
    own_points: Annotated[
        int,
        Knob(
            "At most so many points of a lidar or own source are used, drawn by chance",
            100,
            50_000,
            step=100,
        ),
    ] = 10_000
    seed: Annotated[int, Knob("Which points are sampled", 0, 99)] = 0

    @property
    def idle(self) -> tuple[str, ...]:
        """The inputs that were changed and have no effect, since own scans are open."""
        if self.target is None:
            return ()
        return tuple(name for name in BUILT_IN if getattr(self, name) != getattr(Params, name))


@dataclass(frozen=True, eq=False, kw_only=True)
class Scans:
    """Target and source in their own frames (metres), and what does not change while ICP runs.

    Attributes:
        p_target: Target points, target frame.
        p_source: Source points, source frame.
        is_outlier: Which source points belong to nothing.
        T_truth: The true T_target_source, or None where nobody knows it.
        T_start: The initial guess of T_target_source.
        frame: How the target stands in the picture, which is about its middle.
        spacing: Typical distance between neighbouring target points, metres.
        grid: Segments of a ground grid in the picture.
        cell: The edge of its squares, metres of the scans.
        p_target_shown: The target as the picture has it.
        p_source_shown: The source likewise, before any motion.
        n_target: Gives the normals of the target, computed when first asked for: unit vectors, or
            zero for a point that shall not pull because its neighbours lie along a line.
    """

    p_target: np.ndarray
    p_source: np.ndarray
    is_outlier: np.ndarray
    T_truth: np.ndarray | None
    T_start: np.ndarray
    frame: Frame
    spacing: float
    grid: np.ndarray
    cell: float
    p_target_shown: np.ndarray
    p_source_shown: np.ndarray
    n_target: Callable[[], np.ndarray]

    def about_centre(self, w_world: np.ndarray) -> np.ndarray:
        """Return the turn by a rotation vector of the picture about its middle, as a motion of the
        target frame.
        """
        return turn_about(self.frame.centre, exp_so3(self.frame.R_world_file.T @ w_world))

    def error(self, T_target_source: np.ndarray) -> MotionError:
        """Return how far a motion is from the truth, by the points that belong to something."""
        return motion_error(T_target_source, self.T_truth, self.p_source[~self.is_outlier])

    def at_home(self, error: MotionError) -> bool:
        """Tell whether a motion with this error is the true one, but for sampling.

        It turns by less than HOME_DEGREES, and its points are, by root mean square, less than
        HOME_SPACINGS times the spacing of the target's points away from where they belong. Not so
        where the truth is not known.
        """
        return error.rotation < HOME_DEGREES and error.displacement < HOME_SPACINGS * self.spacing

    def right_share(self, indices: np.ndarray, kept: np.ndarray) -> float:
        """Return the share of kept matches whose partner lies within two spacings of where the
        source point belongs.
        """
        if self.T_truth is None or not kept.any():
            return float("nan")
        off = self.p_target[indices[kept]] - apply(self.T_truth, self.p_source[kept])
        return float(
            np.mean(np.einsum("ij,ij->i", off, off) <= (HOME_SPACINGS * self.spacing) ** 2)
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class Try:
    """One start and where ICP ended from it.

    Attributes:
        start_angle: Degrees about the vertical, away from the truth.
        T_target_truth: The end as a motion of the truly placed source: the identity when it came
            home.
        error: How far that is from the truth.
        rmse: Of the kept matches at the end, metres.
    """

    start_angle: float
    T_target_truth: np.ndarray
    error: MotionError
    rmse: float


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One step of the lesson: a sub-step of ICP, or afterwards one more try from another start.

    Attributes:
        params: The inputs.
        scans: The clouds, the same for the whole run.
        icp: What ICP yielded (its last state, during the tries).
        rmse_before: RMSE of the kept matches one sub-step earlier, metres; NaN at first.
        turned: How far the last fit turned the source, degrees.
        error: How far the motion is from the truth.
        right: Share of the kept matches that are right (within two point spacings).
        tries: Ends from other starts, so far.
    """

    params: Params
    scans: Scans
    icp: icp.State
    rmse_before: float
    turned: float
    error: MotionError
    right: float
    tries: tuple[Try, ...] = ()

    @property
    def known(self) -> bool:
        """Whether the truth is known."""
        return self.scans.T_truth is not None

    @property
    def home(self) -> bool:
        """Whether the motion of ICP itself is the true one, but for sampling."""
        return self.scans.at_home(self.error)

    @property
    def edge(self) -> float | None:
        """The largest start angle up to which every try came home, degrees; None when not even the
        first did.
        """
        edge = None
        for attempt in self.tries:
            if not self.scans.at_home(attempt.error):
                break
            edge = attempt.start_angle
        return edge
