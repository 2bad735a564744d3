"""The forms: each is refined step by step, and what comes back of it is measured against the true
shape.
"""

import functools
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from lessons.representations.state import (
    Built,
    Cells,
    Cloud,
    Fitted,
    Form,
    Growth,
    Joined,
    Params,
    Patches,
    Searched,
    State,
    Subject,
    Surface,
)
from lessons.representations.subjects import RING, TUBE, Samples, covered, measured
from workbench.algorithms.learning.neural_field import new_network, train_field
from workbench.algorithms.spatial.kd_tree import build_tree, looked_at, search
from workbench.algorithms.spatial.octree import grow_octree
from workbench.data.shapes import surfaces
from workbench.geometry.fields.voxels import Grid, counted_area, marched_surface
from workbench.geometry.graphs import components, directed_graph, edges_of, joined
from workbench.geometry.graphs import neighbours as nearest
from workbench.geometry.level_sets import EdgeCrossings, edge_crossings, level_surface
from workbench.geometry.meshes.simplification import clustered, halved
from workbench.geometry.points.sampling import points_on_faces
from workbench.geometry.shapes.bezier import bezier_patch, de_casteljau, raised_patch, torus_patches
from workbench.knobs import only

BezierPatch = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""bezier_patch(control, uv) -> points of a bicubic patch."""

# the cube that is cut into cells
LOW = np.full(3, -1.0)
EDGE = 2.0
NEURAL_CELLS = 28
# samples for a network: near the surface, anywhere; m
NEAR = 10_000
FAR = 5_000
NEAR_SPREAD = 0.05
MOST_VISITS, QUERIES, FEW_QUERIES = 16, 32, 5
MESH_FROM, CLOUD_FROM = 125, 100


@dataclass(frozen=True, kw_only=True)
class Functions:
    """What students can replace, beside the distance to a box."""

    bezier_patch: BezierPatch
    edge_crossings: EdgeCrossings


Steps = Iterator[State]


def cube(cells: int) -> Grid:
    """Return the cube as so many cells along each edge."""
    return Grid(LOW, np.full(3, EDGE / cells), (cells, cells, cells))


def resolutions(last: int) -> tuple[int, ...]:
    """Return 8 cells, then edges shorter by the root of two, and at the end so many."""
    steps = np.rint(8 * 2 ** (np.arange(0, 7) / 2)).astype(int)
    return (*steps[steps < last].tolist(), last)


def grown(state: State, size: int, error: float) -> State:
    """Return the state with one more point in the chart of errors over bytes."""
    return replace(state, bytes=size, sizes=(*state.sizes, size), errors=(*state.errors, error))


def cloud(params: Params, subject: Subject, functions: Functions) -> Steps:
    """Yield ever more points of the surface."""
    p = spread(params, subject)
    state = State(params=params, subject=subject)
    counts = CLOUD_FROM * 2 ** np.arange(0, 11)
    for count in (*counts[counts < len(p)].tolist(), len(p)):
        mean, worst, hole = covered(subject, p[:count])
        form = Cloud(p=p[:count], mean=mean, worst=worst, hole=hole)
        state = grown(replace(state, now=form), 12 * count, mean)
        yield state


def spread(params: Params, subject: Subject) -> np.ndarray:
    """Return points of the surface as chance has them, or of an own cloud as many of its own."""
    rng = np.random.default_rng(params.seed)
    if len(subject.faces):
        return points_on_faces(subject.p, subject.faces, rng.random((params.points, 3)))
    return rng.permutation(subject.p)[: params.points]


def neighbours(params: Params, subject: Subject, functions: Functions) -> Steps:
    """Yield points alone, and then each joined to ever more of its nearest ones."""
    p = spread(params, subject)
    form = Joined(p=p, k=0, edges=np.empty((0, 2), int), pieces=len(p))
    state = State(params=params, subject=subject, now=form, bytes=12 * len(p))
    yield state
    if len(p) < 3:
        return
    most = min(params.neighbours, len(p) - 1)
    rows, _ = nearest(p, most)
    for k in range(1, most + 1):
        graph = joined(directed_graph(rows[:, :k]), "union")
        edges = edges_of(graph)
        away = subject.away(p[edges].mean(axis=1))
        form = Joined(
            p=p,
            k=k,
            edges=edges,
            pieces=int(components(graph).max()) + 1,
            mean=float(away.mean()),
            worst=float(away.max()),
            bridge=int(away.argmax()),
        )
        state = grown(replace(state, now=form), 12 * len(p) + 4 * k * len(p), form.mean)
        yield state


def mesh(params: Params, subject: Subject, functions: Functions) -> Steps:
    """Yield meshes with ever more triangles."""
    state = State(params=params, subject=subject)
    for p, faces in meshes(params, subject):
        surface = measured(subject, p, faces)
        state = grown(replace(state, surface=surface), 12 * (len(p) + len(faces)), surface.mean)
        yield state


def meshes(params: Params, subject: Subject) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield ever finer meshes: vertices on a torus, boxes cut finer, others with vertices made one
    in ever smaller cells.
    """
    made = params.mesh is None
    if made and params.shape not in ("torus", "rabbit"):
        p, faces = subject.p, subject.faces
        while len(p) <= params.points:
            yield p, faces
            p, faces = halved(p, faces)
        return
    counts = MESH_FROM * 2 ** np.arange(0, 11)
    for count in (*counts[counts < params.points].tolist(), params.points):
        if made and params.shape == "torus":
            torus = surfaces.torus(count, RING, TUBE)
            yield torus.p, torus.faces
            continue
        p, faces = clustered(subject.p, subject.faces, float(np.sqrt(1.2 * subject.area / count)))
        if len(faces):
            yield p, faces
        if count >= len(subject.p):
            yield subject.p, subject.faces
            return


