"""The stage of one path: the best so far is carried along a row, and a jump has a price."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from lessons.disparity.above import stand
from lessons.disparity.inputs import Input
from lessons.disparity.matching import OTHER_COSTS
from lessons.disparity.pairs import Pictures
from lessons.disparity.row import FACING, LAYER, blocks, costs_of_row
from workbench.algorithms.stereo.cost_volume import CostVolume, sad_cost_volume
from workbench.algorithms.stereo.disparity import usual_penalties
from workbench.algorithms.stereo.semiglobal import path_costs, prepare
from workbench.captions import share
from workbench.geometry.motions import motion
from workbench.geometry.polylines import between
from workbench.lesson import Look, say
from workbench.scene import Chart, Field, Label, Picture, Points, Primitive, Scene, Segments

EVERY = 4  # columns a step
LEFT_EDGE = -1.6
WIDE = 3.2
# of the strip above the tape
ROWS = 15
TOP = 1.05
# where the tape begins, and about how high it is
FOOT = -0.95
HIGH = 1.5
DOT = 0.017
COLUMN = Chart("Column", unit="px")
WRONG = Chart("Wrong columns", unit="%")
SHARP = 480  # pixels across: so many at least, so that a column stays sharp


@dataclass(frozen=True, eq=False)
class Tape:
    """A row as a path sees it.

    Attributes:
        costs: The costs (d, w) of the row alone.
        carried: The best cost (d, w) of coming so far.
        penalties: What a step of one pixel costs, and a jump.
        alone: The shift that each column would take by itself.
    """

    costs: np.ndarray
    carried: np.ndarray
    penalties: tuple[float, float]
    alone: np.ndarray


@dataclass(frozen=True, eq=False)
class Walked:
    """How many columns were walked, and the cheapest path (n,) of shifts to the last of them."""

    columns: int
    path: np.ndarray
    tape: Tape


TapeLook = Look[Input, Pictures, Walked]


def run(
    params: Input, pictures: Pictures, cost_volume: CostVolume = sad_cost_volume
) -> Iterator[Walked]:
    """Yield the path after some columns more."""
    compare = OTHER_COSTS.get(params.cost, cost_volume)
    tape = tape_of(costs_of_row(pictures, compare, params.window), params.smoothness)
    w = tape.costs.shape[1]
    for columns in [*range(EVERY, w, EVERY), w]:
        yield Walked(columns, cheapest(tape, columns), tape)


def tape_of(costs: np.ndarray, price: float) -> Tape:
    """Return what is carried from left to right along a row of costs (d, w)."""
    volume = np.ascontiguousarray(costs[:, None, :])
    penalties = usual_penalties(np.where(np.isfinite(volume), volume, np.inf), price)
    cost, jumps = prepare(volume, *penalties)
    carried = path_costs(cost, (0, 1), jumps)[:, 0]
    return Tape(cost[:, 0], carried, penalties, np.argmin(cost[:, 0], axis=0))


def cheapest(tape: Tape, columns: int) -> np.ndarray:
    """Return the cheapest path (columns,) that ends at the best shift of the last column."""
    P1, P2 = tape.penalties
    path = np.zeros(columns, np.intp)
    path[-1] = int(np.argmin(tape.carried[:, columns - 1]))
    shifts = np.arange(len(tape.carried))
    for column in range(columns - 2, -1, -1):
        step = np.abs(shifts - path[column + 1])
        toll = np.where(step == 0, 0.0, np.where(step == 1, P1, P2))
        path[column] = int(np.argmin(tape.carried[:, column] + toll))
    return path


def wrong(look: TapeLook, shifts: np.ndarray) -> float:
    """Return the share of the columns walked, seen by both, whose shift is over 1 px off."""
    pair = look.subject.pair
    v = look.subject.pixel[1]
    if pair.disparity is None or pair.visible is None:
        return float("nan")
    n = look.now.columns
    seen = pair.visible[v, :n]
    off = np.abs(shifts[:n] - pair.disparity[v, :n])[seen] > 1.0
    return float(off.mean()) if len(off) else float("nan")


def draw(look: TapeLook) -> Scene:
    """Return the row, the tape of costs below it, and the path through them."""
    state = look.now
    pictures = look.subject
    tape = state.tape
    v = pictures.pixel[1]
    n_shifts, w = tape.costs.shape
    h = pictures.left.shape[0]
    rows = np.clip(np.arange(v - ROWS // 2, v + ROWS // 2 + 1), 0, h - 1)
    tall = WIDE * ROWS / w
    block = max(1, SHARP // w)
    strip = Picture(
        blocks(pictures.pair.left[rows], block, block),
        "left row",
        WIDE,
        motion(FACING, np.array([LEFT_EDGE + WIDE / 2, 0.0, TOP - tall / 2])),
    )

    pitch = _rows_of_shift(n_shifts, w) * WIDE / w

    def at(columns: np.ndarray, shifts: np.ndarray) -> np.ndarray:
        x = LEFT_EDGE + WIDE * (columns + 0.5) / w
        return stand(np.column_stack([x, FOOT + pitch * (shifts + 0.5)]), 0.02)

    columns = np.arange(state.columns)
    line = at(columns, state.path)
    scene: Scene = {
        "left/strip": strip,
        "left/edge": Segments(strip.border(LAYER), "target", 2.0),
        "tape": _tape(look, w),
        "alone": Points(at(columns, tape.alone[columns]), "wrong", DOT, name="lowest by itself"),
        "path": Segments(between(line[:-1], line[1:]), "source", 4.0, name="cheapest path"),
        "axis/0": Label("d = 0", stand(np.array([LEFT_EDGE - 0.12, FOOT + 0.03])), "neutral"),
        "axis/most": Label(
            str(n_shifts - 1),
            stand(np.array([LEFT_EDGE - 0.08, FOOT + pitch * n_shifts - 0.03])),
            "neutral",
        ),
        "column": COLUMN.scalar(state.columns, "column"),
    }
    truth = pictures.pair.disparity
    if truth is not None:
        known = np.flatnonzero(np.isfinite(truth[v]))
        true = at(known, truth[v][known])
        ends = between(true[:-1], true[1:])
        scene["truth"] = Segments(ends, "truth", 2.0, name="truth")
    off = wrong(look, state.path.astype(float))
    alone = wrong(look, tape.alone.astype(float))
    scene["wrong/path"] = WRONG.scalar(100 * off, "path")
    scene["wrong/alone"] = WRONG.scalar(100 * alone, "alone", "wrong")
    if not np.isfinite(off):
        return scene | {"caption": say("The path has walked {n} columns.", n=state.columns)}
    return scene | {
        "caption": say(
            "After {n} columns {alone} are wrong by themselves, {off} on the path.",
            n=state.columns,
            alone=share(alone, 0),
            off=share(off, 0),
        )
    }


def _rows_of_shift(n_shifts: int, w: int) -> int:
    """Return how many pixels high a shift is drawn, the columns being one wide."""
    return max(1, round(HIGH * w / WIDE / n_shifts))


def _tape(look: TapeLook, w: int) -> Primitive:
    """Return the costs walked so far as a picture, shift 0 at the bottom."""
    state = look.now
    shown = state.tape.costs[::-1].astype(np.float32).copy()
    shown[:, state.columns :] = np.nan
    top = float(np.percentile(state.tape.costs, 90))
    high = _rows_of_shift(len(shown), w)
    block = max(1, SHARP // w)
    large = blocks(shown, block * high, block)
    field = Field(large, 0.0, max(top, 1e-6), "Cost", "grey levels")
    middle = FOOT + WIDE / w * high * len(shown) / 2
    return Picture(
        field, "cost by column and shift", WIDE, motion(FACING, np.array([0.0, 0.0, middle]))
    )
