"""Small clouds of five shapes, each with its class: a sphere, a box, a cylinder, a cone and a torus
about the z axis.
"""

from typing import Literal

import numpy as np
from jaxtyping import Float, Int

from workbench.geometry.motions import turns
from workbench.geometry.motions.rotation_outputs import random_rotations

NAMES = ("sphere", "box", "cylinder", "cone", "torus")
Turned = Literal["about z", "freely"]

NOISE = 0.02
STRETCH = (0.8, 1.2)


def labelled_clouds(
    of: Int[np.ndarray, " b"], count: int, turned: Turned, *, rng: np.random.Generator
) -> Float[np.ndarray, "b {count} 3"]:
    """Return a cloud for each class that is asked for: stretched a little along its axes, turned,
    with noise, metres.

    The points of each are listed from the lowest to the highest.

    Args:
        of: Which shapes, as in NAMES.
        count: Points in each cloud.
        turned: By any angle about z, or by any rotation.
        rng: Chance.
    """
    p = _points(of, count, rng) * rng.uniform(*STRETCH, (len(of), 1, 3))
    if turned == "freely":
        R, _ = random_rotations(len(of), 3, np.pi, rng=rng)
    else:
        R = turns(np.outer(rng.uniform(-np.pi, np.pi, len(of)), [0.0, 0.0, 1.0]))
    p = p @ R.swapaxes(1, 2) + NOISE * rng.normal(size=p.shape)
    return np.take_along_axis(p, p[:, :, 2].argsort(axis=1)[:, :, None], 1)


def _points(of: np.ndarray, count: int, rng: np.random.Generator) -> np.ndarray:
    """Return points on the shapes, all shapes made for all points and one taken: loops over clouds
    would take longer.
    """
    shape = (len(of), count, 3)
    of = np.repeat(of, count)
    u, v, w = rng.random((3, len(of)))
    a = 2 * np.pi * u
    end = rng.random(len(of)) < 0.3
    round_ = np.stack([np.cos(a), np.sin(a)], axis=1)
    sign = np.sign(w - 0.5)
    root = np.sqrt(v)
    z = 2 * v - 1
    p = np.column_stack([round_ * np.sqrt(1 - z * z)[:, None], z])
    box = rng.uniform(-0.8, 0.8, (len(of), 3))
    box[np.arange(len(of)), rng.integers(3, size=len(of))] = 0.8 * sign
    around = np.where(end, root, 1)[:, None]
    cylinder = np.column_stack([0.75 * around * round_, 0.9 * np.where(end, sign, z)])
    cone = np.column_stack([0.9 * root[:, None] * round_, np.where(end, -0.8, 0.8 - 1.6 * root)])
    b = 2 * np.pi * v
    torus = np.column_stack([(0.75 + 0.3 * np.cos(b))[:, None] * round_, 0.3 * np.sin(b)])
    for k, points in enumerate((p, box, cylinder, cone, torus)):
        if k:
            p[of == k] = points[of == k]
    return p.reshape(shape)
