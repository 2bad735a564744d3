"""What the calibration lesson says of its runs, decided from a camera written out anew and from differences."""

import functools
import re

import numpy as np

from lessons.calibration.state import State
from lessons.calibration.words import caption
from tests.readings import NUMBER, near, number, says
from tests.truths.calibration import LENS, deviation_of_f, rms_of, worst_ray
from tests.verdicts import Claim, Run

__all__ = ["CAPTIONS", "LINES", "WHYS", "caption", "right"]

F, SIGMAS = 536.0, np.sqrt(2)


def right(run: Run, k: int) -> bool | None:
    """At the end f is right to 1 % and all rays to 10 px; poses are none where they are behind or not rigid."""
    state: State = run.states[k]
    K = state.now.K
    if state.ending is None or state.ending.kind != "known" or state.subject.K is None or K is None:
        return None
    return bool(abs(K[0, 0] - F) <= 0.01 * F and _worst(state) <= 10.0)


@functools.lru_cache(maxsize=8)
def _worst(state: State) -> float:
    assert state.now.K is not None
    return worst_ray(state.now.K, tuple(state.now.lens))


@functools.lru_cache(maxsize=8)
def _deviation(state: State) -> float:
    return deviation_of_f(state)


def _end(run: Run) -> State:
    return run.states[-1]


def _f(run: Run) -> float:
    K = _end(run).now.K
    assert K is not None
    return float(K[0, 0])


# captions -----------------------------------------------------------------------------------------------------------------


def _focal(run: Run, k: int, m: re.Match[str]) -> bool:
    K = run.states[k].now.K
    return says(m["f"], K[0, 0]) and says(m["true"], F)


def _no_camera(run: Run, k: int, m: re.Match[str]) -> bool:
    """The B of the last singular vector has eigenvalues of both signs."""
    rows = run.states[k].now.rows
    a, b, c, d, e = np.linalg.svd(rows[:, [0, 2, 3, 4, 5]])[2][-1]
    signs = np.sign(np.linalg.eigvalsh([[a, 0, c], [0, b, d], [c, d, e]]))
    return len(set(signs)) > 1


def _k1(run: Run, k: int, m: re.Match[str]) -> bool:
    return says(m["k1"], run.states[k].now.lens.k1) and says(m["true"], LENS[0])


def _taken_up(run: Run, k: int, m: re.Match[str]) -> bool:
    """Less than 70 % of k1, or more than 130 %, is what the linear step gives."""
    return not 0.7 < run.states[k].now.lens.k1 / LENS[0] < 1.3


def _rms(run: Run, k: int, m: re.Match[str]) -> bool:
    return near(m["rms"], float(np.sqrt((rms_of(run.states[k]) ** 2).mean())))


def _falls(run: Run, k: int, m: re.Match[str]) -> bool:
    before, after = (float(np.sqrt((rms_of(run.states[i]) ** 2).mean())) for i in (k - 1, k))
    falls = after < before or "falls" not in m[0] or run.params.loss == "Cauchy"
    return near(m["before"], before) and near(m["after"], after) and falls


def _least(run: Run, k: int, m: re.Match[str]) -> bool:
    state, rms = run.states[k], rms_of(run.states[k])
    i = state.subject.views.index(int(m["view"]))
    others = np.delete(rms, i)
    share = 100 * rms[i] ** 2 / (rms**2).sum()
    return (
        rms[i] == rms.max()
        and near(m["rms"], float(rms[i]))
        and near(m["others"], float(np.median(others)))
        and says(m["share"], share)
    )


