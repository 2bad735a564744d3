"""The stage `far dot`: one point of a ring is moved away from it, and three numbers answer, each in
units of what it says of the ring 5 % larger.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from lessons.chamfer_emd.bunch import LARGER
from lessons.chamfer_emd.distances import Measures
from lessons.chamfer_emd.inputs import Input
from lessons.chamfer_emd.panels import disc, nearer
from lessons.chamfer_emd.point_sets import grown, spread, with_outlier
from workbench.algorithms.transport import earth_movers
from workbench.captions import metres
from workbench.geometry.points.shape_distances import chamfer, hausdorff
from workbench.geometry.polylines import fan
from workbench.lesson import Look, cached, say
from workbench.numerals import brief
from workbench.scene import (
    Caption,
    Chart,
    Label,
    Mesh,
    Points,
    Primitive,
    Role,
    Scene,
    Segments,
    circle,
    dimension,
)

FAR = np.round(np.arange(0.0, 1.81, 0.1), 1)
NAMES = ("Hausdorff", "Chamfer", "EMD")
ROLES: tuple[Role, ...] = ("wrong", "source", "highlight")
TIMES = Chart(
    "Times the ring 5 % larger", "how far off the dot is", "×", x_range=(0.0, 1.8), x_unit="m"
)
OFF = Chart("Off", unit="m")
# metres: where the bars stand, how wide they are and how far apart, and their height per 1 ×
FOOT = np.array([1.75, 0.0, -0.75])
WIDE, APART, TALL = 0.3, 0.85, 0.065


@dataclass(frozen=True, eq=False)
class Ring:
    """The ring, and what our functions say at each of FAR over what they say of the ring larger.

    Attributes:
        p_target: The ring (n, 3).
        p_larger: The same 5 % larger.
        times: Hausdorff, Chamfer and earth mover's (3, k), in units of the larger ring's.
    """

    p_target: np.ndarray
    p_larger: np.ndarray
    times: np.ndarray


@dataclass(frozen=True, eq=False)
class Held:
    """One distance of the dot, metres, and the three numbers in units of the larger ring's.

    Attributes:
        off: How far the dot is from its place.
        p: The cloud.
        times: Hausdorff, Chamfer and earth mover's (3,), the last two by the functions in their
            slots.
    """

    off: float
    p: np.ndarray
    times: np.ndarray


@cached
def setup(params: Input) -> Ring:
    """Return the ring, and the three numbers for all distances of its dot."""
    target = spread("ring", params.points)
    larger = grown(target, LARGER)
    ours = Measures(chamfer, earth_movers, chamfer)
    of = [
        in_units(with_outlier(target, far), target, larger, measures=ours) for far in FAR.tolist()
    ]
    return Ring(target, larger, np.array(of).T)


def in_units(
    p: np.ndarray, p_target: np.ndarray, p_larger: np.ndarray, *, measures: Measures
) -> np.ndarray:
    """Return Hausdorff, Chamfer and earth mover's of a cloud over those of the larger target."""
    pairs = [
        (name(p, p_target), name(p_larger, p_target))
        for name in (hausdorff, measures.chamfer, measures.earth_movers)
    ]
    return np.array([here / larger if larger else np.nan for here, larger in pairs])


def run(params: Input, ring: Ring, measures: Measures) -> Iterator[Held]:
    """Yield the cloud with its dot ever farther away."""
    for far in FAR.tolist():
        p = with_outlier(ring.p_target, far)
        yield Held(far, p, in_units(p, ring.p_target, ring.p_larger, measures=measures))


def draw(look: Look[Input, Ring, Held]) -> Scene:
    """Return the ring with its dot, three bars, and the three curves over the distance."""
    state, ring = look.now, look.subject
    i = int(np.argmax(state.p[:, 2]))
    radius = disc(len(state.p))
    home = ring.p_target[i]
    scene: Scene = {
        "target": Points(ring.p_target, "target", radius, name="ring"),
        "source": Points(nearer(np.delete(state.p, i, axis=0)), "source", 0.5 * radius),
        "dot": Points(nearer(state.p[i : i + 1]), "source", 1.6 * radius, name="the far dot"),
        "larger": circle(
            np.array([0.0, 0.02, 0.0]),
            np.array([0.0, 1.0, 0.0]),
            1.0 + LARGER,
            "truth",
            width=2.0,
            name="the ring 5 % larger",
        ),
        **dimension("off", home, state.p[i], aside=np.array([-0.14, 0.0, 0.0])),
        "distance": OFF.scalar(state.off, "off"),
        "caption": caption(state),
    }
    for k, (name, role) in enumerate(zip(NAMES, ROLES, strict=True)):
        scene |= _bar(k, name, role, times=float(state.times[k]))
        scene[f"times/{name}"] = TIMES.whole(FAR, ring.times[k], name, role)
        if np.isfinite(state.times[k]):
            scene[f"mark/{name}"] = TIMES.mark(
                state.off, float(state.times[k]), name, role, steps="off"
            )
        scene[f"value/{name}"] = TIMES.scalar(float(state.times[k]), name, role)
    return scene


def _bar(k: int, name: str, role: Role, *, times: float) -> dict[str, Primitive]:
    """Return one bar: its height is the number, its foot has the name."""
    foot = FOOT + np.array([k * APART, 0.0, 0.0])
    tall = TALL * times if np.isfinite(times) else 0.0
    corners = (
        np.array([[0.0, 0.0, 0.0], [WIDE, 0.0, 0.0], [WIDE, 0.0, tall], [0.0, 0.0, tall]])
        + foot
        - np.array([WIDE / 2, 0.0, 0.0])
    )
    text = f"{brief(times, 2)} ×" if np.isfinite(times) else "–"
    return {
        f"bar/{name}": Mesh(corners, fan(4), role, flat=True),
        f"bar line/{name}": Segments(np.array([[corners[0], corners[1]]]), role, 3.0),
        f"bar name/{name}": Label(name, foot - np.array([0.0, 0.0, 0.16]), role),
        f"bar value/{name}": Label(text, foot + np.array([0.0, 0.0, tall + 0.13]), role),
    }


def caption(state: Held) -> Caption:
    """Say how far off the dot is."""
    if state.off == 0:
        return say("Every dot is at home.")
    return say(
        "One dot is {off} off, the other {others} are at home.",
        off=metres(state.off),
        others=len(state.p) - 1,
    )
