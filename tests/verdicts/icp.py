"""When the sentences of the ICP lesson are true, decided with scipy from the motions and the truth
they carry.
"""

import re
from collections.abc import Callable, Iterator

import numpy as np

from lessons.icp.captions import caption
from lessons.icp.lesson import run as run_icp
from lessons.icp.state import Params, State
from tests.readings import LENGTH, NUMBER, metres, near, near_length
from tests.truths.icp import (
    arrived,
    came_home,
    degrees,
    end_of,
    ended,
    fixed_gate,
    moved,
    off_by,
    share,
    spacing,
    started,
    try_home,
)
from tests.verdicts import Claim, Run
from workbench.algorithms.registration.icp import Stop

__all__ = ["CAPTIONS", "LINES", "WHYS", "caption", "right"]


def until_the_end(params: Params) -> Iterator[State]:
    """The run without its tries from other starts, which take ten times as long."""
    for state in run_icp(params):
        yield state
        if state.icp.stop is not None:
            return


def right(run: Run, k: int) -> bool | None:
    state = run.states[k]
    return None if state.icp.stop is None else arrived(run, k)


def angle_close(said: str, true: float) -> bool:
    return true < 0.0011 if said.startswith("less") else near(said, true)


def said_share(run: Run, k: int, m: re.Match[str]) -> bool:
    true = share(run, k)
    if m[1].startswith("Hardly"):
        return true < 0.005
    return abs(float(re.findall(r"\d+", m[1])[0]) - 100 * true) <= 0.51 and m[1].startswith(
        "Only"
    ) == (true < 0.5)


def stood_still(run: Run, k: int, _: re.Match[str]) -> bool:
    last = max(i for i, state in enumerate(run.states[: k + 1]) if not state.tries)
    before, now = run.states[last - 1], run.states[last]
    p = now.scans.p_source
    step = np.linalg.norm(
        moved(now.icp.T_target_source, p) - moved(before.icp.T_target_source, p), axis=1
    ).max()
    return float(step) <= 1e-5 * float(np.linalg.norm(np.ptp(p, axis=0)))


def came_round(run: Run, k: int, _: re.Match[str]) -> bool:
    now = run.states[k].icp
    return any(
        np.array_equal(s.icp.indices, now.indices) and np.array_equal(s.icp.kept, now.kept)
        for s in run.states[: k - 1]
        if s.icp.iteration < now.iteration
    )


