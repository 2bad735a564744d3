"""What the lesson says: captions, labels and tables, every one with its numbers and units."""

import numpy as np

from lessons.chamfer_emd.state import Numbers, Side, State
from workbench.algorithms.transport.flow import Stop
from workbench.numerals import brief, percent
from workbench.scene import Caption

LOWERED = {
    "both sides": "Chamfer",
    "source to target": "one-sided Chamfer, source to target,",
    "target to source": "one-sided Chamfer, target to source,",
}

ALMOST_NONE = 0.1  # of the mass: who has less astray has come to the target


def caption(state: State) -> Caption:
    """Return what happened in this step and why."""
    return _start(state) if state.before is None else _step(state, *state.before)


def _start(state: State) -> Caption:
    now, note, params = state.left.numbers, state.yardsticks["5 % larger"], state.params
    size = (
        ""
        if state.clouds.scale == 1
        else f" A unit of your files is {brief(state.clouds.scale)} m of the picture."
    )
    text = (
        f"The source is {state.clouds.name}: Chamfer {squared(now.chamfer)}, earth mover's"
        f" {metres(now.earth_movers)}."
    )
    larger = f"the target 5 % larger ({squared(note.chamfer)}, {metres(note.earth_movers)})"
    if 0 < now.chamfer < note.chamfer and now.earth_movers > note.earth_movers:
        text += (
            f" The ranking flips: to Chamfer this is closer than {larger}, to earth mover's it is"
            " farther."
        )
        return Caption(text + size)
    if now.chamfer == 0 < now.earth_movers:
        return Caption(
            text
            + " To Chamfer the two are equal: each point lies on one of the other cloud."
            + size
        )
    if now.earth_movers == 0 < now.index_mse:
        return Caption(
            text + f" Only pairs by index see a change: {squared(now.index_mse)}." + size
        )
    if params.lowers == "source to target" and state.left.flow.stop is Stop.ARRIVED:
        text += (
            " Every source point lies on the target, so that side of Chamfer is 0 and the left flow"
            " has nothing to do;"
        )
        return Caption(text + f" the other side is {squared(now.to_source)}." + size)
    return Caption(text + ("" if params.start == "larger" else f" Compare {larger}.") + size)


def _step(state: State, before_left: Numbers, before_right: Numbers) -> Caption:
    left, right = state.left, state.right
    text = f"Step {state.step}. Left: "
    if left.flow.step < state.step:
        text += f"ended at {_lowered_value(state)}"
    else:
        text += (
            f"{LOWERED[state.params.lowers]} {_value_before(state, before_left)} →"
            f" {_lowered_value(state)}"
        )
    text += f", {percent(left.numbers.astray, 0)} of the mass astray. Right: earth mover's "
    if right.flow.step < state.step:
        text += f"ended at {metres(right.numbers.earth_movers)}"
    else:
        text += f"{metres(before_right.earth_movers)} → {metres(right.numbers.earth_movers)}"
    text += f", {percent(right.numbers.astray, 0)} astray."
    if not state.last:
        return Caption(text)
    text += f" Left {_why(left)}; right {_why(right)}."
    if max(left.numbers.astray, right.numbers.astray) <= ALMOST_NONE:
        return Caption(text, "good")
    unintended = (
        state.params.lowers == "both sides"
        and left.numbers.astray > ALMOST_NONE + right.numbers.astray
    )
    return Caption(text, "wrong" if unintended else "info")


def _why(side: Side) -> str:
    return {
        Stop.ARRIVED: "arrived",
        Stop.SETTLED: "settled where no step lowers it",
        Stop.MAX_STEPS: "used up its steps",
        None: "goes on",
    }[side.flow.stop]


def _value_before(state: State, before: Numbers) -> str:
    sides = {
        "both sides": before.chamfer,
        "source to target": before.to_target,
        "target to source": before.to_source,
    }
    return squared(sides[state.params.lowers])


def _lowered_value(state: State) -> str:
    return squared(state.left.flow.value)


def left_label(state: State) -> str:
    """Return the title over the left flow."""
    lowered = LOWERED[state.params.lowers].rstrip(",")
    return f"{lowered[0].upper()}{lowered[1:]}: {_lowered_value(state)}"


def right_label(state: State) -> str:
    """Return the title over the right flow."""
    return f"Earth mover's: {metres(state.right.flow.value)}"


def squared(value: float) -> str:
    """Return a number of square metres with two digits that count."""
    return f"{significant(value, 2)} m²"


def metres(value: float) -> str:
    """Return a number of metres with two digits that count."""
    return f"{significant(value, 2)} m"


def significant(value: float, digits: int) -> str:
    """Return a number with so many digits that count; a dash where there is none."""
    if np.isnan(value):
        return "–"
    if abs(value) < 1e-12:
        return "0"
    if abs(value) < 1e-4:
        return "<0.0001"
    if float(f"{value:.{digits}g}") >= 10 ** (digits - 1):
        return brief(value, digits)
    return f"{value:#.{digits}g}"
