"""What one step of the flows looks like: both side by side, their partners, curves and tables."""

import itertools

import numpy as np

from lessons.chamfer_emd.captions import caption, left_label, right_label
from lessons.chamfer_emd.inputs import Input
from lessons.chamfer_emd.pairing import unrolled
from lessons.chamfer_emd.panels import (
    T_WORLD_LEFT,
    T_WORLD_RIGHT,
    clumps,
    disc,
    nearer,
    significant,
    squared,
    titled,
)
from lessons.chamfer_emd.state import Clouds, Side, State, Step, state_of
from workbench.geometry.points.shape_distances import DEFINITIONS
from workbench.geometry.polylines import between
from workbench.lesson import Look
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

MOST_SERVED = 10  # the last bar of the histogram holds all counts from here on
TRAIL = 3  # so many steps stay visible behind the points
OUT_OF_PLACE = Chart("Mass out of place", unit="%")
LOWERED = Chart("What the flows lower")
SIDES = Chart("Both sides of Chamfer", unit="m²")
SERVED = Chart(
    "Nearest of how many target points",
    f"target points, {MOST_SERVED} or more at the end",
    "points",
)


def draw(look: Look[Input, Clouds, Step]) -> Scene:
    """Return the picture of one step."""
    state = state_of(look)
    left, right = state.left, state.right
    return {
        "caption": caption(state),
        **titled("left", *left_label(state), T_world_side=T_WORLD_LEFT),
        **titled("right", *right_label(state), T_world_side=T_WORLD_RIGHT),
        **_clouds(state),
        **_trails(look),
        **_left_edges(state),
        **_sides(state),
        "right/pairs": Segments(_matched(right), "correspondence", 1.5, T_WORLD_RIGHT),
        **_owed(state),
        **{
            f"left/unrolled/{path}": primitive
            for path, primitive in unrolled(state, left, T_WORLD_LEFT, nearest=True).items()
        },
        **{
            f"right/unrolled/{path}": primitive
            for path, primitive in unrolled(state, right, T_WORLD_RIGHT, nearest=False).items()
        },
        **_busiest(left, state),
        **_curves(state),
        "numbers": _numbers_table(state),
        "yardsticks": _yardstick_table(state),
    }


def _trails(look: Look[Input, Clouds, Step]) -> dict[str, Primitive]:
    """Return where the points of both clouds were in the last steps."""
    last = [*look.past[-TRAIL:], look.now]
    trails: dict[str, Primitive] = {}
    for side, T in (("left", T_WORLD_LEFT), ("right", T_WORLD_RIGHT)):
        places = [getattr(step, side).flow.p_moving for step in last]
        moved = [
            between(p, q)[np.linalg.norm(q - p, axis=1) > 0.0]
            for p, q in itertools.pairwise(places)
        ]
        ends = np.concatenate(moved) if moved else np.empty((0, 2, 3))
        if len(ends):
            trails[f"{side}/trail"] = Segments(ends, "source", 1.5, T, 0.35)
    return trails


def _sides(state: State) -> dict[str, Primitive]:
    """Return what each of the two sides of Chamfer says, below the left cloud's title."""
    numbers = state.left.numbers
    rows: dict[str, tuple[float, Role]] = {
        "dots to places": (numbers.to_target, "correspondence"),
        "places to dots": (numbers.to_source, "other"),
    }
    return {
        f"left/sides/{k}": Label(
            f"{name}: {squared(value)}",
            np.array([0.0, 0.0, 0.1 - 0.2 * k]),
            role,
            T_WORLD_LEFT,
        )
        for k, (name, (value, role)) in enumerate(rows.items())
    }


def _matched(side: Side) -> np.ndarray:
    return between(side.flow.p_moving[side.matching.i_a], side.p_target[side.matching.i_b])


def _owed(state: State) -> dict[str, Primitive]:
    """Return, once both flows have ended, where the left one's mass belongs that is out of
    place.
    """
    left = state.left
    far = left.matching.distances > state.params.near
    if not state.last or not far.any():
        return {}
    return {
        "left/owed": Segments(
            _matched(left)[far], "truth", 1.0, T_WORLD_LEFT, 0.7, name="where it belongs"
        )
    }


def _clouds(state: State) -> dict[str, Primitive]:
    """Return both clouds on both sides: each target point a disc, each source point a smaller one
    nearer to the viewer.

    So a target point that is covered is an orange dot in a blue ring, however the two round.
    """
    p_target = state.clouds.p_target
    left = state.left
    right = state.right
    radius = disc(len(p_target))
    dot = 0.5 * radius
    idle = left.served == 0
    classes = Classes.marking(idle, "wrong", "nearest to no place", others=("source", "source"))
    # Where several share a place, the one that is somebody's nearest lies on top.
    p_left = nearer(left.flow.p_moving, np.where(idle, 0.75, 1.0))
    return {
        "left/target": Points(p_target, "target", radius, T_WORLD_LEFT, name="target"),
        "left/source": Points(p_left, classes, dot, T_WORLD_LEFT, name="source"),
        "right/target": Points(p_target, "target", radius, T_WORLD_RIGHT),
        "right/source": Points(nearer(right.flow.p_moving), "source", dot, T_WORLD_RIGHT),
        **clumps("left", left.flow.p_moving, dot, T_world_side=T_WORLD_LEFT),
        **clumps("right", right.flow.p_moving, dot, T_world_side=T_WORLD_RIGHT),
    }


def _left_edges(state: State) -> dict[str, Primitive]:
    p = state.left.flow.p_moving
    p_target = state.clouds.p_target
    near = state.left.near
    lowers = state.params.lowers
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
    word = f"nearest of {left.served[i]} places"
    return {
        "left/busiest/dot": Points(p[None], "highlight", 0.035, T_WORLD_LEFT),
        "left/busiest/word": Label(
            word, p + np.array([0.0, -0.02, 0.08]), "highlight", T_WORLD_LEFT
        ),
    }


def _curves(state: State) -> dict[str, Primitive]:
    left, right = state.left, state.right
    sides: tuple[tuple[str, Side, Role], ...] = (
        ("left", left, "source"),
        ("right", right, "highlight"),
    )
    curves: dict[str, Primitive] = {}
    for name, side, role in sides:
        share = 100 * side.numbers.out_of_place
        curves[f"{name}/out of place"] = OUT_OF_PLACE.scalar(share, name, role)
    return curves | {
        "left/lowered": LOWERED.scalar(left.flow.value, "left, m²", "source"),
        "right/lowered": LOWERED.scalar(right.flow.value, "right, m", "highlight"),
        "left/to places": SIDES.scalar(round(left.numbers.to_target, 4), "dots", "correspondence"),
        "left/to dots": SIDES.scalar(round(left.numbers.to_source, 4), "places", "other"),
        "left/served": _served(left, "left", "source"),
        "right/served": _served(right, "right", "highlight"),
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
    left = state.left.numbers
    right = state.right.numbers
    params = state.params
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
            f"Mass out of place by over {brief(params.near)} m",
            percent(left.out_of_place, 0),
            percent(right.out_of_place, 0),
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
