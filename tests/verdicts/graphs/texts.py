"""What lines of presets and explanations of questions of the graphs lesson say, decided from edges
and nodes with dense matrices.
"""

import functools
import re

import numpy as np

from tests.own_seed import of_preset
from tests.readings import near, number
from tests.truths.graphs import A, correct, modes, off, parts
from tests.verdicts import Claim, Run
from tests.verdicts.graphs.captions import VALUE, exact_error, least, one_way, same, volume_kept
from workbench.algorithms.graphs.spectral_cut import Cut


def last_cut(run: Run) -> Cut:
    result = run.states[-1].now
    assert isinstance(result, Cut)
    return result


def middle(run: Run) -> float:
    """Where the cut edges of the last step are, along x."""
    side = last_cut(run).side
    p = run.states[-1].subject.p
    i, j = np.nonzero(np.triu(A(run.states[-1]), 1))
    through = side[i] != side[j]
    return float(np.abs((p[i] + p[j])[through, 0] / 2).max())


def _of_twelve(run: Run) -> np.ndarray:
    return run.states[0].now.values[9:16]


def _uneven(run: Run, k: int, m: re.Match[str]) -> bool:
    z = run.states[0].subject.p[:, 2]
    values = run.states[0].now.values
    own = run.params.seed != 0 or np.allclose(values[1:4], [1.7, 1.8, 2.5], atol=0.05)
    return 3 < np.mean(z > 0) / np.mean(z < 0) < 5 and values[3] / values[1] > 1.2 and bool(own)


def _bridge(run: Run, k: int, m: re.Match[str]) -> bool:
    """By sign a fifth of the edges of the big half or more; the best cut few, between the
    halves.
    """
    sign = run.states[2].now
    assert isinstance(sign, Cut)
    return sign.cut > 2 * last_cut(run).cut and middle(run) < 0.9 and correct(run.states[-1]) >= 412


def _spectra_of_pair(run: Run, of_A: list, of_L: list) -> bool:
    """The eigenvalues of both graphs, from their dense matrices."""
    whole = A(run.states[0])
    classes = run.states[0].subject.classes
    good = True
    for which in (0, 1):
        part = whole[np.ix_(classes == which, classes == which)]
        good &= np.allclose(np.linalg.eigvalsh(part), of_A[which], atol=1e-9)
        good &= np.allclose(
            np.linalg.eigvalsh(np.diag(part.sum(axis=1)) - part), of_L[which], atol=1e-9
        )
    return bool(good)


