"""Where things stand: both pictures upright side by side, the map of disparities below, and beside
it the depths.
"""

import functools
import math

import numpy as np

from lessons.disparity.cameras import VIEW
from lessons.disparity.matching import MapLook, chosen
from lessons.disparity.pairs import ROWS_OFF, Pictures
from workbench.algorithms.stereo.disparity import Stage
from workbench.geometry.motions import R_UPRIGHT, motion
from workbench.geometry.polylines import between
from workbench.scene import Field, Label, Picture, Primitive, Role, Segments

# The left camera is at the world's origin and looks along +Y.
T_WORLD_LEFT = motion(R_UPRIGHT, np.zeros(3))
NEARER = 1.0  # metres towards the eye: in front of the cloud, whatever strays in it
LARGEST = (2.1, 1.575)
"""Metres, across and down, that a picture may have."""
LEFT = -1.09
RIGHT = 1.09
ABOVE = 0.775
BELOW = -0.96
LEAST_FRAME = 2.5  # pixels
LAYER = 0.004  # metres from a picture to the lines on it, and from these to those before them


def standing(look: MapLook) -> dict[str, Primitive]:
    """Return the two pictures, the row along which they are compared, and the map below them."""
    pictures = look.subject
    top = float(pictures.max_disparity)
    field = Field(look.now.disparity.astype(np.float32), 0.0, top, "Disparity", "px")
    left = _upright(pictures.pair.left, "left picture", LEFT, y=ABOVE)
    right = _upright(pictures.pair.right, "right picture", RIGHT, y=ABOVE)
    below = _upright(field, "Disparity of the left picture (grey: unknown)", LEFT, y=BELOW)
    return {
        "left/picture": left,
        "right/picture": right,
        "map/disparity": below,
        "left/name": _named(left, "left picture", "target"),
        "right/name": _named(right, "right picture", "source"),
        "map/name": _named(below, "disparity (grey: unknown)", "neutral"),
        "left/edge": Segments(left.border(LAYER), "target", 2.5),
        "right/edge": Segments(right.border(LAYER), "source", 2.5),
        **_row(look, left, right),
    }


def _upright(image: np.ndarray | Field, title: str, x: float, *, y: float) -> Picture:
    h, w = (image.values if isinstance(image, Field) else image).shape[:2]
    return Picture(image, title, min(LARGEST[0], LARGEST[1] * w / h), _pose(x, y))


@functools.cache
def _pose(x: float, y: float) -> np.ndarray:
    return VIEW.facing(x, y, NEARER)


def _named(picture: Picture, name: str, color: Role) -> Label:
    w, h = picture.size
    return Label(name, picture.places(np.array([w / 2, -0.02 * h])), color)


def _row(look: MapLook, left: Picture, right: Picture) -> dict[str, Primitive]:
    """Return the row of the followed pixel across both pictures: where it is, where its partner is
    sought, and found.
    """
    pictures = look.subject
    u, v = pictures.pixel
    w = pictures.left.shape[1]
    ends = between(
        left.places(np.array([-0.5, v]), LAYER), right.places(np.array([w - 0.5, v]), LAYER)
    )
    comparing = look.now.stage is Stage.COMPARE
    tried = look.now.done - 1 if comparing else pictures.max_disparity
    sought = right.places(np.array([[max(u - tried, 0), v], [u, v]]), 2 * LAYER)
    shown: dict[str, Primitive] = {
        "row": Segments(ends, "highlight", 1.5, name=f"row v = {v}"),
        "row/sought": Segments(
            sought[None], "other", 5.0, name="tried so far" if comparing else ""
        ),
        "left/window": _frame(look, left, u, v=v, color="highlight"),
    }
    at = tried if comparing else chosen(look)
    if math.isfinite(at):
        shown["right/window"] = _frame(
            look,
            right,
            u - at,
            v=v,
            color="source",
            name="compared with" if comparing else "chosen partner",
        )
    truth = pictures.pair.disparity
    if truth is not None and look.params.mistake != "pictures exchanged" and _seen(pictures):
        lower = ROWS_OFF if look.params.mistake == "rows off by 2 px" else 0
        shown["right/truth"] = _frame(
            look, right, u - float(truth[v, u]), v=v + lower, color="truth", name="true partner"
        )
    return shown


def _seen(pictures: Pictures) -> bool:
    u, v = pictures.pixel
    visible = pictures.pair.visible
    return visible is not None and bool(visible[v, u])


def _frame(
    look: MapLook, picture: Picture, u: float, *, v: float, color: Role, name: str = ""
) -> Segments:
    half = max(look.params.window / 2, LEAST_FRAME)
    middle = np.array([u, v])
    return Segments(picture.box(middle - half, middle + half, 3 * LAYER), color, 3.0, name=name)
