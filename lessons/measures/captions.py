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
    result = state.now
    if isinstance(result, Sums):
        return _faces(state, result)
    if isinstance(result, Cells):
        return _cells(state, result)
    if isinstance(result, Throws):
        return _throws(state, result)
    if isinstance(result, Lines):
        return _lines(state, result)
    return _samples(state, result) if isinstance(result, Sampled) else _balls(result)


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
    if abs(error) >= 1e-4:
        sign = "+" if error > 0 else ""
        return f"{sign}{percent(error)}"
    return "off by less than 0.01 %"


def _interval(value: float, error: float) -> str:
    """Write an estimate and how far its interval reaches to either side."""
    return f"{_number(value)} ± {brief(SURE * error, 2)}"


def _number(value: float) -> str:
    return fixed_or_power(value, 0) if abs(value) >= 1e6 else brief(value, 4)


def _faces(state: State, sums: Sums) -> Caption:
    subject = state.subject
    if not np.isfinite(subject.volume) and sums.count < len(subject.faces):
        return _area_alone(subject, sums)
    if sums.count == 0:
        gone = len(subject.whole) - len(subject.faces)
        hole = f" {counted(gone, 'triangle')} cut out." if gone else ""
        return Caption(
            f"{_capital(subject.name)}: {len(subject.p):,} vertices, {len(subject.faces):,}"
            f" triangles.{hole}{subject.note} Each triangle makes a tetrahedron with the origin,"
            " the purple dot."
        )
    if sums.count == len(subject.faces):
        return _all_faces(state, sums)
    if sums.count == 1:
        k = sums.order[0]
        part = float(sums.parts[k])
        side = (
            "minus, for the origin is in front of it"
            if part < 0
            else "plus, for the origin is behind it"
        )
        return Caption(
            "The triangle nearest to the origin: half the length of (b − a) × (c − a) is its area,"
            f" {area(subject, float(sums.areas[k]))}; a · (b × c) / 6 is its tetrahedron,"
            f" {volume(subject, part)}: {side}."
        )
    new = sums.order[sums.count - sums.new : sums.count]
    minus = int(np.count_nonzero(sums.parts[new] < 0))
    return Caption(
        f"{sums.count:,} of {len(subject.faces):,} triangles, near ones first:"
        f" {volume(subject, sums.volume)} so far. New ones that count plus: {sums.new - minus:,};"
        f" that count minus: {minus:,}."
    )


def _area_alone(subject: Subject, sums: Sums) -> Caption:
    if sums.count == 0:
        return Caption(
            f"{_capital(subject.name)}: {len(subject.p):,} vertices, {len(subject.faces):,}"
            f" triangles.{subject.note} Its area is added up, triangle by triangle."
        )
    return Caption(
        f"{sums.count:,} of {len(subject.faces):,} triangles, near ones first: area"
        f" {area(subject, sums.area)} so far."
    )


def _all_faces(state: State, sums: Sums) -> Caption:
    subject = state.subject
    text = (
        f"All {len(subject.faces):,} triangles: area {area(subject, sums.area)}"
        f" ({off(state.area_error)})"
    )
    if not np.isfinite(subject.volume):
        return Caption(f"{text}. It encloses nothing, so no volume is its own.")
    text += (
        f", volume {volume(subject, sums.volume)} ({off(state.volume_error)}). {_origin(subject)}"
    )
    return Caption(text, "good" if right(state) else "wrong")


def right(state: State) -> bool:
    """Tell whether all faces were added up, and their volume is that of the mesh or, but for its
    facets, of its shape.
    """
    result = state.now
    if not isinstance(result, Sums) or not encloses(state.subject.faces):
        return False
    if state.params.subdivisions < 1:
        most = 0.75
    elif state.params.subdivisions < 2:
        most = 0.4
    else:
        most = 0.15
    return -(most if state.subject.smooth else EXACT) < state.volume_error < 1e-6


