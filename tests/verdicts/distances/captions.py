"""What captions of the distances lesson say, and whether a step is right, decided from closed forms
and by trying, apart from the lesson's core.
"""

import functools
import re

import numpy as np
import scipy

from lessons.distances.state import Ball, Found, Front, Landmarks, Scatter, State, Trials
from tests.readings import LENGTH, NUMBER, near, near_length, number, says, says_percent
from tests.truths import decided
from tests.truths.distances import by_heat, errors, mahalanobis, true_distances
from tests.verdicts import Claim, Run
from workbench.algorithms.surfaces.heat_method import HeatState

PERCENT = r"(?:less than )?[\d.,]+ %"


def right(run: Run, k: int) -> bool | None:
    result = run.states[k].now
    if isinstance(result, Found) and len(result.truth):
        off = _off(run, k)
        if len(result.asymmetry) and len(off) and off.mean() <= 0.02:
            return None  # right, but a step that asks whether it is a metric
        return decided(off.mean() <= 0.02, wrong=off.mean() > 0.06) if len(off) else False
    if isinstance(result, Trials):
        return False if result.broken or run.params.metric == "cosine" else None
    if isinstance(result, Scatter) and result.phase == "told" and result.outlier.any():
        beyond = (_radii(run, k) > 2.4477)[result.outlier].mean()
        return decided(beyond >= 0.9, wrong=beyond < 0.5)
    return None


def _off(run: Run, k: int) -> np.ndarray:
    """The sizes of the errors; the same for all steps that have all distances."""
    return np.abs(_errors(run.states[k]))


@functools.lru_cache(maxsize=4)
def _errors(state) -> np.ndarray:
    return errors(state)


def _radii(run: Run, k: int) -> np.ndarray:
    """Mahalanobis distances, by the sample covariance or by the run's own where that is robust."""
    scatter = run.states[k].now
    assert isinstance(scatter, Scatter)
    first = run.states[0].now.p
    if run.params.estimate == "robust":
        return scatter.d
    return mahalanobis(first, first.mean(axis=0), np.cov(first.T))


# captions -----------------------------------------------------------------------------------------


def _mean_and_worst(run: Run, k: int, m: re.Match[str]) -> bool:
    relative = _errors(run.states[k])
    worst = relative[np.abs(relative).argmax()]
    sense = (worst > 0) == (m["sense"] == "long") or abs(worst) < 1e-12
    median = m["median"] is None or says_percent(m["median"], np.median(np.abs(relative)))
    return bool(
        median
        and says_percent(m["mean"], np.abs(relative).mean())
        and says_percent(m["worst"], abs(worst))
        and sense
    )


