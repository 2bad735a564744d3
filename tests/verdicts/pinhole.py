"""What the pinhole lesson says of its camera and its mistakes, held against the camera written out
in plain numpy.
"""

import re
from dataclasses import replace
from typing import Any

import numpy as np

from lessons.pinhole import captions
from lessons.pinhole.lesson import run as follow
from tests.readings import LENGTH, NUMBER, POWER, close, number, says, says_length
from tests.truths.pinhole import (
    CRATE,
    STAGES,
    TOWER,
    bent,
    both,
    camera,
    centre,
    edited,
    fold,
    height,
    ideal,
    lost,
    median_back,
    median_off,
    moves,
    pixels,
    pixels_at,
    shot_gap,
)
from tests.verdicts import Claim, Run
from workbench.data.views.street import BALL_CENTER, BALL_RADIUS, street
from workbench.scene import Caption

POINT = rf"\(({NUMBER}), ({NUMBER}), ({NUMBER})\)"


def caption(state: Any) -> Caption:
    return captions.caption(state)


def right(run: Run, k: int) -> bool | None:
    """False where the calculation is away from the camera by what can be seen; True where it is the
    same.
    """
    if k == 0:
        return True
    if k == 1:
        R, t, _ = camera(run.params)
        return bool(close(run.states[1].now.p_camera, street().points @ R.T + t, atol=1e-9))
    if median_off(run, k) > 0.5 or any(lost(run, k)):
        return False
    return not (k == len(STAGES) - 1 and median_back(run) > 1e-3)


# The sentences ------------------------------------------------------------------------------------


def place(m: re.Match[str], p: np.ndarray) -> bool:
    return all(
        says(text, float(value)) for text, value in zip(m.groups()[: len(p)], p, strict=True)
    )


def _p(run: Run) -> np.ndarray:
    return street().points[run.params.point]


def _world(run: Run, k: int, m: re.Match[str]) -> bool:
    names = {
        "the tower's top": (-3.7, 13.2, 5.0),
        "the crate's corner": (-1.4, 5.5, 1.0),
        "the lamp": (0.9, -5.2, 2.4),
        "the rail, 40 m along": (0.75, 40.0, 0.06),
    }
    return (
        number(m[1]) == len(street().points)
        and close(names[m[2]], _p(run))
        and says(m[3], _p(run)[0])
    )


def _camera(run: Run, k: int, m: re.Match[str]) -> bool:
    p = run.states[k].now.p_camera[run.params.point]
    return place(m, p) and says(m[4], float(p[2])) and says(m[5], float(np.sqrt((p**2).sum())))


def _divided(run: Run, k: int, m: re.Match[str]) -> bool:
    p = run.states[k].now.p_camera[run.params.point]
    found = np.isfinite(run.states[k].now.xy).all(axis=1).sum()
    xy_there = says(m[1], p[2]) and says(m[2], p[0] / p[2]) and says(m[3], p[1] / p[2])
    return bool(xy_there and number(m[4]) == found and number(m[5]) == len(street().points))


def _bent(run: Run, k: int, m: re.Match[str]) -> bool:
    now, f = run.states[k].now, edited(run.params, camera(run.params)[2])[0, 0]
    moved = f * np.linalg.norm(now.xy_bent - now.xy, axis=1)
    nearer = np.linalg.norm(now.xy_bent[run.params.point]) < np.linalg.norm(
        now.xy[run.params.point]
    )
    way = nearer if m[2] == "nearer to" else not nearer
    there = all(
        says(text, value)
        for text, value in zip((m[3], m[4]), now.xy_bent[run.params.point], strict=True)
    )
    return bool(
        says(m[1], moved[run.params.point]) and way and there and says(m[5], np.nanmax(moved))
    )


