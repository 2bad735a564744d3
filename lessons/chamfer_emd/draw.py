"""What one step looks like: both flows side by side, their matchings, curves and tables."""

import numpy as np
import scipy

from lessons.chamfer_emd.captions import caption, left_label, right_label, significant
from lessons.chamfer_emd.pairing import unrolled
from lessons.chamfer_emd.state import Side, State
from workbench.geometry.motions import motion
from workbench.geometry.points.shape_distances import DEFINITIONS
from workbench.geometry.polylines import between
from workbench.lesson import View
from workbench.numerals import brief, percent
from workbench.scene import (
    Chart,
    Classes,
    Curve,
    Label,
    Points,
    Primitive,
    Role,
    Scene,
    Segments,
    Table,
)

T_WORLD_LEFT = motion(np.eye(3), np.array([-1.25, 0.0, 0.0]))
T_WORLD_RIGHT = motion(np.eye(3), np.array([1.25, 0.0, 0.0]))
NEARER = 0.03  # metres towards the viewer, at which source points are drawn
VIEW = View(eye=(0.0, -4.75, -0.5), target=(0.0, 0.0, -0.5), grid=None, axes=False)
P_TITLE = np.array([0.0, 0.0, 1.12])
MOST_SERVED = 10  # the last bar of the histogram holds all counts from here on
SERVED = Chart(
    "Nearest of how many target points",
    f"target points, {MOST_SERVED} or more at the end",
    "points",
)


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    left, right = state.left, state.right
    return {
        "caption": caption(state),
        "left/title": Label(left_label(state), P_TITLE, "source", T_WORLD_LEFT),
        "right/title": Label(right_label(state), P_TITLE, "source", T_WORLD_RIGHT),
        **_clouds(state),
        **_left_edges(state),
        "right/pairs": Segments(_matched(right), "correspondence", 1.5, T_WORLD_RIGHT),
        **_owed(state),
        **{
            f"left/{path}": one
            for path, one in unrolled(state, left, T_WORLD_LEFT, nearest=True).items()
        },
        **{
            f"right/{path}": one
            for path, one in unrolled(state, right, T_WORLD_RIGHT, nearest=False).items()
        },
        **_busiest(left, state),
        **_curves(state),
        "numbers": _numbers_table(state),
        "yardsticks": _yardstick_table(state),
    }


def _matched(side: Side) -> np.ndarray:
    return between(side.flow.p_moving[side.matching.i_a], side.p_target[side.matching.i_b])


def _owed(state: State) -> dict[str, Primitive]:
    """Return, once both flows have ended, where the left one's mass belongs that is far from its
    place.
    """
    left = state.left
    far = left.matching.distances > state.params.near
    if not state.last or not far.any():
        return {}
    return {
        "left/owed": Segments(
            _matched(left)[far], "truth", 1.0, T_WORLD_LEFT, 0.7, name="where the rest belongs"
        )
    }


def _clouds(state: State) -> dict[str, Primitive]:
    """Return both clouds on both sides: each target point a disc, each source point a smaller one
    nearer to the viewer.

    So a target point that is covered is an orange dot in a blue ring, however the two round.
    """
    p_target, left, right = state.clouds.p_target, state.left, state.right
    radius = float(np.clip(0.3 / np.sqrt(len(p_target)), 0.016, 0.04))
    dot, idle = 0.5 * radius, left.served == 0
    who = Classes.marking(idle, "wrong", "nobody's nearest", others=("source", "source"))
    # Where several share a place, the one that is somebody's nearest lies on top.
    p_left = nearer(left.flow.p_moving, np.where(idle, 0.75, 1.0))
    return {
        "left/target": Points(p_target, "target", radius, T_WORLD_LEFT, name="target"),
        "left/source": Points(p_left, who, dot, T_WORLD_LEFT, name="source"),
        "right/target": Points(p_target, "target", radius, T_WORLD_RIGHT),
        "right/source": Points(nearer(right.flow.p_moving, 1.0), "source", dot, T_WORLD_RIGHT),
        **_clumps("left", left.flow.p_moving, dot, T_WORLD_LEFT),
        **_clumps("right", right.flow.p_moving, dot, T_WORLD_RIGHT),
    }


def nearer(p: np.ndarray, share: np.ndarray | float) -> np.ndarray:
    """Return points a share of NEARER closer to where the scene is first seen from."""
    return p - np.outer(np.broadcast_to(share, len(p)), [0.0, NEARER, 0.0])


def _clumps(side: str, p: np.ndarray, dot: float, T_world_side: np.ndarray) -> dict[str, Primitive]:
    """Return a disc behind source points that share a place: its area is theirs, rounded up to 2,
    4, 8, ... points.
    """
    tree = scipy.spatial.KDTree(p)
    pairs = tree.sparse_distance_matrix(tree, 0.3 * dot, output_type="coo_matrix")
    links = scipy.sparse.coo_array(
        (np.ones(pairs.nnz), (pairs.row, pairs.col)), shape=(len(p), len(p))
    )
    _, place = scipy.sparse.csgraph.connected_components(links, directed=False)
    _, first, counts = np.unique(place, return_index=True, return_counts=True)
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


