"""What the pinhole lesson says of its camera and its mistakes, held against the camera written out
in plain numpy.
"""

import re
from dataclasses import replace
from typing import Any

import numpy as np

from lessons.pinhole import captions
from lessons.pinhole.lesson import run as follow
from lessons.pinhole.lesson import setup
from tests.readings import NUMBER, close, number, says
from tests.truths.pinhole import (
    CRATE,
    STAGES,
    TOWER,
    bent,
    both,
    calculated,
    camera,
    centre,
    edited,
    fold,
    followed,
    height,
    ideal,
    lost,
    median_back,
    median_off,
    moves,
    pixels,
    pixels_at,
    points,
    shot_gap,
)
from tests.verdicts import Claim, Run
from workbench.data.views.street import BALL_CENTER, BALL_RADIUS, street
from workbench.lesson import Look
from workbench.scene import Caption

POINT = rf"\(({NUMBER}), ({NUMBER}), ({NUMBER})\)"


def caption(look: Look) -> Caption:
    return captions.caption(look)


def right(run: Run, k: int) -> bool | None:
    """False where the calculation is away from the camera by what can be seen; True where it is the
    same.
    """
    if k == 0:
        return True
    if k == 1:
        R, t, _ = camera(run.params)
        return bool(close(run.states[1].now.p_camera, points(run.params) @ R.T + t, atol=1e-9))
    if median_off(run, k) > 0.5 or any(lost(run, k)):
        return False
    return not (k == len(STAGES) - 1 and median_back(run) > 1e-3)


# The numbers --------------------------------------------------------------------------------------


def place(m: re.Match[str], p: np.ndarray) -> bool:
    return all(
        says(text, float(value)) for text, value in zip(m.groups()[: len(p)], p, strict=True)
    )


def at(stage: str, axis: int):
    """A coordinate of the followed point, calculated anew with the run's own mistake."""
    return lambda run, k: float(calculated(run)[stage][followed(run.params), axis])


def _z(run: Run, k: int) -> float:
    stages = calculated(run)
    return float(
        (stages["z"] if k == len(STAGES) - 1 else stages["camera"][:, 2])[followed(run.params)]
    )


def _x_or_y(axis: int):
    return lambda run, k: at("camera" if k == STAGES.index("camera") else "divide", axis)(run, k)


def _moves(run: Run) -> np.ndarray:
    """How far the lens moves each point, in pixels of the true K."""
    stages = calculated(run)
    f = edited(run.params, camera(run.params)[2])[0, 0]
    return f * np.linalg.norm(stages["distort"] - stages["divide"], axis=1)


def _gap(run: Run, k: int) -> float:
    corners = street().edges.reshape(-1, 3)
    params = replace(run.params, k1=0.0, k2=0.0, p1=0.0, p2=0.0, edit="none")
    R, t, K = camera(params)
    X, Y, Z = R @ corners.T + t[:, None]
    distance = params.dolly * np.linalg.norm(np.subtract(params.target, params.camera))
    flat = np.array([X, Y]).T * K[0, 0] / distance + K[:2, 2]
    return float(np.linalg.norm(pixels(params, corners) - flat, axis=1)[Z > 0].max())


def _rails(axis: int):
    return lambda run, k: float(pixels(run.params, np.array([[0.75, 1e9, 0.06]]))[0, axis])


def _ball(run: Run, k: int) -> float:
    """Longest over shortest half axis: of the cone of rays that touch the ball, cut by the pane."""
    R, t, _ = camera(run.params)
    c = R @ BALL_CENTER + t
    cone = np.outer(c, c) - (c @ c - BALL_RADIUS**2) * np.eye(3)  # rays v with v^T cone v = 0
    values = np.linalg.eigvalsh(cone[:2, :2])
    return float(np.sqrt(values.min() / values.max()) if values.max() < 0 else np.nan)


def _halved(params) -> int:
    return 2 if "half" in params.edit else 1


def _depth(params):
    """The true depth of the point that is followed: its way along the camera's axis."""
    R, t, _ = camera(params)
    return float((points(params)[followed(params)] @ R.T + t)[2])


