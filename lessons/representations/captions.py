"""What a step of storing a shape says, with its numbers."""

import numpy as np

from lessons.representations.state import (
    Built,
    Cells,
    Cloud,
    Fitted,
    Growth,
    Joined,
    Params,
    Patches,
    Searched,
    State,
    Subject,
    Surface,
)
from workbench.algorithms.spatial.octree import Level
from workbench.certain import sure
from workbench.numerals import angle, brief, counted, fixed, length, percent
from workbench.scene import Caption

ROUND_OFF = 1e-9  # m: what rounding leaves of a distance
MOSTLY = 0.6  # of the area: where less came back, parts are missing, and not their edges alone


def caption(state: State) -> Caption:
    """Return the caption of a step."""
    now, surface = state.now, state.surface
    if state.growth is not None:
        return _growth(state.growth)
    if state.others:
        return _others(state)
    if isinstance(now, Cloud):
        surface = "The surface is" if state.params.cloud is None else "The points of the file are"
        return Caption(
            f"{len(now.p):,} points, {size(state.bytes)}. {surface} {length(now.mean, 2)} from the"
            f" nearest of them on average, {length(now.worst, 2)} in the largest hole. What lies"
            " between points, nobody knows."
        )
    if isinstance(now, Joined):
        return _joined(state, now)
    if isinstance(now, Cells):
        return _cells(state, now) if surface is None else Caption(_came_back(state, surface))
    if isinstance(now, Level):
        return _level(now)
    if isinstance(now, Built):
        return _built(now)
    if isinstance(now, Searched):
        return _searched(now)
    if isinstance(now, Patches):
        return _patches(state, now)
    if isinstance(now, Fitted):
        return _fitted(state, now)
    assert surface is not None
    text = f"{len(surface.p):,} vertices and {len(surface.faces):,} triangles, {size(state.bytes)}"
    return Caption(f"{text}: {_errors(surface)}{_sizes(surface)}")


def size(count: float) -> str:
    """Write a number of bytes."""
    for unit, many in (("MB", 1e6), ("kB", 1e3)):
        if count >= many:
            return f"{brief(count / many, 2)} {unit}"
    return f"{count:.0f} B"


def lost(state: State) -> bool:
    """Tell whether a part of the surface did not come back at all."""
    return (
        state.surface is not None
        and np.isfinite(state.surface.area)
        and state.surface.area < MOSTLY
    )


def _errors(surface: Surface) -> str:
    if surface.worst < ROUND_OFF:
        return "nothing but rounding is off"
    return f"{length(surface.mean, 2)} off on average, {length(surface.worst, 2)} at worst"


def more(share: float) -> str:
    """Write a share as how much more or less than all it is."""
    if abs(share - 1) < 1e-4:
        return "the same"
    return f"{percent(share - 1)} {'more' if share > 1 else 'less'}".replace("−", "")


def _sizes(surface: Surface) -> str:
    text = f". Area: {more(surface.area)}"
    if np.isfinite(surface.volume):
        text += f"; volume: {more(surface.volume)}"
    return (
        f"{text}; normals {angle(surface.tilt, 2)} off."
        if np.isfinite(surface.tilt)
        else f"{text}."
    )


def _joined(state: State, now: Joined) -> Caption:
    if not now.k:
        return Caption(
            f"{counted(len(now.p), 'point')}, {size(state.bytes)}. They do not say who is whose"
            " neighbour on the surface."
        )
    whom = "its nearest one" if now.k == 1 else f"its {now.k} nearest"
    off = "off the surface" if state.params.cloud is None else "from the nearest point of the file"
    return Caption(
        f"Each point joined to {whom}: {counted(len(now.edges), 'edge')},"
        f" {counted(now.pieces, 'piece')}, {size(state.bytes)}. Middles of edges are"
        f" {length(now.mean, 2)} {off} on average, {length(now.worst, 2)} at worst."
    )


