"""The stage `flat`: two outlines about one middle. Only a turn is missing, so the cost is a
curve.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from lessons.icp.inputs import Input
from workbench.algorithms import turning
from workbench.algorithms.turning import (
    State,
    best_turn,
    cost,
    cost_of_pairs,
    icp_turn,
    turned,
    within_half,
)
from workbench.captions import Quantity, degrees
from workbench.data.rabbit_outline import along, normals_along, rabbit_outline
from workbench.geometry.polylines import between, segments
from workbench.geometry.upright import dial_arc, on_dial, outlined, upright, upright_turn
from workbench.lesson import Look, cached, say
from workbench.numerals import brief
from workbench.scene import Caption, Chart, Classes, Label, Points, Primitive, Scene, Segments

# points of either outline, and how far the orange ones lie between
BLUE = 60
ORANGE = 50
OFFSET = 0.4
HAND = np.arange(-180.0, 181.0, 3.0)  # degrees: where the hand has been after a full turn
FINE = np.arange(-180.0, 180.5, 1.0)
HOME = 5.0  # degrees within which an end counts as home
DIAL, MARK = 0.72, 0.045  # metres: the radius of the dial, and half of a mark on it
OUTLINE = 0.6  # opacity: seen in the dark too
MM = 1000.0
COST = Chart(
    "Cost of a turn",
    "how far orange is turned",
    "mm",
    x_range=(-180.0, 180.0),
    near=(20.0, 70.0),
    x_unit="deg",
    y_range=(0.0, 150.0),
)
ANGLE, RMSE = Chart("Angle", unit="deg"), Chart("RMSE", unit="m")
SWING = Chart("Swing of each fit", unit="deg")
ROUND = Chart("Round")
BASIN = Chart("Basin", unit="deg")


@dataclass(frozen=True, eq=False)
class Outlines:
    """Two outlines of the rabbit about their common middle, metres in the plane of the drawing.

    Attributes:
        p_target: The blue points.
        n_target: Their unit normals.
        p_source: The orange points, before the turn.
        target_line: The blue outline.
        source_line: The orange one.
        gap: The distance between neighbouring blue points.
        rmse: From the orange points to the nearest blue ones, at each of FINE.
        basin: The lowest and highest start, around 0, from which ICP comes home, degrees.
    """

    p_target: np.ndarray
    n_target: np.ndarray
    p_source: np.ndarray
    target_line: np.ndarray
    source_line: np.ndarray
    gap: float
    rmse: np.ndarray
    basin: tuple[float, float]

    def right(self, partners: np.ndarray) -> np.ndarray:
        """Return which partners lie within one gap of where the orange point belongs."""
        return np.linalg.norm(self.p_target[partners] - self.p_source, axis=1) <= self.gap


@cached
def outlines(params: Input) -> Outlines:
    """Return the outlines, their cost at every angle, and the basin of ICP with the params' fit."""
    line = rabbit_outline()
    p_target = along(line, BLUE)
    p_source = along(line, ORANGE, OFFSET)
    n_target = normals_along(p_target)
    m_target, m_source = p_target.mean(axis=0), p_source.mean(axis=0)
    p_target, p_source = p_target - m_target, p_source - m_source
    n_used = n_target if params.fit == "point-to-plane" else None

    def end_of(start: float) -> float:
        *_, end = icp_turn(p_target, p_source, start, n_target=n_used)
        return end.angle

    return Outlines(
        p_target=p_target,
        n_target=n_target,
        p_source=p_source,
        target_line=line - m_target,
        source_line=line - m_source,
        gap=float(np.median(np.linalg.norm(np.diff(p_target, axis=0), axis=1))),
        rmse=np.array([cost(p_target, p_source, float(angle)) for angle in FINE]),
        basin=turning.basin(end_of, within=HOME),
    )


def run(params: Input, subject: Outlines) -> Iterator[State]:
    """Yield the angles of a hand that turns once around, or the sub-steps of ICP."""
    if params.by == "icp":
        n_target = subject.n_target if params.fit == "point-to-plane" else None
        start = params.start_angle
        yield from icp_turn(subject.p_target, subject.p_source, start, n_target=n_target)
        return
    for angle in HAND:
        p = turned(subject.p_source, float(angle))
        partners = turning.nearest(subject.p_target, p)
        rmse = cost(subject.p_target, subject.p_source, float(angle))
        yield State("match", 0, float(angle), partners, 0.0, rmse)