VALUES = {
    "deep": lambda run, k: _depth(run.params),
    "behind": lambda run, k: -_depth(run.params),
    "cut": lambda run, k: 320 - run.subject.picture.shape[1] * _halved(run.params),
    "x": _x_or_y(0),
    "y": _x_or_y(1),
    "z": _z,
    "moved": lambda run, k: float(_moves(run)[followed(run.params)]),
    "most": lambda run, k: float(np.nanmax(_moves(run))),
    "fold": lambda run, k: (
        float(1 / np.sqrt(-3 * run.params.k1)) if run.params.k2 == 0 else fold(run.params)
    ),
    "u": at("pixels", 0),
    "v": at("pixels", 1),
    "miss": lambda run, k: float(
        np.linalg.norm(calculated(run)["back"] - points(run.params), axis=1)[followed(run.params)]
    ),
    "error": median_off,
    "across": lambda run, k: 320 - run.subject.picture.shape[1],
    "down": lambda run, k: 240 - run.subject.picture.shape[0],
    "missed": lambda run, k: lost(run, k)[0],
    "false": lambda run, k: lost(run, k)[1],
    "apart": lambda run, k: median_back(run),
    "crate": lambda run, k: height(run.params, CRATE),
    "tower": lambda run, k: height(run.params, TOWER),
    "gap": _gap,
    "rail_u": _rails(0),
    "rail_v": _rails(1),
    "ratio": _ball,
}


# The sentences ------------------------------------------------------------------------------------


def _wrong(mistake: str):
    """A sentence that blames a mistake: it was asked for, and the stage is off."""
    return lambda run, k, m: run.params.mistake == mistake and right(run, k) is False


def _inward(run: Run, k: int, m: re.Match[str]) -> bool:
    stages = calculated(run)
    i = followed(run.params)
    nearer = np.linalg.norm(stages["distort"][i]) < np.linalg.norm(stages["divide"][i])
    return bool(nearer == (m[1] == "inwards"))


BLAME = (
    "The pose is|by its negative depth|stands where|The lens was|is not where|was taken for|K is"
    " still|The calculation"
)

CAPTIONS = (
    Claim(
        "it is not in front of the camera, and gets no place",
        lambda run, k, m: bool(
            _z(run, 1) < 0 and np.isnan(calculated(run)["divide"][followed(run.params)]).all()
        ),
    ),
    Claim("it is in front of the camera, and gets no place", lambda run, k, m: _z(run, 1) > 0),
    Claim(
        "This lens bends nothing",
        lambda run, k, m: not (run.params.k1 or run.params.k2 or run.params.p1 or run.params.p2),
    ),
    Claim(
        r"begins \d+ columns further right(, and is half as large)?",
        lambda run, k, m: bool(m[1]) == (run.subject.picture.shape[1] < 200) and run.params.cut > 0,
    ),
    Claim("px (inwards|outwards)", _inward),
    Claim(
        "The followed point has no place behind the lens",
        lambda run, k, m: bool(np.isnan(calculated(run)["distort"][followed(run.params)]).all()),
    ),
    Claim(
        "Beyond radius [\\d.]+ there is no pixel",
        lambda run, k, m: bool(
            np.isnan(
                calculated(run)["distort"][
                    np.linalg.norm(calculated(run)["divide"], axis=1) > fold(run.params)
                ]
            ).all()
        ),
    ),
    Claim(
        "K makes pixels of what is left; the followed point has none",
        lambda run, k, m: bool(np.isnan(calculated(run)["pixels"][followed(run.params)]).all()),
    ),
    Claim("we come out where we began", lambda run, k, m: VALUES["miss"](run, k) < 1e-6),
    Claim(
        "The followed point has no pixel, so nothing leads back to it",
        lambda run, k, m: bool(np.isnan(calculated(run)["pixels"][followed(run.params)]).all()),
    ),
    Claim(
        "The pose is inverted: camera-to-world stands where world-to-camera belongs",
        _wrong("pose inverted"),
    ),
    Claim(
        "What lies behind the camera was divided by its negative depth too",
        _wrong("divides behind too"),
    ),
    Claim(
        "The pose is OpenGL's, so depths ahead are negative and dividing mirrors",
        lambda run, k, m: bool(
            (
                run.states[k].now.p_camera[
                    np.isfinite(ideal(run.params, points(run.params))[:, 0]), 2
                ]
                < 0
            ).all()
        ),
    ),
    Claim(
        r"\(row, column\) stands where \(u, v\) = \(column, row\) belongs",
        _wrong("row before column"),
    ),
    Claim("The lens was given pixels, so r² is f² times too large", _wrong("lens on pixels")),
    Claim(
        "t is not where the camera is; C = −Rᵀt is",
        lambda run, k, m: bool(np.linalg.norm(camera(run.params)[1] - centre(run.params)) > 0.1),
    ),
    Claim("The length of the ray was taken for the depth Z", _wrong("ray length for depth")),
    Claim(
        "The outlines are [^ ]+ px too far right and [^ ]+ px too low",
        lambda run, k, m: close(
            both(run, k)[0],
            both(run, k)[1] + np.array([VALUES["across"](run, k), VALUES["down"](run, k)]),
            equal_nan=True,
        ),
    ),
    Claim(
        r"(points? gets? a pixel), though the camera cannot see (it|them)",
        lambda run, k, m: (lost(run, k)[1] == 1) == (m[2] == "it"),
    ),
    Claim(
        "K is still that of the full picture",
        lambda run, k, m: run.params.edit != "none" and not run.params.k_follows,
    ),
    # who blames nobody says that all is right
    Claim(rf"^(?!.*(?:{BLAME}))", lambda run, k, m: right(run, k) is not False),
)


