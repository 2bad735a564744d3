"""Cameras and points for the tests of poses."""

import numpy as np

from workbench.geometry.motions import apply, exp_so3, inverse, motion


def triples(count: int, seed: int = 0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Random T_camera_world, three points each, and where they are seen."""
    rng = np.random.default_rng(seed)
    Rs = np.array([exp_so3(rng.normal(size=3) * 2) for _ in range(count)])
    ts = np.column_stack([rng.uniform(-0.5, 0.5, (count, 2)), rng.uniform(4, 8, count)])
    x, y = rng.uniform(-2, 2, (2, count, 3))
    p_camera = np.stack([x, y, rng.uniform(4, 8, (count, 3))], axis=-1)
    p_world = np.einsum("kji,kni->knj", np.swapaxes(Rs, 1, 2), p_camera - ts[:, None])
    return (
        np.stack([motion(R, t) for R, t in zip(Rs, ts, strict=True)]),
        p_world,
        p_camera[..., :2] / p_camera[..., 2:],
    )


def view(
    seed: int, n: int, *, sigma: float = 0.0, flat: bool = False
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A T_camera_world, n points, 4 to 8 m before it or on a sheet, and where they are seen, with
    noise.
    """
    rng = np.random.default_rng(seed)
    T = motion(
        exp_so3(rng.normal(size=3) * 2),
        np.array([rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5), 6.0]),
    )
    p_camera = np.column_stack([rng.uniform(-2, 2, (n, 2)), rng.uniform(4, 8, n)])
    p_world = apply(inverse(T), p_camera)
    if flat:
        p_world = rng.uniform(-1, 1, (n, 3)) * [1, 1, 0]
        p_camera = apply(T, p_world)
    xy = p_camera[:, :2] / p_camera[:, 2:]
    return T, p_world, xy + sigma * rng.normal(size=xy.shape)
