"""What the graphs lesson says of its runs, decided from edges and nodes with dense matrices, apart
from its core.
"""

import functools
import re

import numpy as np

from lessons.graphs.captions import caption
from lessons.graphs.state import Grown, Mode
from tests.own_seed import of_preset
from tests.readings import NUMBER, POWER, near, number, says_percent
from tests.truths.graphs import A, correct, modes, off, parts, told, volume
from tests.verdicts import Claim, Run
from workbench.algorithms.graphs.diffusion import Heat, Smoothed
from workbench.algorithms.graphs.spectral_cut import Cut
from workbench.algorithms.learning.graph_network import Layer, Trained

__all__ = ["CAPTIONS", "LINES", "WHYS", "caption", "right"]

VALUE = rf"(?P<value>{POWER})"


def right(run: Run, k: int) -> bool | None:
    state = run.states[k]
    result, last = state.now, k == len(run.states) - 1
    if isinstance(result, Heat):
        if np.abs(result.u).max() > 1 + 1e-9:
            return False
        return True if last and exact_error(run, k) < 0.01 else None
    if isinstance(result, Smoothed) and last:
        first, end = off(state, run.states[0].now.p), off(state, result.p)
        return False if end > first else True if end < 0.9 * first else None
    if not len(state.subject.classes) or not (
        last or (isinstance(result, Cut) and result.phase == "sign")
    ):
        return None
    if isinstance(result, Cut | Trained) or (
        isinstance(result, Layer) and result.features.shape[1] == 2
    ):
        share = correct(state) / len(state.subject.classes)
        return True if share >= 0.9 else False if share < 0.75 else None
    return None


def exact_error(run: Run, k: int) -> float:
    """The largest error of the heat at a step, beside exp(-t L) by all eigenvectors."""
    state = run.states[k]
    values, vectors = modes(state.adjacency)
    t = k * run.params.step_size / values[-1]
    exact = vectors @ (np.exp(-t * values) * (vectors.T @ run.states[0].now.u))
    return float(np.abs(state.now.u - exact).max())


# captions -----------------------------------------------------------------------------------------


