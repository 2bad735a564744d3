"""The stage `twelve`: twelve dots on twelve places, one of them dragged, its neighbours heaped on
it one after the other, and two rules that say which belongs to which.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from lessons.chamfer_emd.distances import Measures
from lessons.chamfer_emd.inputs import Input
from lessons.chamfer_emd.panels import in_metres, in_squares, metres, shared_places, squared
from lessons.chamfer_emd.point_sets import shuffled
from workbench.algorithms.transport import best_matching, earth_movers
from workbench.captions import counted
from workbench.geometry.motions import motion
from workbench.geometry.points.shape_distances import chamfer, index_mse, nearest_both_ways
from workbench.geometry.polylines import between
from workbench.lesson import Look, say
from workbench.numerals import ROUND_OFF
from workbench.scene import Caption, Chart, Label, Points, Primitive, Scene, Segments

COUNT = 12
ASIDE = 2.7  # metres to the right: where the second ring stands
T_WORLD = {"left": np.eye(4), "right": motion(np.eye(3), np.array([ASIDE, 0.0, 0.0]))}
PLACE, DOT = 0.075, 0.042  # metres: the radii of a place and of a dot
BOTH = Chart(
    "Both numbers of the heap",
    "dots heaped on the first",
    "% of the largest heap's",
    x_range=(0.0, 11.0),
)
CHAMFER = Chart("Chamfer", unit="m²")
EMD = Chart("Earth mover's", unit="m")
HEAPED = Chart("Heaped dots")
ROWS = Chart("Pairs by row", unit="m²")


def ring() -> np.ndarray:
    """Return the twelve places (12, 3), metres: the first one on top, the others clockwise."""
    turn = np.pi / 2 - 2 * np.pi * np.arange(COUNT) / COUNT
    return np.round(np.column_stack([np.cos(turn), np.sin(turn), np.zeros(COUNT)]), 12) + 0.0


def heap(dot: tuple[float, float], count: int) -> np.ndarray:
    """Return the dots (12, 3), of which the first is at `dot` and its next `count` with it."""
    p = ring()
    p[: count + 1] = np.array([*dot, 0.0])
    return p


@dataclass(frozen=True, eq=False)
class Twelve:
    """The places, and what our own functions say of each heap: Chamfer in m² and EMD in metres."""

    p_target: np.ndarray
    chamfer: np.ndarray
    earth_movers: np.ndarray

    @property
    def shares(self) -> tuple[float, float]:
        """What makes of either number per cent of what it is with all dots in one place."""
        return 100 / float(self.chamfer[-1]), 100 / float(self.earth_movers[-1])


@dataclass(frozen=True, eq=False)
class Held:
    """The dots with some of them heaped, in the order of their rows, and three numbers of them.

    Attributes:
        heaped: How many have joined the first one.
        p: Where they are.
        chamfer: m², by the function in its slot.
        earth_movers: Metres, by the function in its slot.
        by_row: The mean squared distance of rows with the same number, m².
    """

    heaped: int
    p: np.ndarray
    chamfer: float
    earth_movers: float
    by_row: float


def setup(params: Input) -> Twelve:
    """Return the places and the numbers of all heaps."""
    target = ring()
    heaps = [heap(params.dot, k) for k in range(COUNT)]
    return Twelve(
        target,
        np.array([chamfer(p, target) for p in heaps]),
        np.array([earth_movers(p, target) for p in heaps]),
    )


def run(params: Input, subject: Twelve, measures: Measures) -> Iterator[Held]:
    """Yield the heaps, from the first dot alone to all twelve on one place; where the rows are
    shuffled, behind the dots in their order.
    """
    target = subject.p_target
    heaps = [(k, heap(params.dot, k)) for k in range(COUNT)]
    if params.shuffled:
        rng = np.random.default_rng(params.seed)
        rows = shuffled(np.arange(float(COUNT))[:, None], 1.0, rng)[:, 0].astype(np.intp)
        heaps = [heaps[0], *((k, p[rows]) for k, p in heaps)]
    for k, p in heaps:
        yield Held(
            k,
            p,
            measures.chamfer(p, target),
            measures.earth_movers(p, target),
            index_mse(p, target),
        )


def draw(look: Look[Input, Twelve, Held]) -> Scene:
    """Return both rings with the partners that each rule gives, and both numbers over the heap."""
    state = look.now
    target = look.subject.p_target
    near, matching = nearest_both_ways(state.p, target), best_matching(state.p, target)
    heaps = np.arange(float(COUNT))
    of_chamfer, of_emd = look.subject.shares
    scene: Scene = {
        **_ring("left", state, target),
        **_ring("right", state, target),
        "right/pairs": _lines(
            state.p[matching.i_a], target[matching.i_b], "right", name="one each"
        ),
        **_titled("right", "one for each", metres(state.earth_movers)),
        "chamfer/whole": BOTH.whole(heaps, of_chamfer * look.subject.chamfer, "Chamfer", "source"),
        "chamfer/mark": BOTH.mark(
            state.heaped, of_chamfer * state.chamfer, "here", "source", steps="heaped"
        ),
        "emd/whole": BOTH.whole(
            heaps, of_emd * look.subject.earth_movers, "earth mover's", "highlight"
        ),
        "emd/mark": BOTH.mark(
            state.heaped, of_emd * state.earth_movers, "here", "highlight", steps="heaped"
        ),
        "heaped": HEAPED.scalar(state.heaped, "heaped"),
        "chamfer": CHAMFER.scalar(state.chamfer, "Chamfer"),
        "emd": EMD.scalar(state.earth_movers, "earth mover's", "highlight"),
        "rows": ROWS.scalar(state.by_row, "by row", "highlight"),
        "caption": caption(look.params, state),
    }
    if look.params.shuffled:
        by_row = _lines(state.p, target, "left", name="the same row")
        return scene | {"left/rows": by_row, **_titled("left", "row by row", squared(state.by_row))}
    return scene | {
        "left/to target": _lines(state.p, target[near.a_to_b], "left", name="nearest of a dot"),
        "left/to source": Segments(
            between(target, state.p[near.b_to_a]), "other", 3.0, name="nearest of a place"
        ),
        **_titled("left", "take the nearest", squared(state.chamfer)),
    }


def _ring(side: str, state: Held, target: np.ndarray) -> dict[str, Primitive]:
    """Return the places and the dots of one panel, and how many share a place."""
    T = T_WORLD[side]
    named = side == "left"
    above = np.array([0.0, 0.0, 0.02])
    first, counts = shared_places(state.p, 1e-6)
    scene: dict[str, Primitive] = {
        f"{side}/target": Points(target, "target", PLACE, T, name="places" if named else ""),
        f"{side}/source": Points(state.p + above, "source", DOT, T, name="dots" if named else ""),
    }
    for i, count in zip(first.tolist(), counts.tolist(), strict=True):
        if count > 1:
            scene[f"{side}/heap"] = Label(
                f"{count} dots", state.p[i] + np.array([0.0, 0.16, 0.03]), "source", T
            )
    return scene


def _lines(p: np.ndarray, q: np.ndarray, side: str, *, name: str) -> Segments:
    return Segments(between(p, q), "correspondence", 3.0, T_WORLD[side], name=name)


def _titled(side: str, title: str, number: str) -> dict[str, Primitive]:
    T = T_WORLD[side]
    return {
        f"{side}/title": Label(title, np.array([0.0, -1.28, 0.0]), "neutral", T),
        f"{side}/number": Label(number, np.array([0.0, 0.0, 0.0]), "source", T),
    }


def caption(params: Input, state: Held) -> Caption:
    """Say what both rules make of the dots."""
    values: dict[str, Any] = {
        "chamfer": in_squares(state.chamfer),
        "emd": in_metres(state.earth_movers),
    }
    if params.shuffled and state.by_row > ROUND_OFF:
        return say(
            "Pairs by row say {rows}. Chamfer says {chamfer} and earth mover's {emd}.",
            rows=in_squares(state.by_row),
            **values,
        )
    if state.earth_movers < ROUND_OFF:
        return say("Every dot is at home: both numbers are 0.")
    return say(
        "{dots} in one place: Chamfer says {chamfer}, earth mover's {emd}.",
        dots=counted(state.heaped + 1, "dot", "dots"),
        **values,
    )
