"""What captions of the graphs lesson say of cuts, components, eigenvalues, heat and messages,
decided with dense matrices.
"""

import re

import numpy as np

from lessons.graphs.state import Grown, Mode
from tests.readings import NUMBER, POWER, near, number, says_percent
from tests.truths.graphs import A, correct, modes, off, parts, told, volume
from tests.verdicts import Claim, Run
from workbench.algorithms.graphs.spectral_cut import Cut
from workbench.algorithms.learning.graph_network import Layer

VALUE = rf"(?P<value>{POWER})"


def exact_error(run: Run, k: int) -> float:
    """The largest error of the heat at a step, beside exp(-t L) by all eigenvectors."""
    state = run.states[k]
    values, vectors = modes(state.adjacency)
    t = k * run.params.step_size / values[-1]
    exact = vectors @ (np.exp(-t * values) * (vectors.T @ run.states[0].now.u))
    return float(np.abs(state.now.u - exact).max())


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
    result = run.states[k].now
    a = A(run.states[k])
    assert isinstance(result, Cut)
    cut = a[np.ix_(result.side, ~result.side)].sum()
    smaller = min(a[result.side].sum(), a[~result.side].sum())
    phi = cut / smaller if smaller else 1.0
    sizes = number(m["near"]) == result.side.sum() and number(m["far"]) == (~result.side).sum()
    return bool(sizes and near(m["cut"], cut) and near(m["phi"], phi, 2))


def least(run: Run, k: int, m: re.Match[str]) -> bool:
    """No cut along the vector is better."""
    result = run.states[k].now
    a = A(run.states[k])
    assert isinstance(result, Cut)
    order = np.argsort(result.fiedler, kind="stable")
    d = a.sum(axis=1)[order]
    a = a[np.ix_(order, order)]
    best = np.inf
    cut = 0.0
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


def one_way(run: Run, k: int, m: re.Match[str]) -> bool:
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
    result = state.now
    a = A(state) > 0
    assert isinstance(result, Layer)
    have = np.isin(np.arange(len(a)), state.subject.labelled)
    for _ in range(result.layer):
        have = have | a[have].any(axis=0)
    agrees = have.sum() == (len(a) if m["every"] else number(m["heard"]))
    return bool(agrees and (m["right"] is None or number(m["right"]) == correct(state)))


def _apart(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    assert isinstance(state.now, Layer)
    x = state.now.features
    along = np.sqrt(A(state).sum(axis=1) + 1)
    along = along / np.linalg.norm(along)
    return says_percent(
        m["share"], float(np.linalg.norm(x - along[:, None] * (along @ x)) / np.linalg.norm(x))
    )


def _smooth(run: Run, k: int, m: re.Match[str]) -> bool:
    return near(m["off"], off(run.states[k], run.states[k].now.p), 2)


def volume_kept(run: Run, k: int, m: re.Match[str]) -> bool:
    s = run.states[k].subject
    return says_percent(m["share"], volume(run.states[k].now.p, s.faces) / volume(s.p, s.faces))


def same(run: Run, k: int) -> bool:
    state = run.states[k]
    sums = [state.now.features[state.subject.classes == group].sum(axis=0) for group in (0, 1)]
    return bool(np.allclose(*sums, rtol=1e-9))


def _applied(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    x = state.subject.p[:, 0]
    a = A(state)
    v = state.vertex
    energy = (np.triu(a) * (x[:, None] - x) ** 2).sum()
    return near(m["here"], (a[v] * (x[v] - x)).sum()) and near(m["energy"], energy)


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
    Claim(r"The cut of least conductance along the vector", least),
    Claim(
        rf"By sign it was (?P<n>[\d,]+), for a cut of (?P<edges>{NUMBER})",
        lambda run, k, m: _sign_truer(run, k, m),
    ),
    Claim(r"(?P<edges>[\d,]+) edges?, (?P<parts>[\d,]+) components?", _pieces),
    Claim(r"(?P<share>[\d.]+ %) of the namings are not returned", one_way),
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
    Claim(r"(?P<share>[\d.,]+ %) of the volume", volume_kept),
    Claim(
        r"reached (?:(?P<every>all)|(?P<heard>[\d,]+) of) [\d,]+ nodes(?:; (?P<right>[\d,]+) are"
        r" right)?",
        _reached,
    ),
    Claim(r"(?P<share>(?:less than )?[\d.]+ %) of the features still tell nodes apart", _apart),
    Claim(r"are the same: these messages cannot tell", lambda run, k, m: same(run, k)),
    Claim(r"differ by up to", lambda run, k, m: not same(run, k)),
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


def _sign_truer(run: Run, k: int, m: re.Match[str]) -> bool:
    """By the sign of the vector more nodes are on their side, for so many edges cut."""
    state = run.states[k]
    above = state.now.fiedler > 0
    by_sign = max(
        int((above == state.subject.classes).sum()), int((~above == state.subject.classes).sum())
    )
    edges = A(state)[above][:, ~above].sum()
    return number(m["n"]) == by_sign > correct(state) and near(m["edges"], float(edges))
