"""What lines of presets and explanations of questions of the distances lesson say, decided from the
ends of their runs, closed forms, and runs with one thing changed.
"""

import re

import numpy as np
import scipy

from lessons.distances.state import Found, Scatter
from tests.own_seed import of_preset
from tests.readings import LENGTH, NUMBER, near_length, number, says, says_percent
from tests.truths.distances import errors, true_distances
from tests.verdicts import Claim, Run
from tests.verdicts.distances.captions import (
    _balls,
    _errors,
    _heat_as_a_metric,
    _landmark,
    _negative,
    _radii,
)
from workbench.data.shapes.surfaces import sphere


def _ends(run: Run) -> Found:
    distances = run.states[-1].now
    assert isinstance(distances, Found)
    return distances


def _times(run: Run) -> np.ndarray:
    """The mean errors of heat over its times, per cent."""
    times = _ends(run).times
    assert times is not None
    return times[1]


def _mended(run: Run, k: int, m: re.Match[str]) -> bool:
    """Without the disc the same march is farther off; beyond half a metre too."""
    *_, plain = march_again(run.params.grid)
    assert run.states[-1].subject is not None
    far = true_distances(run.states[-1]) > 0.5
    off = [
        np.abs(d[far] / true_distances(run.states[-1])[far] - 1).mean()
        for d in (_ends(run).d, plain)
    ]
    return off[0] < 0.75 * off[1]


def _exact_near(run: Run) -> bool:
    true = true_distances(run.states[-1])
    return bool(np.allclose(_ends(run).d[true <= 0.1], true[true <= 0.1]))


def _round_about(run: Run) -> tuple[float, float]:
    state = run.states[-1]
    assert state.subject is not None
    ends = state.subject.p[[state.subject.goal, state.subject.source]]
    return float(true_distances(state)[state.subject.goal]), float(
        np.linalg.norm(ends[0] - ends[1])
    )


def _worst_of_march(side: int) -> float:
    """The worst error of fast marching round the wall on a grid, per cent."""
    from lessons.distances.lesson import run as of
    from lessons.distances.state import Params

    *_, last = of(Params(grid=side, neighbours="march"))
    return 100 * float(np.abs(errors(last)).max())


def march_again(side: int) -> list[np.ndarray]:
    """The distances of the same run from a bare source."""
    from lessons.distances.lesson import run as of
    from lessons.distances.state import Params

    states = list(of(Params(grid=side, neighbours="march", wall=0.0)))
    return [state.now.d for state in states if isinstance(state.now, Found)]


def _refined(run: Run) -> np.ndarray:
    return 10 ** _ends(run).study["8 neighbours"][1]