def _cells(state: State, now: Cells) -> Caption:
    n, subject = now.grid.shape[0], sure(state.subject)
    if now.values.dtype == bool:
        full = int(np.count_nonzero(now.values))
        return Caption(
            f"{n} cells along each edge, one bit each: {size(state.bytes)}. {full:,} have their"
            f" middle inside: volume {more(full * now.grid.cell_volume / subject.volume)}. The"
            f" walls around them have {fixed(now.walls / subject.area, 2)} times the area."
        )
    text = (
        f"{n} cells along each edge, a distance in each: {size(state.bytes)}. The picture is a"
        " slice, blue inside."
    )
    off = field_error(state)
    if off is not None:
        text += (
            f" The smaller of both distances: in the middle {length(off[0], 2)} where"
            f" {length(off[1], 2)} is true."
        )
    return Caption(text)


def field_error(state: State) -> tuple[float, float] | None:
    """Return what is stored in the middle and what is true, m, where the two are not one."""
    subject = state.subject
    if subject is None or state.params.mesh is not None or state.params.shape != "two boxes":
        return None
    middle = np.zeros((1, 3))
    return float(subject.field(middle)[0]), float(subject.distance(middle)[0])


def _came_back(state: State, surface: Surface) -> str:
    if not len(surface.p):
        return f"{size(state.bytes)}, and no surface comes back: all cells are on one side."
    bits = isinstance(state.now, Cells) and state.now.values.dtype == bool
    how = (
        "half-way between full and empty middles"
        if bits
        else "where the line between two distances is zero"
    )
    return f"Marching cubes, {len(surface.p):,} vertices {how}: {_errors(surface)}{_sizes(surface)}"


def _level(now: Level) -> Caption:
    cells, mixed = len(now.cells), int(now.mixed.sum())
    text = f"Level {now.depth}, edges of {length(float(now.grid.spacing[0]), 2)}: {mixed:,} of"
    text += (
        f" {counted(cells, 'cell')} may be crossed by the surface, as far as their middle knows."
    )
    if now.depth:
        text += f" Packed {size(now.packed_bytes)}, with pointers {size(now.pointer_bytes)};"
        text += f" dense bits {size(now.dense_bytes)}."
    return Caption(text)


def _built(now: Built) -> Caption:
    tree = now.tree
    n, d = tree.p.shape
    if not now.depth:
        return Caption(
            f"{n:,} points with {d} coordinates, in no order. Which one is nearest to the purple"
            f" query? Without a tree all {n:,} have to be looked at."
        )
    cells = int(((tree.depth == now.depth) | ((tree.axis < 0) & (tree.depth < now.depth))).sum())
    most = int((tree.last - tree.first)[tree.depth == now.depth].max())
    return Caption(
        f"{counted(now.depth, 'cut')} deep: each cell is cut at the median of its longest side."
        f" {cells:,} cells with at most {counted(most, 'point')} each."
    )


def _searched(now: Searched) -> Caption:
    visit, n = now.visits[-1], len(now.tree.p)
    text = f"Cell {len(now.visits):,} of the search: {visit.looked:,} of {n:,} points looked at"
    text += f" ({percent(visit.looked / n)}), the nearest so far {length(visit.distance, 2)} away."
    if len(now.visits) == 1:
        text += " Straight down to the query's own cell; now back up."
    if visit.passed:
        text += (
            f" {counted(len(visit.passed), 'branch', 'branches')} passed over: no point of theirs"
            " can be nearer."
        )
    if now.done:
        text += " Nothing is left to look at."
    return Caption(text)


def _growth(growth: Growth) -> Caption:
    first, last = growth.counts[[1, -1]]
    at = dict(zip(growth.dimensions.tolist(), growth.shares, strict=True))
    return Caption(
        f"In 3 dimensions a search looks at {growth.looked[1]:.0f} of {first:,} points on average,"
        f" and at {growth.looked[-1]:.0f} of {last:,}. Of 4,000 points: {percent(at[3])} in 3"
        f" dimensions, {percent(at[10])} in 10, {percent(at[20])} in 20."
    )


