"""Triangle meshes of surfaces whose curvature is known in closed form, regular or jittered.

A surface is sampled exactly: its vertices lie on it, and jitter moves them along it, so that the
analytic values belong to the vertices whatever the mesh. Noise leaves the surface on purpose.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float, Int

from workbench.errors import InputError
from workbench.geometry.motions import across

# Beyond a quarter of a cell, jitter could turn a triangle over.
MOST_JITTER = 0.25

UV = Float[np.ndarray, "n 2"]


@dataclass(frozen=True, eq=False)
class Surface:
    """A mesh with the analytic curvature at its vertices; lengths in metres.

    `k1 >= k2` are the principal curvatures, positive where the surface bends away from the outward
    unit normal (a sphere of radius r has k1 = k2 = 1/r), and `along_k1` the unit direction of k1,
    arbitrary where k1 = k2.
    """

    p: Float[np.ndarray, "v 3"]
    faces: Int[np.ndarray, "f 3"]
    normals: Float[np.ndarray, "v 3"]
    k1: Float[np.ndarray, " v"]
    k2: Float[np.ndarray, " v"]
    along_k1: Float[np.ndarray, "v 3"]

    @property
    def gaussian(self) -> Float[np.ndarray, " v"]:
        """Gaussian curvature K, in 1/m^2."""
        return self.k1 * self.k2

    @property
    def mean(self) -> Float[np.ndarray, " v"]:
        """Mean curvature H, in 1/m."""
        return (self.k1 + self.k2) / 2


def sphere(
    count: int, radius: float = 1.0, *, jitter: float = 0.0, rng: np.random.Generator | None = None
) -> Surface:
    """Sample a sphere by a subdivided icosahedron: all but twelve vertices have six neighbours."""
    normals, faces = _geodesic(max(1, round(np.sqrt(max(count - 2, 10) / 10))))
    if _checked(jitter):
        spacing = np.sqrt(4 * np.pi / len(normals))
        normals = _unit(normals + jitter * spacing * _rng(rng).uniform(-1, 1, normals.shape))
    k = np.full(len(normals), 1 / radius)
    return Surface(radius * normals, faces, normals, k, k, across(normals)[0])


def torus(
    count: int,
    ring: float = 1.0,
    tube: float = 0.4,
    *,
    jitter: float = 0.0,
    rng: np.random.Generator | None = None,
) -> Surface:
    """Sample a torus around z: K > 0 outside, K < 0 inside, K = 0 on the top and bottom circle."""
    across = max(3, round(np.sqrt(count * tube / ring)))
    around = max(3, round(count / across))
    uv, faces = _grid(
        around,
        across,
        (0, 2 * np.pi),
        v_span=(0, 2 * np.pi),
        closed=(True, True),
        jitter=jitter,
        rng=rng,
    )
    u, v = uv.T
    zero = np.zeros(len(uv))
    outward = np.c_[np.cos(u), np.sin(u), zero]
    normals = np.cos(v)[:, None] * outward + np.sin(v)[:, None] * np.array([0, 0, 1.0])
    along_tube = -np.sin(v)[:, None] * outward + np.cos(v)[:, None] * np.array([0, 0, 1.0])
    k_ring = np.cos(v) / (ring + tube * np.cos(v))
    return Surface(
        ring * outward + tube * normals,
        faces,
        normals,
        np.full(len(uv), 1 / tube),
        k_ring,
        along_tube,
    )


def cylinder(
    count: int,
    radius: float = 0.5,
    height: float = 2.0,
    *,
    jitter: float = 0.0,
    rng: np.random.Generator | None = None,
) -> Surface:
    """Sample a cylinder around z, open at both ends: K = 0 and H = 1 / (2 radius)."""
    around = max(3, round(np.sqrt(count * 2 * np.pi * radius / height)))
    up = max(2, round(count / around))
    span = (-height / 2, height / 2)
    uv, faces = _grid(
        around, up, (0, 2 * np.pi), v_span=span, closed=(True, False), jitter=jitter, rng=rng
    )
    u, z = uv.T
    zero = np.zeros(len(uv))
    normals = np.c_[np.cos(u), np.sin(u), zero]
    p = radius * normals + np.c_[zero, zero, z]
    return Surface(p, faces, normals, zero + 1 / radius, zero, np.c_[-np.sin(u), np.cos(u), zero])


def catenoid(
    count: int,
    waist: float = 0.5,
    height: float = 1.2,
    *,
    jitter: float = 0.0,
    rng: np.random.Generator | None = None,
) -> Surface:
    """Sample a catenoid around z, a minimal surface: K = -1 / (waist^2 cosh^4(z / waist))."""
    # With t = z / waist the metric is waist^2 cosh^2(t) (du^2 + dt^2): square cells in (u, t) are
    # square in space.
    span = height / waist
    around = max(3, round(np.sqrt(count * 2 * np.pi / span)))
    up = max(2, round(count / around))
    uv, faces = _grid(
        around,
        up,
        (0, 2 * np.pi),
        v_span=(-span / 2, span / 2),
        closed=(True, False),
        jitter=jitter,
        rng=rng,
    )
    u, t = uv.T
    zero = np.zeros(len(uv))
    p = waist * np.c_[np.cosh(t) * np.cos(u), np.cosh(t) * np.sin(u), t]
    normals = np.c_[np.cos(u), np.sin(u), -np.sinh(t)] / np.cosh(t)[:, None]
    k = 1 / (waist * np.cosh(t) ** 2)
    return Surface(p, faces, normals, k, -k, np.c_[-np.sin(u), np.cos(u), zero])


def saddle(
    count: int,
    bend: float = 1.0,
    half: float = 1.0,
    *,
    jitter: float = 0.0,
    rng: np.random.Generator | None = None,
) -> Surface:
    """Sample z = bend (x^2 - y^2) / 2 over |x|, |y| <= half: K = -bend^2 in the middle."""
    side = max(2, round(np.sqrt(count)))
    xy, faces = _grid(
        side,
        side,
        (-half, half),
        v_span=(-half, half),
        closed=(False, False),
        jitter=jitter,
        rng=rng,
    )
    x, y = xy.T
    slope = np.c_[bend * x, -bend * y]
    hessian = np.broadcast_to(np.diag([bend, -bend]), (len(xy), 2, 2))
    return _monge(xy, bend * (x**2 - y**2) / 2, slope, hessian=hessian, faces=faces)


def plane(
    count: int, half: float = 1.0, *, jitter: float = 0.0, rng: np.random.Generator | None = None
) -> Surface:
    """Sample the square |x|, |y| <= half of the plane z = 0: K = H = 0."""
    return saddle(count, 0.0, half, jitter=jitter, rng=rng)


SURFACES: dict[str, Callable[..., Surface]] = {
    "sphere": sphere,
    "cylinder": cylinder,
    "saddle": saddle,
    "torus": torus,
    "plane": plane,
    "catenoid": catenoid,
}


def scaled(surface: Surface, factor: float) -> Surface:
    """Return the surface enlarged about the origin: curvatures shrink, K by the square."""
    if factor <= 0:
        raise InputError(f"the size must be positive, not {factor:g}")
    return replace(surface, p=factor * surface.p, k1=surface.k1 / factor, k2=surface.k2 / factor)


def inside_out(surface: Surface) -> Surface:
    """Return the surface with its outside in: k1 and k2 change sign and places, K stays."""
    along = np.cross(surface.normals, surface.along_k1)
    return replace(
        surface,
        faces=surface.faces[:, ::-1],
        normals=-surface.normals,
        k1=-surface.k2,
        k2=-surface.k1,
        along_k1=along,
    )


def with_noise(surface: Surface, sigma: float, rng: np.random.Generator) -> Surface:
    """Move every vertex along its normal by Gaussian noise, metres; analytic values stay."""
    return replace(
        surface,
        p=surface.p + sigma * rng.standard_normal(len(surface.p))[:, None] * surface.normals,
    )


def _monge(
    xy: UV,
    z: Float[np.ndarray, " n"],
    slope: UV,
    *,
    hessian: Float[np.ndarray, "n 2 2"],
    faces: Int[np.ndarray, "f 3"],
) -> Surface:
    """Return a height field with its curvature (do Carmo 3.3, example 5)."""
    w = np.sqrt(1 + (slope**2).sum(axis=1))
    normals = np.c_[-slope, np.ones(len(xy))] / w[:, None]
    metric = np.eye(2) + slope[:, :, None] * slope[:, None, :]
    # In the basis of the Cholesky factor the shape operator is symmetric, so its eigenvectors are
    # orthogonal. The sign makes a bump (negative second derivatives) positive: it bends away from
    # its upward normal.
    basis = np.linalg.inv(np.linalg.cholesky(metric)).swapaxes(1, 2)
    k, directions = np.linalg.eigh(-basis.swapaxes(1, 2) @ hessian @ basis / w[:, None, None])
    step = (basis @ directions[:, :, 1:])[:, :, 0]
    along = np.c_[step, (slope * step).sum(axis=1)]
    return Surface(np.c_[xy, z], faces, normals, k[:, 1], k[:, 0], _unit(along))


def _grid(
    n_u: int,
    n_v: int,
    u_span: tuple[float, float],
    *,
    v_span: tuple[float, float],
    closed: tuple[bool, bool],
    jitter: float,
    rng: np.random.Generator | None,
) -> tuple[UV, Int[np.ndarray, "f 3"]]:
    """Return a grid of parameters, cells cut in two; jitter, in cells, leaves borders alone."""
    ends = [
        np.linspace(*span, n, endpoint=not c)
        for span, n, c in zip((u_span, v_span), (n_u, n_v), closed, strict=True)
    ]
    u, v = np.meshgrid(*ends, indexing="ij")
    if _checked(jitter):
        shift = _rng(rng).uniform(-jitter, jitter, (2, n_u, n_v))
        for axis in (0, 1):
            if not closed[axis]:
                np.moveaxis(shift[axis], axis, 0)[[0, -1]] = 0
        u = u + shift[0] * (ends[0][1] - ends[0][0])
        v = v + shift[1] * (ends[1][1] - ends[1][0])
    i, j = np.meshgrid(
        np.arange(n_u if closed[0] else n_u - 1),
        np.arange(n_v if closed[1] else n_v - 1),
        indexing="ij",
    )
    a = i * n_v + j
    b = (i + 1) % n_u * n_v + j
    c = (i + 1) % n_u * n_v + (j + 1) % n_v
    d = i * n_v + (j + 1) % n_v
    faces = np.stack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)], axis=2).reshape(-1, 3)
    return np.c_[u.ravel(), v.ravel()], faces


def _geodesic(frequency: int) -> tuple[Float[np.ndarray, "v 3"], Int[np.ndarray, "f 3"]]:
    """Return the icosahedron, every edge cut in `frequency` parts, on the unit sphere."""
    golden = (1 + np.sqrt(5)) / 2
    corners = np.array([[s, t * golden, 0] for s in (-1, 1) for t in (-1, 1)], dtype=float)
    corners = _unit(np.concatenate([np.roll(corners, k, axis=1) for k in range(3)]))
    edge = np.linalg.norm(corners[:, None] - corners[None], axis=2)
    near = np.abs(edge - edge[edge > 0].min()) < 1e-9
    triangles = np.array(
        [
            (a, b, c)
            for a in range(12)
            for b in range(a)
            for c in range(b)
            if near[a, b] and near[b, c] and near[a, c]
        ]
    )
    inward = np.linalg.det(corners[triangles]) < 0
    triangles[inward] = triangles[inward][:, ::-1]
    i, j = np.array([(i, j) for i in range(frequency + 1) for j in range(frequency + 1 - i)]).T
    weights = np.stack([frequency - i - j, i, j], axis=1) / frequency
    p = np.einsum("wk,tkd->twd", weights, corners[triangles]).reshape(-1, 3)
    row = np.empty((frequency + 1, frequency + 1), dtype=np.intp)
    row[i, j] = np.arange(len(i))
    up = i + j < frequency
    down = i + j < frequency - 1
    small = [
        np.stack([row[i, j], row[i + 1, j], row[i, j + 1]], axis=1) for i, j in [(i[up], j[up])]
    ]
    small += [
        np.stack([row[i + 1, j], row[i + 1, j + 1], row[i, j + 1]], axis=1)
        for i, j in [(i[down], j[down])]
    ]
    faces = (np.concatenate(small) + len(weights) * np.arange(20)[:, None, None]).reshape(-1, 3)
    # Edges and corners were made once per triangle: the same point to 1e-9 is the same vertex.
    _, first, name = np.unique(np.round(p, 9) + 0.0, axis=0, return_index=True, return_inverse=True)
    return _unit(p[first]), name.ravel()[faces]


def _checked(jitter: float) -> float:
    if not 0 <= jitter <= MOST_JITTER:
        raise InputError(f"jitter is from 0 to {MOST_JITTER:g} cells, not {jitter:g}")
    return jitter


def _unit(v: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    return v / np.linalg.norm(v, axis=1, keepdims=True)


def _rng(rng: np.random.Generator | None) -> np.random.Generator:
    if rng is None:
        raise ValueError("a jittered surface needs rng")
    return rng
