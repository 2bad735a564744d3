"""What captions of the curvature lesson say, decided by brute force over the triangles, and against
the analytic surface.
"""

import re
from collections.abc import Callable

import numpy as np

from lessons.curvature.lesson import STAGES
from tests.readings import NUMBER, number, says_percent
from tests.truths.curvature import (
    angle_K,
    at,
    defect_here,
    defect_sum_of_all,
    exact_sum,
    facts,
    rms,
    shown,
    slope,
    study,
)
from tests.verdicts import Claim, Run
from workbench.lesson import Look
from workbench.scene import Caption

DIGITS = 0.006  # relative: what three digits that count may hide
VALUE = rf"({NUMBER})"


def near(text: str, value: float, relative: float = DIGITS) -> bool:
    return abs(number(text) - value) <= relative * abs(value) + 1e-8


def caption(look: Look) -> Caption:
    """Return the caption alone, without the picture."""
    return STAGES[look.params.stage].caption(look)


def claim(words: str, holds: Callable[[Run, int, re.Match[str]], bool]) -> Claim:
    """Return a claim that is decided from the steps, each beside its mesh."""
    return Claim(words, lambda run, k, m: holds(shown(run), k, m))


def _truth(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    name = {"gaussian": "gaussian", "mean": "mean"}[state.stage]
    return near(m[1], getattr(state.subject.truth, name)[state.now.vertex])


def _k_is(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    return near(m[1], float(angle_K(state)[state.now.vertex]), 2 * DIGITS)


def _relative_error(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    truth = state.subject.truth
    inside = ~facts(state)[2]
    name = "gaussian" if state.stage == "gaussian" else "mean"
    estimate = state.now.K if name == "gaussian" else state.now.H
    true = getattr(truth, name)
    if (m[1] == "all vertices") is not bool(inside.all()):
        return False
    if (
        np.abs(true[inside]).max() < 1e-6
    ):  # the truth is 0 everywhere: of the larger principal curvature, or of a sphere of 1 m
        larger = np.maximum(np.abs(truth.k1), np.abs(truth.k2)) ** (2 if name == "gaussian" else 1)
        of = np.sqrt(np.mean(larger[inside] ** 2)) or 1.0
        return says_percent(m[2], float(np.sqrt(np.mean((estimate - true)[inside] ** 2)) / of))
    return says_percent(m[2], rms(estimate, true, inside))


def _ring(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    v = state.now.vertex
    count = int((state.subject.faces == v).any(axis=1).sum())
    return int(m[1]) == count and abs(number(m[3]) - float(np.degrees(facts(state)[0][v]))) < 0.0051


def _gap(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    here = np.degrees(defect_here(state))
    return (here > 0) == ("gap" in m[0]) and abs(number(m[1]) - abs(here)) < 0.0051


def _pointing(run: Run, k: int, m: re.Match[str]) -> bool:
    """The pushes are (cot a + cot b)(p_i - p_j) / 2 A, added up face by face."""
    state = run.states[k]
    p = state.subject.p
    v = state.now.vertex
    total = np.zeros(3)
    for face in state.subject.faces[(state.subject.faces == v).any(axis=1)]:
        i = int(np.flatnonzero(face == v)[0])
        here = p[face[i]]
        first = p[face[(i + 1) % 3]]
        second = p[face[(i + 2) % 3]]
        for neighbour, across in ((first, second), (second, first)):
            u, w = here - across, neighbour - across
            total += u @ w / np.linalg.norm(np.cross(u, w)) * (here - neighbour)
    total /= 2 * facts(state)[1][v]
    surface = state.subject.truth
    factor = 2.0 if state.params.mistake == "H without the half" else 1.0
    outward = total @ state.now.normals[v] > 0
    agrees = surface.mean[v] == 0 or (surface.mean[v] > 0) == outward or state.params.noise > 0
    return (
        near(m[1], factor * float(np.linalg.norm(total)))
        and (m[2] == "outward") == outward
        and bool(agrees)
    )


def _principal(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    v = state.now.vertex
    K = float(angle_K(state)[v])
    H = float(at(run, "mean").now.H[v])
    if state.params.mistake == "defect taken for K":
        K = defect_here(state)
    roots = np.sort(np.roots([1.0, -2 * H, K]).real)  # k1 and k2 solve x^2 - 2 H x + K = 0
    numbers = number(m[1]), number(m[2])
    return bool(np.allclose(numbers, roots[::-1], rtol=2 * DIGITS, atol=2e-3 * (1 + abs(H))))


def _bends(run: Run, k: int, m: re.Match[str]) -> bool:
    k1 = run.states[k].now.k1[run.states[k].now.vertex]
    k2 = run.states[k].now.k2[run.states[k].now.vertex]
    signs = {np.sign(x) for x in (k1, k2) if abs(x) > 1e-5}
    return {
        "to both sides, as on a saddle": signs == {-1.0, 1.0},
        "to one side": len(signs) == 1 and min(abs(k1), abs(k2)) > 0,
        "one way only": len(signs) <= 1,
        "not at all": not signs,
    }[m[1]]


def _fit_errors(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    return all(
        says_percent(text, state.errors[name])
        for text, name in zip(m.groups(), ("K by fit", "K", "H by fit", "H"), strict=True)
    )


def _sum(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    total = float(state.now.defects.sum())
    return number(m[1]) == len(state.subject.p) and near(m[2], total / np.pi)


def _study_numbers(run: Run, k: int, m: re.Match[str]) -> bool:
    s = study(run)
    return abs(number(m[1]) - s.counts[-1] / s.counts[0]) <= 0.5 and all(
        says_percent(text, value)
        for text, value in zip(m.groups()[1:], (s.K[0], s.K[-1]), strict=True)
    )


PERCENT = rf"((?:less than )?{NUMBER} %)"

CAPTIONS = [
    claim(
        r"([\d,]+) vertices, ([\d,]+) triangles",
        lambda run, k, m: (
            (number(m[1]), number(m[2]))
            == (len(run.states[k].subject.p), len(run.states[k].subject.faces))
        ),
    ),
    claim(
        r"(\d+) vertices on the border",
        lambda run, k, m: int(m[1]) == facts(run.states[k])[2].sum(),
    ),
    claim(r"no border\.", lambda run, k, m: not facts(run.states[k])[2].any()),
    claim(r"(\d+) triangles meet at vertex ([\d,]+); their angles add up to ([\d.]+)°", _ring),
    claim(
        r"It lies on the border",
        lambda run, k, m: bool(facts(run.states[k])[2][run.states[k].now.vertex]),
    ),
    claim(
        r"In a plane they would",
        lambda run, k, m: not facts(run.states[k])[2][run.states[k].now.vertex],
    ),
    claim(r"(?:leaves a gap of|it overlaps by) ([\d.]+)°", _gap),
    claim(
        r"the ring closes: angle defect 0", lambda run, k, m: abs(defect_here(run.states[k])) < 1e-7
    ),
    claim(
        rf"a border vertex misses {VALUE}°",
        lambda run, k, m: near(m[1], np.degrees(defect_here(run.states[k]) + np.pi)),
    ),
    claim(
        rf"from 180°: {VALUE}° is how",
        lambda run, k, m: abs(number(m[1]) - np.degrees(defect_here(run.states[k]))) < 0.0051,
    ),
    claim(rf"K, the defect over the area, is {VALUE} m⁻²", _k_is),
    claim(
        rf"K at vertex [\d,]+ would be {VALUE}(?=[;.])",
        lambda run, k, m: near(m[1], defect_here(run.states[k])),
    ),
    claim(rf"the truth is {VALUE}(?=[ .])", _truth),
    claim(rf"Relative error \(RMS over ([\w ]+)\): {PERCENT}", _relative_error),
    claim(rf"2 H n, {VALUE} m⁻¹ long and pointing (outward|inward)", _pointing),
    claim(
        r"pushes, weighted by cotangents, cancel",
        lambda run, k, m: (
            float(np.linalg.norm(run.states[k].now.normals_2H[run.states[k].now.vertex])) < 1e-6
        ),
    ),
    claim(rf"k₁ = {VALUE} and k₂ = {VALUE} m⁻¹: the two circles", _principal),
    claim(
        r"circles bend (to both sides, as on a saddle|to one side|one way only|not at all)", _bends
    ),
    claim(
        rf"Relative errors \(RMS over all vertices\): K {PERCENT} \(angles {PERCENT}\), "
        rf"H {PERCENT} \(cotangents {PERCENT}\)",
        _fit_errors,
    ),
    claim(
        rf"All ([\d,]+) defects add up to {VALUE} π\.",
        _sum,
    ),
    claim(
        rf"Gauss-Bonnet: that is 2 π times V − E \+ F = {VALUE}, and no noise or resolution",
        lambda run, k, m: number(m[1]) == facts(run.states[k])[3] and defect_sum_of_all(run, k, m),
    ),
    claim(
        rf"2 π times V − E \+ F is {VALUE} π",
        lambda run, k, m: number(m[1]) == 2 * facts(run.states[k])[3],
    ),
    claim(
        r"The sum is too large: π for each of the (\d+) border vertices",
        lambda run, k, m: (
            int(m[1])
            == facts(run.states[k])[2].sum()
            == round(run.states[k].now.total / np.pi - 2 * facts(run.states[k])[3])
        ),
    ),
    claim(r"Some defects are wrong", lambda run, k, m: not defect_sum_of_all(run, k, m)),
    claim(
        rf"With (\d+) times as many vertices the error of K from angles goes from"
        rf" {PERCENT} to {PERCENT}\.",
        _study_numbers,
    ),
    claim(
        r"No mesh is fine enough to mend a missing division",
        lambda run, k, m: study(run).K.min() > 0.9,
    ),
    claim(
        r"No mesh is fine enough to mend a missing ½", lambda run, k, m: study(run).H.min() > 0.9
    ),
    claim(r"angles are exact", lambda run, k, m: study(run).K.max() < 1e-8),
    claim(
        r"Finer is worse: the same noise",
        lambda run, k, m: run.params.noise > 0 and slope(study(run).K, study(run).counts) > 0.2,
    ),
    claim(
        r"does not converge to K; the defects' sum stays exact",
        lambda run, k, m: slope(study(run).K, study(run).counts) > -0.5 and exact_sum(run),
    ),
    claim(
        r"On such meshes angles converge",
        lambda run, k, m: slope(study(run).K, study(run).counts) < -0.8,
    ),
]
