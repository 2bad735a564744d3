"""The stage `paper`: six paper triangles around a point, and a hand that drags their gap through
zero.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from lessons.curvature.functions import Functions
from lessons.curvature.inputs import Input
from workbench.captions import degrees, metres
from workbench.geometry.polylines import between, fan, segments
from workbench.lesson import Look, say
from workbench.scene import Caption, Chart, Label, Mesh, Points, Primitive, Scene, Segments, arc

TRIANGLES = 6
PLACES = {-60.0: "saddle", 0.0: "flat", 60.0: "cone"}
HAND = np.arange(-90.0, 91.0, 3.0)  # degrees: the gaps that the hand goes through
FINE = np.arange(-90.0, 90.5, 1.0)
AZIMUTH = 2 * np.pi * np.arange(TRIANGLES) / TRIANGLES
FLAT = np.array([2.35, 0.0, 0.0])  # metres: where the flat ring stands, facing the viewer
GAP = Chart("Gap", unit="deg")
HEIGHT = Chart("Height of the ring", "gap", "m", x_range=(-90.0, 90.0), x_unit="deg")


@dataclass(frozen=True)
class Sheet:
    """The paper: its triangles have two edges of one metre, which meet at the point."""

    edge: float = 1.0


@dataclass(frozen=True)
class Held:
    """One ring of paper: the angle that is missing around its point, degrees; negative where there
    is too much.
    """

    gap: float

    @property
    def angle(self) -> float:
        """The angle of each triangle at the point, degrees."""
        return (360.0 - self.gap) / TRIANGLES


def setup(params: Input) -> Sheet:
    """Return the paper."""
    return Sheet()


def run(params: Input, subject: Sheet, functions: Functions) -> Iterator[Held]:
    """Yield the rings from the largest overlap to the largest gap."""
    for gap in HAND:
        yield Held(float(gap))


def rim(gap: float) -> np.ndarray:
    """Return the corners (6, 3) of the ring that stands in space, its point at the origin.

    With a gap it is a cone. With an overlap every other corner goes up and the others down, so that
    neighbours make the angle of a triangle: cos(angle) = (1 - s^2) / 2 - s^2 for corners at +-s.
    """
    angle = np.radians((360.0 - gap) / TRIANGLES)
    if gap >= 0:
        height = -np.sqrt(max(0.0, 1.0 - 4.0 * np.sin(angle / 2) ** 2)) * np.ones(TRIANGLES)
    else:
        height = np.sqrt((1.0 - 2.0 * np.cos(angle)) / 3.0) * (-1.0) ** np.arange(TRIANGLES)
    radius = np.sqrt(1.0 - height**2)
    return np.stack([radius * np.cos(AZIMUTH), radius * np.sin(AZIMUTH), height], axis=1)


def height_of(gap: float) -> float:
    """Return how high the ring is from its lowest to its highest point, metres."""
    z = np.append(rim(gap)[:, 2], 0.0)
    return float(np.ptp(z))


HEIGHTS = np.array([height_of(gap) for gap in FINE])


def spokes(state: Held) -> np.ndarray:
    """Return the seven directions (7, 3) of the flat ring's edges; the first and the last are one
    edge, cut.
    """
    turn = np.pi / 2 + np.radians(state.gap / 2 + state.angle * np.arange(TRIANGLES + 1))
    return np.stack([np.cos(turn), np.zeros(len(turn)), np.sin(turn)], axis=1)


def draw(look: Look[Input, Sheet, Held]) -> Scene:
    """Return the ring in space, the same ring laid flat beside it, and its height over the gap."""
    state = look.now
    p = np.vstack([np.zeros(3), rim(state.gap), rim(state.gap)[:1]])
    height = height_of(state.gap)
    scene: dict[str, Primitive] = {
        "ring": Mesh(p, fan(len(p)), "highlight", opacity=0.8, flat=True, name="ring of paper"),
        "ring edges": Segments(
            np.concatenate([between(p[0], p[1:-1]), segments(p[1:])]), "neutral", 2.5
        ),
        "tip": Points(np.zeros((1, 3)), "truth", 0.035, name="the point"),
    }
    return (
        scene
        | _flat(state)
        | {
            "gap scalar": GAP.scalar(state.gap, "gap"),
            "height/whole": HEIGHT.whole(FINE, HEIGHTS, "height of the ring", "highlight"),
            "height/mark": HEIGHT.mark(state.gap, height, "your hand", "source", steps="gap"),
            "caption": caption(look),
        }
    )


def _flat(state: Held) -> dict[str, Primitive]:
    along = spokes(state)
    lift = np.zeros((len(along), 3))
    if state.gap < 0:  # faces that overlap are kept apart
        lift[:, 1] = -0.01 * np.arange(len(along))
    p = np.vstack([FLAT, FLAT + along + lift])
    scene: dict[str, Primitive] = {
        "flat ring": Mesh(
            p, fan(len(p)), "highlight", opacity=0.45, flat=True, name="the same ring, laid flat"
        ),
        "flat edges": Segments(
            np.concatenate([between(p[0], p[1:]), segments(p[1:])]), "neutral", 2.0
        ),
        "cut": Segments(between(p[0], p[[1, -1]]), "other", 4.0, name="the edge that is cut"),
    }
    if state.gap == 0:
        scene["gap words"] = Label("no gap", FLAT + np.array([0.0, -0.05, 1.12]), "other")
        return scene
    word = "gap" if state.gap > 0 else "overlap"
    # From the last edge on to the first one; the axis points at the viewer.
    return scene | arc(
        "gap",
        FLAT + np.array([0.0, -0.08, 0.0]),
        along[-1],
        state.gap,
        about=np.array([0.0, -1.0, 0.0]),
        radius=0.75,
        color="other",
        text=f"{word} {abs(state.gap):.0f}°",
    )


def caption(look: Look[Input, Sheet, Held]) -> Caption:
    """Say what the ring is, and the angle that makes it so."""
    state = look.now
    angle = degrees(state.angle)
    place = PLACES.get(state.gap, "")
    if state.gap == 0:
        return say(
            "Six angles of {angle} make a full turn: the ring lies flat.", angle=angle, place=place
        )
    if state.gap > 0:
        return say(
            "Six angles of {angle} leave a gap of {gap}. Closed, they make a cone {height} high.",
            angle=angle,
            gap=degrees(state.gap),
            height=metres(height_of(state.gap)),
            place=place,
        )
    return say(
        "Six angles of {angle} overlap by {overlap}. In space they make a saddle {height} high.",
        angle=angle,
        overlap=degrees(-state.gap),
        height=metres(height_of(state.gap)),
        place=place,
    )
