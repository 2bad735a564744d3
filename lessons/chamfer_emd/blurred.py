"""The stage `blur`: Sinkhorn's plan of two pairs of clouds, far and near, at ever more blur."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import scipy

from lessons.chamfer_emd.distances import Measures
from lessons.chamfer_emd.inputs import Input
from lessons.chamfer_emd.panels import (
    T_WORLD_LEFT,
    T_WORLD_RIGHT,
    clouds_in,
    in_metres,
    metres,
    titled,
)
from lessons.chamfer_emd.point_sets import blob, spread
from workbench.algorithms.transport import earth_movers, earth_movers_gradient
from workbench.algorithms.transport.flow import flow
from workbench.algorithms.transport.sinkhorn import sinkhorn
from workbench.captions import metres as length
from workbench.geometry.polylines import between
from workbench.lesson import Look, cached, say
from workbench.scene import Caption, Chart, Primitive, Role, Scene, Segments
from workbench.tracing import untraced

BLURS = np.array([0.01, 0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0, 1.4, 2.0])
DRAWN = 4  # the lines of every so many points are drawn
STRANDS = (("threads", 0.5, 1.0, 3.0), ("strands", 0.1, 0.7, 1.5), ("felt", 0.01, 0.35, 0.8))
"""Sets of lines: name, share of a point's mass from which they are drawn, opacity, pixels."""
PAIRS: tuple[tuple[str, Role], ...] = (("blob", "source"), ("almost at home", "other"))
COST = Chart("What Sinkhorn says", "blur", "m", x_range=(0.0, 2.0), x_unit="m")
BLUR = Chart("Blur", unit="m")


@dataclass(frozen=True, eq=False)
class Pairs:
    """A ring, a blob, and the cloud that flowed from the blob onto the ring.

    Attributes:
        p_target: The ring.
        p_far, p_near: The blob, and the cloud close to the ring.
        exact: The earth mover's distances of both, metres.
        costs: Sinkhorn's of both (k, 2), at each of BLURS.
        plans: The plans (n, m) of both at each, in shares of a point's mass.
    """

    p_target: np.ndarray
    p_far: np.ndarray
    p_near: np.ndarray
    exact: np.ndarray
    costs: np.ndarray
    plans: tuple[tuple[np.ndarray, np.ndarray], ...]


@dataclass(frozen=True, eq=False)
class Held:
    """One blur, metres; the costs (2,) of both plans, metres; and the plans (n, m), each in shares
    of a point's mass.
    """

    blur: float
    costs: np.ndarray
    plans: tuple[np.ndarray, np.ndarray]


@cached
def setup(params: Input) -> Pairs:
    """Return both pairs of clouds and what Sinkhorn says of them at every blur."""
    target = spread("ring", params.points)
    rng = np.random.default_rng(params.seed)
    far = blob(params.points, 0.3, True, rng=rng)
    with untraced():
        *_, end = flow(far, target, earth_movers, gradient=earth_movers_gradient, max_steps=40)
    both = far, end.p_moving
    exact = np.array([earth_movers(p, target) for p in both])
    results = [[cost_of(p, target, blur) for p in both] for blur in BLURS.tolist()]
    return Pairs(
        p_target=target,
        p_far=far,
        p_near=end.p_moving,
        exact=exact,
        costs=np.array([[cost for cost, _ in at] for at in results]),
        plans=tuple((far_at[1], near_at[1]) for far_at, near_at in results),
    )


def cost_of(p: np.ndarray, p_target: np.ndarray, blur: float) -> tuple[float, np.ndarray]:
    """Return the cost of Sinkhorn's plan, metres, and the plan in shares of a point's mass."""
    distances = scipy.spatial.distance.cdist(p, p_target)
    solution = sinkhorn(distances, blur, max_sweeps=200, tolerance=1e-4)
    return solution.cost(distances), len(p) * solution.plan(distances)


def run(params: Input, pairs: Pairs, measures: Measures) -> Iterator[Held]:
    """Yield the plans from the least blur to the most."""
    for blur, costs, plans in zip(BLURS.tolist(), pairs.costs, pairs.plans, strict=True):
        yield Held(blur, costs, plans)


def draw(look: Look[Input, Pairs, Held]) -> Scene:
    """Return both plans as lines, and what Sinkhorn says of both pairs over the blur."""
    state, pairs = look.now, look.subject
    level = np.ones(len(BLURS))
    scene: Scene = {
        **_pair("left", pairs.p_far, pairs.p_target, plan=state.plans[0], T=T_WORLD_LEFT),
        **_pair("right", pairs.p_near, pairs.p_target, plan=state.plans[1], T=T_WORLD_RIGHT),
        **titled("left", "a blob", _said(state, pairs, 0), T_world_side=T_WORLD_LEFT),
        **titled("right", "almost at home", _said(state, pairs, 1), T_world_side=T_WORLD_RIGHT),
        "blur": BLUR.scalar(state.blur, "blur"),
        "caption": caption(state),
    }
    for k, (name, role) in enumerate(PAIRS):
        scene[f"cost/{name}"] = COST.whole(BLURS, pairs.costs[:, k], name, role)
        scene[f"exact/{name}"] = COST.second(BLURS, level * pairs.exact[k], f"exact: {name}", role)
        scene[f"mark/{name}"] = COST.mark(state.blur, state.costs[k], "here", role, steps="blur")
        scene[f"said/{name}"] = COST.scalar(float(state.costs[k]), name, role)
    return scene


def _said(state: Held, pairs: Pairs, k: int) -> tuple[str, str]:
    return f"Sinkhorn {metres(state.costs[k])}", f"exact {metres(pairs.exact[k])}"


def _pair(
    side: str, p: np.ndarray, p_target: np.ndarray, *, plan: np.ndarray, T: np.ndarray
) -> dict[str, Primitive]:
    """Return a pair of clouds, and lines for the mass that goes between them."""
    scene = clouds_in(side, p, p_target, T_world_side=T)
    most = np.inf
    for name, least, opacity, width in STRANDS:
        i, j = np.nonzero((plan[::DRAWN] >= least) & (plan[::DRAWN] < most))
        most = least
        if len(i):
            scene[f"{side}/{name}"] = Segments(
                between(p[DRAWN * i], p_target[j]), "correspondence", width, T, opacity
            )
    return scene


def caption(state: Held) -> Caption:
    """Say what Sinkhorn makes of both pairs at this blur."""
    return say(
        "With a blur of {blur} Sinkhorn says {far} for the blob, and {near} for the cloud that is"
        " almost at home.",
        blur=length(state.blur),
        far=in_metres(state.costs[0]),
        near=in_metres(state.costs[1]),
    )
