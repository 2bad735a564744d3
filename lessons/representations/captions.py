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
    form, surface = state.now, state.surface
    if state.growth is not None:
        return _growth(state.growth)
    if state.others:
        return _others(state)
    if isinstance(form, Cloud):
        surface = "The surface is" if state.params.cloud is None else "The points of the file are"
        return Caption(
            f"{len(form.p):,} points, {size(state.bytes)}. {surface} {length(form.mean, 2)} from"
            f" the nearest of them on average, {length(form.worst, 2)} in the largest hole. What"
            " lies between points, nobody knows."
        )
    if isinstance(form, Joined):
        return _joined(state, form)
    if isinstance(form, Cells):
        return _cells(state, form) if surface is None else Caption(_came_back(state, surface))
    if isinstance(form, Level):
        return _level(form)
    if isinstance(form, Built):
        return _built(form)
    if isinstance(form, Searched):
        return _searched(form)
    if isinstance(form, Patches):
        return _patches(state, form)
    if isinstance(form, Fitted):
        return _fitted(state, form)
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


def _joined(state: State, joined: Joined) -> Caption:
    if not joined.k:
        return Caption(
            f"{counted(len(joined.p), 'point')}, {size(state.bytes)}. They do not say who is whose"
            " neighbour on the surface."
        )
    whom = "its nearest one" if joined.k == 1 else f"its {joined.k} nearest"
    off = "off the surface" if state.params.cloud is None else "from the nearest point of the file"
    return Caption(
        f"Each point joined to {whom}: {counted(len(joined.edges), 'edge')},"
        f" {counted(joined.pieces, 'piece')}, {size(state.bytes)}. Middles of edges are"
        f" {length(joined.mean, 2)} {off} on average, {length(joined.worst, 2)} at worst."
    )


def _cells(state: State, cells: Cells) -> Caption:
    n = cells.grid.shape[0]
    subject = sure(state.subject)
    if cells.values.dtype == bool:
        full = int(np.count_nonzero(cells.values))
        return Caption(
            f"{n} cells along each edge, one bit each: {size(state.bytes)}. {full:,} have their"
            f" middle inside: volume {more(full * cells.grid.cell_volume / subject.volume)}. The"
            f" walls around them have {fixed(cells.walls / subject.area, 2)} times the area."
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


def _level(level: Level) -> Caption:
    cells = len(level.cells)
    mixed = int(level.mixed.sum())
    text = f"Level {level.depth}, edges of {length(float(level.grid.spacing[0]), 2)}: {mixed:,} of"
    text += (
        f" {counted(cells, 'cell')} may be crossed by the surface, as far as their middle knows."
    )
    if level.depth:
        text += f" Packed {size(level.packed_bytes)}, with pointers {size(level.pointer_bytes)};"
        text += f" dense bits {size(level.dense_bytes)}."
    return Caption(text)


def _built(built: Built) -> Caption:
    tree = built.tree
    n, d = tree.p.shape
    if not built.depth:
        return Caption(
            f"{n:,} points with {d} coordinates, in no order. Which one is nearest to the purple"
            f" query? Without a tree all {n:,} have to be looked at."
        )
    cells = int(
        ((tree.depth == built.depth) | ((tree.axis < 0) & (tree.depth < built.depth))).sum()
    )
    most = int((tree.last - tree.first)[tree.depth == built.depth].max())
    return Caption(
        f"{counted(built.depth, 'cut')} deep: each cell is cut at the median of its longest side."
        f" {cells:,} cells with at most {counted(most, 'point')} each."
    )


def _searched(search: Searched) -> Caption:
    visit = search.visits[-1]
    n = len(search.tree.p)
    text = f"Cell {len(search.visits):,} of the search: {visit.looked:,} of {n:,} points looked at"
    text += f" ({percent(visit.looked / n)}), the nearest so far {length(visit.distance, 2)} away."
    if len(search.visits) == 1:
        text += " Straight down to the query's own cell; now back up."
    if visit.passed:
        text += (
            f" {counted(len(visit.passed), 'branch', 'branches')} passed over: no point of theirs"
            " can be nearer."
        )
    if search.done:
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


def _patches(state: State, patches: Patches) -> Caption:
    kind = "weighted " if state.params.rational else ""
    if state.surface is not None:
        text = (
            f"{counted(patches.count, 'patch', 'patches')} of 16: {_errors(state.surface)}."
            f" {len(patches.net)} {kind}control"
        )
        return Caption(f"{text} points{f', {size(state.bytes)}' if patches.count == 16 else ''}.")
    u, v = (brief(value, 2) for value in state.params.place)
    n = patches.control.shape[1]
    if not patches.levels:
        return Caption(
            f"{len(patches.net)} {kind}control points make 16 patches of {n} × {n},"
            f" {size(state.bytes)}. Those at a patch's corners lie on it, the others pull."
        )
    if patches.point is None:
        left = n - len(patches.levels)
        return Caption(
            f"De Casteljau along v in the first patch: every leg is divided at v = {v}. Of"
            f" {left + 1} points in each row {counted(left, 'point')}"
            f" {'is' if left == 1 else 'are'} left."
        )
    at = patches.levels[-1][0, :3] / patches.levels[-1][0, 3]
    gap = float(np.linalg.norm(patches.point - at))
    verdict = "agrees" if gap < ROUND_OFF else f"gives a point {length(gap, 2)} away"
    return Caption(
        f"The column of {n} is divided at u = {u} in the same way: the last point lies on the"
        f" patch. The sum of Bernstein polynomials {verdict}."
    )


def _fitted(state: State, fitted: Fitted) -> Caption:
    trained = fitted.trained
    surface = sure(state.surface)
    text = f"{counted(trained.iterations, 'iteration')}, loss {loss(trained.loss)}"
    if not len(surface.p):
        low, high = float(fitted.values.min()), float(fitted.values.max())
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
    subject = sure(state.subject)
    form = state.now
    surface = state.surface
    names = ", ".join(_NAMES[name] for name in state.others)
    if surface is not None and not len(surface.p):
        return Caption(
            f"{size(state.bytes)}, and no surface came back. Beside it in the chart: {names}.",
            "wrong",
        )
    error = form.mean if isinstance(form, Cloud | Joined) else state.errors[-1]
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