def _most(run: Run, k: int, m: re.Match[str]) -> bool:
    now, f = run.states[k].now, edited(run.params, camera(run.params)[2])[0, 0]
    here = np.isfinite(now.xy_bent[run.params.point]).all()
    return (
        says(m[1], float(np.nanmax(f * np.linalg.norm(now.xy_bent - now.xy, axis=1)))) and not here
    )


def _pixel(run: Run, k: int, m: re.Match[str]) -> bool:
    u, v = run.states[k].now.uv[run.params.point]
    return says(m[1], u) and says(m[2], v)


def _inside(run: Run, k: int, m: re.Match[str]) -> bool:
    uv = run.states[k].now.uv
    w, h = (260, 200) if "cropped" in run.params.edit else (320, 240)
    w, h = (w // 2, h // 2) if "half" in run.params.edit else (w, h)
    inside = (uv[:, 0] >= -0.5) & (uv[:, 1] >= -0.5) & (uv[:, 0] <= w - 0.5) & (uv[:, 1] <= h - 0.5)
    return [number(text) for text in m.groups()] == [inside.sum(), len(uv), w, h]


def _came_back(run: Run, k: int, m: re.Match[str]) -> bool:
    now = run.states[k].now
    miss = float(np.linalg.norm(now.p_back[run.params.point] - _p(run)))
    start = all(
        says(text, float(value)) for text, value in zip(m.groups()[:3], now.p_center, strict=True)
    )
    if m[4] is None:
        return start and miss < 1e-6
    return start and says_length(m[4], miss, 3)


def _heights(run: Run, k: int, m: re.Match[str]) -> bool:
    ends = {"crate": CRATE, "tower": TOWER}[m[1]]
    return says(m[2], height(run.params, ends, 1.0)) and says(m[3], height(run.params, ends))


def _gap(run: Run, k: int, m: re.Match[str]) -> bool:
    corners = street().edges.reshape(-1, 3)
    params = replace(run.params, k1=0.0, k2=0.0, p1=0.0, p2=0.0, edit="none")
    R, t, K = camera(params)
    X, Y, Z = R @ corners.T + t[:, None]
    depth = R[2] @ np.array(params.target) + t[2]
    flat = np.array([X, Y]).T * K[0, 0] / depth + K[:2, 2]
    off = np.linalg.norm(pixels(params, corners) - flat, axis=1)[Z > 0]
    return says(m[1], float(off.max()))


def _rails(run: Run, k: int, m: re.Match[str]) -> bool:
    far = pixels(run.params, np.array([[x, 1e9, 0.06] for x in (-0.75, 0.75)]))
    return all(says(m[1], float(u)) and says(m[2], float(v)) for u, v in far)


def _ball(run: Run, k: int, m: re.Match[str]) -> bool:
    """Longest over shortest diameter of the outline of many points of the ball, without the
    lens.
    """
    params = replace(run.params, k1=0.0, k2=0.0, p1=0.0, p2=0.0)
    turn, tilt = np.meshgrid(np.linspace(0, 2 * np.pi, 400), np.linspace(0, np.pi, 400))
    unit = np.stack(
        [np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)], axis=-1
    ).reshape(-1, 3)
    uv = ideal(params, BALL_CENTER + BALL_RADIUS * unit)
    n = np.stack([np.cos(angles := np.linspace(0, np.pi, 360)), np.sin(angles)])
    width = np.ptp(uv @ n, axis=0)
    return abs(number(m[1]) - width.max() / width.min()) < 0.02


def _wrong(mistake: str):
    """A sentence that blames a mistake: it was asked for, and the stage is off."""
    return lambda run, k, m: run.params.mistake == mistake and right(run, k) is False


BLAME = (
    "The pose is|by its negative depth|stands where|The lens was|is not where|was taken for|K is"
    " still|The calculation"
)

