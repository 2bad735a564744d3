"""What a step of measuring says, with its numbers, and at the end how far from the truth it is."""

import numpy as np

from lessons.measures.state import State, Subject
from lessons.measures.study import RUNS, SURE
from workbench.algorithms.surfaces.measures import Cells, Sums
from workbench.algorithms.surfaces.monte_carlo import Balls, Lines, Sampled, Throws
from workbench.certain import sure
from workbench.geometry.meshes.measures import encloses
from workbench.numerals import brief, counted, fixed, fixed_or_power, percent
from workbench.scene import Caption

EXACT = 1e-9  # relative: what rounding may do to a sum
ENOUGH = 1000
"""Throws from which those that are spread evenly scatter less than random ones, whatever the shape.
"""


def caption(state: State) -> Caption:
    """Return the caption of a step."""
    if state.study is not None:
        return _finer(state)
    now = state.now
    if isinstance(now, Sums):
        return _faces(state, now)
    if isinstance(now, Cells):
        return _cells(state, now)
    if isinstance(now, Throws):
        return _throws(state, now)
    if isinstance(now, Lines):
        return _lines(state, now)
    return _samples(state, now) if isinstance(now, Sampled) else _balls(now)


def volume(subject: Subject, value: float) -> str:
    """Write a volume."""
    return f"{_number(value)} {subject.unit}³"


def area(subject: Subject, value: float) -> str:
    """Write an area."""
    return f"{_number(value)} {subject.unit}²"


def off(error: float) -> str:
    """Write a relative error with its sign."""
    if abs(error) < EXACT:
        return "exact"
    return (
        f"{'+' if error > 0 else ''}{percent(error)}"
        if abs(error) >= 1e-4
        else "off by less than 0.01 %"
    )


def _interval(value: float, error: float) -> str:
    """Write an estimate and how far its interval reaches to either side."""
    return f"{_number(value)} ± {brief(SURE * error, 2)}"


def _number(value: float) -> str:
    return fixed_or_power(value, 0) if abs(value) >= 1e6 else brief(value, 4)


def _faces(state: State, now: Sums) -> Caption:
    subject = state.subject
    if not np.isfinite(subject.volume) and now.count < len(subject.faces):
        return _area_alone(subject, now)
    if now.count == 0:
        gone = len(subject.whole) - len(subject.faces)
        hole = f" {counted(gone, 'triangle')} cut out." if gone else ""
        return Caption(
            f"{_capital(subject.name)}: {len(subject.p):,} vertices, {len(subject.faces):,}"
            f" triangles.{hole}{subject.note} Each triangle makes a tetrahedron with the origin,"
            " the purple dot."
        )
    if now.count == len(subject.faces):
        return _all_faces(state, now)
    if now.count == 1:
        k = now.order[0]
        part = float(now.parts[k])
        side = (
            "minus, for the origin is in front of it"
            if part < 0
            else "plus, for the origin is behind it"
        )
        return Caption(
            "The triangle nearest to the origin: half the length of (b − a) × (c − a) is its area,"
            f" {area(subject, float(now.areas[k]))}; a · (b × c) / 6 is its tetrahedron,"
            f" {volume(subject, part)}: {side}."
        )
    new = now.order[now.count - now.new : now.count]
    minus = int(np.count_nonzero(now.parts[new] < 0))
    return Caption(
        f"{now.count:,} of {len(subject.faces):,} triangles, near ones first:"
        f" {volume(subject, now.volume)} so far. New ones that count plus: {now.new - minus:,};"
        f" that count minus: {minus:,}."
    )


def _area_alone(subject: Subject, now: Sums) -> Caption:
    if now.count == 0:
        return Caption(
            f"{_capital(subject.name)}: {len(subject.p):,} vertices, {len(subject.faces):,}"
            f" triangles.{subject.note} Its area is added up, triangle by triangle."
        )
    return Caption(
        f"{now.count:,} of {len(subject.faces):,} triangles, near ones first: area"
        f" {area(subject, now.area)} so far."
    )


def _all_faces(state: State, now: Sums) -> Caption:
    subject = state.subject
    text = (
        f"All {len(subject.faces):,} triangles: area {area(subject, now.area)}"
        f" ({off(state.area_error)})"
    )
    if not np.isfinite(subject.volume):
        return Caption(f"{text}. It encloses nothing, so no volume is its own.")
    text += (
        f", volume {volume(subject, now.volume)} ({off(state.volume_error)}). {_origin(subject)}"
    )
    return Caption(text, "good" if right(state) else "wrong")


def right(state: State) -> bool:
    """Tell whether all faces were added up, and their volume is that of the mesh or, but for its
    facets, of its shape.
    """
    now = state.now
    if not isinstance(now, Sums) or not encloses(state.subject.faces):
        return False
    most = 0.75 if state.params.subdivisions < 1 else 0.4 if state.params.subdivisions < 2 else 0.15
    return -(most if state.subject.smooth else EXACT) < state.volume_error < 1e-6


def _origin(subject: Subject) -> str:
    if encloses(subject.faces):
        return "Every edge has its partner: any other origin gives the same."
    return "Edges lack a partner: another origin gives another volume."