def try_ends(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    assert state.scans.T_truth is not None
    turn, place, _ = off_by(state, state.tries[-1].T_target_truth @ state.scans.T_truth)
    return (
        (m[2] == "comes home") is try_home(state, -1)
        and float(m[1]) == state.tries[-1].start_angle
        and angle_close(m[3], turn)
        and near_length(m[4], place)
    )


def row(run: Run, k: int, m: re.Match[str]) -> bool:
    """Every start up to the angle comes home, and the next one does not."""
    state = run.states[k]
    came = [try_home(state, i) for i in range(len(state.tries))]
    angles = [attempt.start_angle for attempt in state.tries]
    edge = angles.index(float(m[1]))
    return all(came[: edge + 1]) and (edge + 1 == len(came) or not came[edge + 1])


def fit_ends(run: Run, k: int, m: re.Match[str]) -> bool:
    turn, place, _ = off_by(run.states[k], run.states[k].icp.T_target_source)
    return angle_close(m[1], turn) and near_length(m[2], place)


def another_experiment(run: Run, k: int, m: re.Match[str]) -> bool:
    """The try has so many points, and starts on the other side of the truth, without the run's
    shift.
    """
    scans = run.states[k].scans
    assert scans.T_truth is not None
    start = (scans.T_start @ np.linalg.inv(scans.T_truth))[:3, :3]
    turned = degrees(scans.T_start, scans.T_truth) < 1e-6 or start[1, 0] < 0
    return (
        turned
        and int(m[1]) < len(scans.p_source)
        and ("not shifted" in m[0]) == (run.params.start_shift > 0)
    )


ANGLE = rf"(less than 0\.001|{NUMBER})°"
CAPTIONS = (
    Claim(
        r"Another start, with (\d+) of the source's points(?:, turned the other way)?(?:, not"
        r" shifted)?: ",
        another_experiment,
    ),
    Claim(
        rf"from (\d+)° away, ICP (comes home|ends) {ANGLE} and ({LENGTH}) from the truth", try_ends
    ),
    Claim(r"In this row, every start up to (\d+)° comes home\.", row),
    Claim(
        r"Not even the start at 0° comes home\.", lambda run, k, m: not try_home(run.states[k], 0)
    ),
    Claim(rf"(?<=, ){ANGLE} and ({LENGTH}) from the truth\.", fit_ends),
    Claim(r"((?:Only )?\d+ %|Hardly any) of its matches (?:was|were) right\.", said_share),
    Claim(r"converged: the last fit moved no point by more than the tolerance", stood_still),
    Claim(r"the matches are those of an earlier iteration again", came_round),
    Claim(r"It has come home\.", lambda run, k, m: arrived(run, k)),
    Claim(
        r"It looks settled, and it is wrong\.",
        lambda run, k, m: (
            run.states[k].icp.stop in (Stop.CONVERGED, Stop.CIRCLING) and not arrived(run, k)
        ),
    ),
    Claim(r"It is wrong\.", lambda run, k, m: not arrived(run, k)),
)


def seen(holds: Callable[[Run], bool]) -> Callable[[Run, int, re.Match[str]], bool]:
    """Judge a number that is seen at the presets' own seed, and there alone."""
    return lambda run, k, m: run.params.seed != 0 or holds(run)


def from_45_lost(run: Run) -> bool:
    state = run.states[-1]
    return [try_home(state, i) for i in range(len(state.tries))] == [
        one.start_angle < 45 for one in state.tries
    ]


def outliers_fall_out(run: Run, k: int, m: re.Match[str]) -> bool:
    state = end_of(run)
    return float(state.icp.kept[state.scans.is_outlier].mean()) < 0.1


LINES = {
    "home": (Claim("how many of its matches were right", None),),
    "slide": (
        Claim(r"the rotation is found to 0\.1°", lambda run, k, m: ended(run)[0] < 0.15),
        Claim(
            r"the source ends as far off as it started, 0\.31 m",
            seen(
                lambda run: all(abs(off - 0.3135) < 0.005 for off in (started(run), ended(run)[1]))
            ),
        ),
    ),
    "overlap-adaptive": (
        Claim(
            r"a tenth of the fixed gate's rotation error is left, 0\.06° of 0\.63°",
            seen(
                lambda run: (
                    near("0.064", ended(run)[0], 2) and near("0.63", fixed_gate(run.params.seed), 2)
                )
            ),
        ),
    ),
    "overlap-tight": (
        Claim(
            r"from 45° on, too few good matches pass and no start comes home", seen(from_45_lost)
        ),
    ),
    "outliers": (
        Claim(
            r"the outliers pull the source 15° astray",
            seen(lambda run: near("15", ended(run)[0], 2)),
        ),
    ),
    "outliers-trimmed": (
        Claim(r"nearly all outliers fall out", outliers_fall_out),
        Claim(r"ICP comes home", lambda run, k, m: came_home(run)),
    ),
    "rings-chance": (
        Claim(
            r"0\.49 m stay", seen(lambda run: near("0.49", ended(run)[1], 2) and not came_home(run))
        ),
    ),
    "rings-voxel": (Claim(r"36 mm stay", seen(lambda run: near("36", 1e3 * ended(run)[1], 2))),),
    "rings-spread": (Claim(r"6 mm stay", seen(lambda run: near("6", 1e3 * ended(run)[1], 1))),),
}

WHYS = {
    "predict-matches": (
        Claim(
            rf"ICP still (came home to|ended) {ANGLE} and ({LENGTH}) from the truth",
            lambda run, k, m: (
                (m[1] == "came home to") is came_home(run)
                and angle_close(m[2], ended(run)[0])
                and near_length(m[3], ended(run)[1])
            ),
        ),
        Claim(
            r"^(\d+) %",
            lambda run, k, m: (
                abs(100 * share(run, 0) - float(m[1])) <= 0.51 and share(run, 0) < 0.25
            ),
        ),
        Claim(
            r"partners need not be right for a fit to turn the source downhill",
            lambda run, k, m: came_home(run),
        ),
    ),
    "predict-far": (
        Claim(
            rf"It ended {ANGLE} and ({LENGTH}) from the truth",
            lambda run, k, m: (
                angle_close(m[1], ended(run)[0])
                and near_length(m[2], ended(run)[1])
                and not came_home(run)
            ),
        ),
        Claim(
            r"Each fit can only lower the cost",
            lambda run, k, m: all(
                fit.icp.rmse <= match.icp.rmse + 1e-12
                for match, fit in zip(run.states[0::2], run.states[1::2], strict=False)
                if not fit.tries and not match.tries
            ),
        ),
    ),
    "predict-vase": (
        Claim(
            rf"RMSE ({LENGTH}), where neighbouring target points lie ({LENGTH}) apart",
            lambda run, k, m: (
                near_length(m[1], end_of(run).icp.rmse)
                and abs(metres(m[2]) / spacing(end_of(run)) - 1)
                < 0.1  # the lesson takes some hundred points
                and metres(m[1]) < 2 * metres(m[2])
            ),
        ),
        Claim(
            r"(\d+)° of turn left",
            lambda run, k, m: abs(ended(run)[0] - float(m[1])) <= 0.51 and not came_home(run),
        ),
    ),
}