def _on_regular(run: Run) -> float:
    """The worst error of Dijkstra by scipy on the sphere before its vertices were moved, beside
    great circles.
    """
    ball = sphere(run.params.points)
    edges = np.unique(np.sort(ball.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    lengths = np.linalg.norm(ball.p[edges[:, 0]] - ball.p[edges[:, 1]], axis=1)
    assert run.states[0].subject is not None
    source = run.states[0].subject.source
    graph = scipy.sparse.coo_array((lengths, edges.T), shape=(len(ball.p), len(ball.p)))
    d = scipy.sparse.csgraph.dijkstra(graph.tocsr(), directed=False, indices=source)
    true = np.arccos(np.clip(ball.p @ ball.p[source], -1, 1))
    far = true > 0.14 * np.pi
    return float((d[far] / true[far] - 1).max())


def _of(run: Run, m: re.Match[str], *, mean: bool = False) -> bool:
    off = np.abs(_errors(run.states[-1]))
    return says_percent(m["share"], float(off.mean() if mean else off.max()))


def _told(run: Run) -> Scatter:
    scatter = run.states[4].now
    assert isinstance(scatter, Scatter)
    return scatter


def _mean_radius(run: Run, k: int, m: re.Match[str]) -> bool:
    return says(m["d"], float(_radii(run, 4)[_told(run).outlier].mean()))


def _tried(run: Run, k: int, m: re.Match[str]) -> bool:
    trials = run.states[-1].now
    return says_percent(m["share"], trials.broken / trials.tried)


LINES = {
    "taxi": [
        Claim(
            r"point 10 first, Euclid's disc point 18",
            of_preset(lambda run, k, m: run.states[-1].now.straight == 18),
        ),
        Claim(r"At the end (?P<share>13 %)", of_preset(_balls)),
    ],
    "units": [Claim(r"At the end (?P<share>80 %)", of_preset(_balls))],
    "cosine-axioms": [
        Claim(
            r"Points on one ray are at distance 0",
            lambda run, k, m: run.states[-1].now.axioms["d(a, b) > 0"] == 1.0,
        ),
        Claim(r"in (?P<share>32 %) of the triples", of_preset(_tried)),
    ],
    "half": [Claim(r"in (?P<share>15 %) of the triples", of_preset(_tried))],
    "masking": [Claim(r"only (?P<d>2\.15) standard", of_preset(_mean_radius))],
    "robust": [Claim(r"(?P<d>9\.2) standard deviations out", of_preset(_mean_radius))],
    "stereo": [
        Claim(
            r"far worse than what lies across",
            lambda run, k, m: (
                np.ptp(run.states[-1].now.rims[..., 1], axis=1).min()
                > 4 * np.ptp(run.states[-1].now.rims[..., 0], axis=1).max() / 2
            ),
        ),
        Claim(r"right for (?P<near>54 %), Mahalanobis' for (?P<told>94 %)", of_preset(_landmark)),
    ],
    "staircase": [Claim(r"up to (?P<share>41 %) too long", lambda run, k, m: _of(run, m))],
    "marching": [
        Claim(r"that is (?P<share>10 %) off at worst", lambda run, k, m: _of(run, m)),
        Claim(
            r"off at worst, on one twice as fine 6 %",
            lambda run, k, m: 5.5 < _worst_of_march(81) < 6.5,
        ),
    ],
    "sphere": [
        Claim(r"(?P<share>6\.2 %) too long on average", lambda run, k, m: _of(run, m, mean=True)),
        Claim(r"(?P<share>16 %) at worst", lambda run, k, m: _of(run, m)),
    ],
    "jitter": [
        Claim(
            r"The worst way is still (?P<share>14 %) too long, where it was (?P<was>16 %)",
            of_preset(lambda run, k, m: _of(run, m) and says_percent(m["was"], _on_regular(run))),
        )
    ],
    "no-metric": [
        Claim(
            r"by (?P<median>1\.4 %) in the median and (?P<back>17 %) at most, and"
            r" (?P<shorter>1\.5 %)",
            lambda run, k, m: _heat_as_a_metric(run, -1, m),
        )
    ],
    "points": [
        Claim(
            r"(?P<share>0\.9 %) off at worst",
            lambda run, k, m: 0.0085 < np.abs(_errors(run.states[-1])).max() < 0.0095,
        ),
        Claim(
            r"on finer spheres that does not fall",
            lambda run, k, m: bool(
                (np.diff(_ends(run).study["3 points on each edge"][1][1:]) > 0).all()
            ),
        ),
    ],
    "disc": [
        Claim(r"Exact distances in a small disc mend the rest too", _mended),
        Claim(r"Exact near the source", lambda run, k, m: _exact_near(run)),
    ],
    "early": [
        Claim(
            r"come out (?P<share>26 %) too short",
            lambda run, k, m: says_percent(m["share"], -_errors(run.states[-1]).mean()),
        )
    ],
    "flattered": [
        Claim(
            r"here it is no worse, 1\.2 % off in place of 1\.4 %",
            lambda run, k, m: np.allclose(_times(run)[[8, 4]], (1.2, 1.4), atol=0.05),
        )
    ],
    "wrung": [
        Claim(r"(?P<n>848) of its 3,000 edges have negative weights", _negative),
        Claim(r"heat are (?P<share>20 %) off", lambda run, k, m: _of(run, m, mean=True)),
    ],
    "delaunay": [Claim(r"heat is (?P<share>1\.5 %) off", lambda run, k, m: _of(run, m, mean=True))],
    "roll": [
        Claim(
            r"The way round is 6\.4 m, straight through it would be 1\.9 m",
            of_preset(lambda run, k, m: np.allclose(_round_about(run), (6.4, 1.9), atol=0.05)),
        )
    ],
}

WHYS = {
    "finer": [
        Claim(
            rf"(?P<last>{NUMBER}) %, as on the coarse one, (?P<first>{NUMBER}) %",
            lambda run, k, m: (
                says(m["last"], _refined(run)[-1])
                and says(m["first"], _refined(run)[0])
                and abs(_refined(run)[-1] - 100 * (1 / np.cos(np.pi / 8) - 1)) < 0.01
            ),
        )
    ],
    "two-sigma": [
        Claim(
            r"(?P<two>[\d.]+) %: .* In ten it is (?P<ten>[\d.]+) %",
            lambda run, k, m: (
                abs(number(m["two"]) - 86.5) < 2 and abs(number(m["ten"]) - 5.3) < 1.5
            ),
        )
    ],
    "twenty": [
        Claim(
            rf"(?P<most>{NUMBER})\. However far",
            lambda run, k, m: (
                says(m["most"], _radii(run, 4).max()) and _radii(run, 4).max() <= 19 / np.sqrt(20)
            ),
        )
    ],
    "squares": [
        Claim(
            r"(?P<share>\d+ %): wherever the angle at b is obtuse",
            lambda run, k, m: says_percent(
                m["share"], run.states[-1].now.broken / run.states[-1].now.tried
            ),
        )
    ],
    "longer": [
        Claim(
            rf"(?P<ratio>{NUMBER}) times as large",
            lambda run, k, m: says(m["ratio"], _ends(run).times[1][8] / _ends(run).times[1][4]),  # type: ignore[index]
        )
    ],
    "shortcut": [
        Claim(
            rf"(?P<found>{LENGTH}) for (?P<true>{LENGTH}):",
            lambda run, k, m: (
                near_length(m["found"], float(_ends(run).d[run.states[-1].subject.goal]))
                and near_length(
                    m["true"], float(true_distances(run.states[-1])[run.states[-1].subject.goal])
                )
            ),
        )
    ],
}
