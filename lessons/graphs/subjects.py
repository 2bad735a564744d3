"""The graph of a run: built-in points, meshes and networks, or the person's own."""

import functools
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from lessons.graphs.state import MOST_OWN, PAIRS, Params, Subject
from workbench.data import networks
from workbench.data.files import read_cloud, read_mesh, stamp
from workbench.data.files.edge_lists import read_edges
from workbench.data.framing import Upward, own_points
from workbench.data.networks import Network
from workbench.data.shapes import surfaces
from workbench.data.shapes.rabbit import rabbit, rabbit_mesh
from workbench.data.thinning import some_points
from workbench.errors import InputError
from workbench.geometry.meshes import triangles as meshes
from workbench.knobs import called, only

MOST_CLOUD, MOST_NODES = 3000, 1000
OWN_SIZE = 2.0  # metres: how long the longest side of own points is made
SPACING = 0.04  # metres between the vertices of the rabbit's mesh


def subject_of(params: Params) -> Subject:
    """Return the nodes that the params describe, numbered as they ask.

    Raises:
        InputError: If an own file cannot be used, or more than one is given.
    """
    own = {"edges": params.edges, "mesh": params.mesh, "cloud": params.cloud}
    given = [(kind, path) for kind, path in own.items() if path is not None]
    if len(given) > 1:
        raise InputError(
            f"one own file at a time: {called('edges')}, {called('mesh')} or {called('cloud')}"
        )
    if given:
        kind, path = given[0]
        made = _own(path, stamp(path), kind=kind, up=params.up, seed=params.seed)
    else:
        made = _built_in(_what_counts(params))
    return made if params.numbering == 0 else _renumbered(made, params.numbering)


def _what_counts(params: Params) -> Params:
    """Return the params with nothing but what makes a built-in graph, so that it is made once."""
    chance = params.graph in ("dumbbell", "uneven sphere", "rabbit") or (
        params.graph == "sphere" and params.jitter > 0
    )
    kept = ("graph", "points", "share", "bridge", "columns", "jitter", "weighted")
    return only(params, *kept, *(("seed",) if chance else ()))


@functools.lru_cache(maxsize=16)
def _built_in(params: Params) -> Subject:
    rng = np.random.default_rng(params.seed)
    name = params.graph
    if name == "dumbbell":
        p, classes = networks.dumbbell(params.points, params.share, params.bridge, rng=rng)
        ends = _nearest(p, np.array([-1.0, 0, 0])), _nearest(p, np.array([1.0, 0, 0]))
        return Subject(
            name="the dumbbell", p=p, classes=classes, front=ends[0], labelled=ends, radius=0.016
        )
    if name == "karate":
        return replace(
            _network("the karate club", networks.karate(params.weighted)),
            labelled=(0, 33),
            radius=0.045,
        )
    if name == "grid":
        return _network("the grid", networks.grid(params.columns, 10))
    if name == "ring":
        return _network("the ring", networks.ring(params.points))
    if name in PAIRS:
        made = networks.star_and_square() if name == PAIRS[0] else networks.hexagon_and_triangles()
        return _network(f"the pair, {name}", made)
    if name == "sphere":
        ball = surfaces.sphere(params.points, jitter=params.jitter, rng=rng)
        known = {"eigenvalues": _of_the_sphere(len(ball.p)), "of_surface": True}
        return _mesh("the sphere", ball.p, ball.faces, **known)
    if name == "rabbit mesh":
        return _mesh("the rabbit's mesh", *rabbit_mesh(SPACING))
    if name == "rabbit":
        return _cloud("the rabbit", rabbit(params.points, rng))
    p = rng.normal(size=(4 * params.points, 3))
    p /= np.linalg.norm(p, axis=1)[:, None]
    p = p[rng.random(len(p)) < np.where(p[:, 2] > 0, 1.0, 0.25)][: params.points]
    known = {"eigenvalues": _of_the_sphere(len(p)), "of_surface": True}
    return replace(_cloud("the uneven sphere", p, **known), radius=0.016)


def _of_the_sphere(count: int) -> np.ndarray:
    """Return the eigenvalues of the unit sphere, l (l + 1), each 2 l + 1 times."""
    degree = np.arange(int(np.sqrt(count)) + 1)
    return np.repeat(degree * (degree + 1.0), 2 * degree + 1)[:count]


def _network(name: str, made: Network) -> Subject:
    ends = int(np.argmin(made.p[:, 0])), int(np.argmax(made.p[:, 0]))
    return Subject(
        name=name,
        p=made.p,
        edges=made.edges,
        weights=made.weights,
        classes=made.classes,
        eigenvalues=made.eigenvalues,
        labelled=ends,
        radius=float(np.clip(0.25 / np.sqrt(len(made.p)), 0.006, 0.05)),
    )


def _mesh(name: str, p: np.ndarray, faces: np.ndarray, **known: Any) -> Subject:
    edges = meshes.edges(faces)
    made = _cloud(name, p, **known)
    return replace(
        made, radius=0.5 * made.radius, faces=faces, edges=edges, weights=np.ones(len(edges))
    )


def _cloud(name: str, p: np.ndarray, **known: Any) -> Subject:
    ends = int(np.argmin(p[:, 0])), int(np.argmax(p[:, 0]))
    radius = 0.16 * float(np.ptp(p, axis=0).max()) / np.sqrt(len(p))
    return Subject(
        name=name,
        p=p,
        front=int(np.argmax(p[:, 2])),
        labelled=ends,
        radius=radius,
        flat=False,
        **known,
    )


def _nearest(p: np.ndarray, to: np.ndarray) -> int:
    return int(np.argmin(np.linalg.norm(p - to, axis=1)))


@functools.lru_cache(maxsize=4)
def _own(path: Path, _stamp: tuple[int, int], *, kind: str, up: Upward, seed: int) -> Subject:
    """Read an own file; anew when it changed."""
    if kind == "edges":
        given = read_edges(path, MOST_NODES)
        p = networks.drawn(given.edges, len(given.names))
        return replace(
            _network(path.name, Network(p=p, edges=given.edges, weights=given.weights)),
            names=given.names,
        )
    faces = np.empty((0, 3), int)
    if kind == "mesh":
        p, faces = meshes.welded(*read_mesh(path))
        if len(p) > MOST_OWN:
            raise InputError(
                f"{path.name}: {len(p):,} vertices; at most {MOST_OWN:,} are taken, simplify it"
                " first"
            )
        if len(p) < 3 or not len(faces):
            raise InputError(f"{path.name}: no triangle with three different corners")
    else:
        p = some_points(read_cloud(path, fewest=21), MOST_CLOUD, np.random.default_rng(seed))
    p = own_points(p, path, up, width=OWN_SIZE)
    return _mesh(path.name, p, faces) if len(faces) else _cloud(path.name, p)


def _renumbered(made: Subject, numbering: int) -> Subject:
    """Return the same graph with its nodes numbered in another order."""
    order = np.random.default_rng(numbering).permutation(len(made.p))
    number = np.empty_like(order)
    number[order] = np.arange(len(order))
    return replace(
        made,
        p=made.p[order],
        edges=None if made.edges is None else number[made.edges],
        faces=number[made.faces],
        classes=made.classes[order] if len(made.classes) else made.classes,
        front=int(number[made.front]),
        labelled=(int(number[made.labelled[0]]), int(number[made.labelled[1]])),
        names=tuple(made.names[i] for i in order) if made.names else (),
    )
