"""The stage `flat`: the rabbit's outline twice, tied by twelve bands, and a hand that turns one
of them.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from workbench.algorithms.turning import best_turn, cost_of_pairs, turned, within_half
from workbench.captions import degrees, metres
from workbench.data.rabbit_outline import along, rabbit_outline
from workbench.geometry.polylines import between
from workbench.geometry.upright import dial_arc, on_dial, outlined, upright, upright_turn
from workbench.lesson import Look, Params, say
from workbench.scene import Chart, Label, Points, Scene, Segments

BANDS = 12
HAND = np.arange(-180.0, 181.0, 3.0)  # degrees: where the hand has been after a full turn
FINE = np.arange(-180.0, 180.5, 1.0)
DIAL, MARK = 0.72, 0.045  # metres: the radius of the dial, and half of a mark on it
OUTLINE = 0.6  # opacity: seen in the dark too
PULL = Chart(
    "RMSE of the bands", "how far orange is turned", "m", x_range=(-180.0, 180.0), x_unit="deg"
)
ANGLE = Chart("Angle", unit="deg")


@dataclass(frozen=True, eq=False)
class Bands:
    """Two outlines about their common middle, metres in the plane of the drawing.

    Attributes:
        p_target: The blue ends of the bands.
        p_source: The orange ends, before the turn.
        target_line: The blue outline.
        source_line: The orange one.
        rmse: The root mean square length of the bands, at each of FINE.
        best: The angle at which it is least, degrees.
    """

    p_target: np.ndarray
    p_source: np.ndarray
    target_line: np.ndarray
    source_line: np.ndarray
    rmse: np.ndarray
    best: float


@dataclass(frozen=True)
class Held:
    """One angle at which the hand holds the orange outline, degrees, and the RMSE of the bands,
    metres.
    """

    angle: float
    rmse: float


def bands_of(pull: float) -> Bands:
    """Return the outlines and their bands; the highest blue end is pulled aside by so many
    metres.
    """
    line = rabbit_outline()
    p_source = along(line, BANDS)
    p_target = p_source.copy()
    p_target[p_target[:, 1].argmax(), 0] -= pull
    middle, m_target = p_source.mean(axis=0), p_target.mean(axis=0)
    p_source, p_target = p_source - middle, p_target - m_target
    return Bands(
        p_target=p_target,
        p_source=p_source,
        target_line=line - m_target,
        source_line=line - middle,
        rmse=cost_of_pairs(p_target, p_source, FINE),
        best=best_turn(p_target, p_source),
    )


def hand(bands: Bands) -> Iterator[Held]:
    """Yield the angles of a full turn, one after the other."""
    for angle in HAND:
        yield Held(float(angle), float(cost_of_pairs(bands.p_target, bands.p_source, float(angle))))


def draw(look: Look[Params, Bands, Held]) -> Scene:
    """Return both outlines, their bands, the dial, and the pull over the angle."""
    bands, held = look.subject, look.now
    T_turn = upright_turn(held.angle)
    shown = within_half(held.angle)
    moved = turned(bands.p_source, held.angle)
    tick = np.array([[0.0, DIAL - MARK], [0.0, DIAL + MARK]])
    return {
        "dial": Segments(dial_arc(-180.0, 180.0, DIAL), "neutral", 1.0, opacity=0.35),
        "turn": Segments(dial_arc(0.0, shown, DIAL, depth=0.002), "source", 4.0),
        "true mark": Segments(upright(tick, 0.003)[None], "target", 4.0),
        "turn mark": Segments(upright(tick, 0.003)[None], "source", 4.0, T_turn),
        "turn name": Label(
            f"{abs(shown):.0f}°", upright(on_dial(np.array([shown / 2]), DIAL + 0.08))[0], "source"
        ),
        "target line": Segments(outlined(bands.target_line, -0.01), "target", 2.0, opacity=OUTLINE),
        "source line": Segments(
            outlined(bands.source_line, -0.008), "source", 2.0, T_turn, opacity=OUTLINE
        ),
        "target": Points(upright(bands.p_target, 0.004), "target", 0.016, name="blue ends"),
        "source": Points(
            upright(bands.p_source, 0.008), "source", 0.016, T_turn, name="orange ends"
        ),
        "bands": Segments(
            between(upright(moved, -0.004), upright(bands.p_target, -0.004)),
            "correspondence",
            2.5,
            opacity=0.8,
            name="rubber bands",
        ),
        "caption": say(
            "Turned by {angle}, the bands have an RMSE of {rmse}.",
            angle=degrees(shown),
            rmse=metres(held.rmse),
        ),
        "angle": ANGLE.scalar(held.angle, "angle"),
        "pull/curve": PULL.whole(FINE, bands.rmse, "RMSE of the bands", "source"),
        "pull/ball": PULL.mark(held.angle, held.rmse, "your hand", "source", steps="angle"),
    }
