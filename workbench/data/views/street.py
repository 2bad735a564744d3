"""A small street to look at: two rails, sleepers, boxes, spheres and a house."""

import functools
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int, UInt8

from workbench.geometry.cameras.raster import MeshItem, SegmentItem
from workbench.geometry.meshes import face_normals
from workbench.geometry.points.sampling import places_on_faces

RAIL_HALF_GAUGE = 0.75
RAIL_END = 60.0
RAIL_COLOR = (110, 118, 129)
SUN = np.array([0.35, -0.55, 0.76])  # unit direction towards the light
BALL_CENTER = np.array([2.2, 5.0, 0.6])
BALL_RADIUS = 0.6
MAPPED = 4000


@dataclass(frozen=True, eq=False)
class LitMesh:
    """A closed mesh with one colour per face, already lit by the sun."""

    p_world: Float[np.ndarray, "v 3"]
    faces: Int[np.ndarray, "f 3"]
    colors: UInt8[np.ndarray, "f 3"]


@dataclass(frozen=True, eq=False)
class StreetScene:
    """The scene, metres, +Z up; the rails run along +Y and the camera usually stands at negative y.

    Attributes:
        solids: What stands there, by name.
        edges: The outlines of boxes, house and roof.
        points: Worth following: those with a name first, then corners, points along rails and on
            balls.
    """

    solids: dict[str, LitMesh]
    rails: Float[np.ndarray, "2 2 3"]
    edges: Float[np.ndarray, "e 2 3"]
    points: Float[np.ndarray, "n 3"]
    names: tuple[str, ...]


@functools.cache
def street() -> StreetScene:
    """Return the street; it is the same each time."""
    house = _box((4.6, 11.0, 0.0), (3.2, 4.0, 2.4))
    roof = _roof((4.6, 11.0, 2.4), (3.6, 4.4, 1.5))
    door = _door()
    crate, tower = _box((-1.9, 6.0, 0.0), (1.0, 1.0, 1.0)), _box((-4.5, 14.0, 0.0), (1.6, 1.6, 5.0))
    sleepers = [_box((0.0, y, -0.02), (2.2, 0.25, 0.06)) for y in np.arange(1.0, 40.0, 1.5)]
    solids = {
        "ground": chequered(
            np.arange(-5, 5),
            np.arange(-2, 30),
            2.0,
            height=-0.03,
            colors=((214, 214, 214), (226, 226, 226)),
        ),
        "sleepers": lit(_merge(sleepers), (164, 154, 146)),
        "crate": lit(crate, (216, 202, 178)),
        "tower": lit(tower, (200, 198, 206)),
        "house": lit(house, (232, 222, 204)),
        "roof": lit(roof, (188, 160, 152)),
        "door": lit(door, (140, 130, 122)),
        "ball": lit(_ball(BALL_CENTER, BALL_RADIUS), (186, 196, 208)),
        "far ball": lit(_ball(np.array([-2.6, 11.0, 0.9]), 0.9), (194, 206, 192)),
    }
    rails = np.array(
        [[[x, 0.0, 0.06], [x, RAIL_END, 0.06]] for x in (-RAIL_HALF_GAUGE, RAIL_HALF_GAUGE)]
    )
    edges = np.concatenate(
        [_box_edges(mesh) for mesh in (crate, tower, house)] + [_roof_edges(roof)]
    )
    named = {
        "the roof's ridge": roof[0][4],
        "the crate's corner": crate[0][5],
        "the tower's top": tower[0][5],
        "the rail, 2 m along": rails[1, 0] + np.array([0.0, 2.0, 0.0]),
        "the rail, 40 m along": rails[1, 0] + np.array([0.0, 40.0, 0.0]),
        "the lamp": np.array([0.9, -5.2, 2.4]),
    }
    along = np.array(
        [
            [x, y, 0.06]
            for x in (-RAIL_HALF_GAUGE, RAIL_HALF_GAUGE)
            for y in np.arange(3.0, 36.0, 3.0)
        ]
    )
    balls = [solids[name].p_world[::40] for name in ("ball", "far ball")]
    points = np.concatenate(
        [list(named.values()), crate[0], tower[0], house[0], roof[0], along, *balls]
    )
    return StreetScene(solids, rails, edges, points, tuple(named))


@functools.cache
def standing() -> tuple[Float[np.ndarray, "v 3"], Int[np.ndarray, "f 3"]]:
    """Return vertices and faces of all that stands in the street or lies on its ground."""
    return _merge(
        [
            (solid.p_world, solid.faces)
            for name, solid in street().solids.items()
            if name != "ground"
        ]
    )


@functools.cache
def street_map() -> tuple[Float[np.ndarray, "n 3"], Float[np.ndarray, "n 3"]]:
    """Return points on what stands in the street, evenly by area, and their normals."""
    p, faces = standing()
    k, shares = places_on_faces(p, faces, np.random.default_rng(0).random((MAPPED, 3)))
    return np.einsum("ni,nix->nx", shares, p[faces[k]]), face_normals(p, faces)[k]


