"""Finds a camera by three points and a fourth, by a plane's two answers, and by Gauss-Newton steps.

Points are in metres. Image coordinates `xy` are normalised, so errors are too: times the focal
length they are pixels. Motions are T_camera_world.

Reference: Haralick et al., Review and Analysis of Solutions of the Three Point Perspective Pose
Estimation Problem, 1994 (three points); Collins and Bartoli, Infinitesimal Plane-Based Pose
Estimation, 2014 (planes); Nocedal and Wright, Numerical Optimization, 2nd ed., 3.1 and 10.3 (a step
that is halved, Gauss-Newton).
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from enum import Enum
from typing import Literal

import numpy as np
from jaxtyping import Float, Int

from workbench.geometry.cameras.camera_motions import refined, rms_reprojection
from workbench.geometry.cameras.planar_motions import planar_motions
from workbench.geometry.cameras.three_points import p3p, quartics, three_point_lengths, unit_rays
from workbench.geometry.motions import exp_se3, inverse, log_se3, motion
from workbench.geometry.motions.alignment import align_rigid, nearest_rotation
from workbench.tracing import traced

Phase = Literal["rays", "quartic", "root", "both", "choose", "solved", "step", "stop"]
PoseFromDistances = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]
ChoosePose = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]
PoseStep = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]
SHARES = (1.0, 0.5, 0.25, 0.125, 0.0625)
_NONE = np.zeros((0, 4, 4))
_NONE.setflags(write=False)


class Stop(Enum):
    """Why the way downhill ended."""

    SETTLED = "the steps no longer lower the error"
    NOT_LOWER = "no part of the step lowers the error"
    MOST_STEPS = "the most steps are taken"
    BEHIND = "a point lies behind the camera, so there is nothing to go down on"
    NO_POSE = "there is no pose to begin with"

    @property
    def message(self) -> str:
        """The reason in words."""
        return self.value


@dataclass(frozen=True, eq=False, kw_only=True)
class Searched:
    """What is known of the camera after one step.

    Attributes:
        T: The motion now, or None.
        candidates: All motions that were found, in the order in which they were.
        lengths: Of the three rays, metres, one row for each root that has become a motion or will.
        quartic: Its coefficients, the highest power first.
        error: Root mean square reprojection error of T, infinite if a point is behind it.
        share: Of a Gauss-Newton step that was taken; 1 if not halved.
        stop: Why this is the last state, or None.
    """

    phase: Phase
    T: Float[np.ndarray, "4 4"] | None = None
    candidates: Float[np.ndarray, "m 4 4"] = field(default_factory=lambda: _NONE)
    lengths: Float[np.ndarray, "r 3"] = field(default_factory=lambda: _NONE[:, 0, :3])
    quartic: Float[np.ndarray, " q"] = field(default_factory=lambda: _NONE[:, 0, 0])
    error: float = np.inf
    share: float = 1.0
    steps: int = 0
    stop: Stop | None = None


def pose_from_distances(
    p_world: Float[np.ndarray, "3 3"],
    rays: Float[np.ndarray, "3 3"],
    distances: Float[np.ndarray, "3"],
) -> Float[np.ndarray, "4 4"]:
    """Return the motion that takes three points to these distances along unit rays."""
    return align_rigid(distances[:, None] * rays, p_world)


def choose_pose(
    candidates: Float[np.ndarray, "m 4 4"],
    p_world: Float[np.ndarray, "n 3"],
    xy: Float[np.ndarray, "n 2"],
) -> Float[np.ndarray, "4 4"]:
    """Return the candidate with the least reprojection error of those with all points in front.

    Where none has all points in front it is the first.
    """
    return candidates[int(np.argmin(rms_reprojection(candidates, p_world, xy)))].copy()


@traced
def by_three_points(
    p_world: Float[np.ndarray, "n 3"],
    xy: Float[np.ndarray, "n 2"],
    pose_from_distances: PoseFromDistances = pose_from_distances,
    *,
    choose_pose: ChoosePose = choose_pose,
) -> Iterator[Searched]:
    """Yield the motions that three points leave open, and how the fourth chooses among them."""
    p = p_world[:3]
    rays = unit_rays(xy[:3])
    state = Searched(phase="rays")
    yield state
    quartic = quartics(p[None], rays[None])[0]
    lengths, _ = three_point_lengths(p[None], rays[None])
    state = replace(state, phase="quartic", quartic=quartic, lengths=lengths)
    yield state
    for distances in lengths:
        T = np.asarray(pose_from_distances(p, rays, distances), float)
        state = replace(
            state, phase="root", T=T, candidates=np.concatenate([state.candidates, T[None]])
        )
        yield state
    if len(lengths):
        T = np.asarray(choose_pose(state.candidates, p_world[:4], xy[:4]), float)
        yield replace(state, phase="choose", T=T, error=_error(T, p_world, xy))


def by_fourth_points(
    p_world: Float[np.ndarray, "n 3"], xy: Float[np.ndarray, "k n 2"]
) -> tuple[Float[np.ndarray, "m 4 4"], Int[np.ndarray, " m"]]:
    """Return the ends of `by_three_points` in many pictures, and of which picture each is.

    Some pictures have no solution.
    """
    Ts, of_picture = p3p(np.broadcast_to(p_world[:3], (len(xy), 3, 3)), xy[:, :3])
    order = np.lexsort([rms_reprojection(Ts, p_world[:4], xy[of_picture, :4]), of_picture])
    _, first = np.unique(of_picture[order], return_index=True)
    return Ts[order[first]], of_picture[order[first]]


def planar_pairs(
    p_world: Float[np.ndarray, "n 3"], xy: Float[np.ndarray, "k n 2"]
) -> Float[np.ndarray, "k 2 4 4"]:
    """Return both motions of a plane in many pictures, refined, the one that fits better first."""
    twice = np.repeat(xy, 2, axis=0)
    both = refined(planar_motions(p_world, xy).reshape(-1, 4, 4), p_world, twice)
    order = np.argsort(rms_reprojection(both, p_world, twice).reshape(-1, 2), axis=1)
    return both.reshape(-1, 2, 4, 4)[np.arange(len(xy))[:, None], order]


@traced
def by_plane(
    p_world: Float[np.ndarray, "n 3"],
    xy: Float[np.ndarray, "n 2"],
    choose_pose: ChoosePose = choose_pose,
) -> Iterator[Searched]:
    """Yield a plane's two motions, refined, and the one that fits better."""
    Ts = planar_motions(p_world, xy)
    yield Searched(phase="both", candidates=Ts)
    Ts = refined(Ts, p_world, xy)
    T = np.asarray(choose_pose(Ts, p_world, xy), float)
    yield Searched(phase="choose", T=T, candidates=Ts, error=_error(T, p_world, xy))


