"""What is drawn to measure something in place: arcs, dimension lines, arrows, dashed lines and
circles.

Each is made of `Segments` and a `Label`; those that have words return several primitives, by path.
"""

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from workbench.numerals import angle, length
from workbench.scene.colors import Role
from workbench.scene.spatial import Label, Segments

Parts: TypeAlias = dict[str, Segments | Label]
ARC_STEP = 3.0
"""So many degrees of a circle are one straight segment, at most."""
WORDS_OUT = 1.14
"""How far out the words of an arc stand, in its radii."""
BARB = 0.4
"""How wide an arrow's head is, in its lengths."""


def arc(
    path: str,
    p_centre: np.ndarray,
    v_from: np.ndarray,
    degrees: float,
    *,
    about: np.ndarray,
    radius: float,
    color: Role = "source",
    width: float = 4.0,
    text: str | None = None,
) -> Parts:
    """Return the arc of an angle, with a tick at its end and its degrees written at its middle.

    Args:
        path: Where it stands in the scene; its words are at `path/words`.
        p_centre: Its centre (3,), metres.
        v_from: The direction (3,) where it begins.
        degrees: How far it goes about the axis, right-handed; may be negative or more than 180.
        about: The axis (3,) that it goes about.
        radius: Metres.
        color: The role of its colour.
        width: Of its line, pixels.
        text: What is written instead of the degrees; nothing where it is empty.
    """
    turned = _around(v_from, about, np.radians(np.linspace(0.0, degrees, _pieces(degrees) + 1)))
    line = p_centre + radius * turned
    end = p_centre + radius * np.stack([0.94 * turned[-1], 1.06 * turned[-1]])
    words = angle(abs(degrees)) if text is None else text
    parts: Parts = {path: Segments(_chained(line, end), color, width)}
    if words:
        middle = _around(v_from, about, np.radians([degrees / 2]))[0]
        parts[f"{path}/words"] = Label(words, p_centre + WORDS_OUT * radius * middle, color)
    return parts


def circle(
    p_centre: np.ndarray,
    about: np.ndarray,
    radius: float,
    color: Role = "neutral",
    *,
    width: float = 1.5,
    opacity: float = 1.0,
    name: str = "",
) -> Segments:
    """Return a circle about an axis (3,), metres."""
    start = np.cross(about, np.eye(3)[int(np.argmin(np.abs(about)))])
    turned = _around(start, about, np.radians(np.linspace(0.0, 360.0, _pieces(360.0) + 1)))
    return Segments(_chained(p_centre + radius * turned), color, width, opacity=opacity, name=name)


def dimension(
    path: str,
    p: np.ndarray,
    q: np.ndarray,
    *,
    aside: np.ndarray,
    color: Role = "neutral",
    width: float = 2.0,
    text: str | None = None,
) -> Parts:
    """Return the dimension line between two points, moved aside, with ticks at its ends and its
    length at its middle.

    Args:
        path: Where it stands in the scene; its words are at `path/words`.
        p: The one point (3,), metres.
        q: The other one.
        aside: How far the line is moved away from them (3,), metres.
        color: The role of its colour.
        width: Of its lines, pixels.
        text: What is written instead of the length.
    """
    ends = np.stack([p + aside, q + aside])
    ticks = np.stack([[p + 0.6 * aside, p + 1.4 * aside], [q + 0.6 * aside, q + 1.4 * aside]])
    words = length(float(np.linalg.norm(q - p))) if text is None else text
    return {
        path: Segments(np.concatenate([ends[None], ticks]), color, width),
        f"{path}/words": Label(words, ends.mean(axis=0) + 0.6 * aside, color),
    }


def arrows(
    tails: np.ndarray,
    tips: np.ndarray,
    color: Role = "source",
    *,
    head: float = 0.06,
    width: float = 4.0,
    opacity: float = 1.0,
    name: str = "",
) -> Segments:
    """Return arrows from tails (n, 3) to tips (n, 3), each with a head that is seen from every
    side.

    A head is `head` metres long, and never longer than half of its arrow.
    """
    shafts = tips - tails
    sizes = np.linalg.norm(shafts, axis=1)
    ends = [np.stack([tails, tips], axis=1)]
    for shaft, size, tip in zip(shafts, sizes, tips, strict=True):
        if size == 0.0:
            continue
        ahead = shaft / size
        side = np.cross(ahead, np.eye(3)[int(np.argmin(np.abs(ahead)))])
        side /= np.linalg.norm(side)
        reach = min(head, 0.5 * size)
        ways = np.stack([side, -side, np.cross(ahead, side), -np.cross(ahead, side)])
        barbs = tip - reach * ahead + BARB * reach * ways
        ends.append(np.stack([np.broadcast_to(tip, barbs.shape), barbs], axis=1))
    return Segments(np.concatenate(ends), color, width, opacity=opacity, name=name)


def dashed(
    p: np.ndarray,
    color: Role = "correspondence",
    *,
    dash: float = 0.03,
    width: float = 2.0,
    opacity: float = 1.0,
    name: str = "",
) -> Segments:
    """Return a line through points (n, 3) in dashes of this length, metres, as far apart as they
    are long.
    """
    sizes = np.linalg.norm(np.diff(p, axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(sizes)])
    count = max(1, int(np.ceil(along[-1] / (2.0 * dash))))
    starts = 2.0 * dash * np.arange(count)
    ends = np.minimum(starts + dash, along[-1])

    def at(places: np.ndarray) -> np.ndarray:
        return np.column_stack([np.interp(places, along, p[:, i]) for i in range(3)])

    return Segments(
        np.stack([at(starts), at(ends)], axis=1), color, width, opacity=opacity, name=name
    )


def _pieces(degrees: float) -> int:
    return max(1, int(np.ceil(abs(degrees) / ARC_STEP)))


def _around(v: np.ndarray, about: np.ndarray, angles: Sequence[float] | np.ndarray) -> np.ndarray:
    """Return the unit direction across an axis that is nearest to v, turned about the axis by
    angles (n,): (n, 3).
    """
    axis = np.asarray(about, float) / np.linalg.norm(about)
    across = np.asarray(v, float) - (np.asarray(v, float) @ axis) * axis
    across /= np.linalg.norm(across)
    turns = np.asarray(angles, float)[:, None]
    return np.cos(turns) * across + np.sin(turns) * np.cross(axis, across)


def _chained(*lines: np.ndarray) -> np.ndarray:
    """Return the segments (m, 2, 3) of lines through points (n, 3)."""
    return np.concatenate([np.stack([line[:-1], line[1:]], axis=1) for line in lines])
