"""Decides what the curvature lesson says: by brute force over the triangles, and against the
analytic surface.
"""

import re
from collections.abc import Callable

import numpy as np
from scipy.optimize import brentq

from lessons.curvature import balls
from lessons.curvature.inputs import Input
from lessons.curvature.lesson import STAGES
from tests.own_seed import of_preset
from tests.readings import NUMBER, number, says_percent
from tests.truths.curvature import (
    angle_K,
    at,
    defect_here,
    defect_sum_of_all,
    defects,
    exact_sum,
    facts,
    inside,
    mean_of,
    off_by_five_times_itself,
    off_by_more_than_itself,
    on_the_torus,
    params,
    regular,
    rms,
    run_of,
    scaled_by_two,
    shown,
    slope,
    study,
    too_small,
    turned,
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


def right(run: Run, k: int) -> bool | None:
    if run.params.stage != "mesh":
        return None
    run = shown(run)
    state = run.states[k]
    v = state.now.vertex
    if state.stage == "total":
        total, promised = float(state.now.defects.sum()), 2 * np.pi * facts(state)[3]
        return abs(total - promised) < 1e-6
    if state.stage == "defect":
        return bool(abs(state.now.defects[v] - defect_here(state)) < 1e-6)
    if state.stage in ("gaussian", "mean"):
        estimate = state.now.K if state.stage == "gaussian" else state.now.H
        true = getattr(state.subject.truth, state.stage)[v]
        return bool(abs(estimate[v] - true) < 0.5 * abs(true))
    if state.stage == "finer":
        s = study(run)
        return bool((s.K.max() < 1e-8 or slope(s.K, s.counts) < -0.5) and s.H[-1] < 0.5)
    return None


def _truth(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    name = {"gaussian": "gaussian", "mean": "mean"}[state.stage]
    return near(m[1], getattr(state.subject.truth, name)[state.now.vertex])


def _k_is(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    return near(m[1], float(angle_K(state)[state.now.vertex]), 2 * DIGITS)


def _relative_error(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    truth, inside = state.subject.truth, ~facts(state)[2]
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
    p, v, total = state.subject.p, state.now.vertex, np.zeros(3)
    for face in state.subject.faces[(state.subject.faces == v).any(axis=1)]:
        i = int(np.flatnonzero(face == v)[0])
        here, first, second = p[face[i]], p[face[(i + 1) % 3]], p[face[(i + 2) % 3]]
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
    K, H = float(angle_K(state)[v]), float(at(run, "mean").now.H[v])
    if state.params.mistake == "defect taken for K":
        K = defect_here(state)
    roots = np.sort(np.roots([1.0, -2 * H, K]).real)  # k1 and k2 solve x^2 - 2 H x + K = 0
    numbers = number(m[1]), number(m[2])
    return bool(np.allclose(numbers, roots[::-1], rtol=2 * DIGITS, atol=2e-3 * (1 + abs(H))))


def _bends(run: Run, k: int, m: re.Match[str]) -> bool:
    k1, k2 = (
        run.states[k].now.k1[run.states[k].now.vertex],
        run.states[k].now.k2[run.states[k].now.vertex],
    )
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


def _height(run: Run, k: int) -> float:
    """Return the height of the paper, found from the angle that neighbouring corners make."""
    gap = run.states[k].gap
    angle = np.radians((360.0 - gap) / 6)

    def miss(up: float) -> float:
        """Return how far two neighbouring corners miss the angle, one `up`, radians."""
        other = up if gap > 0 else -up
        a, b = (np.array([np.sqrt(1 - z * z), z]) for z in (up, other))
        return float(np.arccos(0.5 * a[0] * b[0] + a[1] * b[1]) - angle)

    up = brentq(miss, 0.0, 0.999)
    return up if gap > 0 else 2 * up


def _ball(k: int) -> tuple[int, float, float]:
    """Return how many vertices a ball has, and at its vertex the gap in radians and the area, both
    from the edges alone: the law of cosines, and Meyer's cotangents of angles that are all acute.
    """
    subject = balls.setup(Input(stage="balls"))
    surface, v = subject.surfaces[k], subject.vertices[k]
    gap, area = 2 * np.pi, 0.0
    for face in surface.faces[(surface.faces == v).any(axis=1)]:
        corner, a, b = surface.p[np.roll(face, -int(np.flatnonzero(face == v)[0]))]
        u, w, far = (float(np.linalg.norm(d)) for d in (a - corner, b - corner, b - a))
        gap -= np.arccos((u * u + w * w - far * far) / (2 * u * w))
        at_a = np.arccos((u * u + far * far - w * w) / (2 * u * far))
        at_b = np.arccos((w * w + far * far - u * u) / (2 * w * far))
        area += (u * u / np.tan(at_b) + w * w / np.tan(at_a)) / 8
    return len(surface.p), float(gap), area


def _gap_said(run: Run, k: int) -> float:
    """Return the gap in degrees, of the paper or of a ball."""
    return float(np.degrees(_ball(k)[1])) if run.params.stage == "balls" else run.states[k].gap


VALUES = {
    "vertices": lambda run, k: _ball(k)[0],
    "area": lambda run, k: _ball(k)[2],
    "K": lambda run, k: _ball(k)[1] / _ball(k)[2],
    "angle": lambda run, k: 60.0 - run.states[k].gap / 6,
    "gap": _gap_said,
    "overlap": lambda run, k: -run.states[k].gap,
    "height": _height,
}


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


LINES = {
    "cylinder": [
        claim(
            r"H is 1/2r = 1 m⁻¹",
            lambda run, k, m: bool(np.allclose(inside(run, "mean", "H"), 1, rtol=2e-3)),
        ),
    ],
    "catenoid": [
        claim(
            r"Catenoid: H = 0, K < 0",
            lambda run, k, m: (
                bool((inside(run, "gaussian", "K") < 0).all())
                and np.abs(inside(run, "mean", "H")).max() < 0.02
            ),
        ),
        claim(
            r"negative everywhere", lambda run, k, m: bool((inside(run, "gaussian", "K") < 0).all())
        ),
    ],
    "double": [
        claim(
            r"Every length is doubled",
            lambda run, k, m: (
                np.ptp(run.states[0].subject.p) == 2 * np.ptp(next(iter(run_of(Input()))).subject.p)
            ),
        ),
    ],
    "no-area": [
        claim(
            r"about a hundred times too small here, and about four times smaller still on a mesh"
            r" four times as fine",
            too_small,
        ),
    ],
    "no-half": [
        claim(
            r"H = 2 m⁻¹, and H² − K = 3",
            lambda run, k, m: (
                bool(np.allclose(inside(run, "mean", "H"), 2, rtol=1e-2))
                and bool(
                    np.allclose(
                        inside(run, "mean", "H") ** 2 - angle_K(at(run, "mean")), 3, atol=0.15
                    )
                )
            ),
        ),
    ],
    "border": [
        claim(
            r"K and H are left open \(grey\) there",
            lambda run, k, m: (
                bool(facts(run.states[0])[2][run.states[0].now.vertex])
                and bool((np.isnan(at(run, "mean").now.H) == facts(run.states[0])[2]).all())
            ),
        ),
    ],
    "border-2pi": [
        claim(
            r"should add up to 2π",
            lambda run, k, m: abs(defects(run.states[0]).sum() - 2 * np.pi) < 1e-9,
        ),
        claim(
            r"each border vertex adds π that is not there, and the sum is far off",
            lambda run, k, m: (
                abs(at(run, "total").now.total - 2 * np.pi - np.pi * facts(run.states[0])[2].sum())
                < 1e-6
            ),
        ),
    ],
    "coarse": [
        claim(
            r"With 60 vertices the relative error of K is about 10 %",
            lambda run, k, m: (
                0.09
                < rms(
                    angle_K(at(run, "gaussian")),
                    at(run, "gaussian").subject.truth.gaussian,
                    ~facts(run.states[0])[2],
                )
                < 0.11
            ),
        ),
    ],
    "fine": [
        claim(r"0\.13 % \(RMS\): on a regular mesh it falls with the square of the edges", regular)
    ],
    "noise": [
        claim(r"K is off by more than its own size", off_by_more_than_itself),
        claim(
            r"A finer mesh makes it worse",
            lambda run, k, m: bool((np.diff(study(run).K) > 0).all()),
        ),
    ],
    "irregular": [claim(r"along the surface, never off it", on_the_torus)],
    "sphere-sum": [
        claim(r"off by over five times its own size", of_preset(off_by_five_times_itself))
    ],
    "torus-sum": [
        claim(
            r"cancel to the last digit",
            lambda run, k, m: abs(at(run, "total").now.defects.sum()) < 1e-9,
        ),
        claim(r"a handle", lambda run, k, m: facts(run.states[0])[3] == 0),
    ],
}

WHYS = {
    "seven": [
        claim(
            r"6 times 70° is 420°",
            lambda run, k, m: any(s.gap == -60 and s.angle == 70 for s in run.states),
        )
    ],
    "inside": [
        claim(
            rf"{VALUE}° of gaps and {VALUE}° of overlaps",
            lambda run, k, m: (
                abs(number(m[1]) - np.degrees(np.maximum(defects(run.states[0]), 0).sum())) < 0.06
                and abs(number(m[2]) + np.degrees(np.minimum(defects(run.states[0]), 0).sum()))
                < 0.06
            ),
        )
    ],
    "which-rolled": [
        claim(
            rf"K = {VALUE} m⁻² and H = {VALUE} m⁻¹",
            lambda run, k, m: (
                abs(number(m[1]) - 0) < 5e-4 and abs(number(m[2]) - 1 / (2 * 0.5)) < 2e-3
            ),
        ),
        claim(
            r"no angle changes",
            lambda run, k, m: bool(
                np.abs(defects(run.states[0])[~facts(run.states[0])[2]]).max() < 1e-9
            ),
        ),
    ],
    "which-double": [
        claim(
            r"It is ([\d.]+) times what it was: the angles stay, and each vertex has four times"
            r" the "
            r"area\. H would be halved",
            lambda run, k, m: number(m[1]) == 0.25 and scaled_by_two(run),
        ),
    ],
    "which-sides": [
        claim(
            r"H turns with the normal\. K is the product",
            lambda run, k, m: (
                bool(np.allclose(angle_K(run.states[-1]), angle_K(turned(run))))
                and bool(
                    np.allclose(at(run, "mean").now.H, -mean_of(params(run, inside_out=False)))
                )
            ),
        ),
    ],
    "which-finer": [
        claim(
            rf"from {PERCENT} to {PERCENT} \(RMS\)",
            lambda run, k, m: (
                says_percent(m[1], study(run).K[0]) and says_percent(m[2], study(run).K[-1])
            ),
        ),
        claim(
            rf"so does the error of defect / area; that of the quadric fit falls to {PERCENT}",
            lambda run, k, m: (
                abs(slope(study(run).K, study(run).counts)) < 0.15
                and study(run).K_fit[-1] < study(run).K_fit[0] / 5
                and says_percent(m[1], study(run).K_fit[-1])
            ),
        ),
    ],
    "which-sum": [
        claim(
            r"V − E \+ F = (\d+), and 2π times that is 4π",
            lambda run, k, m: int(m[1]) == facts(run.states[0])[3] == 2 and exact_sum(run),
        ),
    ],
}
