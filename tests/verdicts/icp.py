"""When what the ICP lesson says is true, decided with scipy from the motions and the truth they
carry.
"""

import re
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from lessons.icp.captions import caption as caption_space
from lessons.icp.flat import Outlines
from lessons.icp.flat import caption as caption_flat
from lessons.icp.inputs import Input
from lessons.icp.lesson import run as run_icp
from lessons.icp.lesson import setup
from lessons.icp.space import Try
from tests.readings import LENGTH, NUMBER, metres, near, near_length
from tests.truths.icp import (
    came_home,
    degrees,
    end_of,
    ended,
    fixed_gate,
    flat_right,
    flat_rmse,
    flat_turn,
    home,
    moved,
    of_try,
    off_by,
    spacing,
    started,
    steps,
    try_home,
)
from tests.verdicts import Claim, Run
from workbench.algorithms.registration.icp import Stop
from workbench.lesson import Look
from workbench.scene import Caption

__all__ = ["CAPTIONS", "LINES", "VALUES", "WHYS", "caption", "right", "until_the_end"]

ANGLE = rf"(less than 0\.001|{NUMBER})°"


def caption(look: Look) -> Caption:
    return caption_flat(look) if isinstance(look.subject, Outlines) else caption_space(look)


def until_the_end(params: Input) -> Iterator[Any]:
    """The run without its tries from other starts, which take ten times as long."""
    for state in run_icp(params, setup(params)):
        yield state
        if not isinstance(state, Try) and state.stop is not None:
            return


def flat(run: Run) -> bool:
    return isinstance(run.subject, Outlines)


def folded(angle: float) -> float:
    """The same direction within (-180, 180]."""
    direction = float(np.degrees(np.angle(np.exp(1j * np.radians(angle)))))
    return direction if direction > -180.0 + 1e-9 else 180.0


def right(run: Run, k: int) -> bool | None:
    state = run.states[k]
    if isinstance(state, Try) or state.stop is None:
        return None
    if flat(run):
        return abs(folded(state.angle)) <= 5.0
    return home(run.subject, state.T_target_source)


def angle_close(text: str, true: float) -> bool:
    return true < 0.0011 if text.startswith("less") else near(text, true)


def stood_still(run: Run, k: int, _: re.Match[str]) -> bool:
    before = run.states[k - 1]
    after = run.states[k]
    if flat(run):
        return abs(after.angle - before.angle) <= 0.05
    p = run.subject.p_source
    step = moved(after.T_target_source, p) - moved(before.T_target_source, p)
    size = float(np.linalg.norm(np.ptp(p, axis=0)))
    return float(np.linalg.norm(step, axis=1).max()) <= 1e-5 * size


def rests(run: Run, k: int, m: re.Match[str]) -> bool:
    """In the flat a run may end in a circle as well."""
    if flat(run) and run.states[k].stop is Stop.CIRCLING:
        return any(np.array_equal(s.partners, run.states[k].partners) for s in run.states[: k - 1])
    return stood_still(run, k, m)


def came_round(run: Run, k: int, _: re.Match[str]) -> bool:
    state = run.states[k]
    return any(
        np.array_equal(s.indices, state.indices) and np.array_equal(s.kept, state.kept)
        for s in run.states[: k - 1]
        if s.iteration < state.iteration
    )


def row(run: Run, k: int, _: re.Match[str]) -> bool:
    """Every start up to the angle comes home, and the next one does not."""
    first = next(i for i, state in enumerate(run.states) if isinstance(state, Try))
    came = [try_home(run, i) for i in range(first, k + 1)]
    angles = [run.states[i].start_angle for i in range(first, k + 1)]
    edge = angles.index(edge_of(run, k))
    return all(came[: edge + 1]) and (edge + 1 == len(came) or not came[edge + 1])


def edge_of(run: Run, k: int) -> float:
    arrived = [
        s.start_angle
        for i, s in enumerate(run.states[: k + 1])
        if isinstance(s, Try) and try_home(run, i)
    ]
    first = next(i for i, state in enumerate(run.states) if isinstance(state, Try))
    lost = [run.states[i].start_angle for i in range(first, k + 1) if not try_home(run, i)]
    return max(angle for angle in arrived if angle < min(lost, default=999.0))


