"""A seeded lidar pair: rings of a spinning scanner on a street, from two places.

Lengths in metres, +Z up. The rings lie densely along themselves and far apart from each other, and
they move with the scanner: what the two scans have in common is the street, not the rings.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from workbench.geometry.motions import exp_so3, motion

SENSOR_HEIGHT, RANGE = 1.73, 80.0
LOWEST, HIGHEST = np.radians([-24.8, 2.0])  # the beams of a Velodyne HDL-64E
POLE_HEIGHT = 5.0


@dataclass(frozen=True, eq=False)
class Street:
    """What a scanner can hit, beside the ground z = 0.

    Attributes:
        boxes: Per row the centre (3), the half size (3) and the turn about +Z in radians.
        poles: Per row the foot x, y and the radius of an upright cylinder, POLE_HEIGHT high.
    """

    boxes: Float[np.ndarray, "b 7"]
    poles: Float[np.ndarray, "k 3"]


def street(rng: np.random.Generator, houses: int = 8, cars: int = 6, *, poles: int = 12) -> Street:
    """Return a street along x, with houses at both sides, parked cars and poles."""
    sides = [rng.choice([-1.0, 1.0], count) for count in (houses, cars, poles)]
    rows = []
    for side in sides[0]:
        size = rng.uniform([5.0, 4.0, 4.0], [12.0, 8.0, 8.0])
        rows.append(
            [
                *rng.uniform([-40, 10], [40, 30]) * [1, side],
                size[2] / 2,
                *size / 2,
                rng.uniform(-1.5, 1.5),
            ]
        )
    for side in sides[1]:
        rows.append(
            [
                *rng.uniform([-30, 4.5], [30, 5.5]) * [1, side],
                0.75,
                2.1,
                0.9,
                0.75,
                rng.uniform(-0.15, 0.15),
            ]
        )
    feet = [
        [*rng.uniform([-30, 6.2], [30, 6.8]) * [1, side], rng.uniform(0.08, 0.2)]
        for side in sides[2]
    ]
    return Street(np.array(rows).reshape(-1, 7), np.array(feet).reshape(-1, 3))


def lidar_scan(
    scene: Street,
    T_world_sensor: Float[np.ndarray, "4 4"],
    rng: np.random.Generator,
    *,
    rings: int = 64,
    columns: int = 1000,
    noise: float = 0.02,
) -> Float[np.ndarray, "n 3"]:
    """Return what a spinning scanner sees, in its own frame.

    Args:
        rings: Beams, evenly between LOWEST and HIGHEST.
        columns: Directions of one turn.
        noise: Standard deviation of each coordinate, metres.
    """
    azimuth = np.linspace(-np.pi, np.pi, columns, endpoint=False) + rng.uniform(
        0, 2 * np.pi / columns
    )
    up = np.linspace(LOWEST, HIGHEST, rings)
    v_sensor = np.empty((3, rings, columns))
    v_sensor[0] = np.cos(up)[:, None] * np.cos(azimuth)
    v_sensor[1] = np.cos(up)[:, None] * np.sin(azimuth)
    v_sensor[2] = np.sin(up)[:, None]
    v_sensor = v_sensor.reshape(3, -1)
    distance = _distances(scene, T_world_sensor[:3, 3], T_world_sensor[:3, :3] @ v_sensor)
    seen = distance < RANGE
    p_sensor = np.ascontiguousarray((v_sensor.compress(seen, axis=1) * distance[seen]).T)
    return p_sensor + noise * rng.standard_normal(p_sensor.shape)


def lidar_pair(
    T_target_source: Float[np.ndarray, "4 4"],
    rng: np.random.Generator,
    *,
    rings: int = 64,
    columns: int = 1000,
    noise: float = 0.02,
) -> tuple[Float[np.ndarray, "m 3"], Float[np.ndarray, "n 3"]]:
    """Return target and source: scans of one street, before and after the motion."""
    scene = street(rng)
    T_world_target = motion(np.eye(3), np.array([0.0, 0.0, SENSOR_HEIGHT]))
    p_target = lidar_scan(scene, T_world_target, rng, rings=rings, columns=columns, noise=noise)
    p_source = lidar_scan(
        scene, T_world_target @ T_target_source, rng, rings=rings, columns=columns, noise=noise
    )
    return p_target, p_source


def _distances(scene: Street, p_world: np.ndarray, v_world: np.ndarray) -> np.ndarray:
    """Return how far rays (3, n) from one place go until they hit something, or infinity."""
    with np.errstate(divide="ignore", invalid="ignore"):  # rays along an axis
        hits = np.where(v_world[2] < 0, -p_world[2] / v_world[2], np.inf)
        flat = v_world[0] ** 2 + v_world[1] ** 2
        for to_it, things, reaches in (
            (_to_box, scene.boxes, np.hypot(*scene.boxes[:, 3:5].T)),
            (_to_pole, scene.poles, scene.poles[:, 2]),
        ):
            for thing, reach in zip(things, reaches, strict=True):
                rays = _towards(thing[:2] - p_world[:2], float(reach), v_world, flat=flat)
                hits[rays] = np.minimum(
                    hits[rays], to_it(thing, p_world, v_world.take(rays, axis=1))
                )
    return hits


def _towards(off: np.ndarray, reach: float, v_world: np.ndarray, *, flat: np.ndarray) -> np.ndarray:
    """Return which rays pass a middle by `reach`; `flat` is their squared length from above."""
    beside = off @ off - (1.01 * reach) ** 2  # square of how far it is to the circle's edge
    if beside <= 0:
        return np.arange(len(flat))
    along = off[0] * v_world[0] + off[1] * v_world[1]
    return np.flatnonzero((along > 0) & (along * along >= beside * flat))


def _to_box(box: np.ndarray, p_world: np.ndarray, v_world: np.ndarray) -> np.ndarray:
    R_box_world = exp_so3(np.array([0.0, 0.0, -box[6]]))
    p = R_box_world @ (p_world - box[:3])
    v = R_box_world @ v_world
    first = (-box[3:6] - p)[:, None] / v
    second = (box[3:6] - p)[:, None] / v
    enter, leave = np.minimum(first, second).max(axis=0), np.maximum(first, second).min(axis=0)
    return np.where((enter < leave) & (enter > 0), enter, np.inf)


def _to_pole(pole: np.ndarray, p_world: np.ndarray, v_world: np.ndarray) -> np.ndarray:
    off = p_world[:2] - pole[:2]
    x, y, z = v_world
    a = x * x + y * y
    b = off[0] * x + off[1] * y
    c = off @ off - pole[2] ** 2
    root = b * b - a * c
    s = (-b - np.sqrt(np.maximum(root, 0.0))) / a
    return np.where((root > 0) & (s > 0) & (p_world[2] + s * z < POLE_HEIGHT), s, np.inf)