CAPTIONS = (
    Claim(
        rf"^({NUMBER}) points of the street in world coordinates, z up. We follow (.*):"
        rf" \(({NUMBER}),",
        _world,
    ),
    Claim(
        rf"^R p \+ t is the point in the camera's frame \(x right, y down, z forward\): {POINT} m."
        r" Its depth is Z ="
        rf" ({NUMBER}) m; along its ray it is ({NUMBER}) m away",
        _camera,
    ),
    Claim(
        rf"Divided by Z = ({NUMBER}) m the point is at \(x, y\) = \(({NUMBER}), ({NUMBER})\) on the"
        r" plane one metre in"
        rf" front of the camera. ({NUMBER}) of ({NUMBER}) points have a place there",
        _divided,
    ),
    Claim(
        rf"The point is not in front of the camera, Z = ({NUMBER}) m, and gets no place",
        lambda run, k, m: (
            says(m[1], run.states[k].now.p_camera[run.params.point, 2])
            and number(m[1]) < 0
            and np.isnan(run.states[k].now.xy[run.params.point]).all()
        ),
    ),
    Claim(
        "A lens without distortion: .*y\\)",
        lambda run, k, m: (
            not (
                np.nan_to_num(run.states[k].now.xy_bent - run.states[k].now.xy).any()
                or run.params.k1
                or run.params.k2
                or run.params.p1
                or run.params.p2
            )
        ),
    ),
    Claim(
        rf"The lens moves the point ({POWER}) px, (nearer to|further from) the principal point:"
        rf" \(x′, y′\) = \(({POWER}),"
        rf" ({POWER})\); the farthest goes ({POWER}) px",
        _bent,
    ),
    Claim(rf"The followed point has no place on the lens; the farthest goes ({POWER}) px", _most),
    Claim(
        rf"Beyond radius ({NUMBER}) this model folds back; what lies there has no pixel",
        lambda run, k, m: (
            abs(number(m[1]) - fold(run.params)) < 1e-3
            and np.isnan(run.states[k].now.xy_bent)[
                np.linalg.norm(run.states[k].now.xy, axis=1) > fold(run.params)
            ].all()
        ),
    ),
    Claim(rf"is the pixel: column u = ({POWER}), row v = ({POWER})\.", _pixel),
    Claim(
        "K makes pixels of what is left; the followed point has none",
        lambda run, k, m: bool(np.isnan(run.states[k].now.uv[run.params.point]).all()),
    ),
    Claim(
        rf"({NUMBER}) of ({NUMBER}) points fall into the ({NUMBER}) × ({NUMBER}) picture", _inside
    ),
    Claim(rf"(?<=[Tt]he )(crate|tower) was ({NUMBER}) px high and is ({NUMBER}) px now", _heights),
    Claim(rf"o corner in front of it is more than ({NUMBER}) px from its orthographic pixel", _gap),
    Claim(
        rf"The rails stay 1.5 m apart; their pictures run towards \(({NUMBER}), ({NUMBER})\)",
        _rails,
    ),
    Claim(rf"the ball's outline is ({NUMBER}) times as long as wide", _ball),
    Claim(
        rf"it gives a ray from {POINT} m, but not how far to go along it. With .* we come out"
        rf" (?:where we began|({LENGTH}) from where we began)",
        _came_back,
    ),
    Claim(
        "the followed point has no pixel, so nothing leads back to it",
        lambda run, k, m: bool(np.isnan(run.states[k].now.uv[run.params.point]).all()),
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
        r"The pose is OpenGL's .*: depths ahead are negative, dividing mirrors",
        lambda run, k, m: bool(
            (
                run.states[k].now.p_camera[np.isfinite(ideal(run.params, street().points)[:, 0]), 2]
                < 0
            ).all()
        ),
    ),
    Claim(
        r"\(row, column\) stands where \(u, v\) = \(column, row\) belongs",
        _wrong("row before column"),
    ),
    Claim(
        "The lens was given pixels, not normalised coordinates: r² is f² times too large",
        _wrong("lens on pixels"),
    ),
    Claim(
        "t is not where the camera is; C = −Rᵀt is",
        lambda run, k, m: bool(np.linalg.norm(camera(run.params)[1] - centre(run.params)) > 0.1),
    ),
    Claim("The length of the ray was taken for the depth Z", _wrong("ray length for depth")),
    Claim(
        "K is still that of the full picture",
        lambda run, k, m: run.params.edit != "none" and not run.params.k_follows,
    ),
    Claim(
        rf"[Tt]he pixels are off by ({POWER}) px \(median\)",
        lambda run, k, m: says(m[1], median_off(run, k)),
    ),
    Claim(
        rf"({NUMBER}) of ({NUMBER}) points lose their pixel",
        lambda run, k, m: number(m[1]) == lost(run, k)[0] and number(m[2]) == len(street().points),
    ),
    Claim(
        rf"({NUMBER}) points? ha(?:s|ve) a pixel that the true camera does not give",
        lambda run, k, m: number(m[1]) == lost(run, k)[1],
    ),
    Claim(
        rf"[Tt]he points that come back are off by ({LENGTH}) \(median\)",
        lambda run, k, m: says_length(m[1], median_back(run)),
    ),
    # who blames nobody says that all is right
    Claim(rf"^(?!.*(?:{BLAME}))", lambda run, k, m: right(run, k) is not False),
)


