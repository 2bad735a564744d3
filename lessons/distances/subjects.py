"""What ways lead over: a square with a wall, a surface, a roll, or a person's own mesh or cloud."""

import functools
from dataclasses import replace
from pathlib import Path

import numpy as np

from lessons.distances.state import MOST_OWN, Params, Subject
from lessons.distances.swiss_roll import rolled, swiss_roll
from workbench.data.files import read_cloud, stamp
from workbench.data.framing import Upward, own_points
from workbench.data.own_meshes import read_surface
from workbench.data.shapes import surfaces
from workbench.data.shapes.rabbit import rabbit_mesh
from workbench.data.thinning import some_points
from workbench.errors import InputError
from workbench.geometry.graphs import adjacency as graphs
from workbench.geometry.meshes import geodesics
from workbench.geometry.meshes import triangles as meshes
from workbench.geometry.polylines import at_height
from workbench.knobs import only

OWN_SIZE = 2.0
MOST_CLOUD = 3000
TOWARDS_EYE = np.array([0.3, -0.8, 0.55])  # where the source is, on a surface
# in the square, the origin being its middle
FROM = (-0.3, 0.0)
TO = (0.3, -0.2)
SHORTCUT = 3.0  # so many times as far apart on the sheet as in space
WRUNG = 3.0  # how far a wrung sphere is turned per metre of height, radians
POINTS_ON_EDGES = 4  # what the reference of a surface without formula is made with; 2 on large ones
LARGE = 1500


def subject_of(params: Params) -> Subject:
    """Return what the params describe, with the source that they name.

    Raises:
        InputError: If an own file cannot be used, or the source is in the wall.
    """
    if params.stage == "grid":
        made = _square(params.grid, params.wall)
    elif params.stage == "surface":
        made = (
            _made_surface(params)
            if params.mesh is None
            else _own_mesh(params.mesh, stamp(params.mesh), params.up)
        )
    elif params.cloud is not None:
        made = _own_cloud(params.cloud, stamp(params.cloud), params.up, k=params.k)
    else:
        made = _roll(params.points, params.k, params.seed)
    source = made.source if params.source < 0 else params.source % len(made.p)
    if len(made.free) and not made.free[source]:
        raise InputError("the source lies in the wall: pick another place")
    return replace(made, source=source, truth=true_distances(made, source))


def true_distances(subject: Subject, source: int) -> np.ndarray:
    """Return the true distance of every node from a source; empty where no formula is known."""
    if subject.tip is not None:
        flat = subject.p[:, :2]
        return geodesics.distance_past_wall(flat, flat[source], subject.tip)
    if len(subject.sheet):
        return np.linalg.norm(subject.sheet - subject.sheet[source], axis=1)
    if subject.is_sphere:
        p = subject.p
        q = subject.p[source]
        return np.linalg.norm(q) * np.arctan2(np.linalg.norm(np.cross(p, q), axis=1), p @ q)
    return np.empty(0)


def reference(subject: Subject) -> np.ndarray:
    """Return the distances that a subject's ways are held against, computed where no formula is
    known; empty for clouds.
    """
    if len(subject.truth) or not len(subject.faces):
        return subject.truth
    count = POINTS_ON_EDGES if len(subject.p) <= LARGE else 2
    nodes, edges, lengths = _fine(subject.p.tobytes(), subject.faces.tobytes(), count)
    return geodesics.shortest_distances(edges, lengths, len(nodes), subject.source)[
        : len(subject.p)
    ]


