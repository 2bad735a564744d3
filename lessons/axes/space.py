"""The stages `space`, `frames` and `turn`: the frame of one cloud after the other, signs, and
frame on frame.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
import scipy

from lessons.axes.inputs import Input
from lessons.axes.scans import Scans, sample_of, second_scan
from workbench.algorithms.registration.jacobi import State as Rotated
from workbench.algorithms.registration.jacobi import jacobi
from workbench.certain import sure
from workbench.data.scan_shapes import sampler
from workbench.data.thinning import every
from workbench.geometry.motions import apply, motion
from workbench.geometry.motions.alignment import degrees_between, nearest_rotation
from workbench.geometry.motions.principal_axes import (
    canonical_signs,
    centroid_and_covariance,
    degrees_between_axes,
    largest_entry_signs,
    ordered,
    right_handed_frames,
    third_moments,
)
from workbench.geometry.points.metrics import rms
from workbench.lesson import Slot, cached
from workbench.tracing import untraced

TURNS, FRESH_TURNS = 100, 40
MOST_ASKED = 2000  # points whose nearest neighbour is looked up
HOME_DEGREES = 10.0
HAND = np.arange(-45.0, 46.0, 1.5)  # degrees: where a hand turns the frame to
SIDES = (0.6, 0.7, 0.8, 0.85, 0.9, 0.925, 0.95, 0.97, 0.98, 0.99, 1.0)  # metres
PAIRS = 40  # pairs of scans for each side

Moment = Literal[
    "cloud",
    "centroid",
    "covariance",
    "rotation",
    "hand",
    "order",
    "frame",
    "signs",
    "pose",
    "turns",
]


@dataclass(frozen=True, eq=False, kw_only=True)
class Outcome:
    """How well a motion brings the source to the target.

    Attributes:
        T_target_source: The motion.
        rotation: Degrees to the truth; NaN where that is not known.
        axes: Degrees between each axis, brought over by the truth, and its namesake of the target.
        gap: RMS distance from the moved source's points to the nearest of the target, metres.
    """

    T_target_source: np.ndarray
    rotation: float
    axes: np.ndarray | None
    gap: float

    @property
    def home(self) -> bool:
        """Whether it is the true rotation, but for sampling."""
        return self.rotation < HOME_DEGREES


@dataclass(frozen=True, eq=False, kw_only=True)
class Turns:
    """The same recipe on the second scan turned at random, many times.

    Attributes:
        degrees: How far each ended from the truth.
        tips: Where axes 1 and 2 came to lie in the target's frame, unit vectors (k, 2, 3).
        axes: How far each axis came from its namesake, whatever its sign, degrees (k, 3).
    """

    degrees: np.ndarray
    tips: np.ndarray
    axes: np.ndarray

    @property
    def home(self) -> np.ndarray:
        """Which came home."""
        return self.degrees < HOME_DEGREES


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One step; what is not known yet is None.

    Attributes:
        moment: What was done just now.
        p_centre: Centroid of the source, source frame.
        jacobi: The source's covariance and frame after the last rotation.
        before: Its covariance in the frame before that rotation.
        rotations: How many there were.
        variances: Of the source along its axes, falling.
        axes: The source's axes as they stand, source frame.
        axes_target: The target's, target frame.
        frames: What each of the four right-handed frames of the source comes to, once they are
            laid.
        frame: Which of the four is shown, or is the one that the signs choose; from 1.
        moments: Third moments of the source along its axes before they got signs, m^3.
        outcome: What comes of laying the frames as they stand on each other.
        turns: What comes of many turns.
        box: Volume of the box along the axes over that along the shape's own sides, or NaN.
    """

    moment: Moment
    p_centre: np.ndarray
    jacobi: Rotated | None = None
    before: np.ndarray | None = None
    rotations: int = 0
    variances: np.ndarray | None = None
    axes: np.ndarray | None = None
    axes_target: np.ndarray | None = None
    frames: tuple[Outcome, ...] = ()
    frame: int = 0
    moments: np.ndarray | None = None
    outcome: Outcome | None = None
    turns: Turns | None = None
    box: float = float("nan")