def _origin(subject: Subject) -> str:
    if encloses(subject.faces):
        return "Every edge has its partner: any other origin gives the same."
    return "Edges lack a partner: another origin gives another volume."


def _cells(state: State, cells: Cells) -> Caption:
    subject = state.subject
    n = cells.across[-1]
    full = int(np.count_nonzero(cells.bits))
    whole = (
        "the true area"
        if state.params.voxels is None
        else "the area by marching through all voxels"
    )
    text = (
        f"{n} cells across, {full:,} full: volume {volume(subject, cells.volumes[-1])}"
        f" ({off(state.volume_error)})."
    )
    text += f" The walls between full and empty: {area(subject, cells.areas[-1])}"
    text += f", {fixed(cells.areas[-1] / subject.area, 2)} times {whole}"
    if np.isfinite(cells.marched[-1]):
        text += f"; marching cubes: {fixed(cells.marched[-1] / subject.area, 2)} times"
    return Caption(f"{text}.{subject.note if len(cells.across) == 1 else ''}")


def _throws(state: State, throws: Throws) -> Caption:
    subject = state.subject
    n = throws.estimates.counts[-1]
    value, error = throws.estimates.values[-1], throws.estimates.errors[-1]
    text = f"{n:,} throws, {throws.hits:,} hits: {_interval(value, error)} {subject.unit}³"
    text += f"; truth {volume(subject, subject.volume)}, {off(state.volume_error)}."
    if throws.hits in (0, n):
        return Caption(
            f"{text} Without a {'hit' if throws.hits == 0 else 'miss'} the interval is empty: it"
            " knows nothing."
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
    return Caption(text + _peeked(state, len(throws.estimates.counts)))


def _peeked(state: State, looks: int) -> str:
    if state.peeked is None:
        return ""
    here, ever = state.peeked
    return (
        f" Of {RUNS:,} such runs {percent(here, 0)} miss it at this step, and {percent(ever, 0)}"
        f" missed it at one or more of the {looks} looks."
    )


def _lines(state: State, lines: Lines) -> Caption:
    subject = state.subject
    n = lines.estimates.counts[-1]
    value, error = lines.estimates.values[-1], lines.estimates.errors[-1]
    return Caption(
        f"{n:,} lines through the ball around it cross the surface {lines.total:,} times,"
        f" {fixed(lines.total / n, 2)} each; times 2πR² that is {_interval(value, error)}"
        f" {subject.unit}²; truth {area(subject, subject.area)}, {off(state.area_error)}."
    )


def _samples(state: State, sampled: Sampled) -> Caption:
    if state.in_triangle:
        shares = ", ".join(percent(share, 0) for share in state.quarters[:3])
        return Caption(
            f"{len(sampled.q):,} points in one triangle. Its four quarters are of one size; the"
            f" corners got {shares}, the middle {percent(state.quarters[3], 0)}."
        )
    subject = state.subject
    gap = float(np.linalg.norm(sampled.mean - state.middle)) / subject.diagonal
    return Caption(
        f"{len(sampled.q):,} points on {subject.name}: {percent(state.half_hits, 0)} of them on the"
        f" half whose faces were cut in four, which has {percent(state.half_share, 0)} of the area."
        f" Their mean is {percent(gap)} of the diagonal away from the surface's middle."
    )


def _balls(balls: Balls) -> Caption:
    d, hits, share = balls.dimensions[-1], balls.hits[-1], balls.shares[-1]
    text = (
        f"{d} dimensions: {balls.throws:,} throws, {counted(hits, 'hit')}; the ball fills"
        f" {_share(share)} of its cube"
    )
    if hits == 0:
        return Caption(f"{text}. The estimate is 0, and its interval too.")
    return Caption(
        f"{text}. The volume is known to"
        f" ±{percent(SURE * np.sqrt((1 - hits / balls.throws) / hits))} (95 %)."
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