@traced
def downhill(
    T: Float[np.ndarray, "4 4"] | None,
    p_world: Float[np.ndarray, "n 3"],
    xy: Float[np.ndarray, "n 2"],
    *,
    pose_step: PoseStep,
    most: int = 12,
    tolerance: float = 1e-5,
) -> Iterator[Searched]:
    """Yield the motions after each step on the squared errors; a step that raises them is halved.

    Args:
        T: Where to begin; None where nothing was found.
        pose_step: Gives the motion after one whole step.
        most: Steps taken at most.
        tolerance: It is settled where a step lowers the error by less than this share.
    """
    stop = Stop.NO_POSE
    steps = 0
    error = np.inf
    if T is not None:
        error = _error(T, p_world, xy)
        stop = Stop.MOST_STEPS if np.isfinite(error) else Stop.BEHIND
        for steps in range(1, most + 1) if np.isfinite(error) else ():
            whole = np.asarray(pose_step(T, p_world, xy), float)
            tried = ((share, _part(T, whole, share)) for share in SHARES)
            lower = next(((s, T_s) for s, T_s in tried if _error(T_s, p_world, xy) < error), None)
            if lower is None:
                near = _error(whole, p_world, xy) <= error * (1.0 + tolerance)
                stop = Stop.SETTLED if near else Stop.NOT_LOWER
                steps = steps - 1
                break
            (share, T), before = lower, error
            error = _error(T, p_world, xy)
            yield Searched(phase="step", T=T, error=error, share=share, steps=steps)
            if before - error <= tolerance * before:
                stop = Stop.SETTLED
                break
    yield Searched(phase="stop", T=T, error=error, steps=steps, stop=stop)


def _part(T: np.ndarray, whole: np.ndarray, share: float) -> np.ndarray:
    """Return the motion a share of the way along the screw from T to a whole step."""
    if share == 1.0 or not np.isfinite(whole).all():
        return whole
    moved = whole @ inverse(T)
    return exp_se3(share * log_se3(motion(nearest_rotation(moved[:3, :3]), moved[:3, 3]))) @ T


def _error(T: np.ndarray, p_world: np.ndarray, xy: np.ndarray) -> float:
    error = float(rms_reprojection(T, p_world, xy))
    return error if np.isfinite(error) else np.inf
