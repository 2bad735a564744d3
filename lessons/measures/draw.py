"""What one step looks like: the shape, what was counted of it so far, and the charts of its
errors.
"""

import functools

import numpy as np

from lessons.measures.captions import caption
from lessons.measures.charts import beside
from lessons.measures.samples import TRIANGLE, at_corners
from lessons.measures.state import State, Subject
from workbench.algorithms.surfaces.measures import Cells, Sums
from workbench.algorithms.surfaces.monte_carlo import Balls, Lines, Sampled, Throws
from workbench.data.thinning import every
from workbench.geometry.fields.voxels import counted_surface
from workbench.geometry.meshes import boundary_edges, edges
from workbench.geometry.polylines import between
from workbench.scene import Classes, Label, Mesh, Points, Primitive, Scene, Segments

MOST_RAYS, MOST_EDGES, MOST_POINTS, MOST_LINES, MOST_SHOWN = 120, 4500, 6000, 120, 96
CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
RIMS = CUBE[[[a, b] for a in range(8) for b in range(a) if np.abs(CUBE[a] - CUBE[b]).sum() == 1]]


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    result = state.now
    scene: dict[str, Primitive] = {"caption": caption(state)}
    if isinstance(result, Sums):
        scene |= _faces(state, result)
    elif isinstance(result, Cells):
        scene |= _cells(state, result)
    elif isinstance(result, Throws):
        scene |= _throws(state, result)
    elif isinstance(result, Lines):
        scene |= _lines(state, result)
    elif isinstance(result, Sampled):
        scene |= _triangle(result) if state.in_triangle else _samples(state, result)
    else:
        scene |= _ball(result)
    return scene | beside(state)


@functools.lru_cache(maxsize=4)
def _apart(subject: Subject) -> tuple[np.ndarray, np.ndarray]:
    """Return the faces with corners of their own, so that each can have its colour."""
    corners = subject.scale * subject.p[subject.faces].reshape(-1, 3)
    return corners, np.arange(len(corners)).reshape(-1, 3)


@functools.lru_cache(maxsize=4)
def _shown(subject: Subject) -> np.ndarray:
    return subject.scale * subject.p


def _faint(subject: Subject, opacity: float = 0.25) -> Mesh:
    return Mesh(_shown(subject), subject.faces, "target", opacity=opacity, name=subject.name)


def _faces(state: State, sums: Sums) -> dict[str, Primitive]:
    subject = state.subject
    origin = np.array(state.params.origin)
    p, faces = _apart(subject)
    added = np.zeros(len(faces), dtype=np.uint8)
    done = sums.order[: sums.count]
    added[done] = np.where(sums.parts[done] < 0, 2, 1)
    color = Classes(
        np.repeat(added, 3),
        ("neutral", "target", "wrong"),
        ("not yet", "counts plus", "counts minus"),
    )
    scene: dict[str, Primitive] = {
        "surface": Mesh(p, faces, color, flat=True, name=subject.name),
        "origin": Points(origin[None], "highlight", 0.04, name="origin"),
    }
    if len(_edges(subject)) <= MOST_EDGES:
        scene["edges"] = Segments(_edges(subject), "neutral", 1, opacity=0.5, name="edges")
    if len(subject.faces) < len(subject.whole):
        scene["border"] = Segments(_rim(subject), "highlight", 4, name="border of the hole")
    new = sums.order[sums.count - sums.new : sums.count]
    if len(new) and sums.count < len(faces):
        few = new[every(3 * len(new), MOST_RAYS)]
        corners = p.reshape(-1, 3, 3)[few].reshape(-1, 3)
        sign = Classes(
            np.repeat(added[few] == 2, 3).astype(np.uint8),
            ("target", "wrong"),
            ("counts plus", "counts minus"),
        )
        scene["tetrahedra"] = Segments(between(origin, corners), sign, 1.5, name="tetrahedra")
    return scene


@functools.lru_cache(maxsize=4)
def _edges(subject: Subject) -> np.ndarray:
    return _shown(subject)[edges(subject.faces)]


@functools.lru_cache(maxsize=4)
def _rim(subject: Subject) -> np.ndarray:
    """Return the edges of the whole mesh that have a face on one side only here."""
    return _shown(subject)[np.unique(np.sort(boundary_edges(subject.faces), axis=1), axis=0)]


