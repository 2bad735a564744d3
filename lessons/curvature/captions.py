"""What just happened, in one or two sentences with its numbers."""

import numpy as np

from lessons.curvature.scales import H_SCALE, K_SCALE, reach, share_within
from lessons.curvature.state import State
from workbench.certain import sure
from workbench.lesson import say
from workbench.numerals import brief, percent
from workbench.scene import Caption

NOWHERE = "The vertex lies on the border, where {} is not defined."


def caption(state: State) -> Caption:
    """Return the caption of a step."""
    return _CAPTIONS[state.stage](state)


def _mesh(state: State) -> Caption:
    subject, params = state.subject, state.params
    name = subject.name if subject.truth is None else f"{subject.name[0].upper()}{subject.name[1:]}"
    text = f"{name}: {len(subject.p):,} vertices, {len(subject.faces):,} triangles"
    border = int(np.count_nonzero(subject.border))
    text += f", {border} vertices on the border." if border else ", no border."
    if subject.truth is None:
        text += (
            f" A length of 1 in its file is {brief(subject.enlarged)} m here; its {subject.up} axis"
            " points up."
        )
        text += "".join(f" Mended: {', '.join(subject.mended)}." for _ in subject.mended[:1])
    elif params.jitter or params.noise:
        ways = [f"up to {brief(params.jitter)} cells along it"] * bool(params.jitter)
        ways += [f"{1000 * params.noise:g} mm (sigma) off it"] * bool(params.noise)
        text += f" Its vertices stray by {' and '.join(ways)}."
    else:
        text += " Every triangle is flat: all bending sits at vertices and edges."
    return say(text)


def _ring(state: State) -> Caption:
    angles = sure(state.now.angles)
    total = np.degrees(angles.sum())
    text = (
        f"{len(angles)} triangles meet at vertex {state.now.vertex:,}; their angles add up to"
        f" {total:.2f}°."
    )
    if state.on_border:
        return say(
            text + " It lies on the border: on a straight, flat border they would add up to 180°."
        )
    return say(text + " In a plane they would add up to 360°.")


def _unfolding(state: State) -> Caption:
    return say(
        f"Cut along one edge, the ring unfolds, {100 * state.unfolded:.0f} % of the way: each of"
        f" its {len(state.now.angles)} triangles keeps its shape and its angle."
    )


def _defect(state: State) -> Caption:
    defects = sure(state.now.defects)
    here = np.degrees(float(defects[state.now.vertex]))
    if abs(here) < 5e-7:
        return say(
            "Laid flat, the ring closes: angle defect 0. Flat triangles can bend around an edge"
            " without one."
        )
    text = (
        f"Laid flat, the ring leaves a gap of {here:.2f}°"
        if here > 0
        else f"Laid flat, it overlaps by {-here:.2f}°"
    )
    text += ": the angle defect."
    if not state.on_border:
        return say(text)
    if state.params.mistake == "2 pi on the border":
        return say(
            f"Taken from 360°, a border vertex misses {here:.2f}°: half a turn that is not there.",
            tone="wrong",
        )
    return say(
        f"On the border angles are taken from 180°: {here:.2f}° is how the border itself turns"
        " here, not how the surface bends."
    )


def _gaussian(state: State) -> Caption:
    mesh = state.now
    v = mesh.vertex
    true = state.true("gaussian")
    if state.on_border:
        return say(
            NOWHERE.format("K") + _error(state, "K") + _colors(state, mesh.K, K_SCALE, unit="m⁻²")
        )
    if state.params.mistake == "defect taken for K":
        text = f"Without the division by the area, K at vertex {v:,} would be {brief(mesh.K[v])}"
        return say(
            text + _truth(true, "") + f" The mesh decides, not the surface.{_error(state, 'K')}",
            tone="wrong",
        )
    text = f"Here K, the defect over the area, is {brief(mesh.K[v])} m⁻²"
    return say(text + _truth(true, "m⁻²") + _colors(state, mesh.K, K_SCALE, unit="m⁻²"))


def _normal(state: State) -> Caption:
    mesh = state.now
    if state.on_border:
        return say(NOWHERE.format("the mean-curvature normal"))
    v = mesh.normals_2H[mesh.vertex]
    side = "outward" if v @ mesh.normals[mesh.vertex] > 0 else "inward"
    if np.linalg.norm(v) < 1e-6:
        return say(
            f"At vertex {mesh.vertex:,} the neighbours' pushes, weighted by cotangents, cancel: 2 H"
            " n = 0."
        )
    return say(
        f"Over twice the area, the pushes at vertex {mesh.vertex:,} add up to 2 H n,"
        f" {brief(float(np.linalg.norm(v)))} m⁻¹ long and pointing {side}."
    )


