"""What is stored: a shape whose distance is known in closed form, the rabbit, or a person's own
mesh.
"""

import functools
from collections.abc import Callable
from pathlib import Path

import numpy as np
import scipy

from lessons.representations.state import OF_CLOUDS, Params, Shape, Subject, Surface
from workbench.data.files import read_cloud, stamp
from workbench.data.framing import Upward, own_points
from workbench.data.own_meshes import read_welded
from workbench.data.shapes import solids, surfaces
from workbench.data.shapes.rabbit import rabbit_mesh
from workbench.data.thinning import some_points
from workbench.errors import InputError
from workbench.geometry.fields import signed_distances
from workbench.geometry.fields.signed_distances import face_tree, mesh_distance, mesh_sdf, torus_sdf
from workbench.geometry.meshes import face_normals
from workbench.geometry.meshes.containment import windings
from workbench.geometry.meshes.measures import encloses, signed_volume, surface_area
from workbench.geometry.motions import exp_so3
from workbench.geometry.points.sampling import places_on_faces, points_on_faces, unit_points
from workbench.knobs import called

BoxSdf = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""box_sdf(p, half_size) -> the signed distances of points to a box about the origin."""

RING, TUBE = 0.6, 0.25
HALF = np.array([0.5, 0.35, 0.25])
PLATE = 0.6  # m, half of its long sides
PAIR_HALF, PAIR_APART = np.array([0.325, 0.3, 0.3]), np.array([0.275, 0.0, 0.0])
OWN_SIZE = 1.6  # m of the picture that an own mesh is long
MOST_OWN = 50_000  # faces
MOST_CLOUD = 20_000  # points of an own cloud
SPREAD = 2048  # points at which surfaces are compared
STEP = 1e-4  # m, of the true normals' differences


def subject_of(params: Params, box_sdf: BoxSdf) -> Subject:
    """Return what the params describe.

    Raises:
        InputError: If an own file cannot be used, or it has no inside where one is needed.
    """
    if params.cloud is not None:
        if params.mesh is not None:
            raise InputError(
                f"{called('mesh')} and {called('cloud')} are both given: one of them is stored"
            )
        if params.form not in OF_CLOUDS["form"]:
            forms = ", ".join(OF_CLOUDS["form"])
            raise InputError(
                f"{params.cloud.name} is points, which have no faces and no inside;"
                f" {called('form')} is one of {forms}"
            )
        return _own_cloud(params.cloud, stamp(params.cloud), params.up)
    if params.mesh is not None:
        subject = _own(params.mesh, stamp(params.mesh), params.up)
        if not subject.closed and params.form not in ("cloud", "mesh"):
            raise InputError(
                f"{subject.name} is open, or its faces disagree: inside has no meaning; store it as"
                " cloud or mesh"
            )
        return subject
    if params.shape == "rabbit":
        return _rabbit()
    if params.shape == "torus":
        return _torus()
    return _boxed(params.shape, params.thickness / params.resolution, params.seed, box_sdf=box_sdf)


@functools.lru_cache(maxsize=16)
def _boxed(shape: Shape, thin: float, seed: int, *, box_sdf: BoxSdf) -> Subject:
    """Return the box, both boxes, or the plate, half of whose thickness is given."""
    if shape == "box":
        return _box("the box", HALF, lambda q: box_sdf(q, HALF))
    if shape == "two boxes":
        whole = PAIR_HALF + PAIR_APART
        return _box(
            "the two boxes",
            whole,
            lambda q: np.minimum(
                box_sdf(q - PAIR_APART, PAIR_HALF), box_sdf(q + PAIR_APART, PAIR_HALF)
            ),
        )
    half = np.array([PLATE, PLATE, thin])
    R = exp_so3(1.5 * np.random.default_rng(seed).normal(size=3))
    return _box("the plate", half, lambda q: box_sdf(q @ R, half), R=R)


def measured(subject: Subject, p: np.ndarray, faces: np.ndarray) -> Surface:
    """Return a surface with its errors."""
    if not len(faces) or not (area := surface_area(p, faces)) > 0:
        nan = float("nan")
        return Surface(
            p=p[:0], faces=faces[:0], mean=nan, worst=nan, area=0.0, volume=0.0, tilt=nan
        )
    u = spread_numbers()
    q = points_on_faces(p, faces, u)
    away = subject.away(q)
    return Surface(
        p=p,
        faces=faces,
        mean=float(away.mean()),
        worst=float(away.max()),
        area=area / subject.area,
        volume=signed_volume(p, faces) / subject.volume if encloses(faces) else float("nan"),
        tilt=_tilt(subject, p, faces, u=u[::16]) if subject.closed else float("nan"),
    )


def covered(subject: Subject, p: np.ndarray) -> tuple[float, float, np.ndarray]:
    """Return how far the surface is from the nearest of some points, on average and at worst, and
    where it is worst.
    """
    away = np.asarray(scipy.spatial.cKDTree(p).query(subject.on)[0])
    return float(away.mean()), float(away.max()), subject.on[int(away.argmax())]


class Samples:
    """The distances that are stored of some points.

    Those of the first rows that are asked for are found alone, as a first picture needs no more;
    then all.
    """

    def __init__(self, subject: Subject, p: np.ndarray) -> None:
        self._subject = subject
        self._p = p
        self._asked = False

    def __call__(self, rows: np.ndarray) -> np.ndarray:
        """Return the distances of the points in these rows, m."""
        if self._asked:
            return self._all[rows]
        self._asked = True
        return self._subject.field(self._p[rows])

    @functools.cached_property
    def _all(self) -> np.ndarray:
        return self._subject.field(self._p)


@functools.cache
def spread_numbers() -> np.ndarray:
    """Return the numbers that spread points over any surface, the same for all."""
    return unit_points(SPREAD, 3, "Sobol", rng=np.random.default_rng(0))


def _tilt(subject: Subject, p: np.ndarray, faces: np.ndarray, *, u: np.ndarray) -> float:
    """Return the mean angle between face normals and the gradient of the true distance, degrees."""
    normals = face_normals(p, faces)
    k, _ = places_on_faces(p, faces, u)
    q = points_on_faces(p, faces, u)
    steps = STEP * np.concatenate([np.eye(3), -np.eye(3)])
    ahead, behind = (
        subject.distance((q[:, None] + steps).reshape(-1, 3)).reshape(-1, 2, 3).swapaxes(0, 1)
    )
    gradient = ahead - behind
    size = np.linalg.norm(gradient, axis=1)
    cosine = np.einsum("nx,nx->n", gradient, normals[k])[size > 0] / size[size > 0]
    return float(np.degrees(np.arccos(np.clip(cosine, -1, 1))).mean())


@functools.cache
def _torus() -> Subject:
    made, fine = surfaces.torus(3000, RING, TUBE), surfaces.torus(20_000, RING, TUBE)
    return Subject(
        name="the torus",
        p=made.p,
        faces=made.faces,
        distance=lambda q: torus_sdf(q, RING, TUBE),
        field=lambda q: torus_sdf(q, RING, TUBE),
        inside=lambda q: torus_sdf(q, RING, TUBE) < 0,
        area=4 * np.pi**2 * RING * TUBE,
        volume=2 * np.pi**2 * RING * TUBE**2,
        on=points_on_faces(fine.p, fine.faces, spread_numbers()),
    )


def _box(
    name: str,
    half: np.ndarray,
    field: Callable[[np.ndarray], np.ndarray],
    *,
    R: np.ndarray | None = None,
) -> Subject:
    """Return a box about the origin, turned, with what is stored as its distance."""
    R_box = np.eye(3) if R is None else R
    made = solids.box((2 * half[0], 2 * half[1], 2 * half[2]))
    p = (made.p - [0, 0, half[2]]) @ R_box.T
    a, b, c = 2 * half
    return Subject(
        name=name,
        p=p,
        faces=made.faces,
        distance=lambda q: signed_distances.box_sdf(q @ R_box, half),
        field=field,
        inside=lambda q: field(q) < 0,
        area=2 * float(a * b + b * c + c * a),
        volume=float(a * b * c),
        on=points_on_faces(p, made.faces, spread_numbers()),
    )


@functools.cache
def _rabbit() -> Subject:
    p, faces = rabbit_mesh(0.04)
    return _of_mesh("the rabbit", OWN_SIZE * (p - (p.min(axis=0) + p.max(axis=0)) / 2), faces)


def _of_mesh(name: str, p: np.ndarray, faces: np.ndarray) -> Subject:
    """Return a mesh that is the truth itself."""
    closed = encloses(faces)
    mesh = face_tree(p, faces, closed=closed)
    return Subject(
        name=name,
        p=p,
        faces=faces,
        distance=lambda q: mesh_sdf(mesh, q),
        field=lambda q: mesh_sdf(mesh, q),
        inside=lambda q: (
            windings(mesh.columns, q) != 0 if mesh.columns else np.zeros(len(q), dtype=bool)
        ),
        area=surface_area(p, faces),
        volume=signed_volume(p, faces) if closed else float("nan"),
        on=points_on_faces(p, faces, spread_numbers()),
        quick=False,
        unsigned=lambda q: mesh_distance(mesh, q),
    )


@functools.lru_cache(maxsize=4)
def _own(path: Path, _stamp: tuple[int, int], up: Upward) -> Subject:
    p, faces = read_welded(path, MOST_OWN, "stored")
    return _of_mesh(path.name, own_points(p, path, up, width=OWN_SIZE), faces)


@functools.lru_cache(maxsize=4)
def _own_cloud(path: Path, _stamp: tuple[int, int], up: Upward) -> Subject:
    """Return points whose truth is nothing but themselves."""
    p = some_points(read_cloud(path, fewest=2), MOST_CLOUD, np.random.default_rng(0))
    p = own_points(p, path, up, width=OWN_SIZE)
    tree = scipy.spatial.cKDTree(p)

    def distance(q: np.ndarray) -> np.ndarray:
        return np.asarray(tree.query(q)[0])

    return Subject(
        name=path.name,
        p=p,
        faces=np.empty((0, 3), int),
        distance=distance,
        field=distance,
        inside=lambda q: np.zeros(len(q), dtype=bool),
        area=float("nan"),
        volume=float("nan"),
        on=p,
        quick=False,
    )