def _patches(state: State, now: Patches) -> Caption:
    kind = "weighted " if state.params.rational else ""
    if state.surface is not None:
        text = (
            f"{counted(now.count, 'patch', 'patches')} of 16: {_errors(state.surface)}."
            f" {len(now.net)} {kind}control"
        )
        return Caption(f"{text} points{f', {size(state.bytes)}' if now.count == 16 else ''}.")
    u, v = (brief(value, 2) for value in state.params.place)
    n = now.control.shape[1]
    if not now.levels:
        return Caption(
            f"{len(now.net)} {kind}control points make 16 patches of {n} × {n},"
            f" {size(state.bytes)}. Those at a patch's corners lie on it, the others pull."
        )
    if now.point is None:
        left = n - len(now.levels)
        return Caption(
            f"De Casteljau along v in the first patch: every leg is divided at v = {v}. Of"
            f" {left + 1} points in each row {counted(left, 'point')}"
            f" {'is' if left == 1 else 'are'} left."
        )
    at = now.levels[-1][0, :3] / now.levels[-1][0, 3]
    gap = float(np.linalg.norm(now.point - at))
    said = "agrees" if gap < ROUND_OFF else f"gives a point {length(gap, 2)} away"
    return Caption(
        f"The column of {n} is divided at u = {u} in the same way: the last point lies on the"
        f" patch. The sum of Bernstein polynomials {said}."
    )


def _fitted(state: State, now: Fitted) -> Caption:
    trained, surface = now.trained, sure(state.surface)
    text = f"{counted(trained.iterations, 'iteration')}, loss {loss(trained.loss)}"
    if not len(surface.p):
        low, high = float(now.values.min()), float(now.values.max())
        return Caption(
            f"{text}. No surface: the field is nowhere zero, from {brief(low, 2)} to"
            f" {brief(high, 2)}.",
        )
    return Caption(
        f"{text}; {size(state.bytes)}. Where the field is zero: {_errors(surface)}{_sizes(surface)}"
    )


def loss(value: float) -> str:
    """Write a loss, which may be small."""
    return brief(value, 2) if value >= 1e-5 else "below 0.00001"


def _others(state: State) -> Caption:
    subject, now, surface = sure(state.subject), state.now, state.surface
    names = ", ".join(_NAMES[name] for name in state.others)
    if surface is not None and not len(surface.p):
        return Caption(
            f"{size(state.bytes)}, and no surface came back. Beside it in the chart: {names}.",
            "wrong",
        )
    error = now.mean if isinstance(now, Cloud | Joined) else state.errors[-1]
    off = (
        "off by nothing but rounding" if error < ROUND_OFF else f"{length(error, 2)} off on average"
    )
    text = f"{capital(subject.name)} in {size(state.bytes)}, {off}"
    if lost(state) and surface is not None:
        return Caption(
            f"{text} where there is a surface: only {percent(surface.area)} of the area came back."
            f" Beside it in the chart: {names}.",
            "wrong",
        )
    return Caption(f"{text}. Beside it in the chart: {names}.")


_NAMES = {
    "cloud": "clouds",
    "mesh": "meshes",
    "voxels": "voxels",
    "distances": "grids of distances",
    "patches": "patches",
}


def capital(name: str) -> str:
    """Return a name as a sentence begins; file names as they are."""
    return name if "." in name else f"{name[0].upper()}{name[1:]}"


def form_of(params: Params) -> str:
    """Return what the form is called in the chart."""
    return {"octree": "octree, packed", "neural": "network"}.get(params.form, params.form)


def subject_name(subject: Subject | None) -> str:
    """Return what the legend calls the true shape."""
    return "" if subject is None else f"{subject.name}, as it is"