def _to_goal(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    assert state.subject is not None
    goal = state.subject.goal
    distance = float(state.now.d[goal])
    true = float(true_distances(state)[goal])
    return near_length(m["found"], distance) and near_length(m["true"], true)


def _accepted(run: Run, k: int, m: re.Match[str]) -> bool:
    """So many have a distance that no later step changes."""
    front = run.states[k].now
    assert isinstance(front, Front)
    end = next(s.now.d for s in run.states if isinstance(s.now, Found))
    same = np.array_equal(end[front.accepted], front.d[front.accepted])
    return same and number(m["n"]) == front.accepted.sum() == np.sum(
        end <= front.reach * (1 + 1e-9) + 1e-12
    )


def _balls(run: Run, k: int, m: re.Match[str]) -> bool:
    """Of the queries so many change their nearest point; by own formulas."""
    ball = run.states[k].now
    a = run.params
    assert isinstance(ball, Ball)
    units = np.array([1.0, a.stretch])
    v = np.abs((ball.queries[:, None] - ball.p[None]) * units)
    C = np.linalg.inv([[1, a.correlation], [a.correlation, 1]])
    w = (ball.queries[:, None] - ball.p[None]) * units
    x, y = ball.queries * units, ball.p * units
    by = {
        "euclid": (v**2).sum(axis=2),
        "squared": (v**2).sum(axis=2),
        "manhattan": v.sum(axis=2),
        "chebyshev": v.max(axis=2),
        "p": (v**a.p).sum(axis=2),
        "p-sum": (v**a.p).sum(axis=2),
        "cosine": -(x @ y.T) / np.linalg.norm(x, axis=1)[:, None] / np.linalg.norm(y, axis=1),
        "mahalanobis": np.einsum("qpi,ij,qpj->qp", w, C, w),
    }[a.metric]
    straight = np.linalg.norm(ball.queries[:, None] - ball.p[None], axis=2)
    return says_percent(m["share"], float((by.argmin(axis=1) != straight.argmin(axis=1)).mean()))


def _detour(run: Run, k: int, m: re.Match[str]) -> bool:
    trials = run.states[k].now
    assert isinstance(trials, Trials)
    ab, bc, ac = trials.sides
    return near(m["ac"], ac) and near(m["over"], ab + bc) and ac > ab + bc


def _share_broken(run: Run, k: int, m: re.Match[str]) -> bool:
    """As many as of other triples, by formulas of their own."""
    trials = run.states[k].now
    a = run.params
    assert isinstance(trials, Trials)
    if not says_percent(m["share"], trials.broken / trials.tried):
        return False
    p = np.random.default_rng(77).random((3, 20_000, 2))

    def d(first: np.ndarray, other: np.ndarray) -> np.ndarray:
        if a.metric == "cosine":
            return 1 - (first * other).sum(axis=1) / np.hypot(*first.T) / np.hypot(*other.T)
        if a.metric == "squared":
            return ((first - other) ** 2).sum(axis=1)
        return (np.abs(first - other) ** a.p).sum(axis=1) ** (1 / a.p if a.metric == "p" else 1)

    expected = (d(p[0], p[2]) > d(p[0], p[1]) + d(p[1], p[2]) + 1e-9).mean()
    return (
        abs(expected - trials.broken / trials.tried)
        < 4.5 * np.sqrt(expected * (1 - expected) / trials.tried) + 0.01
    )


def _flagged(run: Run, k: int, m: re.Match[str]) -> bool:
    scatter = run.states[k].now
    d = _radii(run, k)
    assert isinstance(scatter, Scatter)
    return says_percent(m["share"], float((d[~scatter.outlier] > 2.4477).mean()))


def _second(run: Run, k: int, m: re.Match[str]) -> bool:
    scatter = run.states[k].now
    d = _radii(run, k)
    assert isinstance(scatter, Scatter)
    caught = int((d[scatter.outlier] > 2.4477).sum())
    return number(m["n"]) == caught and says(m["mean"], float(d[scatter.outlier].mean()))


def _landmark(run: Run, k: int, m: re.Match[str]) -> bool:
    """Nearest by Euclid's distance, and by the covariance of depth from disparity."""
    result = run.states[k].now
    assert isinstance(result, Landmarks)
    near_, told = [], []
    for x, z in result.seen:
        v = result.landmarks - [x, z]
        near_.append(int(np.argmin((v**2).sum(axis=1))))
        by_pixel = np.array([[z / 700, -x * z / 84], [0, -z * z / 84]]) / 2
        told.append(int(np.argmin((np.linalg.solve(by_pixel, v.T) ** 2).sum(axis=0))))
    return says_percent(m["near"], float((np.array(near_) == result.true).mean())) and says_percent(
        m["told"], float((np.array(told) == result.true).mean())
    )


def _shares(run: Run, k: int, m: re.Match[str]) -> bool:
    """Near what the chi-squared distribution says."""
    return all(
        abs(number(m[name]) / 100 - scipy.stats.chi2.cdf(4, d)) < 0.02
        for name, d in (("one", 1), ("ten", 10))
    )


def _wrong(run: Run, k: int, m: re.Match[str]) -> bool:
    return right(run, k) is False


def _good(run: Run, k: int, m: re.Match[str]) -> bool:
    return right(run, k) is True


def _weakest(run: Run, k: int, m: re.Match[str]) -> bool:
    heat = run.states[k].now
    assert isinstance(heat, HeatState)
    return (
        abs(number(m["far"]) - np.log10(np.sort(np.abs(heat.u))[len(heat.u) // 2] / heat.u.max()))
        < 0.51
    )


@functools.lru_cache(maxsize=2)
def _as_a_metric(state: State) -> tuple[float, float, float]:
    """Of some vertices how far there and back differ, at most and in the median, and the share of
    shorter detours.
    """
    s = state.subject
    assert s is not None
    some = np.unique(np.linspace(0, len(s.p) - 1, 24).astype(int))
    D = by_heat(s.p, s.faces, some, time=10.0**state.params.time * s.h**2)[some]
    np.fill_diagonal(D, 0.0)
    back = (np.abs(D - D.T) / np.maximum(np.maximum(D, D.T), 1e-300))[np.triu_indices(len(some), 1)]
    triples = [
        (a, b, c) for a in range(len(some)) for b in range(len(some)) for c in range(len(some))
    ]
    a, b, c = np.array([triple for triple in triples if len(set(triple)) == 3]).T
    return (
        float(back.max()),
        float(np.median(back)),
        float((D[a, c] > D[a, b] + D[b, c] + 1e-9).mean()),
    )


def _heat_as_a_metric(run: Run, k: int, m: re.Match[str]) -> bool:
    # by_heat knows the mesh as it stands only: on the same sphere a regular one is held against it
    if run.params.delaunay:
        return number(m["back"].split()[0]) < 10 and number(m["median"].split()[0]) < 1
    back, median, shorter = _as_a_metric(run.states[k])
    near_ones = (m["back"], back, 0.15), (m["shorter"], shorter, 0.15), (m["median"], median, 0.25)
    return all(
        abs(number(text.split()[0]) / 100 - true) < share * true for text, true, share in near_ones
    )


def _eight_beside(run: Run, k: int, m: re.Match[str]) -> bool:
    """Eight directions zigzag towards 22.5 degrees at worst; marching is held against that."""
    off = _errors(run.states[k])
    worst = np.abs(off).max()
    eight = 1 / np.cos(np.pi / 8) - 1
    return says_percent(m["eight"], eight) and (m["said"] == "nearer to the truth") == bool(
        eight < worst
    )


def _negative(run: Run, k: int, m: re.Match[str]) -> bool:
    """Edges of two triangles whose opposite angles are more than a straight one together."""
    s = run.states[k].subject
    assert s is not None
    sums: dict[tuple[int, int], float] = {}
    for face in s.faces:
        for j in range(3):
            a, b, o = (int(face[(j + i) % 3]) for i in (1, 2, 0))
            u, v = s.p[a] - s.p[o], s.p[b] - s.p[o]
            key = (min(a, b), max(a, b))
            sums[key] = sums.get(key, 0.0) + np.arctan2(np.linalg.norm(np.cross(u, v)), u @ v)
    return number(m["n"]) == sum(angle > np.pi + 1e-9 for angle in sums.values())


CAPTIONS = [
    Claim(
        rf"(?P<mean>{PERCENT}) off on average(?: \(median (?P<median>{PERCENT})\))?, at worst"
        rf" (?P<worst>{PERCENT}) too"
        " (?P<sense>long|short)",
        _mean_and_worst,
    ),
    Claim(rf"(?P<found>{LENGTH}) to the goal, in truth (?P<true>{LENGTH})", _to_goal),
    Claim(r"Right to 2 %", _good),
    Claim(r"That is wrong, also on average", _wrong),
    Claim(r"(?P<n>[\d,]+) of [\d,]+ nodes are accepted, their distance is final", _accepted),
    Claim(r"10 to the power of (?P<far>[−\d]+) of the strongest", _weakest),
    Claim(r"Of \d+ other queries (?P<share>[\d.]+ %) have another nearest", _balls),
    Claim(rf"(?P<share>{PERCENT}) break the triangle inequality\. (?:Here|Also|No)", _share_broken),
    Claim(
        rf"There and back differ by (?P<median>{PERCENT}) in the median and (?P<back>{PERCENT}) at"
        r" most;"
        rf" (?P<shorter>{PERCENT}) of the triples break",
        _heat_as_a_metric,
    ),
    Claim(
        r"8 neighbours are (?P<said>nearer to the truth|farther off) on this grid: at worst"
        rf" (?P<eight>{PERCENT}) too long",
        _eight_beside,
    ),
    Claim(r"(?P<n>[\d,]+) edges have a negative weight", _negative),
    Claim(rf"from a to c is (?P<ac>{NUMBER}), over b it is (?P<over>{NUMBER})", _detour),
    Claim(r"No metric\.", _wrong),
    Claim(r"none breaks the triangle inequality", lambda run, k, m: run.states[k].now.broken == 0),
    Claim(rf"Beyond 2\.45 lie (?P<share>{PERCENT}) of the scatter", _flagged),
    Claim(
        rf"(?P<n>[\d,]+) of [\d,]+ of the second cluster, at (?P<mean>{NUMBER}) on average", _second
    ),
    Claim(r"It is found\.", _good),
    Claim(r"It hides itself", lambda run, k, m: right(run, k) is not True),
    Claim(
        rf"is the right one for (?P<near>{PERCENT}), by Mahalanobis' for (?P<told>{PERCENT})",
        _landmark,
    ),
    Claim(r"from (?P<one>[\d.]+) % in one down to (?P<ten>[\d.]+) % in ten", _shares),
]
