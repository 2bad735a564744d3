"""What the lines of the pinhole lesson's presets say of the whole picture, held against the camera
written out in plain numpy, or run once more with one thing changed.
"""

import re
from dataclasses import replace
from typing import Any

import numpy as np

from lessons.pinhole.lesson import run as follow
from lessons.pinhole.lesson import setup
from tests.readings import close
from tests.truths.pinhole import (
    CRATE,
    STAGES,
    bent,
    both,
    camera,
    centre,
    height,
    ideal,
    median_off,
    moves,
    pixels,
    pixels_at,
    points,
    shot_gap,
)
from tests.verdicts import Claim, Run
from tests.verdicts.pinhole.captions import right
from workbench.data.views.street import street


def with_(run: Run, **changes: Any) -> Run:
    params = replace(run.params, **changes)
    subject = setup(params)
    return Run(params, tuple(follow(params, subject)), subject)


def _doubled(run: Run, k: int, m: re.Match[str]) -> bool:
    c = np.array([159.5, 119.5])
    half = with_(run, f=run.params.f / 2)
    same = close(half.states[-1].now.xy, run.states[-1].now.xy, equal_nan=True)
    return same and close(
        run.states[-1].now.uv - c, 2 * (half.states[-1].now.uv - c), equal_nan=True
    )


def _one_over_the_distance(run: Run, k: int, m: re.Match[str]) -> bool:
    corners = street().edges.reshape(-1, 3)
    rays = corners - centre(run.params)
    rays /= np.linalg.norm(rays, axis=1, keepdims=True)
    parallel = np.degrees(np.arccos((rays @ rays.T).min())) < 3
    gaps = [shot_gap(replace(run.params, dolly=by)) for by in (25.0, 50.0)]
    return run.params.dolly == 50 and bool(parallel) and abs(gaps[0] / gaps[1] - 2) < 0.1


def _meet(run: Run, k: int, m: re.Match[str]) -> bool:
    """Lines along d far out, wherever they and the camera are, come to K R d."""
    R, _, K = camera(run.params)
    v = K @ R @ [0.0, 1.0, 0.0]
    far = pixels(run.params, np.array([[x, 1e9, z] for x in (-5.0, 0.0, 7.0) for z in (0.0, 3.0)]))
    return close(far, v[:2] / v[2], atol=1e-5)


def _radial(sign: int):
    def holds(run: Run, k: int, m: re.Match[str]) -> bool:
        xy, shift = moves(run)
        r = np.linalg.norm(xy, axis=1)
        out = sign * (shift * xy).sum(axis=1) / r
        edge = np.array([[-0.5, -0.4], [0.0, -0.4], [0.5, -0.4]])
        ends = bent(run.params, edge)
        bow = ends[[0, 2], 1].mean() - ends[1, 1]  # y points down: positive is away from the middle
        rising = (np.diff(out[np.argsort(r)]) > -1e-12).all()
        return bool((out > 0).all() and rising and (-sign * bow) > 0.001)

    return holds


def _tangential(run: Run, k: int, m: re.Match[str]) -> bool:
    xy, shift = moves(run)
    q = np.array([run.params.p2, run.params.p1])
    size = np.linalg.norm(shift, axis=1)
    angle = np.degrees(np.arccos(shift @ q / size / np.linalg.norm(q)))
    aside = (
        np.abs(shift[:, 0] * xy[:, 1] - shift[:, 1] * xy[:, 0]) / size / np.linalg.norm(xy, axis=1)
    )
    order = np.argsort(np.linalg.norm(xy, axis=1))
    return bool(
        angle.max() <= 30.001
        and aside.max() > 0.3
        and size[order[-20:]].mean() > 2 * size[order[:20]].mean()
    )