# The lines of the presets -------------------------------------------------------------------------


def with_(run: Run, **changes: Any) -> Run:
    params = replace(run.params, **changes)
    return Run(params, tuple(follow(params)))


def _doubled(run: Run, k: int, m: re.Match[str]) -> bool:
    c, half = np.array([159.5, 119.5]), with_(run, f=run.params.f / 2)
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
    now = run.states[STAGES.index("divide")].now
    beyond = np.linalg.norm(now.xy, axis=1) > 0.745
    x, y = now.xy[beyond].T
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
    off = np.linalg.norm(run.states[-1].now.p_back - street().points, axis=1)
    t = camera(run.params)[1]
    return close(off[np.isfinite(off)], np.linalg.norm(t - centre(run.params)))


def _too_far(run: Run, k: int, m: re.Match[str]) -> bool:
    R, t, _ = camera(run.params)
    seen = np.isfinite(run.states[-1].now.p_back).all(axis=1)
    z, z_back = ((p @ R.T + t)[seen, 2] for p in (street().points, run.states[-1].now.p_back))
    r = np.linalg.norm(ideal(run.params, street().points)[seen], axis=1)
    return bool(
        (z_back >= z).all()
        and (np.diff((z_back / z)[np.argsort(r)]) > -1e-9).all()
        and r.max() > 0.3
    )


def _mirrored(run: Run, k: int, m: re.Match[str]) -> bool:
    """Left to right, about the principal point; what is in front has a negative depth."""
    true = pixels(run.params, street().points)
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
            "a ball's outline is longer than wide",
            lambda run, k, m: run.states[0].shot.ball_ratio > 1.2,
        ),
    ),
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
                pixels_at(run), pixels(run.params, street().points)[:, ::-1], equal_nan=True
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
                bool(np.abs(run.states[0].shot.K[:2, 2] - (64.5, 49.5)).min() > 5)
                and close(run.states[0].shot.K[0, 0], run.params.f / 2)
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
    R, t, K = camera(run.params)
    before, after = (
        K @ (R @ p + t - offset) for offset in (np.zeros(3), np.array([2.0, 0.0, 0.0]))
    )
    return float(after[0] / after[2] - before[0] / before[2])


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
    "predict-crop": (
        Claim(
            rf"({NUMBER}) px: first .*The middle of the picture is ({NUMBER}) px",
            lambda run, k, m: (
                says(m[1], (159.5 - 60 + 0.5) / 2 - 0.5)
                and says(m[2], ((320 - 60) / 2 - 1) / 2)
                and says(m[1], float(run.states[0].shot.K[0, 2]))
            ),
        ),
    ),
}
