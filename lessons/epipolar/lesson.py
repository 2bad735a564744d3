"""Epipolar geometry: a pixel of one picture is a line of the other, and many matches hold the
motion of the camera.

What it teaches: where the other camera's centre is seen all lines meet; eight matches and a
singular value decomposition give the lines, K makes a motion of them, up to four readings and an
unknown length; and some matches hold no motion at all.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from lessons.epipolar.draw import VIEW, draw
from lessons.epipolar.exercises.eight_point import eight_point
from lessons.epipolar.exercises.essential_to_poses import essential_to_poses
from lessons.epipolar.exercises.triangulate import triangulate
from lessons.epipolar.presets import PRESETS, QUESTIONS
from lessons.epipolar.state import MOST_MATCHES, Params, State
from workbench.algorithms.two_views import (
    EightPoint,
    Poses,
    Triangulate,
    follow_ray,
    relate,
    solve_linear,
)
from workbench.data.views.two_views import TwoViews, made_views, own_views, shown_length
from workbench.errors import InputError
from workbench.geometry.motions import motion
from workbench.geometry.two_views.homography import normalising_similarity
from workbench.knobs import called
from workbench.lesson import Lesson, Sweep

# metres along the ray of the followed pixel, as they are drawn
DEPTHS = np.array([3.0, 4.0, 6.0, 8.0, 12.0, np.inf])


def run(
    params: Params,
    *,
    eight_point: EightPoint = eight_point,
    essential_to_poses: Poses = essential_to_poses,
    triangulate: Triangulate = triangulate,
) -> Iterator[State]:
    """Yield the line of one pixel, where the true cameras are known, and the way from matches to a
    motion.
    """
    views = views_of(params)
    w, h = views.sizes[0]
    # of the columns of K
    believed = np.array([1 + params.f_error / 100, 1 + params.f_error / 100, 1.0])
    length = shown_length(views)
    T = views.T_second_first
    if T is not None and np.any(T[:3, 3]):
        T = motion(T[:3, :3], length * T[:3, 3] / np.linalg.norm(T[:3, 3]))
    known: dict[str, Any] = {
        "params": params,
        "views": views,
        "uv_first": np.minimum(
            np.array(params.pixel, float) * views.strides[0], [w - 1.0, h - 1.0]
        ),
        "K_first": views.K_first * believed,
        "K_second": views.K_second * believed,
        "length": length,
        "T_true": T,
    }
    if T is not None:
        for result in follow_ray(
            known["uv_first"],
            views.model * DEPTHS,
            T,
            K_first=views.K_first,
            K_second=views.K_second,
        ):
            yield State(**known, now=result)

    uv_first, uv_second = views.matches[:, :2], views.matches[:, 2:]
    scales = (
        normalising_similarity(np.stack([uv_first, uv_second]))
        if params.normalise
        else np.stack([np.eye(3)] * 2)
    )
    linear = solve_linear(uv_first, uv_second, scales[0], T_second=scales[1])
    if not (params.normalise and params.rank_two):
        F = linear.F_rank_two if params.rank_two else linear.F
        eight_point = lambda *_: F  # noqa: E731
    for result in relate(
        uv_first,
        uv_second,
        known["K_first"],
        K_second=known["K_second"],
        linear=linear,
        eight_point=eight_point,
        essential_to_poses=essential_to_poses,
        triangulate=triangulate,
        route=params.route,
        keep_upright=params.keep_upright,
    ):
        yield State(**known, now=result, last=result.stage == "rectified")


def views_of(params: Params) -> TwoViews:
    """Return the pictures and matches of a run.

    Raises:
        InputError: If own files cannot be used, or their matches are missing.
    """
    if params.own_matches is not None:
        return own_views(
            params.own_matches,
            first_image=params.first_image,
            second_image=params.second_image,
            K=params.intrinsics,
            most=MOST_MATCHES,
        )
    if any((params.first_image, params.second_image, params.intrinsics)):
        raise InputError(
            f"own images and intrinsics belong to own matches: give {called('own_matches')} too"
        )
    return made_views(
        params.scene,
        count=params.matches,
        sigma=params.noise,
        baseline=params.baseline,
        heading=np.radians(params.heading),
        rng=np.random.default_rng(params.seed),
    )


lesson = Lesson(
    name="epipolar",
    title="Epipolar geometry",
    summary="A point in one picture lies on a known line in the other. Eight pairs of points "
    "tell how the camera moved.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=1200,
    chapter="See",
    minutes=25,
    needs=("pinhole", "ransac"),
    view=VIEW,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=7,
    opening=0,
    sweeps=(Sweep("heading", (0.0, 20.0, 45.0, 60.0, 90.0)),),
    telling="Error of the pose",
)
