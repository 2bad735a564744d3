"""What stands beside the picture: error for bytes, errors by step, tables, and how searches
grow.
"""

import numpy as np

from lessons.representations.captions import field_error, form_of, size
from lessons.representations.state import Built, Cells, Fitted, Growth, Joined, Searched, State
from workbench.algorithms.spatial.octree import Level
from workbench.certain import sure
from workbench.numerals import angle, length, percent
from workbench.scene import Chart, Primitive, Role, Table

FLOOR = 1e-6  # mm: what lies below is rounding
MEMORY = Chart("Error for its bytes", "log₁₀ bytes", "log₁₀ error (mm)")
ERROR = Chart("Error of the surface", unit="mm")
AREA = Chart("Area over the true area", unit="times")
LOSS = Chart("Loss")
PIECES = Chart("Pieces of the graph", unit="pieces")
CELLS = Chart("Cells of the octree", "level", "log₁₀ cells")
LOOKED = Chart("Points looked at, 3 dimensions", "log₁₀ points", "points looked at")
SHARE = Chart("Share looked at, of 4,000 points", "dimensions", "%")
FIELD = Chart("Along x through the middle", "x (m)", "m")
ROLES: dict[str, Role] = {
    "cloud": "correspondence",
    "mesh": "target",
    "voxels": "neutral",
    "distances": "other",
    "patches": "highlight",
}


def beside(state: State) -> dict[str, Primitive]:
    """Return the charts and tables of a step."""
    form, surface = state.now, state.surface
    if state.growth is not None:
        return _growth(state.growth)
    if isinstance(form, Built | Searched):
        return _search(form)
    scene: dict[str, Primitive] = _memory(state)
    if surface is not None:
        scene["mean error"] = ERROR.scalar(_mm(surface.mean), "on average", log=True)
        scene["worst error"] = ERROR.scalar(_mm(surface.worst), "at worst", "wrong", log=True)
        if np.isfinite(surface.area):
            scene["area"] = AREA.scalar(surface.area, _NAMED.get(state.params.form, "surface"))
            scene["true area"] = AREA.scalar(1.0, "truth", "truth")
            scene["surface table"] = _table(state)
    if isinstance(form, Joined) and form.k:
        scene["mean error"] = ERROR.scalar(_mm(form.mean), "middles of edges", log=True)
        scene["worst error"] = ERROR.scalar(_mm(form.worst), "at worst", "wrong", log=True)
        scene["pieces"] = PIECES.scalar(form.pieces, "joined")
    if isinstance(form, Cells) and np.isfinite(form.walls) and state.subject is not None:
        scene["walls"] = AREA.scalar(form.walls / state.subject.area, "walls of cells", "wrong")
    if isinstance(form, Cells) and field_error(state) is not None:
        scene |= _field(state)
    if isinstance(form, Level):
        scene |= _levels(state, form)
    if isinstance(form, Fitted):
        scene["loss"] = LOSS.scalar(max(form.trained.loss, FLOOR), "of the batches", log=True)
    return scene


_NAMED = {
    "voxels": "marching cubes",
    "distances": "marching cubes",
    "octree": "marching cubes",
    "neural": "zero level",
}


def _mm(metres: float) -> float:
    return max(1e3 * metres, FLOOR) if np.isfinite(metres) else float("nan")


def _memory(state: State) -> dict[str, Primitive]:
    scene: dict[str, Primitive] = {}
    for name, (sizes, errors) in state.others.items():
        curve = MEMORY.curve if len(sizes) > 1 else MEMORY.dots
        scene[f"memory/{name}"] = curve(np.log10(sizes), _log(errors), name, ROLES[name])
    if state.sizes:
        x = np.log10(np.array(state.sizes, float))
        y = _log(np.array(state.errors))
        dots = len(x) == 1 or state.params.form == "neural"
        scene["memory/now"] = (MEMORY.dots if dots else MEMORY.curve)(
            x, y, form_of(state.params), "source"
        )
    return scene


def _log(errors: np.ndarray) -> np.ndarray:
    return np.log10(np.maximum(1e3 * errors, FLOOR))


def _table(state: State) -> Table:
    surface = sure(state.surface)
    rows = [
        ("bytes", size(state.bytes)),
        ("error, mean", length(surface.mean, 2) if len(surface.p) else "no surface"),
        ("error, worst", length(surface.worst, 2) if len(surface.p) else "no surface"),
        ("area over the true one", percent(surface.area, 1)),
    ]
    if np.isfinite(surface.volume):
        rows.append(("volume over the true one", percent(surface.volume, 1)))
    if np.isfinite(surface.tilt):
        rows.append(("normals off by", angle(surface.tilt, 2)))
    return Table("What comes back", ("", ""), tuple(rows))


def _field(state: State) -> dict[str, Primitive]:
    subject = sure(state.subject)
    x = np.linspace(-1, 1, 81)
    q = np.stack([x, 0 * x, 0 * x], axis=1)
    return {
        "stored": FIELD.curve(x, subject.field(q), "smaller of both", "source"),
        "true": FIELD.curve(x, subject.distance(q), "true distance", "truth"),
    }


def _levels(state: State, level: Level) -> dict[str, Primitive]:
    depth = np.arange(0.0, level.depth + 1)
    mixed = np.array([*state.mixed, float(level.mixed.sum())])
    return {
        "all cells": CELLS.curve(depth, depth * np.log10(8.0), "a dense grid", "neutral"),
        "mixed cells": CELLS.curve(
            depth, np.log10(np.maximum(mixed, 1.0)), "mixed, cut again", "source"
        ),
    }


def _search(form: Built | Searched) -> dict[str, Primitive]:
    if isinstance(form, Built) or form.visits[-1].looked == 0:
        return {}
    visits = form.visits
    n = len(form.tree.p)
    chart = Chart("The search", "cells looked into", "% of the points")
    x = np.arange(1.0, len(visits) + 1)
    looked = 100 * np.array([visit.looked for visit in visits]) / n
    return {
        "share looked at": chart.curve(x, looked, "looked at", "source"),
        "share of all": chart.curve(x, 0 * x + 100, "all", "neutral"),
    }


def _growth(growth: Growth) -> dict[str, Primitive]:
    x = np.log10(growth.counts)
    return {
        "looked by count": LOOKED.curve(x, growth.looked, "by a k-d tree", "source"),
        "looked by dimension": SHARE.curve(
            growth.dimensions.astype(float), 100 * growth.shares, "looked at", "source"
        ),
        "all by dimension": SHARE.curve(
            growth.dimensions.astype(float), 0 * growth.shares + 100, "all", "neutral"
        ),
    }