def voxels(params: Params, subject: Subject, functions: Functions) -> Steps:
    """Yield ever smaller cells, and after each the surface that comes back."""
    state = State(params=params, subject=subject)
    for n in resolutions(params.resolution):
        grid = cube(n)
        bits = subject.inside(grid.centres()).reshape(grid.shape)
        size = max(1, n**3 // 8)
        form = Cells(grid=grid, values=bits, walls=counted_area(bits, grid.spacing))
        state = replace(state, now=form, surface=None, bytes=size)
        yield state
        surface = measured(subject, *_marched(bits, grid))
        state = grown(replace(state, surface=surface), size, surface.mean)
        yield state


def _marched(bits: np.ndarray, grid: Grid) -> tuple[np.ndarray, np.ndarray]:
    """Return the surface around full cells, which has no faces where none is full."""
    return (
        marched_surface(bits, grid)
        if bits.any()
        else (np.empty((0, 3)), np.empty((0, 3), dtype=np.intp))
    )


def distances(params: Params, subject: Subject, functions: Functions) -> Steps:
    """Yield ever more distances on a grid, and after each the surface that comes back."""
    state = State(params=params, subject=subject)
    for n in resolutions(params.resolution):
        grid = cube(n)
        values = (_sampled if subject.quick else _stored)(subject, n)
        state = replace(
            state, now=Cells(grid=grid, values=values), surface=None, bytes=values.nbytes
        )
        yield state
        surface = measured(subject, *level_surface(values, grid, functions.edge_crossings))
        state = grown(replace(state, surface=surface), values.nbytes, surface.mean)
        yield state


def _sampled(subject: Subject, cells: int) -> np.ndarray:
    """Return the distances at the middles of all cells."""
    grid = cube(cells)
    return subject.field(grid.centres()).reshape(grid.shape).astype(np.float32)


_stored = functools.lru_cache(maxsize=16)(_sampled)  # of a mesh they cost most of a run


def octree(params: Params, subject: Subject, functions: Functions) -> Steps:
    """Yield the levels of the tree, and with each the surface of cells of that size."""
    state = State(params=params, subject=subject)
    for level in grow_octree(subject.field, LOW, EDGE, depth=params.depth):
        state = replace(state, now=level, surface=None, bytes=level.packed_bytes)
        if level.depth >= 3:
            surface = measured(subject, *_marched(level.bits, level.grid))
            state = grown(replace(state, surface=surface), level.packed_bytes, surface.mean)
        yield state
        state = replace(state, mixed=(*state.mixed, int(level.mixed.sum())))


def neural(params: Params, subject: Subject, functions: Functions) -> Steps:
    """Yield a network while it learns the distance, and where its field is zero."""
    rng = np.random.default_rng(params.seed)
    state = State(params=params, subject=subject)
    grid = cube(NEURAL_CELLS)
    near = points_on_faces(subject.p, subject.faces, rng.random((NEAR, 3)))
    p = np.concatenate(
        [near + NEAR_SPREAD * rng.standard_normal(near.shape), rng.uniform(-1, 1, (FAR, 3))]
    )
    network = new_network(params.width, params.features, params.activation, rng=rng)
    corners = grid.centres()
    counts = iteration_counts(params.iterations)
    distances_of = subject.field(p).take if subject.quick else _known(subject, p.tobytes())
    training = train_field(network, p, distances_of, counts=counts, target=params.target, rng=rng)
    for trained in training:
        values = trained.network(corners).reshape(grid.shape)
        surface = measured(subject, *level_surface(values, grid, functions.edge_crossings))
        form = Fitted(trained=trained, grid=grid, values=values)
        state = grown(replace(state, now=form, surface=surface), network.bytes, surface.mean)
        yield state


@functools.lru_cache(maxsize=4)
def _known(subject: Subject, p: bytes) -> Samples:
    """Return the distances of samples to a mesh, which do not change with the network."""
    return Samples(subject, np.frombuffer(p).reshape(-1, 3))


def iteration_counts(last: int) -> tuple[int, ...]:
    """Return after how many iterations a step is shown: every 25, later every 100."""
    counts = [*range(0, 300, 25), *range(300, last, 100)]
    return (*[count for count in counts if count < last], last)


def patches(params: Params, subject: Subject, functions: Functions) -> Steps:
    """Yield the control net, one point by de Casteljau, and then patch after patch."""
    control = torus_patches(RING, TUBE, params.rational)
    shown = control[..., :3] / control[..., 3:]
    net = np.unique(
        np.round(np.concatenate([shown, control[..., 3:]], axis=-1).reshape(-1, 4), 9) + 0.0, axis=0
    )
    form = Patches(control=control, net=net)
    state = State(
        params=params, subject=subject, now=form, bytes=(16 if params.rational else 12) * len(net)
    )
    yield state
    u, v = params.place
    rows = [de_casteljau(row, v) for row in control[0]]
    levels = ()
    for k in range(1, len(rows)):
        levels = tuple(np.stack([row[j] for row in rows]) for j in range(1, k + 1))
        yield replace(state, now=replace(form, levels=levels))
    point = evaluated(functions.bezier_patch, control[0], np.array([[u, v]]))[0]
    levels = (*levels, *de_casteljau(np.stack([row[-1][0] for row in rows]), u)[1:])
    form = replace(form, levels=levels, point=point)
    yield replace(state, now=form)
    uv, quads = _square(11)
    p = [evaluated(functions.bezier_patch, patch, uv) for patch in control]
    for n in (1, 4, 8, 12, 16):
        at = np.concatenate(p[:n])
        faces = np.concatenate([quads + len(uv) * k for k in range(n)])
        away = subject.away(at)
        surface = Surface(
            p=at,
            faces=faces,
            mean=float(away.mean()),
            worst=float(away.max()),
            area=float("nan"),
            volume=float("nan"),
            tilt=float("nan"),
        )
        state = replace(state, now=replace(form, count=n), surface=surface)
        if n == 16:
            state = grown(state, state.bytes, surface.mean)
        yield state


def _square(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Return n x n places of the unit square, and the triangles between them."""
    ends = np.linspace(0, 1, n)
    i, j = (
        index.ravel() for index in np.meshgrid(np.arange(n - 1), np.arange(n - 1), indexing="ij")
    )
    a = n * i + j
    b = n * (i + 1) + j
    c = n * (i + 1) + j + 1
    d = n * i + j + 1
    faces = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    return np.stack(np.meshgrid(ends, ends, indexing="ij"), axis=-1).reshape(-1, 2), faces


def evaluated(bezier_patch: BezierPatch, control: np.ndarray, uv: np.ndarray) -> np.ndarray:
    """Return points of a rational patch: numerator and denominator are patches too."""
    control = raised_patch(control) if len(control) == 3 else control
    weights = np.asarray(bezier_patch(np.repeat(control[..., 3:], 3, axis=-1), uv), float)
    return np.asarray(bezier_patch(control[..., :3], uv), float) / np.where(
        weights == 0, 1.0, weights
    )


def kd_tree(params: Params, subject: Subject | None, functions: Functions) -> Steps:
    """Yield the cuts of a k-d tree, then the cells that a search looks into."""
    rng = np.random.default_rng(params.seed)
    d = params.dimensions if subject is None else 3
    p = rng.uniform(-1, 1, (params.points, d)) if subject is None else spread(params, subject)
    tree = build_tree(p, np.full(d, -1.0), np.full(d, 1.0))
    query = np.concatenate([params.query, rng.uniform(-1, 1, d)])[:d]
    deepest = int(tree.depth.max())
    state = State(params=params, subject=None, bytes=4 * p.size)
    for depth in sorted({0, 1, 2, 3, 4, 6, deepest}):
        if depth <= deepest:
            yield replace(state, now=Built(tree=tree, depth=depth))
    visits = tuple(search(tree, query))
    ends = np.unique(
        np.rint(np.geomspace(1, len(visits), min(len(visits), MOST_VISITS))).astype(int)
    )
    for end in ends.tolist():
        form = Searched(tree=tree, query=query, visits=visits[:end], done=end == len(visits))
        state = replace(state, now=form)
        yield state
    yield replace(state, growth=_growth(params.seed))


@functools.lru_cache(maxsize=4)
def _growth(seed: int) -> Growth:
    """Return how searches grow with points, and with dimensions."""

    def mean_looked(n: int, d: int) -> float:
        rng = np.random.default_rng(seed)
        tree = build_tree(rng.random((n, d)), np.zeros(d), np.ones(d))
        return float(looked_at(tree, rng.random((QUERIES if d < 10 else FEW_QUERIES, d))).mean())

    counts = np.array([250, 1000, 4000, 16_000])
    dimensions = np.array([2, 3, 5, 10, 15, 20])
    return Growth(
        counts=counts,
        looked=np.array([mean_looked(int(n), 3) for n in counts]),
        dimensions=dimensions,
        shares=np.array([mean_looked(4000, int(d)) for d in dimensions]) / 4000,
    )


FORMS: dict[Form, Callable[..., Steps]] = {
    "cloud": cloud,
    "neighbours": neighbours,
    "mesh": mesh,
    "voxels": voxels,
    "distances": distances,
    "octree": octree,
    "k-d tree": kd_tree,
    "patches": patches,
    "neural": neural,
}


def others(params: Params, subject: Subject) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Return bytes and errors of the other forms that are quickly made, at a few sizes."""
    references = {} if params.cloud else _references(subject, only(params, "shape", "mesh"))
    return {form: points for form, points in references.items() if form != params.form}


@functools.lru_cache(maxsize=16)
def _references(subject: Subject, params: Params) -> dict[Form, tuple[np.ndarray, np.ndarray]]:
    functions = Functions(bezier_patch=bezier_patch, edge_crossings=edge_crossings)
    forms: tuple[Form, ...] = ("cloud", "mesh")
    if subject.closed:
        forms = ("cloud", "mesh", "voxels", "distances")
    if params.mesh is None and params.shape == "torus":
        forms = (*forms, "patches")
    references = {}
    for form in forms:
        few = replace(params, form=form, points=6400, resolution=32 if subject.quick else 16)
        *_, last = FORMS[form](few, subject, functions)
        references[form] = (np.array(last.sizes, float), np.array(last.errors))
    return references
