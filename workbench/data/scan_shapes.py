"""What is scanned twice: a built-in shape or a person's own cloud, and two scans side by side in
a picture.
"""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from jaxtyping import Float

from workbench.data.files import read_cloud, read_pose
from workbench.data.framing import FAR, Frame, Up, box, extent, frame
from workbench.data.shapes.clouds import box_surface, vase
from workbench.data.shapes.rabbit import rabbit
from workbench.data.thinning import some_points
from workbench.errors import InputError
from workbench.geometry.motions import motion

Cloud = Float[np.ndarray, "n 3"]
Sample = Callable[[int, np.random.Generator], Cloud]
"""Draws so many points of a shape."""

# metres: the least side of the box, and what lies between two scans in the picture
LOW = 0.4
GAP = 0.2


def sampler(shape: str, side: float = 0.6) -> Sample:
    """Return what draws points of a built-in shape: rabbit, vase, box, plate or cube.

    Args:
        shape: Its name.
        side: The middle side of box and plate, metres; their long one is 1 m.
    """
    if shape in ("rabbit", "vase"):
        return rabbit if shape == "rabbit" else vase
    sizes = {"box": (1.0, side, LOW), "plate": (1.0, side, 0.0), "cube": (1.0, 1.0, 1.0)}
    return lambda count, rng: box_surface(count, sizes[shape], rng)


def own_sampler(source: Path, up: Up) -> Sample:
    """Return what draws points of an own cloud, as it stands in the picture; all that it has where
    they are fewer.

    Raises:
        InputError: If the file cannot be used.
    """
    p_file, how = framed(source, up)
    p = how.shown(p_file)
    return lambda count, rng: some_points(p, count, rng)


def framed(source: Path, up: Up) -> tuple[Cloud, Frame]:
    """Return the points of an own file, and how they stand in the picture: upright about their
    middle, 1 m long.

    Raises:
        InputError: If the file cannot be used, or all its points lie at one place.
    """
    p_file = read_cloud(source, 4)
    if not extent(p_file, FAR) > 0:
        raise InputError(f"{source.name}: all its points lie at one place")
    return p_file, frame(p_file, 1.0, up=up, far=FAR)


def own_pair(
    target: Path, source: Path, truth: Path | None, *, up: Up
) -> tuple[Float[np.ndarray, "m 3"], Cloud, Float[np.ndarray, "4 4"] | None]:
    """Return two own clouds in one picture, at the scale of the first, and what truly brings the
    second to the first.

    Args:
        target: The first scan.
        source: The second.
        truth: A file with the known pose of the second in the frame of the first; None where nobody
            knows it.
        up: Which axis points up.

    Raises:
        InputError: If a file cannot be used.
    """
    (p_target, how), (p_source, theirs) = framed(target, up), framed(source, up)
    p_target = how.shown(p_target)
    p_source = replace(theirs, scale=how.scale).shown(p_source)
    if truth is None:
        return p_target, p_source, None
    T = read_pose(truth, target, source)
    R_up = how.R_world_file
    moved = T[:3, :3] @ theirs.centre + T[:3, 3] - how.centre
    return p_target, p_source, motion(R_up @ T[:3, :3] @ R_up.T, how.scale * R_up @ moved)


def beside(
    p_target: Float[np.ndarray, "m 3"], p_source: Cloud, far: float = 0.0
) -> Float[np.ndarray, "4 4"]:
    """Return where the target is shown: to the left of the source, with a gap.

    Args:
        p_target: Its points, metres.
        p_source: The source's points, which stay.
        far: The share of far points that push nothing out of the picture.
    """
    left = min(-0.5, box(p_source, far)[0][0]) - GAP - box(p_target, far)[1][0]
    return motion(np.eye(3), np.array([left, 0.0, 0.0]))