def _left_edges(state: State) -> dict[str, Primitive]:
    p, p_target, near, lowers = (
        state.left.flow.p_moving,
        state.clouds.p_target,
        state.left.near,
        state.params.lowers,
    )
    edges: dict[str, Primitive] = {}
    if lowers != "target to source":
        edges["left/to target"] = Segments(
            between(p, p_target[near.a_to_b]), "correspondence", 1.5, T_WORLD_LEFT
        )
    if lowers != "source to target":
        edges["left/to source"] = Segments(
            between(p_target, p[near.b_to_a]), "other", 1.5, T_WORLD_LEFT, 0.8
        )
    return edges


def _busiest(left: Side, state: State) -> dict[str, Primitive]:
    """Return a mark at the point of the cloud that is the nearest of the most target points, where
    they are many.
    """
    i = int(np.argmax(left.served))
    if left.served[i] < 3 or state.params.lowers == "source to target":
        return {}
    p = left.flow.p_moving[i]
    word = f"nearest of {left.served[i]} target points"
    return {
        "left/busiest": Points(p[None], "highlight", 0.035, T_WORLD_LEFT),
        "left/busiest word": Label(
            word, p + np.array([0.0, -0.02, 0.08]), "highlight", T_WORLD_LEFT
        ),
    }


def _curves(state: State) -> dict[str, Primitive]:
    left, right = state.left, state.right
    curves: dict[str, Primitive] = {}
    for name, title, side in (("left", "Left flow", left), ("right", "Right flow", right)):
        n, chart = side.numbers, Chart(title)
        value = (
            n.chamfer if name == "right" or state.params.lowers == "both sides" else side.flow.value
        )
        curves[f"{name}/chamfer"] = chart.scalar(value, "Chamfer in m²")
        curves[f"{name}/earth movers"] = chart.scalar(n.earth_movers, "earth mover's in m", "other")
        curves[f"{name}/astray"] = chart.scalar(n.astray, "truth: mass astray", "truth")
    return curves | {
        "left/served": _served(left, "left", "source"),
        "right/served": _served(right, "right", "other"),
    }


def _served(side: Side, name: str, color: Role) -> Curve:
    """Return how many points of the cloud are the nearest of 0, 1, 2, ... target points: all at 1
    where it is one to one.
    """
    counts = np.bincount(np.minimum(side.served, MOST_SERVED), minlength=MOST_SERVED + 1).astype(
        float
    )
    draw = SERVED.bars if name == "left" else SERVED.dots
    return draw(np.arange(MOST_SERVED + 1.0), counts, name, color)


def _numbers_table(state: State) -> Table:
    """Return every distance of both clouds to the target."""
    left, right, params = state.left.numbers, state.right.numbers, state.params
    rows = [
        ("Chamfer, mean of squares, m²", *_both(left.chamfer, right.chamfer)),
        ("… only source to target, m²", *_both(left.to_target, right.to_target)),
        ("… only target to source, m²", *_both(left.to_source, right.to_source)),
    ]
    for name in DEFINITIONS:
        if name != "mean of squares":
            unit = "m²" if name.endswith("squares") else "m"
            rows.append(
                (
                    f"Chamfer, {name}, {unit}",
                    *_both(left.definitions[name], right.definitions[name]),
                )
            )
    rows += [
        ("Earth mover's, exact, m", *_both(left.earth_movers, right.earth_movers)),
        (
            f"Sinkhorn, blur {brief(params.blur)} m, m",
            *_both(state.left.sinkhorn, state.right.sinkhorn),
        ),
        ("Hausdorff, m", *_both(left.hausdorff, right.hausdorff)),
        (f"F-score at {brief(params.near)} m", percent(left.f_score, 0), percent(right.f_score, 0)),
        ("Pairs by index, mean of squares, m²", *_both(left.index_mse, right.index_mse)),
        (
            f"Mass astray by over {brief(params.near)} m",
            percent(left.astray, 0),
            percent(right.astray, 0),
        ),
    ]
    return Table("Distances to the target", ("", "left", "right"), tuple(rows))


def _yardstick_table(state: State) -> Table:
    """Return what known changes of the target cost, to read the other numbers by."""
    rows = [
        (name, _three(n.chamfer), _three(n.earth_movers), _three(n.hausdorff), _three(n.index_mse))
        for name, n in state.yardsticks.items()
    ]
    header = ("", "Chamfer m²", "EMD m", "Hausdorff m", "index m²")
    return Table("What known changes of the target cost", header, tuple(rows))


def _both(left: float, right: float) -> tuple[str, str]:
    return _three(left), _three(right)


def _three(value: float) -> str:
    return significant(value, 3)
