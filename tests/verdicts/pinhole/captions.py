"""What captions of the pinhole lesson say of a stage, the values that they carry, and whether the
stage is right: held against the camera written out in plain numpy.
"""

import re
from dataclasses import replace

import numpy as np

from tests.readings import close
from tests.truths.pinhole import (
    CRATE,
    STAGES,
    TOWER,
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
    pixels,
    points,
)
from tests.verdicts import Claim, Run
from workbench.data.views.street import BALL_CENTER, BALL_RADIUS, street


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
