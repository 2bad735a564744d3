"""What one step looks like: the true shape, what is stored of it, and the surface that comes
back.
"""

import functools

import numpy as np

from lessons.representations.captions import caption, subject_name
from lessons.representations.charts import beside
from lessons.representations.state import (
    Built,
    Cells,
    Cloud,
    Fitted,
    Joined,
    Patches,
    Searched,
    State,
    Subject,
)
from workbench.algorithms.spatial.kd_tree import Tree
from workbench.algorithms.spatial.octree import Level
from workbench.data.thinning import every
from workbench.geometry.fields.voxels import Grid, counted_surface
from workbench.geometry.motions import R_UPRIGHT, motion
from workbench.geometry.polylines import at_height, segments, sphere_rings
from workbench.scene import Field, Mesh, Picture, Points, Primitive, Scene, Segments

MOST_POINTS, MOST_BOXES, MOST_EDGES = 8000, 260, 12_000
ASIDE = np.array([0.0, 1.1, 0.85])  # m: a slice that is out of the way is behind and above
REACH = 0.5  # m: the end of the colour bar of distances
CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
RIMS = CUBE[[[a, b] for a in range(8) for b in range(a) if np.abs(CUBE[a] - CUBE[b]).sum() == 1]]


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    form, surface = state.now, state.surface
    scene: dict[str, Primitive] = {"caption": caption(state)}
    if state.subject is not None:
        scene["truth"] = _truth(state.subject)
    if isinstance(form, Cloud):
        scene |= _cloud(form)
    elif isinstance(form, Joined):
        scene |= _joined(form)
    elif isinstance(form, Cells | Fitted):
        scene |= _cells(state, form)
    elif isinstance(form, Level):
        scene |= _level(form)
    elif isinstance(form, Patches):
        scene |= _patches(form)
    elif isinstance(form, Built | Searched):
        scene |= _tree(form)
    if surface is not None and len(surface.faces) and not isinstance(form, Level):
        facets = not isinstance(form, Patches | Fitted)
        scene["surface"] = Mesh(
            surface.p, surface.faces, "source", flat=facets, name="what comes back"
        )
    return scene | beside(state)


@functools.lru_cache(maxsize=8)
def _truth(subject: Subject) -> Mesh | Points:
    if not len(subject.faces):
        p = subject.p[every(len(subject.p), MOST_POINTS)]
        return Points(p, "truth", 0.006, opacity=0.3, name=subject_name(subject))
    return Mesh(subject.p, subject.faces, "truth", opacity=0.18, name=subject_name(subject))


def _cloud(cloud: Cloud) -> dict[str, Primitive]:
    p = cloud.p[every(len(cloud.p), MOST_POINTS)]
    return {
        "points": Points(
            p, "source", float(np.clip(0.5 / np.sqrt(len(p)), 0.006, 0.025)), name="points"
        ),
        "hole": Segments(
            sphere_rings(cloud.hole, cloud.worst), "wrong", 2, name="the largest hole"
        ),
    }


def _joined(joined: Joined) -> dict[str, Primitive]:
    scene: dict[str, Primitive] = {
        "points": Points(
            joined.p[every(len(joined.p), MOST_POINTS)], "source", 0.008, name="points"
        )
    }
    if joined.k:
        shown = joined.edges[every(len(joined.edges), MOST_EDGES)]
        scene["edges"] = Segments(joined.p[shown], "correspondence", 1, name="edges to the nearest")
        scene["bridge"] = Segments(
            joined.p[joined.edges[[joined.bridge]]],
            "wrong",
            4,
            name="the edge that is farthest off",
        )
    return scene


def _cells(state: State, form: Cells | Fitted) -> dict[str, Primitive]:
    if form.values.dtype == bool:
        if state.surface is not None or not form.values.any():
            return {}
        return {
            "cells": Mesh(
                *counted_surface(form.values, form.grid), "source", flat=True, name="full cells"
            )
        }
    return {"slice": _slice(form.values, form.grid, aside=state.surface is not None)}


def _slice(values: np.ndarray, grid: Grid, *, aside: bool) -> Picture:
    """Return the distances in the layer of cells behind y = 0, as an upright picture there, or out
    of the way.
    """
    layer = grid.shape[1] // 2
    shown = Field(
        values[:, layer, ::-1].T.astype(float), -REACH, REACH, "Stored distance", "m", "diverging"
    )
    place = ASIDE if aside else np.array([0.0, grid.low[1] + grid.spacing[1] * (layer + 0.5), 0.0])
    width = float(grid.spacing[0] * grid.shape[0])
    return Picture(shown, "Slice through the middle", width, motion(R_UPRIGHT, place))


