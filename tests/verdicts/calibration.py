"""What the calibration lesson says of its runs, decided from a camera written out anew and from
differences.
"""

import functools
import re
from collections.abc import Callable

import numpy as np

from lessons.calibration.captions import caption
from lessons.calibration.lesson import lesson
from lessons.calibration.presets import FEW, FLAT
from lessons.calibration.state import Params, State
from tests.readings import NUMBER, near, number, says
from tests.truths.calibration import LENS, deviation_of_f, rms_of, worst_ray
from tests.verdicts import Claim, Run

__all__ = ["CAPTIONS", "LINES", "WHYS", "caption", "right"]

F = 536.0
SIGMAS = np.sqrt(2)


def right(run: Run, k: int) -> bool | None:
    """At the end f is right to 1 % and all rays to 10 px; poses are none where they are behind or
    not rigid.
    """
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


# captions -----------------------------------------------------------------------------------------


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
    state = run.states[k]
    rms = rms_of(run.states[k])
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
    f = float(state.now.K[0, 0])
    other = float(state.ending.without.K[0, 0])
    agrees = says(m["f"], f) and says(m["other"], other) and near(m["move"], abs(f - other))
    return (
        agrees
        and abs(number(m["times"]) * _deviation(state) / max(abs(f - other), 1e-9) - 1) < 0.07
    )


def _plus_minus(run: Run, k: int, m: re.Match[str]) -> bool:
    """The deviation to two digits, and f to no more than it bears out."""
    K = run.states[k].now.K
    sd = _deviation(run.states[k])
    agrees = abs(number(m["sd"]) - sd) < 0.051 * 10 ** np.floor(np.log10(sd)) + 0.01 * sd
    return agrees and abs(number(m["f"]) - K[0, 0]) < max(0.051, 0.1 * sd)


def _not_at_rest(run: Run, k: int, m: re.Match[str]) -> bool:
    """The limit ended it, and the gradient of the cost by f has not vanished."""
    state = run.states[k]
    cut = [state.now.adjustment, *([] if state.ending is None else [state.ending.without])]
    return any(
        adjustment is not None and adjustment.stop is not None and adjustment.iteration == 400
        for adjustment in cut
    )


def _off(run: Run, k: int, m: re.Match[str]) -> bool:
    return near(m["worst"], _worst(run.states[k]))


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
        rf"View (?P<view>\d+) fits worst: (?P<rms>{NUMBER}) px \(rms\), the others"
        rf" (?P<others>{NUMBER}) px in the median\."
        rf" Its residuals carry (?P<share>{NUMBER}) %",
        _least,
    ),
    Claim(
        rf"f = (?P<f>{NUMBER}) px becomes (?P<other>{NUMBER}) px, a move of (?P<move>{NUMBER}) px,"
        rf" (?P<times>{NUMBER}) times",
        _moved,
    ),
    Claim(rf"f = (?P<f>{NUMBER}) ± (?P<sd>{NUMBER}) px", _plus_minus),
    Claim(r"not at rest", _not_at_rest),
    Claim(rf"fx and fy are (?P<share>{NUMBER}) % apart", _apart_by),
    Claim(
        rf"The largest error of the lens map anywhere in the picture is (?P<worst>{NUMBER}) px",
        _off,
    ),
    Claim(
        r"It looks settled, and it is wrong\.",
        lambda run, k, m: (
            right(run, k) is False and run.states[k].now.adjustment.stop.name == "CONVERGED"
        ),
    ),
    Claim(r"It is wrong\.", lambda run, k, m: right(run, k) is False),
]

# preset lines and explanations --------------------------------------------------------------------


def _noise_left(run: Run) -> float:
    return float(np.sqrt((rms_of(_end(run)) ** 2).mean())) / (SIGMAS * run.params.noise)


@functools.cache
def _home() -> State:
    """The end of the default run: eight boards, tilted by up to 30°."""
    return list(lesson.run(lesson.params()))[-1]


def _apart(run: Run, k: int, m: re.Match[str]) -> bool:
    K = _end(run).now.K
    assert K is not None
    return says(m["share"], 100 * abs(K[0, 0] / K[1, 1] - 1))


def _f_off(run: Run, k: int, m: re.Match[str]) -> bool:
    return (
        near(m["off"], abs(_f(run) - F)) and abs(number(m["sd"]) / _deviation(_end(run)) - 1) < 0.05
    )


