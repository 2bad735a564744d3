"""What the lesson says of the flows: captions and titles, every one with its numbers and units."""

from typing import Any

from lessons.chamfer_emd.panels import in_metres, in_squares, metres, squared
from lessons.chamfer_emd.state import Side, State
from workbench.algorithms.transport.flow import Stop
from workbench.captions import number, share
from workbench.lesson import say
from workbench.scene import Caption

LOWERED = {
    "both sides": "take the nearest",
    "source to target": "dots take the nearest",
    "target to source": "places take the nearest",
}
ALMOST_NONE = 0.1  # of the mass: who has less out of place has come to the target


def caption(state: State) -> Caption:
    """Return what happened in this step and why."""
    nothing_to_do = state.before is None and state.params.lowers == "source to target"
    if _looks_left(state) and not nothing_to_do:
        return _missing(state)
    if state.before is None:
        return _start(state)
    values: dict[str, Any] = {
        "left": share(state.left.numbers.out_of_place, 0),
        "other": share(state.right.numbers.out_of_place, 0),
    }
    if not state.last:
        return say(
            "Step {step}: {left} of the left mass is out of place, and {other} of the right.",
            step=state.step,
            **values,
        )
    almost = max(state.left.numbers.out_of_place, state.right.numbers.out_of_place) <= ALMOST_NONE
    return say(
        "The left flow {left_end}, {left} of its mass out of place; the right one {right_end},"
        " {other}.",
        tone="good" if almost else "info",
        left_end=_end(state.left),
        right_end=_end(state.right),
        **values,
    )


def _looks_left(state: State) -> bool:
    """Return whether a step is of the ring without a part, where the story shows the left face
    alone.
    """
    params = state.params
    built_in = params.shape == "ring" and params.target is None and params.source is None
    return built_in and params.start == "part missing"


def _missing(state: State) -> Caption:
    numbers = state.left.numbers
    if state.before is None:
        return say(
            "A part of the ring has no dots: Chamfer is {chamfer}.",
            chamfer=in_squares(numbers.chamfer),
        )
    left = share(numbers.out_of_place, 0)
    if not state.last:
        return say(
            "Step {step}: {left} of the left mass is out of place.", step=state.step, left=left
        )
    return say(
        "The flow {left_end}, {left} of its mass out of place.",
        tone="good" if numbers.out_of_place <= ALMOST_NONE else "info",
        left_end=_end(state.left),
        left=left,
    )


def _start(state: State) -> Caption:
    numbers = state.left.numbers
    note = state.yardsticks["5 % larger"]
    params = state.params
    values: dict[str, Any] = {
        "chamfer": in_squares(numbers.chamfer),
        "emd": in_metres(numbers.earth_movers),
    }
    text = f"The source is {state.clouds.name}: " + "Chamfer {chamfer}, earth mover's {emd}."
    if 0 < numbers.chamfer < note.chamfer and numbers.earth_movers > note.earth_movers:
        text += (
            " The ranking flips: to Chamfer this is closer than the target 5 % larger ({larger}),"
            " to earth mover's it is farther."
        )
        values["larger"] = in_squares(note.chamfer)
    elif numbers.chamfer == 0 < numbers.earth_movers:
        text += " To Chamfer the two are equal: each point lies on one of the other cloud."
    elif params.lowers == "source to target" and state.left.flow.stop is Stop.ARRIVED:
        text += (
            " Every source point lies on the target, so the left flow has nothing to do; the other"
            " side is {back}."
        )
        values["back"] = in_squares(numbers.to_source)
    if state.clouds.scale != 1:
        text += " A unit of your files is {unit} m of the picture."
        values["unit"] = number(state.clouds.scale)
    return say(text, **values)


def _end(side: Side) -> str:
    return {
        Stop.ARRIVED: "arrived",
        Stop.SETTLED: "came to rest",
        Stop.MAX_STEPS: "used up its steps",
        None: "goes on",
    }[side.flow.stop]


def left_label(state: State) -> tuple[str, tuple[str, ...]]:
    """Return the rule of the left flow, and what it says."""
    side = "Chamfer" if state.params.lowers == "both sides" else "one-sided Chamfer"
    return LOWERED[state.params.lowers], (f"{side} {squared(state.left.flow.value)}",)


def right_label(state: State) -> tuple[str, tuple[str, ...]]:
    """Return the rule of the right flow, and what it says."""
    return "one for each", (f"EMD {metres(state.right.flow.value)}",)