def _mean(state: State) -> Caption:
    mesh = state.now
    if state.on_border:
        return say(NOWHERE.format("H") + _error(state, "H"))
    H = float(mesh.H[mesh.vertex])
    true = state.true("mean")
    if state.params.mistake == "H without the half":
        text = f"Taken whole, the normal's length gives H = {brief(H)} m⁻¹"
        return say(
            text + _truth(true, "m⁻¹") + " The ½ is missing." + _error(state, "H"), tone="wrong"
        )
    text = f"H is half the normal's length, positive where it points outward: {brief(H)} m⁻¹"
    return say(text + _truth(true, "m⁻¹") + _colors(state, mesh.H, H_SCALE, unit="m⁻¹"))


def _principal(state: State) -> Caption:
    mesh = state.now
    k1, k2 = float(mesh.k1[mesh.vertex]), float(mesh.k2[mesh.vertex])
    if not np.isfinite([k1, k2]).all():
        return say(NOWHERE.format("K or H"))
    text = f"k₁ = {brief(k1)} and k₂ = {brief(k2)} m⁻¹"
    if max(abs(k1), abs(k2)) <= 1e-6:
        kind = "not at all"
    elif k1 * k2 < -1e-6:
        kind = "to both sides, as on a saddle"
    elif k1 * k2 > 1e-6:
        kind = "to one side"
    else:
        kind = "one way only"
    return say(f"{text}: the two circles bend {kind}.")


def _quadric(state: State) -> Caption:
    quadrics = sure(state.now.quadrics)
    v = state.now.vertex
    K, H = (float(values[v]) for values in quadrics.curvatures())
    n = int(quadrics.neighbours[v])
    if not np.isfinite(K):
        return say(
            f"Another way, a quadric through two rings, needs six vertices in reach; here are {n}."
        )
    text = (
        f"Another way: a quadric fitted to {n} vertices bends by K = {brief(K)} m⁻², H = {brief(H)}"
        " m⁻¹."
    )
    if state.errors:
        e = state.errors
        text += (
            f" Relative errors (RMS over all vertices): K {percent(e['K by fit'])} (angles"
            f" {percent(e['K'])}), H {percent(e['H by fit'])} (cotangents {percent(e['H'])})."
        )
    return say(text)


def _total(state: State) -> Caption:
    mesh = state.now
    expected = 2 * np.pi * mesh.chi
    text = f"All {len(mesh.p):,} defects add up to {brief(mesh.total / np.pi)} π."
    if abs(mesh.total - expected) < 1e-6:
        return say(
            f"{text} Gauss-Bonnet: that is 2 π times V − E + F = {brief(mesh.chi)}, and no noise or"
            " resolution changes it.",
            tone="good",
        )
    halves = (mesh.total - expected) / np.pi
    text += f" 2 π times V − E + F is {brief(2 * mesh.chi)} π. "
    if state.params.mistake == "2 pi on the border":
        return say(
            f"{text}The sum is too large: π for each of the {halves:.0f} border vertices.",
            tone="wrong",
        )
    return say(f"{text}Some defects are wrong.", tone="wrong")


def _finer(state: State) -> Caption:
    study = sure(state.study)
    text = (
        f"With {study.counts[-1] / study.counts[0]:.0f} times as many vertices the error of K from"
        f" angles goes from {percent(study.K[0])} to {percent(study.K[-1])}."
    )
    missing = {"defect taken for K": "division by the area", "H without the half": "½ in H"}.get(
        state.params.mistake
    )
    if missing:
        return say(f"{text} No mesh is fine enough to mend a missing {missing}.", tone="wrong")
    if study.K.max() < 1e-8:
        return say(text + " On such a mesh angles are exact.", tone="good")
    if study.K[-1] > 2 * study.K[0]:
        why = ": the same noise bends smaller triangles more." if state.params.noise else "."
        return say(f"{text} Finer is worse{why}", tone="wrong")
    if study.K[-1] > study.K[0] / 4:
        return say(
            text
            + " On such meshes the quotient defect / area does not converge to K; the defects' sum"
            " stays exact.",
            tone="wrong",
        )
    return say(text + " On such meshes angles converge.", tone="good")


_CAPTIONS = {
    "mesh": _mesh,
    "ring": _ring,
    "unfolding": _unfolding,
    "defect": _defect,
    "gaussian": _gaussian,
    "normal": _normal,
    "mean": _mean,
    "principal": _principal,
    "quadric": _quadric,
    "total": _total,
    "finer": _finer,
}


def _truth(true: float, unit: str) -> str:
    if not np.isfinite(true):
        return "."
    space = " " if unit else ""
    return f"; the truth is {brief(true)}{space}{unit}."


def _error(state: State, name: str) -> str:
    if name not in state.errors:
        return ""
    which = "the vertices inside" if state.subject.border.any() else "all vertices"
    return f" Relative error (RMS over {which}): {percent(state.errors[name])}."


def _colors(state: State, values: np.ndarray, fixed: float, *, unit: str) -> str:
    """Return how far the colours of an own mesh reach."""
    if state.subject.truth is not None:
        return ""
    limit = reach(state, values, fixed)
    return (
        f" The colours reach to ±{brief(limit)} {unit}; {share_within(values, limit)} of the"
        " vertices lie within."
    )