def _level(level: Level) -> dict[str, Primitive]:
    mixed = level.cells[level.mixed]
    h = float(level.grid.spacing[0])
    scene: dict[str, Primitive] = {
        "cube": Segments(2.0 * RIMS - 1.0, "neutral", 2, name="the whole cube")
    }
    if level.depth < 5:
        edges = level.grid.low + h * (mixed[:, None, None] + RIMS)
        scene["cells"] = Segments(edges.reshape(-1, 2, 3), "source", 1.5, name="mixed cells")
    else:
        mixed = mixed[every(len(mixed), MOST_POINTS)]
        scene["middles"] = Points(
            level.grid.low + h * (mixed + 0.5), "source", 0.4 * h, name="middles of mixed cells"
        )
    return scene


def _patches(patches: Patches) -> dict[str, Primitive]:
    dividing = bool(patches.levels) and not patches.count
    shown = (patches.control[..., :3] / patches.control[..., 3:])[: 1 if dividing else None]
    rows = np.concatenate(
        [segments(line) for net in shown for line in (*net, *net.transpose(1, 0, 2))]
    )
    scene: dict[str, Primitive] = {
        "net": Points(
            shown.reshape(-1, 3) if dividing else patches.net[:, :3],
            "target",
            0.016,
            name="control points",
        ),
        "legs": Segments(rows, "correspondence", 1, opacity=0.6, name="control net"),
    }
    for k, level in enumerate(patches.levels if dividing else ()):
        p = (level[..., :3] / level[..., 3:]).reshape(*level.shape[:-1], 3)
        lines = [segments(line) for line in (p if p.ndim == 3 else p[None])]
        scene[f"divided/{k}"] = Points(p.reshape(-1, 3), "source", 0.018, name="divided")
        if p.shape[-2] > 1:
            scene[f"lines/{k}"] = Segments(np.concatenate(lines), "source", 2, name="divided again")
    if patches.point is not None and dividing:
        scene["point"] = Points(
            patches.point[None], "highlight", 0.035, name="the point on the patch"
        )
    return scene


def _tree(form: Built | Searched) -> dict[str, Primitive]:
    tree = form.tree
    scene: dict[str, Primitive] = {}
    p = _three(tree.p)
    if isinstance(form, Built):
        depth = min(form.depth, 6)
        cells = np.flatnonzero((tree.depth == depth) | ((tree.axis < 0) & (tree.depth < depth)))
        scene["points"] = Points(p[every(len(p), MOST_POINTS)], "target", 0.012, name="points")
        scene["cells"] = Segments(
            _boxes(tree, cells[every(len(cells), MOST_BOXES)]), "neutral", 1, name="cells"
        )
        return scene
    visit = form.visits[-1]
    seen = np.zeros(len(p), dtype=bool)
    looked_into = np.array([step.cell for step in form.visits])
    for cell in looked_into:
        seen[tree.first[cell] : tree.last[cell]] = True
    query = _three(form.query[None])
    rest = p[~seen]
    if len(rest):
        scene["points"] = Points(
            rest[every(len(rest), MOST_POINTS)], "target", 0.01, opacity=0.35, name="not looked at"
        )
    scene["looked"] = Points(
        p[seen][every(int(seen.sum()), MOST_POINTS)], "source", 0.016, name="looked at"
    )
    boxes = _boxes(tree, looked_into[-MOST_BOXES:])
    scene["cells"] = Segments(boxes, "source", 2, name="cells looked into")
    scene["query"] = Points(query, "highlight", 0.03, name="query")
    scene["nearest"] = Points(
        p[[visit.nearest]], "truth" if form.done else "source", 0.03, name="nearest so far"
    )
    if tree.p.shape[1] <= 3:
        scene["ball"] = Segments(
            sphere_rings(query[0], visit.distance), "highlight", 1.5, name="nothing nearer outside"
        )
    return scene


def _three(p: np.ndarray) -> np.ndarray:
    """Return the first three coordinates; 0 where there is no third."""
    return at_height(p[:, :3])


def _boxes(tree: Tree, cells: np.ndarray) -> np.ndarray:
    low, high = _three(tree.low[cells]), _three(tree.high[cells])
    return (low[:, None, None] + RIMS * (high - low)[:, None, None]).reshape(-1, 2, 3)