LINES = {
    "one-way": [
        Claim(r"1,500 points", lambda run, k, m: len(run.states[0].subject.p) == 1500),
        Claim(
            r"(?P<share>39 %) of the namings are not returned",
            of_preset(lambda run, k, m: one_way(run, 0, m)),
        ),
    ],
    "matrix": [
        Claim(
            r"34 members, 78 friendships",
            lambda run, k, m: A(run.states[0]).shape == (34, 34) and A(run.states[0]).sum() == 156,
        ),
    ],
    "neck": [Claim(r"The best cut along it", lambda run, k, m: least(run, k, m))],
    "unbalanced": [
        Claim(r"The sign is not the best cut", _bridge),
        Claim(r"its best cut finds the bridge", _bridge),
    ],
    "split": [
        Claim(r"0 is an eigenvalue twice", lambda run, k, m: len(parts(A(run.states[0]))) == 2),
        Claim(
            r"it is 100 against 100 nodes", lambda run, k, m: run.states[2].now.side.sum() == 100
        ),
    ],
    "square": [
        Claim(
            r"two eigenvectors share λ₂",
            lambda run, k, m: bool(np.isclose(*modes(run.states[0].adjacency)[0][1:3], atol=1e-12)),
        ),
    ],
    "sphere": [
        Claim(
            r"Where a sphere has λ = 12 seven times, this graph has 11 to 12\.6: two groups",
            lambda run, k, m: bool(
                np.allclose(_of_twelve(run)[:3], 11.0, atol=0.05)
                and np.allclose(_of_twelve(run)[3:], 12.6, atol=0.05)
            ),
        ),
    ],
    "cotangent": [
        Claim(
            r"all seven are 11\.85 to 11\.92",
            lambda run, k, m: bool(
                np.allclose(
                    [_of_twelve(run).min(), _of_twelve(run).max()], [11.85, 11.92], atol=0.005
                )
            ),
        ),
    ],
    "uneven": [Claim(r"the three slowest should all be 2, and are 1\.7, 1\.8 and 2\.5", _uneven)],
    "twins": [
        Claim(
            r"both A have eigenvalues −2, 0, 0, 0, 2\. Those of L differ: 0, 1, 1, 1, 5 and 0, 0,"
            r" 2, 2, 4",
            lambda run, k, m: _spectra_of_pair(
                run, [(-2, 0, 0, 0, 2)] * 2, [(0, 1, 1, 1, 5), (0, 0, 2, 2, 4)]
            ),
        ),
    ],
    "warm": [
        Claim(
            r"The error to the exact heat falls as the fast parts die out",
            lambda run, k, m: exact_error(run, 100) < exact_error(run, 30) < exact_error(run, 5),
        ),
    ],
    "shrink": [
        Claim(
            r"noise goes in a few rounds",
            lambda run, k, m: (
                off(run.states[5], run.states[5].now.p)
                < 0.6 * off(run.states[0], run.states[0].now.p)
            ),
        ),
    ],
    "taubin": [
        Claim(
            r"(?P<share>101 %) of the volume",
            of_preset(lambda run, k, m: volume_kept(run, len(run.states) - 1, m)),
        ),
    ],
    "deep": [
        Claim(
            r"Everybody has heard after two",
            lambda run, k, m: all(
                (np.abs(s.now.features).sum(axis=1) > 0).all()
                for s in run.states
                if s.now.layer == 2
            ),
        ),
    ],
    "trained": [
        Claim(
            r"in the end 33 of 34 are right",
            of_preset(lambda run, k, m: correct(run.states[-1]) == 33),
        )
    ],
    "deeper": [Claim(r"watch what is right", None)],
    "same": [
        Claim(r"every message is the same too", lambda run, k, m: same(run, k)),
    ],
}

WHYS = {
    "mutual": [
        Claim(
            r"(?P<n>[\d,]+) components: a quarter of the namings are not returned",
            lambda run, k, m: (
                number(m["n"]) == len(parts(run.states[-1].adjacency.toarray()))
                and 0.22 < run.states[-1].now.one_way < 0.27
            ),
        ),
    ],
    "club-right": [
        Claim(r"(?P<n>\d+) of 34\.", lambda run, k, m: int(m["n"]) == correct(run.states[2])),
        Claim(r"it is one more: only node 8 is left over", lambda run, k, m: _weighted_club()),
    ],
    "longer": [
        Claim(
            rf"The largest heat is {VALUE} in the end",
            lambda run, k, m: near(m["value"], float(np.abs(run.states[-1].now.u).max())),
        ),
        Claim(
            r"for the largest λ that is −1\.5", lambda run, k, m: 1 - run.params.step_size == -1.5
        ),
    ],
    "volume": [
        Claim(r"(?P<share>[\d.]+ %)\. The mean of the neighbours lies inwards", volume_kept)
    ],
    "sixty-four": [
        Claim(
            r"(?P<n>\d+): as many as if all were given one label",
            lambda run, k, m: (
                int(m["n"]) == correct(run.states[-1]) == 17 == run.states[-1].subject.classes.sum()
            ),
        ),
    ],
}


@functools.cache
def _weighted_club() -> bool:
    """The sign of the weighted club's second eigenvector leaves node 8 alone on the wrong side."""
    from lessons.graphs.lesson import run
    from lessons.graphs.state import Params

    states = list(run(Params(graph="karate", weighted=True)))
    vector = modes(states[0].adjacency)[1][:, 1] > 0
    classes = states[0].subject.classes
    wrong = [np.flatnonzero(side != classes) for side in (vector, ~vector)]
    return min(wrong, key=len).tolist() == [8]
