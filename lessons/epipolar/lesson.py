"""Epipolar geometry: a pixel of one picture is a line of the other, and many matches hold the motion of the camera.

What it teaches: where the other camera's centre is seen all lines meet; eight matches and a singular value decomposition
give the lines, K makes a motion of them, up to four readings and an unknown length; and some matches hold no motion at all.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from lessons.epipolar.draw import VIEW, draw
from lessons.epipolar.exercises.eight_point import eight_point
from lessons.epipolar.exercises.essential_to_poses import essential_to_poses
from lessons.epipolar.exercises.triangulate import triangulate
from lessons.epipolar.experiments import PRESETS, QUESTIONS
from lessons.epipolar.state import MOST_MATCHES, Params, State
from workbench.algorithms.two_views import EightPoint, Poses, Triangulate, follow_ray, relate, solve_linear
from workbench.data.two_views import TwoViews, own_views, street_views
from workbench.geometry.cameras import normalize
from workbench.geometry.epipolar import fit_fundamental
from workbench.geometry.essential import essential_from_fundamental
from workbench.geometry.essential import essential_to_poses as essential_motions
from workbench.geometry.homography import normalising_similarity
from workbench.geometry.motions import motion
from workbench.geometry.triangulation import midpoints
from workbench.lesson import Lesson, Sweep

DEPTHS = np.array([3.0, 4.0, 6.0, 8.0, 12.0, np.inf])  # metres along the ray of the followed pixel
SHOWN_DEPTH = 9.0  # metres that the middle of an own scene is drawn away


def run(
    params: Params,
    *,
    eight_point: EightPoint = eight_point,
    essential_to_poses: Poses = essential_to_poses,
    triangulate: Triangulate = triangulate,
) -> Iterator[State]:
    """Yield the line of one pixel, where the true cameras are known, and the way from matches to a motion."""
    views = views_of(params)
    w, h = views.sizes[0]
    length, T = drawn_length(views), views.T_second_first
    if T is not None and np.any(T[:3, 3]):
        T = motion(T[:3, :3], length * T[:3, 3] / np.linalg.norm(T[:3, 3]))
    known: dict[str, Any] = {
        "params": params,
        "views": views,
        "uv_first": np.minimum(np.array(params.pixel, float) * views.strides[0], [w - 1.0, h - 1.0]),
        "K_first": with_f(views.K_first, params.f_error),
        "K_second": with_f(views.K_second, params.f_error),
        "length": length,
        "T_true": T,
    }
    if T is not None:
        for now in follow_ray(known["uv_first"], DEPTHS, T, views.K_first, views.K_second):
            yield State(**known, now=now)

    uv_first, uv_second = views.matches[:, :2], views.matches[:, 2:]
    scales = normalising_similarity(np.stack([uv_first, uv_second])) if params.normalise else np.stack([np.eye(3)] * 2)
    linear = solve_linear(uv_first, uv_second, *scales)
    if not (params.normalise and params.rank_two):
        F = linear.F_rank_two if params.rank_two else linear.F
        eight_point = lambda *_: F  # noqa: E731
    for now in relate(
        uv_first,
        uv_second,
        known["K_first"],
        known["K_second"],
        linear=linear,
        eight_point=eight_point,
        essential_to_poses=essential_to_poses,
        triangulate=triangulate,
        route=params.route,
        keep_upright=params.keep_upright,
    ):
        yield State(**known, now=now, last=now.stage == "rectified")


def with_f(K: np.ndarray, error: float) -> np.ndarray:
    """Return intrinsics whose focal lengths are wrong by so many per cent."""
    wrong = K.copy()
    wrong[:2, :2] *= 1 + error / 100
    return wrong


def views_of(params: Params) -> TwoViews:
    """Return the pictures and matches of a run."""
    if params.own_matches is not None:
        return own_views(
            params.own_matches,
            first_image=params.first_image,
            second_image=params.second_image,
            K=params.intrinsics,
            most=MOST_MATCHES,
        )
    return street_views(
        params.scene,
        count=params.matches,
        sigma=params.noise,
        baseline=params.baseline,
        heading=np.radians(params.heading),
        rng=np.random.default_rng(params.seed),
    )


def drawn_length(views: TwoViews) -> float:
    """Return how long the baseline is drawn, metres: as long as it is, and in an own scene so that it fits."""
    if views.sigma is not None and views.T_second_first is not None:
        return float(np.linalg.norm(views.T_second_first[:3, 3])) or 1.0
    uv_first, uv_second = views.matches[:, :2], views.matches[:, 2:]
    xy = normalize(uv_first, views.K_first), normalize(uv_second, views.K_second)
    Ts = essential_motions(
        essential_from_fundamental(fit_fundamental(uv_first, uv_second), views.K_first, views.K_second)
    )
    depths = max((midpoints(T, *xy)[:, 2] for T in Ts), key=lambda z: int((z > 0).sum()))
    middle = float(np.nanmedian(np.abs(depths)))
    return SHOWN_DEPTH / middle if 0 < middle < np.inf else 1.0


lesson = Lesson(
    name="epipolar",
    title="Epipolar geometry",
    summary="A pixel of one picture is a line of the other, and eight such pairs hold the motion between two cameras.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=1600,
    needs=("pinhole", "ransac"),
    view=VIEW,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=7,
    sweeps=(Sweep("heading", (0.0, 20.0, 45.0, 60.0, 90.0)),),
    telling="Error of the pose",
)