@functools.lru_cache(maxsize=2)
def _fine(p: bytes, faces: bytes, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    return geodesics.with_points_on_edges(
        np.frombuffer(p).reshape(-1, 3), np.frombuffer(faces, np.intp).reshape(-1, 3), count
    )


@functools.lru_cache(maxsize=8)
def _square(side: int, wall: float) -> Subject:
    x = np.linspace(-0.5, 0.5, side)
    flat = np.stack(np.meshgrid(x, x, indexing="ij"), axis=-1).reshape(-1, 2)
    h = 1.0 / (side - 1)
    tip = np.array([x[side // 2], x[round(wall * (side - 1))]])
    free = ~((np.abs(flat[:, 0] - tip[0]) < h / 2) & (flat[:, 1] < tip[1] - h / 2))
    corner = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    faces = np.concatenate(
        [corner[:, None] + [0, side, side + 1], corner[:, None] + [0, side + 1, 1]]
    )
    source, goal = (
        int(np.argmin(np.linalg.norm(flat - at, axis=1) + 9.0 * ~free)) for at in (FROM, TO)
    )
    return Subject(
        name="the square",
        p=at_height(flat),
        faces=faces,
        edges=np.empty((0, 2), int),
        lengths=np.empty(0),
        source=source,
        goal=goal,
        free=free,
        h=h,
        tip=tip,
        side=side,
        radius=0.3 * h,
    )


@functools.lru_cache(maxsize=12)
def ways_in_square(side: int, wall: float, neighbours: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the edges of the square's grid that no wall cuts, and their lengths."""
    square = _square(side, wall)
    assert square.tip is not None
    edges = geodesics.grid_edges(side, neighbours)
    flat = square.p[:, :2]
    if not square.free.all():
        edges = edges[square.free[edges].all(axis=1)]
        edges = edges[~geodesics.crosses_wall(flat[edges], square.tip)]
    return edges, geodesics.edge_lengths(flat, edges)


def _made_surface(params: Params) -> Subject:
    return _surface(
        only(
            params,
            "shape",
            "points",
            *(("jitter", "seed") if params.jitter and params.shape == "sphere" else ()),
        )
    )


@functools.lru_cache(maxsize=8)
def _surface(params: Params) -> Subject:
    if params.shape == "rabbit":
        return _mesh(
            "the rabbit",
            *rabbit_mesh(float(np.clip(0.03 * np.sqrt(2844 / params.points), 0.03, 0.05))),
        )
    if params.shape == "torus":
        ring = surfaces.torus(max(params.points, 50), 0.7, 0.3)
        return _mesh("the torus", ring.p, ring.faces)
    ball = surfaces.sphere(
        params.points, jitter=params.jitter, rng=np.random.default_rng(params.seed)
    )
    if params.shape == "wrung sphere":
        turn = WRUNG * ball.p[:, 2]
        along, across = np.cos(turn), np.sin(turn)
        x = along * ball.p[:, 0] - across * ball.p[:, 1]
        y = across * ball.p[:, 0] + along * ball.p[:, 1]
        return replace(
            _mesh("the wrung sphere", np.column_stack([x, y, ball.p[:, 2]]), ball.faces),
            is_sphere=True,
        )
    return replace(_mesh("the sphere", ball.p, ball.faces), is_sphere=True)


def _mesh(name: str, p: np.ndarray, faces: np.ndarray) -> Subject:
    edges = meshes.edges(faces)
    lengths = geodesics.edge_lengths(p, edges)
    h = float(lengths.mean())
    return Subject(
        name=name,
        p=p,
        faces=np.ascontiguousarray(faces, np.intp),
        edges=edges,
        lengths=lengths,
        source=int(np.argmax(p @ TOWARDS_EYE)),
        h=h,
        radius=0.25 * h,
    )


@functools.lru_cache(maxsize=4)
def _own_mesh(path: Path, _stamp: tuple[int, int], up: Upward) -> Subject:
    p, faces, _ = read_surface(path, MOST_OWN)
    return _mesh(path.name, own_points(p, path, up, width=OWN_SIZE), faces)


@functools.lru_cache(maxsize=8)
def _roll(count: int, k: int, seed: int) -> Subject:
    p, sheet = swiss_roll(count, np.random.default_rng(seed))
    made = _neighbours("the roll", p, k)
    apart = geodesics.edge_lengths(sheet, made.edges)
    source = int(np.argmin(sheet[:, 0]))
    goal = int(np.argmax(np.linalg.norm(sheet - sheet[source], axis=1)))
    return replace(
        made, sheet=sheet, source=source, goal=goal, shortcuts=apart > SHORTCUT * made.lengths
    )


@functools.lru_cache(maxsize=4)
def _own_cloud(path: Path, _stamp: tuple[int, int], up: Upward, *, k: int) -> Subject:
    p = some_points(read_cloud(path, fewest=31), MOST_CLOUD, np.random.default_rng(0))
    p = own_points(p, path, up, width=OWN_SIZE)
    made = _neighbours(path.name, p, k)
    source = int(np.argmin(p[:, 0]))
    return replace(made, source=source, goal=int(np.argmax(np.linalg.norm(p - p[source], axis=1))))


def _neighbours(name: str, p: np.ndarray, k: int) -> Subject:
    if k >= len(p):
        raise InputError(
            f"{len(p)} points cannot have {k} neighbours each: fewer neighbours, or more points"
        )
    edges = graphs.edges_of(graphs.directed_graph(graphs.neighbours(p, k)[0]))
    lengths = geodesics.edge_lengths(p, edges)
    return Subject(
        name=name,
        p=p,
        faces=np.empty((0, 3), int),
        edges=edges,
        lengths=lengths,
        source=0,
        h=float(lengths.mean()),
        radius=0.4 / np.sqrt(len(p)),
    )


def true_way(subject: Subject, goal: int) -> np.ndarray:
    """Return points along the true shortest way to a node, a little above the surface; none where
    nobody knows it.
    """
    p = subject.p[subject.source]
    q = subject.p[goal]
    t = np.linspace(0.0, 1.0, 60)[:, None]
    if subject.tip is not None:
        straight = np.linalg.norm(q - p)
        around = [np.append(subject.tip, 0.0)] if subject.truth[goal] > straight + 1e-9 else []
        return np.stack([p, *around, q])
    if subject.is_sphere:
        angle = subject.truth[goal] / np.linalg.norm(p)
        if not np.sin(angle) > 0:
            return np.empty((0, 3))
        return 1.01 * (np.sin((1 - t) * angle) * p + np.sin(t * angle) * q) / np.sin(angle)
    if len(subject.sheet):
        return rolled((1 - t) * subject.sheet[subject.source] + t * subject.sheet[goal])
    return np.empty((0, 3))
