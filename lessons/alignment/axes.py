"""The steps: the frame of one cloud after the other, their signs, and what laying them on each
other gives.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
import scipy

from lessons.alignment.scans import box_sides, scans_of, second_scan
from lessons.alignment.state import Outcome, Params, Scans, State, Turns
from workbench.algorithms.registration.jacobi import jacobi
from workbench.certain import sure
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

FindAxes = Callable[[np.ndarray], np.ndarray]
"""principal_axes(p) -> 3x3, axes in columns by falling variance."""
Sign = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""canonical_signs(axes, p) -> the axes with their signs."""

TURNS, FRESH_TURNS = 100, 40
MOST_ASKED = 2000  # points whose nearest neighbour is looked up


def steps(params: Params, find: FindAxes | None, sign: Sign | None) -> Iterator[State]:
    """Yield the steps; where functions are given in place of ours (None), they end before the
    many turns.
    """
    scans = scans_of(params)
    p_centre, covariance = centroid_and_covariance(scans.p_source)
    state = State(params=params, scans=scans, moment="cloud", p_centre=p_centre)
    yield state
    yield replace(state, moment="centroid")
    for k, now in enumerate(jacobi(covariance)):
        before = state.jacobi.A if state.jacobi else None
        state = replace(
            state, moment="rotation" if k else "covariance", jacobi=now, before=before, rotations=k
        )
        yield state
    axes, axes_target = ((find or by_jacobi)(p) for p in (scans.p_source, scans.p_target))
    state = replace(
        state,
        moment="order",
        variances=np.einsum("ij,ik,kj->j", axes, covariance, axes),
        axes=axes,
        axes_target=axes_target,
        frames=len(right_handed_frames(axes)),
    )
    yield state
    state = signed(state, sign or canonical_signs)
    yield state
    state = replace(state, moment="pose", box=box_ratio(state))
    yield state
    if find is None and sign is None and scans.T_target_source is not None:
        yield replace(state, moment="turns", turns=many_turns(params, scans, signed_axes(state)[1]))


def by_jacobi(p: np.ndarray) -> np.ndarray:
    """Return the principal axes with the signs that Jacobi's rotations happen to leave."""
    *_, last = jacobi(centroid_and_covariance(p)[1])
    return ordered(np.diag(last.A).copy(), last.V)[1]


def with_signs(
    axes: np.ndarray, p: np.ndarray, params: Params, sign: Sign = canonical_signs
) -> np.ndarray:
    """Return axes with the signs of the chosen rule."""
    if params.signs == "none":
        return axes
    return largest_entry_signs(axes) if params.signs == "largest-entry" else sign(axes, p)


def signed(state: State, sign: Sign) -> State:
    """Return the step in which both frames get their signs."""
    axes, axes_target = signed_axes(state)
    scans, params = state.scans, state.params
    state = replace(
        state,
        moment="signs",
        moments=third_moments(axes, scans.p_source),
        axes=with_signs(axes, scans.p_source, params, sign),
        axes_target=with_signs(axes_target, scans.p_target, params, sign),
    )
    return replace(state, outcome=outcome_of(state))


def signed_axes(state: State) -> tuple[np.ndarray, np.ndarray]:
    """Return both frames of a state that has them."""
    return sure(state.axes), sure(state.axes_target)


def outcome_of(state: State) -> Outcome:
    """Return what comes of laying the two frames on each other: R = V_target V_source^T."""
    axes, axes_target = signed_axes(state)
    scans = state.scans
    R = axes_target @ axes.T
    T = motion(R, scans.p_target.mean(axis=0) - R @ state.p_centre)
    if scans.T_target_source is None:
        return Outcome(T_target_source=T, rotation=float("nan"), axes=None, gap=gap(T, scans))
    R_true = nearest_rotation(scans.T_target_source[:3, :3])
    return Outcome(
        T_target_source=T,
        rotation=degrees_between(T, scans.T_target_source),
        axes=degrees_between_axes(R_true @ axes, axes_target),
        gap=gap(T, scans),
    )


def gap(T_target_source: np.ndarray, scans: Scans) -> float:
    """Return the root mean square distance from the moved source to the nearest points of the
    target, metres.
    """
    p = scans.p_source[every(len(scans.p_source), MOST_ASKED)]
    return rms(np.asarray(scipy.spatial.KDTree(scans.p_target).query(apply(T_target_source, p))[0]))


def box_ratio(state: State) -> float:
    """Return the volume of the box along the source's axes over that of the box along the
    shape's own sides.
    """
    sides, T = box_sides(state.params), state.scans.T_target_source
    if sides is None or T is None:
        return float("nan")
    p = state.scans.p_source
    along_axes, along_sides = p @ signed_axes(state)[0], p @ T[:3, :3].T
    return float(np.prod(np.ptp(along_axes, axis=0)) / np.prod(np.ptp(along_sides, axis=0)))


def many_turns(params: Params, scans: Scans, axes_target: np.ndarray) -> Turns:
    """Turn the second scan at random, find its frame by the same recipe, and bring it over by
    the truth.
    """
    assert scans.T_target_source is not None
    rng = np.random.default_rng(params.seed)
    turns = scipy.spatial.transform.Rotation.random(
        FRESH_TURNS if params.fresh else TURNS, rng=rng
    ).as_matrix()
    brought = []
    for Q in turns:
        p_source = second_scan(params, rng) if params.fresh else scans.p_source
        p_turned, R_true = p_source @ Q.T, scans.T_target_source[:3, :3] @ Q.T
        brought.append(R_true @ with_signs(by_jacobi(p_turned), p_turned, params))
    return Turns(
        degrees=np.array([degrees_between(axes_target, axes) for axes in brought]),
        tips=np.stack(brought)[:, :, :2].transpose(0, 2, 1),
        axes=np.stack([degrees_between_axes(axes_target, axes) for axes in brought]),
    )