@functools.cache
def street_items() -> tuple[MeshItem | SegmentItem, ...]:
    """Return what `cameras.raster.render` takes to make a photograph of the street."""
    scene = street()
    meshes = [MeshItem(solid.p_world, solid.faces, solid.colors) for solid in scene.solids.values()]
    return (*meshes, SegmentItem(scene.rails, np.tile(np.array(RAIL_COLOR, np.uint8), (2, 1)), 2))


Mesh = tuple[np.ndarray, np.ndarray]


def _box(foot: tuple[float, float, float], size: tuple[float, float, float]) -> Mesh:
    """Return a box standing on the middle of its floor; vertex bits 1, 2, 4 say high x, y, z."""
    bits = (np.arange(8)[:, None] >> np.arange(3)) & 1
    p = np.array(foot) + (bits - np.array([0.5, 0.5, 0.0])) * np.array(size)
    quads = np.array(
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    )
    return p, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def _roof(foot: tuple[float, float, float], size: tuple[float, float, float]) -> Mesh:
    """Return a gable along y: four eaves corners, then the ends of the ridge, low y first."""
    x, y, h = np.array(size) * (0.5, 0.5, 1.0)
    p = np.array(foot) + np.array(
        [[-x, -y, 0], [x, -y, 0], [x, y, 0], [-x, y, 0], [0, -y, h], [0, y, h]]
    )
    return p, np.array(
        [[0, 1, 4], [2, 3, 5], [1, 2, 5], [1, 5, 4], [3, 0, 4], [3, 4, 5], [0, 2, 1], [0, 3, 2]]
    )


def _door() -> Mesh:
    return _box((4.6, 8.98, 0.0), (0.9, 0.06, 1.7))


def _ball(center: np.ndarray, radius: float, rings: int = 16) -> Mesh:
    """Return a sphere of latitude rings, 2 x rings vertices each, and its two poles."""
    turn = 2 * rings
    polar = np.linspace(0, np.pi, rings + 1)[1:-1, None]
    around = np.linspace(0, 2 * np.pi, turn, endpoint=False)[None, :]
    unit = np.stack(
        np.broadcast_arrays(
            np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar)
        ),
        axis=-1,
    ).reshape(-1, 3)
    p = np.concatenate([unit, [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]])
    here = np.arange(turn)
    beside = (here + 1) % turn
    top = np.full(turn, len(unit))
    bottom = np.full(turn, len(unit) + 1)
    last = (rings - 2) * turn
    faces = [
        np.stack([top, here, beside], axis=1),
        np.stack([bottom, last + beside, last + here], axis=1),
    ]
    for ring in range(rings - 2):
        a = ring * turn
        b = (ring + 1) * turn
        faces += [
            np.stack([a + here, b + here, b + beside], axis=1),
            np.stack([a + here, b + beside, a + beside], axis=1),
        ]
    return center + radius * p, np.concatenate(faces)


def chequered(
    x: Int[np.ndarray, " n"],
    y: Int[np.ndarray, " m"],
    tile: float,
    *,
    height: float,
    colors: tuple[tuple[int, int, int], tuple[int, int, int]],
) -> LitMesh:
    """Return level ground of square tiles, two colours by turns; the first is at the origin.

    x and y say where tiles begin, in tiles; `tile` is how long a side is, metres.
    """
    corner = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    p = tile * (corner[:, None] + [[0, 0], [1, 0], [1, 1], [0, 1]]).reshape(-1, 2)
    first = 4 * np.arange(len(corner))[:, None]
    faces = np.concatenate([first + np.array(corners) for corners in ((0, 1, 2), (0, 2, 3))])
    shown = np.array(colors, np.uint8)[corner.sum(axis=1) % 2]
    return LitMesh(
        np.column_stack([p, np.full(len(p), height)]), faces, np.concatenate([shown, shown])
    )


def _merge(meshes: list[Mesh]) -> Mesh:
    starts = np.cumsum([0, *[len(p) for p, _ in meshes]])
    faces = [faces + start for (_, faces), start in zip(meshes, starts, strict=False)]
    return np.concatenate([p for p, _ in meshes]), np.concatenate(faces)


def lit(mesh: Mesh, color: tuple[int, int, int]) -> LitMesh:
    """Return a mesh with a colour per face, by Lambert's law, half of the light from everywhere."""
    p, faces = mesh
    a, b, c = p[faces[:, 0]], p[faces[:, 1]], p[faces[:, 2]]
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    light = 0.55 + 0.45 * np.maximum(normal @ SUN, 0.0)
    return LitMesh(p, faces, np.rint(light[:, None] * np.array(color)).astype(np.uint8))


def _box_edges(mesh: Mesh) -> np.ndarray:
    low, bit = np.meshgrid(np.arange(8), [1, 2, 4], indexing="ij")
    low, bit = low[low & bit == 0], bit[low & bit == 0]
    return np.stack([mesh[0][low], mesh[0][low + bit]], axis=1)


def _roof_edges(mesh: Mesh) -> np.ndarray:
    pairs = np.array([[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 4], [2, 5], [3, 5], [4, 5]])
    return mesh[0][pairs]