def _cells(state: State, now: Cells) -> Caption:
    subject, n = state.subject, now.across[-1]
    full = int(np.count_nonzero(now.bits))
    whole = (
        "the true area"
        if state.params.voxels is None
        else "the area by marching through all voxels"
    )
    text = (
        f"{n} cells across, {full:,} full: volume {volume(subject, now.volumes[-1])}"
        f" ({off(state.volume_error)})."
    )
    text += f" The walls between full and empty: {area(subject, now.areas[-1])}"
    text += f", {fixed(now.areas[-1] / subject.area, 2)} times {whole}"
    if np.isfinite(now.marched[-1]):
        text += f"; marching cubes: {fixed(now.marched[-1] / subject.area, 2)} times"
    return Caption(f"{text}.{subject.note if len(now.across) == 1 else ''}")


def _throws(state: State, now: Throws) -> Caption:
    subject, n = state.subject, now.estimates.counts[-1]
    value, error = now.estimates.values[-1], now.estimates.errors[-1]
    text = f"{n:,} throws, {now.hits:,} hits: {_interval(value, error)} {subject.unit}³"
    text += f"; truth {volume(subject, subject.volume)}, {off(state.volume_error)}."
    if now.hits in (0, n):
        return Caption(
            f"{text} Without a {'hit' if now.hits == 0 else 'miss'} the interval is empty: it knows"
            " nothing."
        )
    held = abs(value - subject.volume) <= SURE * error
    text += f" The interval (95 %) {'holds' if held else 'misses'} the truth."
    if state.params.draw != "random":
        anew = (
            " All are thrown anew, one in each small cube."
            if state.params.draw == "stratified"
            else ""
        )
        wide = ": too wide here" if n >= ENOUGH else ""
        return Caption(f"{text} It is that of random throws{wide}.{anew}")
    return Caption(text + _peeked(state, len(now.estimates.counts)))


def _peeked(state: State, looks: int) -> str:
    if state.peeked is None:
        return ""
    now, ever = state.peeked
    return (
        f" Of {RUNS:,} such runs {percent(now, 0)} miss it at this step, and {percent(ever, 0)}"
        f" missed it at one or more of the {looks} looks."
    )


def _lines(state: State, now: Lines) -> Caption:
    subject, n = state.subject, now.estimates.counts[-1]
    value, error = now.estimates.values[-1], now.estimates.errors[-1]
    return Caption(
        f"{n:,} lines through the ball around it cross the surface {now.total:,} times,"
        f" {fixed(now.total / n, 2)} each; times 2πR² that is {_interval(value, error)}"
        f" {subject.unit}²; truth {area(subject, subject.area)}, {off(state.area_error)}."
    )


def _samples(state: State, now: Sampled) -> Caption:
    if state.in_triangle:
        shares = ", ".join(percent(share, 0) for share in state.quarters[:3])
        return Caption(
            f"{len(now.q):,} points in one triangle. Its four quarters are of one size; the corners"
            f" got {shares}, the middle {percent(state.quarters[3], 0)}."
        )
    subject = state.subject
    gap = float(np.linalg.norm(now.mean - state.middle)) / subject.diagonal
    return Caption(
        f"{len(now.q):,} points on {subject.name}: {percent(state.half_hits, 0)} of them on the"
        f" half whose faces were cut in four, which has {percent(state.half_share, 0)} of the area."
        f" Their mean is {percent(gap)} of the diagonal away from the surface's middle."
    )


def _balls(now: Balls) -> Caption:
    d, hits, share = now.dimensions[-1], now.hits[-1], now.shares[-1]
    text = (
        f"{d} dimensions: {now.throws:,} throws, {counted(hits, 'hit')}; the ball fills"
        f" {_share(share)} of its cube"
    )
    if hits == 0:
        return Caption(f"{text}. The estimate is 0, and its interval too.")
    return Caption(
        f"{text}. The volume is known to ±{percent(SURE * np.sqrt((1 - hits / now.throws) / hits))}"
        " (95 %)."
    )


def _share(share: float) -> str:
    return percent(share) if share >= 1e-4 else f"one part in {brief(1 / share)}"


def _finer(state: State) -> Caption:
    study = sure(state.study)
    if state.params.shape == "lantern":
        straight, square, cube = (values[-1] for values in study.errors.values())
        return Caption(
            f"{study.faces[-1]:.0f} sectors, all vertices on the cylinder: with as many rings"
            f" {fixed(straight, 2)} times its area, with sectors² rings {fixed(square, 2)} times,"
            f" with sectors³ rings {fixed(cube, 1)} times."
        )
    (first_area, area), (first_volume, volume) = (
        values[[-2, -1]] for values in study.errors.values()
    )
    return Caption(
        f"{study.faces[-1]:,.0f} faces: the area is {percent(area)} too small, the volume"
        f" {percent(volume)}. Edges half as long divide the errors by {fixed(first_area / area, 1)}"
        f" and {fixed(first_volume / volume, 1)}.",
    )


def _capital(name: str) -> str:
    return name if "." in name else f"{name[0].upper()}{name[1:]}"