# The lines of the presets -------------------------------------------------------------------------


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


def _step_right(run: Run, p: np.ndarray) -> float:
    """By how many pixels a point moves to the right when the camera steps 2 m to its right."""
    before, after = (
        K @ (R @ p + t) for R, t, K in (camera(replace(run.params, aside=a)) for a in (0.0, 2.0))
    )
    return float(after[0] / after[2] - before[0] / before[2])


def _bow(run: Run) -> float:
    """How far straight edges through the middle leave their lines, px, at most over all
    directions.
    """
    r = np.linspace(-0.7, 0.7, 57)
    worst = 0.0
    for angle in np.linspace(0.0, np.pi, 12):
        along = np.array([np.cos(angle), np.sin(angle)])
        across = np.array([-np.sin(angle), np.cos(angle)])
        worst = max(
            worst, run.params.f * np.abs(bent(run.params, r[:, None] * along) @ across).max()
        )
    return float(worst)


WHYS = {
    "predict-dolly": (
        Claim(
            rf"It grows from ({NUMBER}) to ({NUMBER}) px. .*f is three times as long, and the"
            r" tower's Z, which was larger to"
            " begin with, did not grow three times",
            lambda run, k, m: bool(
                says(m[1], height(run.params, TOWER, 1.0))
                and says(m[2], height(run.params, TOWER))
                and number(m[2]) > number(m[1])
                and 1
                < np.linalg.norm(TOWER[0] - centre(run.params))
                / np.linalg.norm(TOWER[0] - run.params.camera)
                < 3
            ),
        ),
    ),
    "predict-behind": (
        Claim(
            rf"At \(({NUMBER}), ({NUMBER})\), well inside the picture. Z = ({NUMBER}) m turns both"
            r" signs, and a lamp above the"
            " axis shows up below it",
            lambda run, k, m: bool(
                says(m[1], pixels_at(run)[5, 0])
                and says(m[2], pixels_at(run)[5, 1])
                and 40 < number(m[1]) < 280
                and 119.5 < number(m[2]) < 200
                and says(m[3], run.states[1].now.p_camera[5, 2])
                and run.states[1].now.p_camera[5, 1] < 0
            ),
        ),
    ),
    "predict-centre": (
        Claim(
            rf"It is at C = −Rᵀt = {POINT} m",
            lambda run, k, m: place(m, np.array(run.params.camera)),
        ),
        Claim(
            rf"Both are ({NUMBER}) m long",
            lambda run, k, m: (
                says(m[1], float(np.linalg.norm(camera(run.params)[1])))
                and says(m[1], float(np.linalg.norm(run.params.camera)))
            ),
        ),
    ),
    "predict-rails": (
        Claim(
            rf"It moves by ({NUMBER}) px, while a near point of the rail moves by ({NUMBER}) px to"
            r" the left",
            lambda run, k, m: (
                says(m[1], abs(_step_right(run, np.array([0.0, 1e9, 0.0]))))
                and says(m[2], -_step_right(run, street().points[3]))
            ),
        ),
    ),
    "through-the-middle": (
        Claim(rf"It is bent by ({NUMBER}) px", lambda run, k, m: says(m[1], _bow(run))),
    ),
    "predict-crop": (
        Claim(
            rf"({NUMBER}) px: first .*The middle of the picture is ({NUMBER}) px",
            lambda run, k, m: (
                says(m[1], (159.5 - 60 + 0.5) / 2 - 0.5)
                and says(m[2], ((320 - 60) / 2 - 1) / 2)
                and says(m[1], float(run.subject.K[0, 2]))
            ),
        ),
    ),
}