def _cells(state: State, cells: Cells) -> dict[str, Primitive]:
    subject = state.subject
    bits, grid = cells.bits, cells.grid
    step = -(-max(bits.shape) // MOST_SHOWN)
    if step > 1:
        bits = bits[step // 2 :: step, step // 2 :: step, step // 2 :: step]
        grid = type(grid)(grid.low, step * grid.spacing, bits.shape)
    scene: dict[str, Primitive] = {"surface": _faint(subject, 0.3)}
    if bits.any():
        p, faces = counted_surface(bits, grid)
        scene["cells"] = Mesh(subject.scale * p, faces, "source", flat=True, name="full cells")
    return scene


def _throws(state: State, throws: Throws) -> dict[str, Primitive]:
    subject = state.subject
    low, high = subject.scale * subject.low, subject.scale * subject.high
    return {
        "surface": _faint(subject),
        "box": Segments(low + (high - low) * RIMS, "neutral", 2, name="box"),
        "throws": _thrown(subject.scale * throws.q, throws.inside),
    }


def _thrown(q: np.ndarray, inside: np.ndarray) -> Points:
    if len(q) < 300:
        radius = 0.03
    elif len(q) < 1200:
        radius = 0.02
    else:
        radius = 0.014
    return Points(
        q,
        Classes(inside.astype(np.uint8), ("correspondence", "source"), ("miss", "hit")),
        radius,
        name="throws",
    )


def _lines(state: State, lines: Lines) -> dict[str, Primitive]:
    subject = state.subject
    few = lines.ends[:MOST_LINES]
    met = subject.scale * lines.crossings
    scene: dict[str, Primitive] = {
        "surface": _faint(subject, 0.5),
        "lines": Segments(subject.scale * few, "correspondence", 1.5, name="the last lines"),
    }
    if len(met):
        scene["crossings"] = Points(met, "wrong", 0.018, name="crossings")
    return scene


def _triangle(sampled: Sampled) -> dict[str, Primitive]:
    a, b, c = TRIANGLE
    inner = np.array([a + b, b + c, c + a]) / 2
    corner = at_corners(sampled.q)
    which = np.where(corner.any(axis=1), corner.argmax(axis=1), 3).astype(np.uint8)
    color = Classes(
        which,
        ("source", "other", "highlight", "neutral"),
        ("at a", "at b", "at c", "in the middle"),
    )
    if len(sampled.q) < 300:
        radius = 0.035
    elif len(sampled.q) < 1000:
        radius = 0.02
    else:
        radius = 0.011
    back = np.array([0.0, 0.01, 0.0])
    middle = TRIANGLE.mean(axis=0)
    names = {
        f"corner {name}": Label(name, middle + 1.1 * (p - middle))
        for name, p in zip("abc", TRIANGLE, strict=True)
    }
    return names | {
        "surface": Mesh(
            TRIANGLE + back, np.array([[0, 1, 2]]), "target", opacity=0.25, name="one triangle"
        ),
        "quarters": Segments(
            np.stack([inner, np.roll(inner, 1, axis=0)], axis=1), "target", 2, name="its quarters"
        ),
        "points": Points(
            sampled.q,
            color,
            radius,
            name="points",
        ),
    }


def _samples(state: State, sampled: Sampled) -> dict[str, Primitive]:
    subject = state.subject
    q = sampled.q[-MOST_POINTS:]
    half = Classes(
        (subject.p[:, 0] > 0).astype(np.uint8),
        ("neutral", "other"),
        ("faces as they are", "faces cut in four"),
    )
    two = subject.scale * np.stack([sampled.mean, state.middle])
    return {
        "surface": Mesh(_shown(subject), subject.faces, half, opacity=0.3, name=subject.name),
        "points": Points(
            subject.scale * q, "source", 0.022 if len(q) < 1200 else 0.012, name="points"
        ),
        "mean": Points(two[:1], "wrong", 0.06, name="mean of the points"),
        "middle": Points(two[1:], "truth", 0.06, name="middle of the surface"),
        "miss": Segments(two[None], "wrong", 3, name="how far apart"),
    }


def _ball(balls: Balls) -> dict[str, Primitive]:
    return {
        "box": Segments(2.0 * RIMS - 1.0, "neutral", 2, name="the cube's first three sides"),
        "throws": _thrown(balls.q, balls.inside),
    }
