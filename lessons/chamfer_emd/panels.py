"""What the stages draw alike: two panels side by side, clouds of discs, and marks of a place that
several points share.
"""

import numpy as np
import scipy

from workbench.captions import Quantity
from workbench.geometry.motions import motion
from workbench.numerals import brief
from workbench.scene import Label, Points, Primitive, Role

T_WORLD_LEFT = motion(np.eye(3), np.array([-1.25, 0.0, 0.0]))
T_WORLD_RIGHT = motion(np.eye(3), np.array([1.25, 0.0, 0.0]))
NEARER = 0.03  # metres towards the viewer, at which source points are drawn
NUMBER, SPACING = 1.13, 0.17  # metres: the lowest line above the middle of a panel, and the next


def nearer(p: np.ndarray, share: np.ndarray | float = 1.0) -> np.ndarray:
    """Return points a share of NEARER closer to where the scene is first seen from."""
    return p - np.outer(np.broadcast_to(share, len(p)), [0.0, NEARER, 0.0])


def titled(
    side: str, title: str, numbers: tuple[str, ...], *, T_world_side: np.ndarray
) -> dict[str, Primitive]:
    """Return what stands over a panel: its rule, and below it what is said of it, one line each."""
    lines: list[tuple[str, Role]] = [(title, "neutral"), *((text, "source") for text in numbers)]
    return {
        f"{side}/title/{k}": Label(
            text, np.array([0.0, 0.0, NUMBER + SPACING * (len(lines) - 1 - k)]), role, T_world_side
        )
        for k, (text, role) in enumerate(lines)
    }


def disc(count: int) -> float:
    """Return the radius of the discs of so many target points, metres."""
    return float(np.clip(0.3 / np.sqrt(count), 0.016, 0.04))


def clouds_in(
    side: str, p: np.ndarray, p_target: np.ndarray, *, T_world_side: np.ndarray
) -> dict[str, Primitive]:
    """Return a cloud over the ring in a panel; the legend names those of the left one."""
    radius = disc(len(p_target))
    named = side == "left"
    return {
        f"{side}/target": Points(
            p_target, "target", radius, T_world_side, name="ring" if named else ""
        ),
        f"{side}/source": Points(
            nearer(p), "source", 0.5 * radius, T_world_side, name="cloud" if named else ""
        ),
    }


def step_at(values: np.ndarray, value: float) -> int:
    """Return the step at which a hand that goes through these values is nearest to one."""
    return int(np.argmin(np.abs(values - value)))


def shared_places(p: np.ndarray, reach: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the first point of each place, and how many points are chained to it by steps of at
    most `reach`, metres.
    """
    tree = scipy.spatial.KDTree(p)
    pairs = tree.sparse_distance_matrix(tree, reach, output_type="coo_matrix")
    links = scipy.sparse.coo_array(
        (np.ones(pairs.nnz), (pairs.row, pairs.col)), shape=(len(p), len(p))
    )
    _, place = scipy.sparse.csgraph.connected_components(links, directed=False)
    _, first, counts = np.unique(place, return_index=True, return_counts=True)
    return first, counts


def clumps(
    side: str, p: np.ndarray, dot: float, *, T_world_side: np.ndarray
) -> dict[str, Primitive]:
    """Return a disc behind source points that share a place: its area is theirs, rounded up to 2,
    4, 8, ... points.
    """
    first, counts = shared_places(p, 0.3 * dot)
    doublings = np.ceil(np.log2(counts)).astype(int)
    return {
        f"{side}/clumps of {2**k}": Points(
            nearer(p[first[doublings == k]], 0.5),
            "source",
            dot * np.sqrt(2.0**k),
            T_world_side,
            0.6,
        )
        for k in np.unique(doublings[doublings > 0]).tolist()
    }


def squared(value: float) -> str:
    """Return a number of square metres with two digits that count."""
    return f"{significant(value, 2)} m²"


def metres(value: float) -> str:
    """Return a number of metres with two digits that count."""
    return f"{significant(value, 2)} m"


def in_squares(value: float) -> Quantity:
    """Return a number of square metres for a caption."""
    return Quantity(float(value), squared(value))


def in_metres(value: float) -> Quantity:
    """Return a number of metres for a caption."""
    return Quantity(float(value), metres(value))


def significant(value: float, digits: int) -> str:
    """Return a number with so many digits that count; a dash where there is none."""
    if np.isnan(value):
        return "–"
    if abs(value) < 1e-12:
        return "0"
    if abs(value) < 1e-4:
        return "<0.0001"
    if float(f"{value:.{digits}g}") >= 10 ** (digits - 1):
        return brief(value, digits)
    return f"{value:#.{digits}g}"
