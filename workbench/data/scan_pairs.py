"""Two scans of one thing, thinned for descriptors, fine for ICP, and their true motion."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from jaxtyping import Bool, Int

from workbench.data.files import read_cloud, read_pose
from workbench.data.framing import FAR, Up, extent, frame
from workbench.data.thinning import some_points, voxel_means
from workbench.errors import InputError
from workbench.geometry.motions import apply, motion
from workbench.geometry.motions.alignment import MotionError, motion_error

FINE_SOURCE, FINE_TARGET = 5000, 40_000
FEWEST, MOST = 20, 5000  # points after thinning


@dataclass(frozen=True, eq=False, kw_only=True)
class Scans:
    """Two scans in their own frames, metres, thinned and as ICP has them.

    Attributes:
        T_truth: The true T_target_source; None where nobody knows it.
        own: Whether they are a person's.
    """

    p_target: np.ndarray
    p_source: np.ndarray
    fine_target: np.ndarray
    fine_source: np.ndarray
    T_truth: np.ndarray | None
    own: bool = False

    def error(self, T_target_source: np.ndarray) -> MotionError:
        """Return how far a motion is from the truth."""
        return motion_error(T_target_source, self.T_truth, self.p_source)

    def right(
        self, pairs: Int[np.ndarray, "n 2"], distance: float
    ) -> Bool[np.ndarray, " n"] | None:
        """Return which pairs (source, target) are that near in truth; None if not known."""
        if self.T_truth is None:
            return None
        off = apply(self.T_truth, self.p_source[pairs[:, 0]]) - self.p_target[pairs[:, 1]]
        return np.linalg.norm(off, axis=1) < distance


def read_scans(
    target: Path,
    source: Path,
    truth: Path | None,
    *,
    width: float,
    up: Up,
    voxel: float,
    rng: np.random.Generator,
) -> Scans:
    """Return a person's two scans, each about its own middle, in one unit.

    Args:
        truth: The source's pose in the target's frame, in the unit of the files, or a list of
            poses.
        width: The longest edge of the target's box in the picture, metres.
        voxel: The edge of the voxels that thin them, as a share of that edge.
        rng: Draws what ICP has.

    Raises:
        InputError: If a file cannot be read, a scan is one place, or too few or too many points are
            left.
    """
    files = (target, source)
    p = [read_cloud(file) for file in (target, source)]
    for file, points in zip(files, p, strict=True):
        if not extent(points, FAR) > 0:
            raise InputError(f"{file.name}: all its points lie at one place")
    how = frame(p[0], width, up=up, far=FAR)
    theirs = replace(how, centre=frame(p[1], width, up=up, far=FAR).centre)
    fine = how.shown(p[0]), theirs.shown(p[1])
    thinned = [voxel_means(points, voxel * width) for points in fine]
    for file, points in zip(files, thinned, strict=True):
        if len(points) < FEWEST:
            raise InputError(
                f"{file.name}: {len(points)} points are left after thinning; {FEWEST} at least are"
                " needed"
            )
        if len(points) > MOST:
            raise InputError(
                f"{file.name}: {len(points):,} points after thinning, at most {MOST:,}; raise voxel"
            )
    T_truth = None
    if truth is not None:
        T_truth = how.shown_motion(read_pose(truth, *files)) @ motion(
            np.eye(3), how.shown(theirs.centre)
        )
    return Scans(
        p_target=thinned[0],
        p_source=thinned[1],
        fine_target=some_points(fine[0], FINE_TARGET, rng),
        fine_source=some_points(fine[1], FINE_SOURCE, rng),
        T_truth=T_truth,
        own=True,
    )
