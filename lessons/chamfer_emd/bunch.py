"""The stage `bunch`: ever more of a ring's points in one bunch, beside the ring 5 % larger, and
which of the two is closer by which number.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from lessons.chamfer_emd.distances import Measures
from lessons.chamfer_emd.inputs import Input
from lessons.chamfer_emd.panels import (
    T_WORLD_LEFT,
    T_WORLD_RIGHT,
    clouds_in,
    clumps,
    disc,
    in_metres,
    in_squares,
    metres,
    squared,
    titled,
)
from lessons.chamfer_emd.point_sets import bunched, grown, spread
from workbench.algorithms.transport import best_matching, earth_movers
from workbench.captions import share
from workbench.geometry.points.shape_distances import chamfer
from workbench.geometry.polylines import between
from workbench.lesson import Look, cached, say
from workbench.numerals import ROUND_OFF
from workbench.scene import Caption, Chart, Label, Primitive, Role, Scene, Segments

SHARES = np.round(np.arange(0.0, 0.96, 0.05), 2)
LARGER = 0.05
MOST = 3.0  # times: what is above leaves the chart
TIMES = Chart(
    "Times the number of L",
    "points in the bunch",
    "×",
    x_range=(0.0, 95.0),
    x_unit="%",
    y_range=(0.0, MOST),
)
CHAMFER = Chart("Chamfer", unit="m²")
EMD = Chart("Earth mover's", unit="m")
SHARE = Chart("Bunched", unit="%")


@dataclass(frozen=True, eq=False)
class Rings:
    """The ring, the ring 5 % larger, and what our own functions say of every bunch and of it.

    Attributes:
        p_target: The ring.
        p_larger: The larger one.
        chamfer, earth_movers: Of the ring with each of SHARES in one bunch; m² and metres.
        larger_chamfer, larger_emd: Of the larger one.
    """

    p_target: np.ndarray
    p_larger: np.ndarray
    chamfer: np.ndarray
    earth_movers: np.ndarray
    larger_chamfer: float
    larger_emd: float


@dataclass(frozen=True, eq=False)
class Held:
    """A share of the points in one bunch, and both numbers of the cloud and of the larger ring.

    Attributes:
        share: From 0 to 1.
        p: The cloud.
        chamfer, earth_movers: Of it, by the functions in their slots; m² and metres.
        larger_chamfer, larger_emd: Of the ring 5 % larger, likewise.
    """

    share: float
    p: np.ndarray
    chamfer: float
    earth_movers: float
    larger_chamfer: float
    larger_emd: float


@cached
def setup(params: Input) -> Rings:
    """Return both rings and the numbers of all bunches."""
    target = spread("ring", params.points)
    larger = grown(target, LARGER)
    clouds = [bunched("ring", params.points, float(part)) for part in SHARES]
    return Rings(
        p_target=target,
        p_larger=larger,
        chamfer=np.array([chamfer(p, target) for p in clouds]),
        earth_movers=np.array([earth_movers(p, target) for p in clouds]),
        larger_chamfer=chamfer(larger, target),
        larger_emd=earth_movers(larger, target),
    )


def run(params: Input, rings: Rings, measures: Measures) -> Iterator[Held]:
    """Yield the clouds with ever more points in the bunch."""
    target = rings.p_target
    larger = (
        measures.chamfer(rings.p_larger, target),
        measures.earth_movers(rings.p_larger, target),
    )
    for part in SHARES.tolist():
        p = bunched("ring", len(target), part)
        yield Held(part, p, measures.chamfer(p, target), measures.earth_movers(p, target), *larger)


def draw(look: Look[Input, Rings, Held]) -> Scene:
    """Return the bunched cloud and the larger ring beside it, and both numbers over the share."""
    state, rings = look.now, look.subject
    x = 100 * SHARES
    here = 100 * state.share
    return {
        **_cloud("left", state.p, rings, T=T_WORLD_LEFT),
        **_cloud("right", rings.p_larger, rings, T=T_WORLD_RIGHT),
        **clumps("left", state.p, 0.5 * disc(len(state.p)), T_world_side=T_WORLD_LEFT),
        **_count(state),
        **titled(
            "left", "B: a bunch", both(state.chamfer, state.earth_movers), T_world_side=T_WORLD_LEFT
        ),
        **titled(
            "right",
            "L: 5 % larger",
            both(state.larger_chamfer, state.larger_emd),
            T_world_side=T_WORLD_RIGHT,
        ),
        "larger": TIMES.second(x, np.ones(len(x)), "L", "truth"),
        "chamfer/whole": TIMES.whole(x, rings.chamfer / rings.larger_chamfer, "Chamfer", "source"),
        "emd/whole": TIMES.whole(x, rings.earth_movers / rings.larger_emd, "EMD", "highlight"),
        **_marks(state),
        "bunched": SHARE.scalar(here, "bunched"),
        "chamfer": CHAMFER.scalar(state.chamfer, "Chamfer"),
        "emd": EMD.scalar(state.earth_movers, "earth mover's", "highlight"),
        "caption": caption(state),
    }


def _marks(state: Held) -> dict[str, Primitive]:
    """Return both numbers of this bunch in units of those of the larger ring."""
    pairs: tuple[tuple[str, float, float, Role], ...] = (
        ("Chamfer", state.chamfer, state.larger_chamfer, "source"),
        ("EMD", state.earth_movers, state.larger_emd, "highlight"),
    )
    return {
        f"{name.lower()}/mark": TIMES.mark(
            100 * state.share, here / larger, name, role, steps="bunched"
        )
        for name, here, larger, role in pairs
        if larger
    }


def both(chamfer_now: float, emd_now: float) -> tuple[str, str]:
    """Return both numbers of a cloud, as stand over a panel."""
    return f"Chamfer {squared(chamfer_now)}", f"EMD {metres(emd_now)}"


def _cloud(side: str, p: np.ndarray, rings: Rings, *, T: np.ndarray) -> dict[str, Primitive]:
    """Return the ring, a cloud over it, and the partners that one to one gives."""
    matching = best_matching(p, rings.p_target)
    return {
        **clouds_in(side, p, rings.p_target, T_world_side=T),
        f"{side}/pairs": Segments(
            between(p[matching.i_a], rings.p_target[matching.i_b]),
            "correspondence",
            1.5,
            T,
            0.7,
            name="one to one" if side == "left" else "",
        ),
    }


def _count(state: Held) -> dict[str, Primitive]:
    """Return the number of points in the bunch, written inside the ring."""
    crowd = round(state.share * len(state.p))
    if crowd < 2:
        return {}
    p = 0.72 * state.p[len(state.p) - crowd :].mean(axis=0)
    return {"left/bunch": Label(f"{crowd} points", p, "source", T_WORLD_LEFT)}


def caption(state: Held) -> Caption:
    """Say which of the two clouds is closer by which number."""
    values: dict[str, Any] = {
        "bunched": share(state.share),
        "chamfer": in_squares(state.chamfer),
        "emd": in_metres(state.earth_movers),
    }
    if state.earth_movers < ROUND_OFF:
        return say("No bunch yet: every point is at home.")
    if state.chamfer < state.larger_chamfer and state.earth_movers > state.larger_emd:
        return say(
            "{bunched} in a bunch: closer than L by Chamfer ({chamfer}), and farther by earth"
            " mover's ({emd}).",
            **values,
        )
    return say("{bunched} in a bunch: Chamfer {chamfer}, earth mover's {emd}.", **values)
