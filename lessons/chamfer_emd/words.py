"""What the lesson says: captions, labels and tables, every one with its numbers and units."""

import numpy as np

from lessons.chamfer_emd.states import Numbers, Side, State
from workbench.algorithms.flow import Stop
from workbench.geometry.shape_distances import DEFINITIONS
from workbench.numerals import brief
from workbench.scene import Caption, Table

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
    size = "" if state.clouds.scale == 1 else f" A unit of your files is {brief(state.clouds.scale)} m of the picture."
    text = (
        f"The source is {state.clouds.name}: Chamfer {squared(now.chamfer)}, earth mover's {metres(now.earth_movers)}."
    )
    larger = f"the target 5 % larger ({squared(note.chamfer)}, {metres(note.earth_movers)})"
    if 0 < now.chamfer < note.chamfer and now.earth_movers > note.earth_movers:
        text += f" The ranking flips: to Chamfer this is closer than {larger}, to earth mover's it is farther."
        return Caption(text + size, "wrong")
    if now.chamfer == 0 < now.earth_movers:
        return Caption(
            text + " To Chamfer the two are equal: each point lies on one of the other cloud." + size, "wrong"
        )
    if now.earth_movers == 0 < now.index_mse:
        return Caption(text + f" Only pairs by index see a change: {squared(now.index_mse)}." + size, "wrong")
    if params.lowers == "source to target" and state.left.flow.stop is Stop.ARRIVED:
        text += (
            " Every source point lies on the target, so that side of Chamfer is 0 and the left flow has nothing to do;"
        )
        return Caption(text + f" the other side is {squared(now.to_source)}." + size, "wrong")
    return Caption(text + ("" if params.start == "larger" else f" Compare {larger}.") + size)


def _step(state: State, before_left: Numbers, before_right: Numbers) -> Caption:
    left, right = state.left, state.right
    text = f"Step {state.step}. Left: "
    if left.flow.step < state.step:
        text += f"ended at {_lowered_value(state)}"
    else:
        text += f"{LOWERED[state.params.lowers]} {_value_before(state, before_left)} → {_lowered_value(state)}"
    text += f", {share(left.numbers.astray)} of the mass astray. Right: earth mover's "
    if right.flow.step < state.step:
        text += f"ended at {metres(right.numbers.earth_movers)}"
    else:
        text += f"{metres(before_right.earth_movers)} → {metres(right.numbers.earth_movers)}"
    text += f", {share(right.numbers.astray)} astray."
    if not state.last:
        return Caption(text)
    text += f" Left {_why(left)}; right {_why(right)}."
    if max(left.numbers.astray, right.numbers.astray) <= ALMOST_NONE:
        return Caption(text, "good")
    return Caption(text, "wrong" if left.numbers.astray > ALMOST_NONE + right.numbers.astray else "info")


def _why(side: Side) -> str:
    return {
        Stop.ARRIVED: "arrived",
        Stop.SETTLED: "settled where no step lowers it",
        Stop.MAX_STEPS: "used up its steps",
        None: "goes on",
    }[side.flow.stop]


def _value_before(state: State, before: Numbers) -> str:
    sides = {"both sides": before.chamfer, "source to target": before.to_target, "target to source": before.to_source}
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


def numbers_table(state: State) -> Table:
    """Return every distance of both clouds to the target."""
    left, right, params = state.left.numbers, state.right.numbers, state.params
    rows = [
        ("Chamfer, mean of squares, m²", *_both(left.chamfer, right.chamfer)),
        ("… only source to target, m²", *_both(left.to_target, right.to_target)),
        ("… only target to source, m²", *_both(left.to_source, right.to_source)),
    ]
    for name in DEFINITIONS:
        if name != "mean of squares":
            unit = "m²" if name.endswith("squares") else "m"
            rows.append((f"Chamfer, {name}, {unit}", *_both(left.definitions[name], right.definitions[name])))
    rows += [
        ("Earth mover's, exact, m", *_both(left.earth_movers, right.earth_movers)),
        (f"Sinkhorn, blur {params.blur:g} m, m", *_both(state.left.sinkhorn, state.right.sinkhorn)),
        ("Hausdorff, m", *_both(left.hausdorff, right.hausdorff)),
        (f"F-score at {params.near:g} m", share(left.f_score), share(right.f_score)),
        ("Pairs by index, mean of squares, m²", *_both(left.index_mse, right.index_mse)),
        (f"Mass astray by over {params.near:g} m", share(left.astray), share(right.astray)),
    ]
    return Table("Distances to the target", ("", "left", "right"), tuple(rows))


def yardstick_table(state: State) -> Table:
    """Return what known changes of the target cost, to read the other numbers by."""
    rows = [
        (name, _three(n.chamfer), _three(n.earth_movers), _three(n.hausdorff), _three(n.index_mse))
        for name, n in state.yardsticks.items()
    ]
    header = ("", "Chamfer m²", "EMD m", "Hausdorff m", "index m²")
    return Table("What known changes of the target cost", header, tuple(rows))


def _both(left: float, right: float) -> tuple[str, str]:
    return _three(left), _three(right)


def squared(value: float) -> str:
    """Return a number of square metres with two digits that count."""
    return f"{_digits(value, 2)} m²"


def metres(value: float) -> str:
    """Return a number of metres with two digits that count."""
    return f"{_digits(value, 2)} m"


def share(value: float) -> str:
    """Return a share in percent."""
    return f"{100 * value:.0f} %"


def _three(value: float) -> str:
    return _digits(value, 3)


def _digits(value: float, digits: int) -> str:
    if np.isnan(value):
        return "–"
    if abs(value) < 1e-12:
        return "0"
    if abs(value) < 1e-4:
        return "<0.0001"
    if float(f"{value:.{digits}g}") >= 10 ** (digits - 1):
        return brief(value, digits)
    return f"{value:#.{digits}g}"