CAPTIONS = (
    Claim(r"ICP comes home,", lambda run, k, m: try_home(run, k)),
    Claim(r"ICP ends elsewhere,", lambda run, k, m: not try_home(run, k)),
    Claim(r"It comes home from every start up to ", row),
    Claim(
        r"Not even a start at 0° comes home\.", lambda run, k, m: right_of_first_try(run) is False
    ),
    Claim(r"It comes to rest ", rests),
    Claim(r"the matches are those of an earlier iteration again", came_round),
    Claim(r"\d+ of 50 partners are right", None),
    Claim(r"It looks settled, and it is wrong\.", lambda run, k, m: right(run, k) is False),
    Claim(r"It is wrong\.", lambda run, k, m: right(run, k) is False),
)


def right_of_first_try(run: Run) -> bool:
    return try_home(run, next(i for i, s in enumerate(run.states) if isinstance(s, Try)))


def turn_of(run: Run, k: int) -> float:
    if flat(run):
        return flat_turn(run, k)
    return degrees(run.states[k].T_target_source, run.states[k - 1].T_target_source)


def rmse_of(run: Run, k: int) -> float:
    if flat(run):
        return flat_rmse(run, k)
    state = run.states[k]
    if isinstance(state, Try):
        return state.rmse
    p = moved(state.T_target_source, run.subject.p_source)
    q = run.subject.p_target[state.indices]
    return float(np.sqrt(((p - q)[state.kept] ** 2).sum(axis=1).mean()))


def degrees_off(run: Run, k: int) -> float:
    if isinstance(run.states[k], Try):
        return of_try(run, k)[0]
    return off_by(run.subject, run.states[k].T_target_source)[0]


def rounds(run: Run, k: int) -> float:
    return sum(state.phase == "match" for state in steps(run)[: k + 1])


VALUES = {
    "angle": lambda run, k: folded(run.states[k].angle),
    "at": lambda run, k: folded(run.states[k].angle),
    "rmse": rmse_of,
    "n": rounds,
    "rounds": rounds,
    "good": flat_right,
    "points": lambda run, k: len(run.subject.p_source),
    "kept": lambda run, k: (
        int(np.ceil(run.params.keep * len(run.subject.p_source)))
        if run.params.gate == "trimmed"
        else int(run.states[k].kept.sum())
    ),
    "turned": turn_of,
    "off": degrees_off,
    "away": lambda run, k: off_by(run.subject, run.states[k].T_target_source)[1],
    "start": lambda run, k: 15.0 * sum(isinstance(s, Try) for s in run.states[:k]),
    "edge": edge_of,
}


def seen(holds: Callable[[Run], bool]) -> Callable[[Run, int, re.Match[str]], bool]:
    """Judge a number that is seen at the presets' own seed, and there alone."""
    return lambda run, k, m: run.params.seed != 0 or holds(run)


def from_60_lost(run: Run) -> bool:
    came = [try_home(run, i) for i, state in enumerate(run.states) if isinstance(state, Try)]
    return came == [15 * i < 60 for i in range(len(came))]


def outliers_fall_out(run: Run, k: int, m: re.Match[str]) -> bool:
    left_out = 1.0 - run.params.keep
    fell_out = float(end_of(run).kept[run.subject.is_outlier].mean()) < 0.1
    return run.params.outliers < left_out <= run.params.outliers + 0.1 and fell_out