def steps(params: Input, scans: Scans, find: Slot | None, *, sign: Slot | None) -> Iterator[State]:
    """Yield the steps; where functions are given in place of ours (None), without the many
    turns.
    """
    p_centre, covariance = centroid_and_covariance(scans.p_source)
    state = State(moment="cloud", p_centre=p_centre)
    yield state
    yield replace(state, moment="centroid")
    for k, rotated in enumerate(jacobi(covariance)):
        before = state.jacobi.A if state.jacobi else None
        moment = "rotation" if k else "covariance"
        state = replace(state, moment=moment, jacobi=rotated, before=before, rotations=k)
        yield state
    axes, axes_target = ((find or by_jacobi)(p) for p in (scans.p_source, scans.p_target))
    variances = np.einsum("ij,ik,kj->j", axes, covariance, axes)
    state = replace(state, moment="order", variances=variances, axes=axes, axes_target=axes_target)
    yield state
    frames = outcomes(scans, p_centre, axes, axes_target=axes_target)
    moments = third_moments(axes, scans.p_source)
    axes = with_signs(axes, scans.p_source, params, sign=sign)
    axes_target = with_signs(axes_target, scans.p_target, params, sign=sign)
    outcome = outcome_of(scans, p_centre, axes, axes_target=axes_target)
    R = outcome.T_target_source
    chosen = [degrees_between(frame.T_target_source, R) for frame in frames]
    state = replace(
        state,
        moment="signs",
        frames=frames,
        frame=int(np.argmin(chosen)) + 1,
        moments=moments,
        axes=axes,
        axes_target=axes_target,
        outcome=outcome,
    )
    yield state
    state = replace(state, moment="pose", box=box_ratio(scans, axes))
    yield state
    if find is None and sign is None and scans.T_target_source is not None:
        yield replace(state, moment="turns", turns=many_turns(params, scans, axes_target))


def candidates(scans: Scans, find: Slot | None) -> Iterator[State]:
    """Yield the axes of both as lines, then the four frames of the source laid on the target's."""
    p_centre, covariance = centroid_and_covariance(scans.p_source)
    *_, rotated = jacobi(covariance)
    axes, axes_target = ((find or by_jacobi)(p) for p in (scans.p_source, scans.p_target))
    state = State(
        moment="order",
        p_centre=p_centre,
        jacobi=rotated,
        axes=axes,
        axes_target=axes_target,
        variances=np.einsum("ij,ik,kj->j", axes, covariance, axes),
        frames=outcomes(scans, p_centre, axes, axes_target=axes_target),
    )
    yield state
    for k, right_handed in enumerate(right_handed_frames(axes)):
        yield replace(state, moment="frame", axes=right_handed, frame=k + 1)


def outcomes(
    scans: Scans, p_centre: np.ndarray, axes: np.ndarray, *, axes_target: np.ndarray
) -> tuple[Outcome, ...]:
    """Return what comes of laying each right-handed frame with these axes on the target's."""
    return tuple(
        outcome_of(scans, p_centre, frame, axes_target=axes_target)
        for frame in right_handed_frames(axes)
    )


def by_hand(scans: Scans) -> Iterator[State]:
    """Yield the frame at each angle of HAND in the plane of the largest entry off the diagonal."""
    p_centre, covariance = centroid_and_covariance(scans.p_source)
    _, first, *_ = jacobi(covariance)
    i, j = sure(first.plane)
    for degrees in HAND:
        angle = float(np.radians(degrees))
        G = np.eye(3)
        c, s = np.cos(angle), np.sin(angle)
        G[[i, j, i, j], [i, j, j, i]] = c, c, -s, s
        A = G.T @ covariance @ G
        off = float(np.linalg.norm(A - np.diag(np.diag(A))) / np.linalg.norm(A))
        rotated = Rotated(A, G, (i, j), angle, off)
        yield State(moment="hand", p_centre=p_centre, jacobi=rotated, before=covariance)


