"""Where things in space are in a picture: a pinhole with the eye of a View."""

from dataclasses import dataclass, replace

import numpy as np

from workbench.view import View

NEAR = 0.02
"""Metres before the eye from where on things are seen."""
NARROWEST = 1.2
"""Width by height of a picture below which as much is seen in its width, as on a page."""
ROOM = 1.12
"""How much larger the picture is than what it is to hold."""
CLOSEST = 0.42
FARTHEST = 1.4
"""Share of the view that a framed picture has at least and at most, along each side."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Lens:
    """A pinhole camera: right, down and ahead are its axes.

    Args:
        p_eye: Where it is in the world, (3,), metres.
        R_eye_world: Its axes in rows, (3, 3).
        focal: Pixels.
        middle: Pixel of what is straight ahead, (2,), column first.
        size: Width and height of the picture, pixels.
    """

    p_eye: np.ndarray
    R_eye_world: np.ndarray
    focal: float
    middle: np.ndarray
    size: tuple[int, int]

    @classmethod
    def of(cls, view: View, size: tuple[int, int]) -> "Lens":
        """Return the lens of a view for a picture of a size, pixels; what a page shows in its
        width stays in a narrow picture.
        """
        p_eye = np.array(view.seen_from(), float)
        ahead = np.array(view.target, float) - p_eye
        ahead /= np.linalg.norm(ahead)
        right = np.cross(ahead, view.up)
        right /= np.linalg.norm(right)
        width, height = size
        wider = max(1.0, NARROWEST * height / width)
        return cls(
            p_eye=p_eye,
            R_eye_world=np.stack([right, np.cross(ahead, right), ahead]),
            focal=0.5 * height / np.tan(np.radians(view.fov_degrees) / 2) / wider,
            middle=np.array(size) / 2,
            size=size,
        )

    def before(self, p_world: np.ndarray) -> np.ndarray:
        """Return points (..., 3) in the frame of the eye."""
        return (p_world - self.p_eye) @ self.R_eye_world.T

    def pixels(self, p_eye: np.ndarray) -> np.ndarray:
        """Return the pixels (..., 2) of points in the frame of the eye; NaN where they are not
        before it.
        """
        depth = np.where(p_eye[..., 2] > NEAR, p_eye[..., 2], np.nan)
        return self.middle + self.focal * p_eye[..., :2] / depth[..., None]

    def seen(self, p_world: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return pixels (..., 2) and depths (...) of points; NaN behind the eye."""
        p_eye = self.before(p_world)
        uv = self.pixels(p_eye)
        return uv, np.where(np.isfinite(uv[..., 0]), p_eye[..., 2], np.nan)

    def scaled(self, factor: float) -> "Lens":
        """Return the lens of the same picture with so many times as many pixels along each
        side.
        """
        width, height = self.size
        return replace(
            self,
            focal=factor * self.focal,
            middle=factor * self.middle,
            size=(round(factor * width), round(factor * height)),
        )

    def around(self, low: np.ndarray, high: np.ndarray) -> "Lens":
        """Return the lens for a picture of the same size that has a box of pixels in its middle,
        with some room around it: a part of this one where all of the box is in it.

        Args:
            low: Its smallest column and row, (2,).
            high: Its largest, (2,).
        """
        size = np.array(self.size, float)
        share = float(np.clip(ROOM * np.max((high - low) / size), CLOSEST, FARTHEST))
        center = (low + high) / 2
        if np.all((low >= -1) & (high <= size + 1)):
            share = min(share, 1.0)
            center = np.clip(center, share * size / 2, size - share * size / 2)
        middle = size / 2 + (self.middle - center) / share
        return replace(self, focal=self.focal / share, middle=middle)