def draw(look: Look[Input, Outlines, State]) -> Scene:
    """Return both outlines, each partner, the dial, and the cost over the angle."""
    lines, state = look.subject, look.now
    T_turn = upright_turn(state.angle)
    shown = within_half(state.angle)
    p_moved = turned(lines.p_source, state.angle)
    q = lines.p_target[state.partners]
    tick = np.array([[0.0, DIAL - MARK], [0.0, DIAL + MARK]])
    asked = state.iteration == 1 and state.phase == "match"  # a question asks how many are right
    good = lines.right(state.partners) & (not asked)
    color = Classes.marking(good, "truth", "right partner", others=("correspondence", "partner"))
    scene: dict[str, Primitive] = {
        "dial": Segments(dial_arc(-180.0, 180.0, DIAL), "neutral", 1.0, opacity=0.35),
        "turn": Segments(dial_arc(0.0, shown, DIAL, depth=0.002), "source", 4.0),
        "true mark": Segments(upright(tick, 0.003)[None], "truth", 4.0),
        "turn mark": Segments(upright(tick, 0.003)[None], "source", 4.0, T_turn),
        "turn name": Label(
            f"{abs(shown):.0f}°", upright(on_dial(np.array([shown / 2]), DIAL + 0.08))[0], "source"
        ),
        "target line": Segments(outlined(lines.target_line, -0.01), "target", 2.0, opacity=OUTLINE),
        "source line": Segments(
            outlined(lines.source_line, -0.008), "source", 2.0, T_turn, opacity=OUTLINE
        ),
        "target": Points(upright(lines.p_target, 0.004), "target", 0.0125, name="target"),
        "source": Points(upright(lines.p_source, 0.008), "source", 0.0115, T_turn, name="source"),
        "partners": Segments(
            between(upright(p_moved, -0.004), upright(q, -0.004)), color, 2.5, opacity=0.8
        ),
        "caption": caption(look),
        "angle": ANGLE.scalar(state.angle, "angle"),
        "rmse": RMSE.scalar(state.rmse, "RMSE of the partners"),
    }
    if state.iteration:
        low, high = lines.basin
        swing = abs(state.turned) if state.phase == "fit" else np.nan
        scene |= {
            "turned": SWING.scalar(swing, "swing"),
            "round": ROUND.scalar(state.iteration, "round"),
            "basin/from": BASIN.scalar(low, "from", "truth"),
            "basin/to": BASIN.scalar(high, "to", "truth"),
        }
    if asked:
        scene |= _ring(p_moved, q)
    return scene | _landscape(look, shown)


def _landscape(look: Look[Input, Outlines, State], shown: float) -> dict[str, Primitive]:
    """Return the cost over the angle, where we stand in it, and what the frozen partners say."""
    lines, state = look.subject, look.now
    parts: dict[str, Primitive] = {"cost/curve": COST.whole(FINE, MM * lines.rmse, "true cost")}
    if state.iteration == 0:
        ball = COST.mark(shown, MM * state.rmse, "ball", steps="angle")
        return parts | {"cost/ball": ball}
    q = lines.p_target[state.partners]
    # its lowest point is computed, not looked up
    x = np.union1d(HAND, best_turn(q, lines.p_source))
    frozen = cost_of_pairs(q, lines.p_source, x)
    return parts | {
        "cost/frozen": COST.second(x, MM * frozen, "partners frozen"),
        "cost/ball": COST.mark(shown, MM * state.rmse, "ball", knob="start_angle"),
        "cost/basin": COST.band(*lines.basin, "comes home from here"),
    }


def _ring(p_moved: np.ndarray, q: np.ndarray) -> dict[str, Primitive]:
    """Return a circle around the point whose partner is farthest: nothing blue lies inside it."""
    gaps = np.linalg.norm(p_moved - q, axis=1)
    farthest = int(gaps.argmax())
    p_one = p_moved[farthest]
    radius = float(gaps[farthest])
    circle = p_one + on_dial(np.linspace(0.0, 360.0, 73), radius)
    name = on_dial(np.array([180.0]), 0.86 * DIAL)  # below both outlines
    return {
        "ring/circle": Segments(segments(upright(circle, 0.01)), "neutral", 1.5, opacity=0.8),
        "ring/name": Label("nothing blue is nearer", upright(name)[0]),
    }


def millimetres(metres: float) -> Quantity:
    """Return a length as the chart has it."""
    return Quantity(metres, f"{brief(MM * metres)} mm")


def caption(look: Look[Input, Outlines, State]) -> Caption:
    """Return what just happened, with the number that changed."""
    lines, state = look.subject, look.now
    if state.iteration == 0:
        return say(
            "Turned by {angle}, the lines have an RMSE of {rmse}.",
            angle=degrees(within_half(state.angle)),
            rmse=millimetres(state.rmse),
        )
    if state.phase == "match" and state.iteration == 1:
        return say("Match {n}: every orange point takes the nearest blue one.", n=1, place="match")
    if state.phase == "match":
        return say(
            "Match {n}: {good} of {points} partners are right.",
            n=state.iteration,
            good=int(lines.right(state.partners).sum()),
            points=len(lines.p_source),
            place="match",
        )
    if state.stop is None:
        words = "Fit {n} turns the rabbit by {turned}."
        return say(words, n=state.iteration, turned=degrees(abs(state.turned)), place="fit")
    at = within_half(state.angle)
    return say(
        "It comes to rest at {at} after {n} rounds, with an RMSE of {rmse}.",
        right=abs(at) <= HOME,
        settled=True,
        at=degrees(at),
        n=state.iteration,
        rmse=millimetres(state.rmse),
        place="fit",
    )