def _true_sides(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    misses = np.flatnonzero(told(state) != state.subject.classes)
    named = (
        []
        if not m["nodes"]
        else [int(number(numeral)) for numeral in re.split(r", (?=\d)", m["nodes"])]
    )
    good = number(m["n"]) == correct(state) and number(m["all"]) == len(state.subject.p)
    return good and (named == misses.tolist() if named else not 0 < len(misses) <= 3)


def _cut(run: Run, k: int, m: re.Match[str]) -> bool:
    result, a = run.states[k].now, A(run.states[k])
    assert isinstance(result, Cut)
    cut = a[np.ix_(result.side, ~result.side)].sum()
    smaller = min(a[result.side].sum(), a[~result.side].sum())
    phi = cut / smaller if smaller else 1.0
    sizes = number(m["near"]) == result.side.sum() and number(m["far"]) == (~result.side).sum()
    return bool(sizes and near(m["cut"], cut) and near(m["phi"], phi, 2))


def _least(run: Run, k: int, m: re.Match[str]) -> bool:
    """No cut along the vector is better."""
    result, a = run.states[k].now, A(run.states[k])
    assert isinstance(result, Cut)
    order = np.argsort(result.fiedler, kind="stable")
    a, d = a[np.ix_(order, order)], a.sum(axis=1)[order]
    best, cut = np.inf, 0.0
    for i in range(
        1, len(order)
    ):  # one more node on this side: its edges to the others are cut, those to its own no more
        cut += d[i - 1] - 2 * a[i - 1, : i - 1].sum()
        smaller = min(d[:i].sum(), d[i:].sum())
        best = min(best, cut / smaller if smaller else 1.0)
    return abs(best - result.conductance) < 1e-9


def _pieces(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    a = state.adjacency.toarray()
    return number(m["edges"]) == np.triu(a, 1).astype(bool).sum() and number(m["parts"]) == len(
        parts(np.maximum(a, a.T))
    )


def _one_way(run: Run, k: int, m: re.Match[str]) -> bool:
    result = run.states[k].now
    assert isinstance(result, Grown)
    apart = np.linalg.norm(run.states[k].subject.p[:, None] - run.states[k].subject.p, axis=2)
    np.fill_diagonal(apart, np.inf)
    names = apart <= np.partition(apart, result.k - 1, axis=1)[:, result.k - 1 : result.k]
    return says_percent(m["share"], 1 - (names & names.T).sum() / names.sum())


def _mode(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    result = state.now
    assert isinstance(result, Mode)
    if run.params.laplacian != "plain":
        return True  # of the mesh: beside the truth, which is claimed apart
    values = modes(state.adjacency)[0]
    scale = 2 / values[1:4].mean() if state.subject.of_surface and len(result.values) > 3 else 1.0
    return near(m["value"], values[result.index] * scale)


def _reached(run: Run, k: int, m: re.Match[str]) -> bool:
    """So many nodes are at most so many edges from a label, and so many are right."""
    state = run.states[k]
    result, a = state.now, A(state) > 0
    assert isinstance(result, Layer)
    have = np.isin(np.arange(len(a)), state.subject.labelled)
    for _ in range(result.layer):
        have = have | a[have].any(axis=0)
    agrees = have.sum() == (len(a) if m["every"] else number(m["heard"]))
    return bool(agrees and (m["right"] is None or number(m["right"]) == correct(state)))


def _apart(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    assert isinstance(state.now, Layer)
    x, along = state.now.features, np.sqrt(A(state).sum(axis=1) + 1)
    along = along / np.linalg.norm(along)
    return says_percent(
        m["share"], float(np.linalg.norm(x - along[:, None] * (along @ x)) / np.linalg.norm(x))
    )


def _smooth(run: Run, k: int, m: re.Match[str]) -> bool:
    return near(m["off"], off(run.states[k], run.states[k].now.p), 2)


def _volume(run: Run, k: int, m: re.Match[str]) -> bool:
    s = run.states[k].subject
    return says_percent(m["share"], volume(run.states[k].now.p, s.faces) / volume(s.p, s.faces))


def _same(run: Run, k: int) -> bool:
    state = run.states[k]
    sums = [state.now.features[state.subject.classes == group].sum(axis=0) for group in (0, 1)]
    return bool(np.allclose(*sums, rtol=1e-9))


def _applied(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    x, a, v = state.subject.p[:, 0], A(state), state.vertex
    energy = (np.triu(a) * (x[:, None] - x) ** 2).sum()
    return near(m["here"], (a[v] * (x[v] - x)).sum()) and near(m["energy"], energy)


def last_cut(run: Run) -> Cut:
    result = run.states[-1].now
    assert isinstance(result, Cut)
    return result


def middle(run: Run) -> float:
    """Where the cut edges of the last step are, along x."""
    side, p = last_cut(run).side, run.states[-1].subject.p
    i, j = np.nonzero(np.triu(A(run.states[-1]), 1))
    through = side[i] != side[j]
    return float(np.abs((p[i] + p[j])[through, 0] / 2).max())


CAPTIONS = [
    Claim(
        r"(?P<n>[\d,]+) of (?P<all>[\d,]+) nodes are on their true side(?: \(not (?P<nodes>[\d,"
        r" ]+)\))?",
        _true_sides,
    ),
    Claim(
        rf"(?P<near>[\d,]+) nodes? against (?P<far>[\d,]+), (?:edges of weight )?(?P<cut>{NUMBER})"
        rf"(?: edges? (?:is|are)| are) cut, conductance (?P<phi>{NUMBER})",
        _cut,
    ),
    Claim(r"The cut of least conductance along the vector", _least),
    Claim(
        rf"By sign it was (?P<n>[\d,]+), for a cut of (?P<edges>{NUMBER})",
        lambda run, k, m: _sign_truer(run, k, m),
    ),
    Claim(r"(?P<edges>[\d,]+) edges?, (?P<parts>[\d,]+) components?", _pieces),
    Claim(r"(?P<share>[\d.]+ %) of the namings are not returned", _one_way),
    Claim(r"0 twice: the graph has no path", lambda run, k, m: len(parts(A(run.states[k]))) == 2),
    Claim(rf"Eigenvector \d+: λ = {VALUE}(?=[,.:])", _mode),
    Claim(
        rf"off the exact heat by {VALUE}",
        lambda run, k, m: near(m["value"], exact_error(run, k), 2),
    ),
    Claim(
        r"off the exact heat by less than 0\.00001", lambda run, k, m: exact_error(run, k) < 1.05e-5
    ),
    Claim(
        r"dt is above 2 / λmax",
        lambda run, k, m: run.params.step_size > 2 and np.abs(run.states[k].now.u).max() > 1,
    ),
    Claim(rf"(?P<off>{NUMBER}) mean edges \(RMS\)", _smooth),
    Claim(r"(?P<share>[\d.,]+ %) of the volume", _volume),
    Claim(
        r"reached (?:(?P<every>all)|(?P<heard>[\d,]+) of) [\d,]+ nodes(?:; (?P<right>[\d,]+) are"
        r" right)?",
        _reached,
    ),
    Claim(r"(?P<share>(?:less than )?[\d.]+ %) of the features still tell nodes apart", _apart),
    Claim(r"are the same: these messages cannot tell", lambda run, k, m: _same(run, k)),
    Claim(r"differ by up to", lambda run, k, m: not _same(run, k)),
    Claim(
        r"on the two labels, (?P<n>[\d,]+) of [\d,]+ nodes right",
        lambda run, k, m: number(m["n"]) == correct(run.states[k]),
    ),
    Claim(rf"(?P<here>{NUMBER}) at node .*? xᵀ L x = (?P<energy>{NUMBER})", _applied),
    Claim(
        r"the eigenvalues of A are the same for both, those of L = D − A are different",
        lambda run, k, m: bool(
            np.allclose(*(pair[0] for pair in run.states[k].now.spectra), atol=1e-9)
            and not np.allclose(*(pair[1] for pair in run.states[k].now.spectra), atol=1e-3)
        ),
    ),
]

# preset lines -------------------------------------------------------------------------------------


def _of_twelve(run: Run) -> np.ndarray:
    return run.states[0].now.values[9:16]


def _uneven(run: Run, k: int, m: re.Match[str]) -> bool:
    z, values = run.states[0].subject.p[:, 2], run.states[0].now.values
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
    whole, classes = A(run.states[0]), run.states[0].subject.classes
    good = True
    for which in (0, 1):
        part = whole[np.ix_(classes == which, classes == which)]
        good &= np.allclose(np.linalg.eigvalsh(part), of_A[which], atol=1e-9)
        good &= np.allclose(
            np.linalg.eigvalsh(np.diag(part.sum(axis=1)) - part), of_L[which], atol=1e-9
        )
    return bool(good)


def _sign_truer(run: Run, k: int, m: re.Match[str]) -> bool:
    """By the sign of the vector more nodes are on their side, for so many edges cut."""
    state = run.states[k]
    above = state.now.fiedler > 0
    by_sign = max(
        int((above == state.subject.classes).sum()), int((~above == state.subject.classes).sum())
    )
    edges = A(state)[above][:, ~above].sum()
    return number(m["n"]) == by_sign > correct(state) and near(m["edges"], float(edges))


LINES = {
    "one-way": [
        Claim(r"1,500 points", lambda run, k, m: len(run.states[0].subject.p) == 1500),
        Claim(
            r"(?P<share>39 %) of the namings are not returned",
            of_preset(lambda run, k, m: _one_way(run, 0, m)),
        ),
    ],
    "matrix": [
        Claim(
            r"34 members, 78 friendships",
            lambda run, k, m: A(run.states[0]).shape == (34, 34) and A(run.states[0]).sum() == 156,
        ),
    ],
    "neck": [Claim(r"The best cut along it", lambda run, k, m: _least(run, k, m))],
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
            of_preset(lambda run, k, m: _volume(run, len(run.states) - 1, m)),
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
        Claim(r"every message is the same too", lambda run, k, m: _same(run, k)),
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
    "volume": [Claim(r"(?P<share>[\d.]+ %)\. The mean of the neighbours lies inwards", _volume)],
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