LINES = {
    "slide": (
        Claim(r"the turn is off by less than 0\.1°", lambda run, k, m: ended(run)[0] < 0.1),
        Claim(
            r"the source ends as far off as it started, 0\.31 m",
            seen(
                lambda run: all(abs(off - 0.3135) < 0.005 for off in (started(run), ended(run)[1]))
            ),
        ),
    ),
    "overlap-adaptive": (
        Claim(
            r"a tenth of the fixed gate's rotation error, 0\.06° of 0\.63°",
            seen(
                lambda run: (
                    near("0.064", ended(run)[0], 2) and near("0.63", fixed_gate(run.params.seed), 2)
                )
            ),
        ),
    ),
    "overlap-tight": (
        Claim(r"leaves 0\.02°", seen(lambda run: near("0.024", ended(run)[0], 2))),
        Claim(r"from 60° on too few good matches pass", seen(from_60_lost)),
    ),
    "outliers": (
        Claim(r"the source stays 15° off", seen(lambda run: near("15", ended(run)[0], 2))),
    ),
    "outliers-trimmed": (
        Claim(r"leaves out somewhat more than there are outliers", outliers_fall_out),
        Claim(r"ICP comes home", lambda run, k, m: came_home(run)),
    ),
    "rings-chance": (Claim(r"0\.49 m stay", seen(lambda run: near("0.49", ended(run)[1], 2))),),
    "rings-voxel": (Claim(r"36 mm stay", seen(lambda run: near("36", 1e3 * ended(run)[1], 2))),),
    "rings-spread": (Claim(r"6 mm stay", seen(lambda run: near("6", 1e3 * ended(run)[1], 1))),),
}


def never_raised(run: Run, k: int, m: re.Match[str]) -> bool:
    return bool(np.all(np.diff([rmse_of(run, i) for i in range(len(steps(run)))]) <= 1e-9))


WHYS = {
    "how-many-now": (
        Claim(r"^(\d+) of them, most of them shallow", lambda run, k, m: valleys(run) == int(m[1])),
        Claim(
            rf"it reaches down to ({LENGTH})", lambda run, k, m: near_length(m[1], lowest(run), 2)
        ),
    ),
    "predict-matches": (
        Claim(r"^(\d+) of 50", lambda run, k, m: flat_right(run, 0) == int(m[1])),
        Claim(
            rf"it ends at {ANGLE}",
            lambda run, k, m: angle_close(m[1], folded(run.states[-1].angle)),
        ),
        Claim(
            r"wrong partners turn the rabbit too little, but together they turn it the right way",
            lambda run, k, m: 0 < run.states[0].angle - run.states[1].angle < run.states[0].angle,
        ),
    ),
    "where-it-rests": (
        Claim(
            rf"^({NUMBER})°\. From 75° the way down leads to the right, away from home",
            lambda run, k, m: (
                abs(float(m[1]) - folded(run.states[-1].angle)) < 0.6 and run.states[1].angle > 75.0
            ),
        ),
    ),
    "predict-far": (
        Claim(
            rf"It ended {ANGLE} and ({LENGTH}) from the truth, at an RMSE of ({LENGTH})",
            lambda run, k, m: (
                angle_close(m[1], ended(run)[0])
                and near_length(m[2], ended(run)[1])
                and near_length(m[3], rmse_of(run, len(steps(run)) - 1))
                and not came_home(run)
            ),
        ),
        Claim(r"No match and no fit raised the cost", never_raised),
    ),
    "best-share": (
        Claim(
            rf"it ends {ANGLE} and ({LENGTH}) from the truth",
            lambda run, k, m: angle_close(m[1], ended(run)[0]) and near_length(m[2], ended(run)[1]),
        ),
    ),
    "predict-vase": (
        Claim(
            rf"The RMSE is ({LENGTH}), where neighbouring target points lie ({LENGTH}) apart",
            lambda run, k, m: (
                near_length(m[1], rmse_of(run, len(run.states) - 1))
                and abs(metres(m[2]) / spacing(run.subject) - 1)
                < 0.1  # the lesson takes some hundred points
                and metres(m[1]) < 2 * metres(m[2])
            ),
        ),
        Claim(
            r"(\d+)° of the turn are left",
            lambda run, k, m: abs(ended(run)[0] - float(m[1])) <= 0.51 and not came_home(run),
        ),
    ),
}


def costs(run: Run) -> np.ndarray:
    """The RMSE to the nearest points at each angle of the hand, by a tree."""
    from scipy.spatial import KDTree

    from tests.truths.icp import turned

    tree = KDTree(run.subject.p_target)
    distances = [
        tree.query(turned(run.subject.p_source, state.angle))[0] for state in run.states[:-1]
    ]
    return np.sqrt((np.array(distances) ** 2).mean(axis=1))


def valleys(run: Run) -> int:
    rmse = costs(run)
    return int(((rmse < np.roll(rmse, 1)) & (rmse <= np.roll(rmse, -1))).sum())


def lowest(run: Run) -> float:
    return float(costs(run).min())
