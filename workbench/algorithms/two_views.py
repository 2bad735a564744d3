"""From matches to the motion between two cameras; and one pixel's ray seen by the other camera.

Pixels are `uv`, intrinsics K in pixels; motions T_second_first take the first camera's frame to the
second's, lengths in units of the baseline where it is not known.

Reference: Hartley and Zisserman, Multiple View Geometry, 2nd ed., 9.1 (the line), 11.2 (eight
points), 9.6 (four motions), chapter 12 (triangulation), 11.4.3 (refinement); Fusiello, Trucco and
Verri 2000 (rectification).
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from jaxtyping import Float

from workbench.errors import InputError
from workbench.geometry.cameras import normalize
from workbench.geometry.motions import angle_between, apply
from workbench.geometry.two_views.epipolar import (
    epipolar_constraints,
    fundamental_from_cameras,
    rank_two,
    refine_fundamental,
)
from workbench.geometry.two_views.essential import (
    equal_singular_values,
    essential_from_fundamental,
    refine_motion,
)
from workbench.geometry.two_views.homography import homogeneous
from workbench.geometry.two_views.rectification import Rectification, rectify
from workbench.geometry.two_views.triangulation import before_both, camera_matrix
from workbench.tracing import traced

EightPoint = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""eight_point(uv_first, uv_second) -> F (3, 3)."""
Poses = Callable[[np.ndarray], np.ndarray]
"""essential_to_poses(E) -> the four motions T_second_first (4, 4, 4), translations of length 1."""
Triangulate = Callable[[np.ndarray, np.ndarray, np.ndarray, np.ndarray], np.ndarray]
"""triangulate(P_first, P_second, uv_first, uv_second) -> points (n, 3) in the first camera's frame.
"""
Route = Literal["eight-point", "refined F", "refined pose"]
Stage = Literal[
    "equations",
    "rank three",
    "rank two",
    "refined F",
    "essential",
    "pose",
    "points",
    "refined",
    "rectified",
]

MOST_ROUNDS = 8
STILL = 1e-4  # radians: a round that turns less is the last
FAR = 1e6  # metres for a point at infinity


@dataclass(frozen=True, eq=False, kw_only=True)
class Followed:
    """The ray of one pixel, as far as it was followed.

    Attributes:
        stage: "ray" while points are taken on it; then the plane through both centres, then the
            pencil of all lines.
        depths: Of the points so far, metres; infinity is the last.
        p_first: The points, metres; the one at infinity very far away.
        uv_second: Their pixels in the second picture, NaN where it cannot see them.
    """

    stage: Literal["ray", "plane", "pencil"]
    depths: Float[np.ndarray, " k"]
    p_first: Float[np.ndarray, "k 3"]
    uv_second: Float[np.ndarray, "k 2"]


@dataclass(frozen=True, eq=False, kw_only=True)
class Related:
    """How far the motion between two cameras is found.

    Attributes:
        singular_values: Of the equations, nine; the last belongs to the answer.
        F: The fundamental matrix so far.
        E_values: Of the essential matrix before they were made equal.
        tested: Motions that were tried, with |t| = 1.
        in_front: How many points each of them puts in front of both cameras.
        T_second_first: The one under test, then the chosen one, then the refined one.
        p_first: The points by that motion.
        rounds: Rounds of refinement done.
        rectification: In the end, where there is one.
    """

    stage: Stage
    singular_values: Float[np.ndarray, "9"]
    F: Float[np.ndarray, "3 3"]
    E_values: Float[np.ndarray, "3"] | None = None
    tested: Float[np.ndarray, "k 4 4"]
    in_front: tuple[int, ...] = ()
    T_second_first: Float[np.ndarray, "4 4"] | None = None
    p_first: Float[np.ndarray, "n 3"] | None = None
    rounds: int = 0
    rectification: Rectification | None = None


@traced
def follow_ray(
    uv_first: Float[np.ndarray, "2"],
    depths: Float[np.ndarray, " m"],
    T_second_first: Float[np.ndarray, "4 4"],
    *,
    K_first: Float[np.ndarray, "3 3"],
    K_second: Float[np.ndarray, "3 3"],
) -> Iterator[Followed]:
    """Yield ever more points of a pixel's ray and their second pixels, its plane, the pencil.

    Depths are in metres, infinity allowed.
    """
    ray = homogeneous(normalize(uv_first[None], K_first))[0]
    p_first = np.minimum(depths, FAR)[:, None] * ray
    u, v, w = K_second @ apply(T_second_first, p_first).T
    uv_second = np.stack([u, v], axis=1) / np.where(w > 0.0, w, np.nan)[:, None]
    state = Followed(stage="ray", depths=depths[:0], p_first=p_first[:0], uv_second=uv_second[:0])
    for k in range(1, len(depths) + 1):
        state = replace(state, depths=depths[:k], p_first=p_first[:k], uv_second=uv_second[:k])
        yield state
    if np.any(T_second_first[:3, 3]):  # without a baseline there is neither plane nor pencil
        yield replace(state, stage="plane")
        yield replace(state, stage="pencil")