def _folds(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[STAGES.index("divide")].now
    beyond = np.linalg.norm(state.xy, axis=1) > 0.745
    x, y = state.xy[beyond].T
    s = x * x + y * y
    folded = np.array([x, y]).T * (1 - 0.6 * s)[:, None] * run.params.f
    back = (np.abs(folded) < (160, 120)).all(axis=1).any()
    none = np.isnan(run.states[-1].now.uv[beyond]).all()
    return bool(
        run.params.k1 == -0.6
        and abs(np.sqrt(1 / 1.8) - 0.745) < 5e-4
        and beyond.any()
        and back
        and none
    )


def _shifted_and_doubled(run: Run, k: int, m: re.Match[str]) -> bool:
    got, true = both(run, STAGES.index("pixels"))
    seen = np.isfinite(true).all(axis=1)
    A = np.column_stack([true[seen], np.ones(seen.sum())])
    fit, *_ = np.linalg.lstsq(A, got[seen])
    return close(fit[:2], 2 * np.eye(2), atol=1e-6) and bool(np.abs(fit[2]).min() > 10)


def _misses_alike(run: Run, k: int, m: re.Match[str]) -> bool:
    off = np.linalg.norm(run.states[-1].now.p_back - points(run.params), axis=1)
    t = camera(run.params)[1]
    return close(off[np.isfinite(off)], np.linalg.norm(t - centre(run.params)))


def _too_far(run: Run, k: int, m: re.Match[str]) -> bool:
    R, t, _ = camera(run.params)
    seen = np.isfinite(run.states[-1].now.p_back).all(axis=1)
    z, z_back = ((p @ R.T + t)[seen, 2] for p in (points(run.params), run.states[-1].now.p_back))
    r = np.linalg.norm(ideal(run.params, points(run.params))[seen], axis=1)
    return bool(
        (z_back >= z).all()
        and (np.diff((z_back / z)[np.argsort(r)]) > -1e-9).all()
        and r.max() > 0.3
    )


def _mirrored(run: Run, k: int, m: re.Match[str]) -> bool:
    """Left to right, about the principal point; what is in front has a negative depth."""
    true = pixels(run.params, points(run.params))
    seen = np.isfinite(true).all(axis=1)
    behind = (run.states[1].now.p_camera[seen, 2] < 0).all()
    return bool(behind) and close(pixels_at(run)[seen], true[seen] * (-1, 1) + (319, 0))


LINES = {
    "dolly": (
        Claim(
            "Three times as far, three times the focal length: the crate keeps its size",
            lambda run, k, m: bool(
                run.params.dolly == 3
                and abs(height(run.params, CRATE) / height(run.params, CRATE, 1.0) - 1) < 0.01
                and close(
                    np.linalg.norm(centre(run.params) - run.params.target),
                    3 * np.linalg.norm(np.subtract(run.params.camera, run.params.target)),
                )
            ),
        ),
    ),
    "zoom": (
        Claim(
            "Every pixel moves to twice its distance from the principal point and nothing else"
            " changes",
            _doubled,
        ),
    ),
    "orthographic": (
        Claim(
            "At fifty times the distance the rays are nearly parallel.*one over the distance",
            _one_over_the_distance,
        ),
    ),
    "rails": (
        Claim("The pictures of all lines of one direction d run towards one point, K R d", _meet),
    ),
    "ball": (
        Claim(
            "a ball's outline is longer than wide", lambda run, k, m: run.subject.ball_ratio > 1.2
        ),
    ),
    "cut": (
        Claim(
            "slide to the right and down by as many pixels",
            lambda run, k, m: close(
                pixels_at(run),
                pixels(run.params, points(run.params)) + np.array([run.params.cut, 40]),
                equal_nan=True,
            ),
        ),
    ),
    "lamp-1": (Claim("Half as far from the camera, the same picture is half as large", None),),
    "lamp-4": (Claim("Twice as far from the camera, the same picture is twice as large", None),),
    "barrel": (Claim("Points move towards the middle.*bow outwards", _radial(-1)),),
    "pincushion": (Claim("Points move away from the middle.*bow inwards", _radial(1)),),
    "tangential": (
        Claim(
            "push every point to within 30° of one direction, more so away from the middle",
            _tangential,
        ),
    ),
    "fold": (Claim("k₁ = −0.6 turns round at radius 0.745.*they get no pixel", _folds),),
    "behind": (
        Claim(
            "The followed lamp hangs behind the camera. Step on: it is divided by its negative"
            " depth",
            lambda run, k, m: bool(
                run.states[1].now.p_camera[run.params.point, 2] < 0
                and np.isfinite(pixels_at(run)[run.params.point]).all()
            ),
        ),
    ),
    "inverted": (
        Claim(
            "Nearly every point is then behind the camera and loses its pixel",
            lambda run, k, m: bool(
                (run.states[1].now.p_camera[:, 2] < 0).mean() > 0.95
                and np.isnan(pixels_at(run)).mean() > 0.95
            ),
        ),
    ),
    "opengl": (
        Claim(
            "gives all that is in front a negative depth; dividing anyway gives a picture mirrored"
            " left to right",
            _mirrored,
        ),
    ),
    "rows": (
        Claim(
            "the picture is flipped about its diagonal",
            lambda run, k, m: close(
                pixels_at(run), pixels(run.params, points(run.params))[:, ::-1], equal_nan=True
            ),
        ),
    ),
    "lens-on-pixels": (
        Claim(
            r"points fly 36 million pixels away \(median\)",
            lambda run, k, m: abs(median_off(run, 3) - 36e6) < 0.5e6,
        ),
    ),
    "crop-wrong": (
        Claim(
            "the calculation is shifted and twice as large as it should be", _shifted_and_doubled
        ),
    ),
    "crop-right": (
        Claim(
            "A crop moves the principal point, away from the middle of the picture; halving halves"
            " f as well",
            lambda run, k, m: (
                bool(np.abs(run.subject.K[:2, 2] - (64.5, 49.5)).min() > 5)
                and close(run.subject.K[0, 0], run.params.f / 2)
            ),
        ),
        Claim(
            "Now all fits again", lambda run, k, m: right(run, 4) is True and right(run, 5) is True
        ),
    ),
    "centre": (
        Claim("Rays that start there miss every point by the distance from t to C", _misses_alike),
    ),
    "ray-length": (
        Claim("Points come back too far out, the more the further from the axis", _too_far),
    ),
}