def _moved(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    f, other = float(state.now.K[0, 0]), float(state.ending.without.K[0, 0])
    said = says(m["f"], f) and says(m["other"], other) and near(m["move"], abs(f - other))
    return said and abs(number(m["times"]) * _deviation(state) / max(abs(f - other), 1e-9) - 1) < 0.07


def _plus_minus(run: Run, k: int, m: re.Match[str]) -> bool:
    return abs(number(m["sd"]) - _deviation(run.states[k])) < 0.051 + 0.01 * _deviation(run.states[k])


def _off(run: Run, k: int, m: re.Match[str]) -> bool:
    return near(m["worst"], _worst(run.states[k])) or says(m["worst"], _worst(run.states[k]))


def _apart_by(run: Run, k: int, m: re.Match[str]) -> bool:
    K = run.states[k].now.K
    return says(m["share"], 100 * abs(K[0, 0] / K[1, 1] - 1))


def _more_than_noise(run: Run, k: int, m: re.Match[str]) -> bool:
    off = np.linalg.norm(run.states[k].now.residuals, axis=2)
    return bool(np.sqrt((off**2).mean()) > 1.4 * SIGMAS * run.params.noise)


CAPTIONS = [
    Claim(rf"f = (?P<f>{NUMBER}) px, in truth (?P<true>{NUMBER}) px", _focal),
    Claim(r"more than noise of .* in each coordinate explains", _more_than_noise),
    Claim(r"The B that fits best is not positive definite", _no_camera),
    Claim(rf"corners are off by (?P<rms>{NUMBER}) px", _rms),
    Claim(rf"k1 = (?P<k1>{NUMBER}), in truth (?P<true>{NUMBER})\.", _k1),
    Claim(r"have taken up most of it", _taken_up),
    Claim(rf"rms (?:goes|falls) from (?P<before>{NUMBER}) px to (?P<after>{NUMBER}) px", _falls),
    Claim(rf"Iteration \d+: rms (?P<rms>{NUMBER}) px", _rms),
    Claim(
        rf"View (?P<view>\d+) fits least: (?P<rms>{NUMBER}) px \(rms\), the others (?P<others>{NUMBER}) px in the median\."
        rf" Its residuals carry (?P<share>{NUMBER}) %",
        _least,
    ),
    Claim(
        rf"f = (?P<f>{NUMBER}) px becomes (?P<other>{NUMBER}) px, a move of (?P<move>{NUMBER}) px,"
        rf" (?P<times>{NUMBER}) times",
        _moved,
    ),
    Claim(rf"± (?P<sd>{NUMBER}) px", _plus_minus),
    Claim(rf"fx and fy are (?P<share>{NUMBER}) % apart", _apart_by),
    Claim(rf"Rays are off somewhere in the picture by (?P<worst>{NUMBER}) px", _off),
    Claim(
        r"It looks settled, and it is wrong\.",
        lambda run, k, m: right(run, k) is False and run.states[k].now.adjustment.stop.name == "CONVERGED",
    ),
    Claim(r"It is wrong\.", lambda run, k, m: right(run, k) is False),
]

# preset lines and explanations --------------------------------------------------------------------------------------------


def _noise_left(run: Run) -> float:
    return float(np.sqrt((rms_of(_end(run)) ** 2).mean())) / (SIGMAS * run.params.noise)


def _apart(run: Run, k: int, m: re.Match[str]) -> bool:
    K = _end(run).now.K
    assert K is not None
    return abs(K[0, 0] / K[1, 1] - 1) > 0.005


def _f_off(run: Run, k: int, m: re.Match[str]) -> bool:
    return near(m["off"], abs(_f(run) - F)) and abs(number(m["sd"]) / _deviation(_end(run)) - 1) < 0.02


def _distances(run: Run, k: int, m: re.Match[str]) -> bool:
    found, true = (Ts[:, :3, 3] for Ts in (_end(run).now.Ts_camera_board, _end(run).subject.Ts_camera_board))
    ratio = np.linalg.norm(found, axis=1).sum() / np.linalg.norm(true, axis=1).sum()
    return says(m["share"], 100 * abs(ratio - 1)) and (ratio < 1) == (m["sense"] == "short")


def _determined(run: Run, k: int, m: re.Match[str]) -> bool:
    """As many views as have rows of rank four, and not one fewer."""
    n = int(number(m["n"]))
    rows = {len(s.now.Hs_image_board): s.now.rows[:, [0, 2, 3, 4, 5]] for s in run.states if len(s.now.rows)}
    return np.linalg.matrix_rank(rows[n]) >= 4 and np.linalg.matrix_rank(rows[n - 1]) < 4


def _ratio(run: Run, k: int, m: re.Match[str]) -> bool:
    off, sd = abs(_f(run) - F), _deviation(_end(run))
    return near(m["off"], off) and abs(number(m["times"]) - off / sd) < 0.1 and abs(number(m["sd"]) / sd - 1) < 0.02


NOT_JUDGED = Claim(r"were found 5 px away|a wrong board is wrong in all views alike", None)

LINES = {
    "flat": [Claim(r"its ±: more than 50 px", lambda run, k, m: _deviation(_end(run)) > 50)],
    "pinhole": [
        Claim(
            r"f goes astray, and arrows in the picture show a pattern",
            lambda run, k, m: _noise_left(run) > 2 and abs(_f(run) - F) > 3,
        )
    ],
    "middle": [
        Claim(r"corners fit as well as ever", lambda run, k, m: _noise_left(run) < 1.1),
        Claim(r"off by thousands of pixels", lambda run, k, m: _worst(_end(run)) > 2000),
    ],
    "bad": [
        NOT_JUDGED,
        Claim(r"The bars tell which view it is", lambda run, k, m: int(np.argmax(rms_of(_end(run)))) == 1),
    ],
    "stretched": [Claim(r"fx and fy come out over half a per cent apart", _apart)],
}

WHYS = {
    "flat-rms": [
        Claim(rf"^(?P<rms>{NUMBER}) px, while", lambda run, k, m: near(m["rms"], _noise_left(run) * SIGMAS * 0.2)),
        Claim(rf"f is off by (?P<off>{NUMBER}) px \(± (?P<sd>{NUMBER}) px\)", _f_off),
    ],
    "noise-rms": [
        Claim(
            rf"^(?P<rms>{NUMBER}) px: .* It is a little less",
            lambda run, k, m: near(m["rms"], _noise_left(run) * SIGMAS * 0.2),
        )
    ],
    "views": [Claim(r"^(?P<n>\d+): B has", _determined)],
    "larger": [
        Claim(rf"f is off by (?P<off>{NUMBER}) px \(± (?P<sd>{NUMBER}) px\)", _f_off),
        Claim(rf"all distances are (?P<share>{NUMBER}) % too (?P<sense>short|long)", _distances),
    ],
    "bent-error": [
        NOT_JUDGED,
        Claim(rf"f is off by (?P<off>{NUMBER}) px, (?P<times>{NUMBER}) times its ± of (?P<sd>{NUMBER}) px", _ratio),
    ],
}