def by_jacobi(p: np.ndarray) -> np.ndarray:
    """Return the principal axes with the signs that Jacobi's rotations happen to leave."""
    *_, last = jacobi(centroid_and_covariance(p)[1])
    return ordered(np.diag(last.A).copy(), last.V)[1]


def with_signs(
    axes: np.ndarray, p: np.ndarray, params: Input, *, sign: Slot | None = None
) -> np.ndarray:
    """Return axes with the signs of the chosen rule."""
    if params.signs == "none":
        return axes
    if params.signs == "largest-entry":
        return largest_entry_signs(axes)
    return (sign or canonical_signs)(axes, p)


def outcome_of(
    scans: Scans, p_centre: np.ndarray, axes: np.ndarray, *, axes_target: np.ndarray
) -> Outcome:
    """Return what comes of laying one frame on the other: R = V_target V_source^T."""
    R = axes_target @ axes.T
    T = motion(R, scans.p_target.mean(axis=0) - R @ p_centre)
    gap = gap_of(T, scans)
    T_true = scans.T_target_source
    if T_true is None:
        return Outcome(T_target_source=T, rotation=float("nan"), axes=None, gap=gap)
    R_true = nearest_rotation(T_true[:3, :3])
    return Outcome(
        T_target_source=T,
        rotation=degrees_between(T, T_true),
        axes=degrees_between_axes(R_true @ axes, axes_target),
        gap=gap,
    )


def gap_of(T_target_source: np.ndarray, scans: Scans) -> float:
    """Return the RMS distance from the moved source to the nearest points of the target, metres."""
    p = scans.p_source[every(len(scans.p_source), MOST_ASKED)]
    tree = scipy.spatial.KDTree(scans.p_target)
    return rms(np.asarray(tree.query(apply(T_target_source, p))[0]))


def box_ratio(scans: Scans, axes: np.ndarray) -> float:
    """Return the volume of the box along the source's axes over that along the shape's own
    sides.
    """
    if scans.sides is None or scans.T_target_source is None:
        return float("nan")
    p = scans.p_source
    along_axes = p @ axes
    along_sides = p @ scans.T_target_source[:3, :3].T
    return float(np.prod(np.ptp(along_axes, axis=0)) / np.prod(np.ptp(along_sides, axis=0)))


def many_turns(params: Input, scans: Scans, axes_target: np.ndarray) -> Turns:
    """Turn the second scan at random, find its frame by the same recipe, bring it over by the
    truth.
    """
    is_fresh = params.target is None and params.fresh
    rng = np.random.default_rng(params.seed)
    count = FRESH_TURNS if is_fresh else TURNS
    turns = scipy.spatial.transform.Rotation.random(count, rng).as_matrix()
    R = sure(scans.T_target_source)[:3, :3]
    brought = []
    for Q in turns:
        p_source = scans.p_source
        if is_fresh:
            p_source = second_scan(params, sample_of(params), R, rng=rng)
        p_turned = p_source @ Q.T
        brought.append(R @ Q.T @ with_signs(by_jacobi(p_turned), p_turned, params))
    return Turns(
        degrees=np.array([degrees_between(axes_target, axes) for axes in brought]),
        tips=np.stack(brought)[:, :, :2].transpose(0, 2, 1),
        axes=np.stack([degrees_between_axes(axes_target, axes) for axes in brought]),
    )


@cached
def off_by_side(params: Input) -> np.ndarray:
    """Return how far axis 1 of one scan of a box is from that of another, degrees, at each of
    SIDES.

    The medians of PAIRS pairs of scans.
    """
    medians = []
    with untraced():
        for side in SIDES:
            rng = np.random.default_rng(params.seed)
            sample = sampler("box", side)
            pairs = []
            for _ in range(PAIRS):
                first, second = (
                    centroid_and_covariance(sample(params.points, rng))[1] for _ in range(2)
                )
                axes = [np.linalg.eigh(C)[1][:, ::-1] for C in (first, second)]
                pairs.append(degrees_between_axes(*axes)[0])
            medians.append(np.median(pairs))
    return np.array(medians)