def _distances(run: Run, k: int, m: re.Match[str]) -> bool:
    estimated, true = (
        Ts[:, :3, 3] for Ts in (_end(run).now.Ts_camera_board, _end(run).subject.Ts_camera_board)
    )
    ratio = np.linalg.norm(estimated, axis=1).sum() / np.linalg.norm(true, axis=1).sum()
    return says(m["share"], 100 * abs(ratio - 1)) and (ratio < 1) == (m["sense"] == "short")


def _determined(run: Run, k: int, m: re.Match[str]) -> bool:
    """As many views as have rows of rank four, and not one fewer."""
    n = int(number(m["n"]))
    rows = {
        len(s.now.Hs_image_board): s.now.rows[:, [0, 2, 3, 4, 5]]
        for s in run.states
        if len(s.now.rows)
    }
    return np.linalg.matrix_rank(rows[n]) >= 4 and np.linalg.matrix_rank(rows[n - 1]) < 4


def _ratio(run: Run, k: int, m: re.Match[str]) -> bool:
    off = abs(_f(run) - F)
    sd = _deviation(_end(run))
    return (
        near(m["off"], off)
        and abs(number(m["times"]) - off / sd) < 0.1
        and abs(number(m["sd"]) / sd - 1) < 0.05
    )


NOT_JUDGED = Claim(r"were found 5 px away|a wrong board is wrong in all views alike", None)


def _own(
    params: Params, holds: Callable[[Run, int, re.Match[str]], bool]
) -> Callable[[Run, int, re.Match[str]], bool]:
    """What is claimed of the preset's own seed alone."""
    return lambda run, k, m: run.params.seed != params.seed or holds(run, k, m)


def _at_rest(state: State) -> bool:
    adjustment = state.now.adjustment
    return (
        adjustment is not None
        and adjustment.stop is not None
        and adjustment.stop.name == "CONVERGED"
    )


def _deviations(run: Run, m: re.Match[str]) -> bool:
    """The ± of this run and that of the default one, to two digits."""
    return near(m["sd"], _deviation(_end(run)), 2) and near(m["home"], _deviation(_home()), 2)


LINES = {
    "flat": [
        Claim(
            rf"comes to rest (?P<off>{NUMBER}) px short .* is (?P<sd>{NUMBER}) px, .* it is"
            rf" (?P<home>{NUMBER}) px",
            _own(
                FLAT,
                lambda run, k, m: (
                    says(m["off"], F - _f(run)) and _at_rest(_end(run)) and _deviations(run, m)
                ),
            ),
        )
    ],
    "few": [
        Claim(
            rf"fit well and leave f uncertain: its ± at the end is (?P<sd>{NUMBER}) px, .* is"
            rf" (?P<home>{NUMBER}) px",
            _own(FEW, lambda run, k, m: _noise_left(run) < 1.1 and _deviations(run, m)),
        )
    ],
    "pinhole": [
        Claim(
            rf"f comes out (?P<off>{NUMBER}) px too long, and arrows in the picture show a pattern",
            _own(Params(), lambda run, k, m: _noise_left(run) > 2 and says(m["off"], _f(run) - F)),
        )
    ],
    "middle": [
        Claim(r"corners fit as well as ever", lambda run, k, m: _noise_left(run) < 1.1),
        Claim(
            rf"off by (?P<worst>{NUMBER}) px",
            _own(Params(), lambda run, k, m: near(m["worst"], _worst(_end(run)), 2)),
        ),
    ],
    "bad": [
        NOT_JUDGED,
        Claim(
            r"The bars tell which view it is",
            lambda run, k, m: int(np.argmax(rms_of(_end(run)))) == 1,
        ),
    ],
    "stretched": [
        Claim(rf"fx and fy come out (?P<share>{NUMBER}) % apart", _own(Params(), _apart))
    ],
}

WHYS = {
    "flat-rms": [
        Claim(
            rf"^(?P<rms>{NUMBER}) px, while",
            lambda run, k, m: near(m["rms"], _noise_left(run) * SIGMAS * 0.2),
        ),
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
        Claim(
            rf"f is off by (?P<off>{NUMBER}) px, (?P<times>{NUMBER}) times its ± of"
            rf" (?P<sd>{NUMBER}) px",
            _ratio,
        ),
    ],
}