@dataclass(frozen=True, eq=False)
class Linear:
    """The linear answer to the equations of some matches.

    Attributes:
        singular_values: Of the equations, nine.
        F: In pixels, of rank three where the matches have noise.
        F_rank_two: Without its smallest singular value, in the coordinates of the equations.
    """

    singular_values: np.ndarray
    F: np.ndarray
    F_rank_two: np.ndarray


def solve_linear(
    uv_first: Float[np.ndarray, "n 2"],
    uv_second: Float[np.ndarray, "n 2"],
    T_first: Float[np.ndarray, "3 3"],
    *,
    T_second: Float[np.ndarray, "3 3"],
) -> Linear:
    """Return the answer with the least algebraic error in given coordinates, T times the pixels.

    Reference: Hartley, In Defense of the Eight-Point Algorithm, PAMI 1997.
    """
    constraints = epipolar_constraints(
        (T_first @ homogeneous(uv_first).T).T, (T_second @ homogeneous(uv_second).T).T
    )
    _, values, Vt = np.linalg.svd(constraints)
    F, F_two = (
        T_second.T @ G @ T_first for G in (Vt[-1].reshape(3, 3), rank_two(Vt[-1].reshape(3, 3)))
    )
    nine = np.zeros(9)
    nine[: len(values)] = values
    return Linear(nine, F / np.linalg.norm(F), F_two / np.linalg.norm(F_two))


@traced
def relate(
    uv_first: Float[np.ndarray, "n 2"],
    uv_second: Float[np.ndarray, "n 2"],
    K_first: Float[np.ndarray, "3 3"],
    *,
    K_second: Float[np.ndarray, "3 3"],
    linear: Linear,
    eight_point: EightPoint,
    essential_to_poses: Poses,
    triangulate: Triangulate,
    route: Route,
    keep_upright: bool = True,
) -> Iterator[Related]:
    """Yield the way from eight matches or more to F, E, four motions, points, and a rectified pair.

    Args:
        linear: The equations' answer before anything is known of F's rank.
        route: What is refined, and whether.
        keep_upright: As `rectify` takes it.

    Raises:
        InputError: If one of the functions returns what is no number.
    """
    none = np.empty((0, 4, 4))
    yield Related(
        stage="equations", singular_values=linear.singular_values, F=linear.F, tested=none
    )
    state = Related(
        stage="rank three", singular_values=linear.singular_values, F=linear.F, tested=none
    )
    yield state
    F = _numbers(eight_point(uv_first, uv_second), "eight_point")
    state = replace(state, stage="rank two", F=F)
    yield state
    for k in range(MOST_ROUNDS if route == "refined F" else 0):
        before = F
        F = refine_fundamental(F, uv_first, uv_second, steps=1)
        state = replace(state, stage="refined F", F=F, rounds=k + 1)
        yield state
        if np.abs(F * np.sign((F * before).sum()) - before).max() < STILL * np.abs(F).max():
            break

    E = essential_from_fundamental(F, K_first, K_second)
    E_values = np.linalg.svd(E)[1]
    E = equal_singular_values(E)
    yield (state := replace(state, stage="essential", E_values=E_values))
    Ts = _numbers(essential_to_poses(E), "essential_to_poses")
    P_first = camera_matrix(K_first, np.eye(4))
    points = [triangulate(P_first, camera_matrix(K_second, T), uv_first, uv_second) for T in Ts]
    in_front = tuple(int(before_both(p, T).sum()) for p, T in zip(points, Ts, strict=True))
    for k in range(len(Ts)):
        tested = Ts[: k + 1]
        state = replace(
            state,
            stage="pose",
            tested=tested,
            in_front=in_front[: k + 1],
            T_second_first=Ts[k],
            p_first=points[k],
        )
        yield state
    best = int(np.argmax(in_front))
    T_second_first = Ts[best]
    yield (
        state := replace(state, stage="points", T_second_first=T_second_first, p_first=points[best])
    )

    for k in range(MOST_ROUNDS if route == "refined pose" else 0):
        before = T_second_first
        T_second_first = refine_motion(
            T_second_first, uv_first, uv_second, K_first=K_first, K_second=K_second, steps=1
        )
        p_first = triangulate(P_first, camera_matrix(K_second, T_second_first), uv_first, uv_second)
        F = fundamental_from_cameras(K_first, K_second, T_second_first)
        state = replace(
            state,
            stage="refined",
            T_second_first=T_second_first,
            p_first=p_first,
            F=F,
            rounds=k + 1,
        )
        yield state
        if _moved(before, T_second_first) < STILL:
            break
    try:
        rectification = rectify(T_second_first, K_first, K_second, keep_upright=keep_upright)
    except ValueError:
        rectification = None
    yield replace(state, stage="rectified", rectification=rectification)


def _moved(T: np.ndarray, other: np.ndarray) -> float:
    """Return by how much the rotation or the direction changed, radians."""
    return max(
        float(np.abs(T[:3, :3] - other[:3, :3]).max()), angle_between(T[:3, 3], other[:3, 3])
    )


def _numbers(answer: np.ndarray, name: str) -> np.ndarray:
    if not np.isfinite(answer).all():
        raise InputError(f"{name} returned what is no number; nothing can be made of it")
    return answer
