"""How a scene is seen: the eye, what it looks at, and which way is up."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class View:
    """How the scene is first seen: the eye, what it looks at, metres; +Z is up unless `up` says
    otherwise.

    `grid` is the spacing of the ground grid in metres at height `grid_height` along `up`; None
    draws none. `axes` draws the world's axes, labelled, at the origin.
    """

    eye: tuple[float, float, float] = (2.0, -2.0, 1.5)
    target: tuple[float, float, float] = (0.0, 0.0, 0.0)
    up: tuple[float, float, float] = (0.0, 0.0, 1.0)
    grid: float | None = 0.5
    grid_height: float = 0.0
    fov_degrees: float = 45.0
    axes: bool = True

    def __post_init__(self) -> None:
        numbers = np.array([*self.eye, *self.target, *self.up])
        if numbers.shape != (9,) or not np.isfinite(numbers).all():
            raise ValueError("a View's eye, target and up are three finite numbers each")
        if self.eye == self.target or not any(self.up):
            raise ValueError("a View's eye is apart from its target, and its up has a length")

    def seen_from(self) -> np.ndarray:
        """Return the eye, moved aside by a thousandth of its distance where it looks along `up`.

        Straight down or up no direction of the picture would be decided: +y points up in it then,
        +z where y is vertical itself (-z from above, so that +x is on the right).
        """
        eye, target, up = (np.array(triple, float) for triple in (self.eye, self.target, self.up))
        away = eye - target
        up = up / np.linalg.norm(up)
        aside = np.cross(away, up)
        if np.linalg.norm(aside) > 1e-3 * np.linalg.norm(away):
            return eye
        above = np.sign(away @ up)
        upwards = (
            np.array([0.0, 1.0, 0.0])
            if abs(up[1]) < 0.9
            else np.array([0.0, 0.0, -above * np.sign(up[1])])
        )
        return eye - above * 2e-3 * np.linalg.norm(away) * upwards

    def facing(self, right: float, up: float, nearer: float = 0.0) -> np.ndarray:
        """Return the pose (4, 4) of a picture that stands upright before the eye.

        Its middle is so many metres right of the target, above it, and nearer to the eye.
        """
        ahead = np.array(self.target) - self.seen_from()
        axes = [np.cross(ahead, self.up), np.cross(ahead, np.cross(ahead, self.up)), ahead]
        pose = np.eye(4)
        pose[:3, :3] = np.column_stack([axis / np.linalg.norm(axis) for axis in axes])
        pose[:3, 3] = np.array(self.target) + pose[:3, :3] @ (right, -up, -nearer)
        return pose
