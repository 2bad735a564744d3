"""When the sentences of the epipolar lesson are true, decided ray by ray and by scipy from its
states.
"""

import re

import numpy as np

from tests.readings import NUMBER, near, number
from tests.truths.epipolar import apart, errors, in_front, is_right, rows_apart, sampson
from tests.verdicts import Claim, Run

__all__ = ["CAPTIONS", "LINES", "WHYS", "right"]

PX = rf"({NUMBER}) px"


def right(run: Run, k: int) -> bool | None:
    return is_right(run.states[k])


def off(run: Run, k: int, m: re.Match[str]) -> bool:
    angles = errors(run.states[k])
    return angles is not None and near_angle(m[1], angles[0]) and near_angle(m[2], angles[1])


def near_angle(text: str, degrees: float) -> bool:
    """Whether an angle to three digits says what was found; arc cosines are good to a few
    millionths of a degree.
    """
    return near(text, degrees) or abs(number(text) - degrees) < 2e-5


def judged(run: Run, k: int, m: re.Match[str]) -> bool:
    return off(run, k, m) and (m[3].startswith(": right")) == bool(is_right(run.states[k]))


def with_true_length(run: Run, k: int, m: re.Match[str]) -> bool:
    """The baseline that depths are given with is the true one."""
    return (
        abs(run.states[k].length - float(np.linalg.norm(run.states[k].views.T_second_first[:3, 3])))
        < 1e-9
    )


def only_turned(run: Run, k: int, m: re.Match[str]) -> bool:
    return not np.any(run.states[k].views.T_second_first[:3, 3])


def to_lines(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    return near_px(m[1], sampson(state.now.F, state.views.matches))


def near_px(text: str, value: float) -> bool:
    return abs(value) < 5e-4 if number(text) == 0 else near(text, value)


def before_both(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    return abs(number(m[1]) - in_front(state, state.now.tested[-1])) <= 1  # one may be on a border


def parallax(run: Run, k: int, m: re.Match[str]) -> bool:
    """Each match's true point beside the point a million times as far along its ray, both seen by
    the second camera.
    """
    views = run.states[k].views
    R = views.T_second_first[:3, :3]
    t = views.T_second_first[:3, 3]
    moves = []
    for p in views.p_first:
        near, far = (views.K_second @ (R @ q + t) for q in (p, 1e9 * p))
        moves.append(np.hypot(*(near[:2] / near[2] - far[:2] / far[2])))
    return near_px(m[1], float(np.median(moves))) and near_px(m[2], run.params.noise)


CAPTIONS = (
    Claim(
        rf"The motion is ({NUMBER}|less than 0\.001)° in rotation and ({NUMBER})° in direction from"
        r" the true one"
        r"(: right\.|\. It is wrong\.)",
        judged,
    ),
    Claim(
        r"there is no direction, and the one of this motion is made up\. It is wrong\.", only_turned
    ),
    Claim(r"with the baseline's true length", with_true_length),
    Claim(rf"atches are {PX} from their lines", to_lines),
    Claim(rf"it puts ({NUMBER}) of {NUMBER} points in front", before_both),
    Claim(
        rf"matched rows are {PX} apart", lambda run, k, m: near_px(m[1], rows_apart(run.states[k]))
    ),
    Claim(rf"In the median parallax is {PX}, depths .* Noise is ({NUMBER}) px", parallax),
    Claim(rf"the rotation is ({NUMBER})° off, the direction ({NUMBER})°", off),
)


def last_errors(run: Run) -> tuple[float, float]:
    angles = errors(run.states[-1])
    assert angles is not None
    return angles


def turned_over(run: Run) -> float:
    """How far the first camera is turned to be rectified, degrees."""
    return apart(run.states[-1].now.rectification.R_rectified_first, np.eye(3))


def last_distance(run: Run) -> float:
    state = run.states[-1]
    return sampson(state.now.F, state.views.matches)


def four(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[-1]
    return [int(n) for n in m[1].split(", ")] == [in_front(state, T) for T in state.now.tested]


LINES = {
    "sideways": (
        Claim(
            r"Straight to the right",
            lambda run, k, m: run.states[0].views.T_second_first[0, 3] < -0.9,
        ),
        Claim(r"rectification hardly changes anything", lambda run, k, m: turned_over(run) < 12),
    ),
    "oblique": (
        Claim(r"by more than half a right angle", lambda run, k, m: turned_over(run) > 45),
    ),
    "left": (
        Claim(
            r"Left and right are swapped",
            lambda run, k, m: run.states[0].views.T_second_first[0, 3] > 0.9,
        ),
    ),
    "upside-down": (
        Claim(r"rows correspond, upside down", lambda run, k, m: turned_over(run) > 150),
    ),
    "short": (
        Claim(
            r"the lines are as near", lambda run, k, m: last_distance(run) < 1.3 * run.params.noise
        ),
        Claim(
            r"the rotation stays within 1° with every seed",
            lambda run, k, m: last_errors(run)[0] < 1.0,
        ),
    ),
    "far": (
        Claim(
            r"nothing nearer than 180 baselines",
            lambda run, k, m: run.states[0].views.p_first[:, 2].min() > 180,
        ),
        Claim(
            r"The rotation stays within 1° with every seed",
            lambda run, k, m: last_errors(run)[0] < 1.0,
        ),
    ),
    "wrong-f": (
        Claim(
            r"The matches of the run straight to the side",
            lambda run, k, m: run.params.heading == 0,
        ),
    ),
    "turned": (
        Claim(r"the rotation can be had all the same", lambda run, k, m: last_errors(run)[0] < 1.0),
    ),
}

WHYS = {
    "predict-f": (
        Claim(
            rf"They are {PX} from them.*it is ({NUMBER})° off in rotation",
            lambda run, k, m: (
                near_px(m[1], last_distance(run)) and near_angle(m[2], last_errors(run)[0])
            ),
        ),
    ),
    "predict-plane": (
        Claim(rf"^({NUMBER})°\.", lambda run, k, m: near_angle(m[1], last_errors(run)[1])),
    ),
    "predict-four": (
        Claim(
            r"They put ([\d, ]+) of (\d+) points there",
            four,
        ),
    ),
    "predict-baseline": (
        Claim(
            rf"^({NUMBER}) cm",
            lambda run, k, m: abs(number(m[1]) - 100 * 64 / (420 * 0.5) * 0.5 * 2**0.5) < 1.0,
        ),
    ),
}
