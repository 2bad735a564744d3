"""What an author writes: fields of `Params`, each a knob, and how a hand in the scene turns it."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, dataclass_transform


@dataclass(frozen=True)
class Gizmo:
    """The field is also set by a handle in the scene.

    The field is a tuple of floats: 2 are a position in the plane z = 0, metres, 3 one in space, 6 a
    position and a rotation vector (radians), in the world.
    """

    size: float = 0.5


@dataclass(frozen=True)
class Pick:
    """The field is also set by a click on the primitive at `path`.

    The field is an int (the index of the nearest point or vertex), or a tuple of ints (the last so
    many clicks); on a Picture a pair of ints is the pixel (u, v), column first.
    """

    path: str


@dataclass(frozen=True)
class Knob:
    """How one input of a lesson is shown and set.

    Args:
        hint: One line that says what it does to the run.
        low: The lower end of the range, included; of every entry for tuples. Required for numbers.
        high: Its upper end, likewise.
        unit: Written behind the value: `m`, `deg`, `px`. Degrees are converted in the first lines
            of `run`.
        step: The slider's step; None picks a fine one.
        label: The words on the control; None makes them from the field's name.
        parts: What the entries of a tuple are called, where x, y, z would mislead.
        by: A Gizmo or a Pick where the scene sets it too.
        needs: Other params and the values they need for this one to have an effect, as {"metric":
            ("plane",)}; a page greys it out while they have others, and says so. Changing it then
            changes nothing in the run. {"scan": (None,)} asks that no own file is open as `scan`.
        of_files: It says how to read a person's own files (their unit, which axis is up), and is
            kept as long as they are.
    """

    hint: str
    low: float | None = None
    high: float | None = None
    unit: str = ""
    step: float | None = None
    label: str | None = None
    parts: tuple[str, ...] = ()
    by: Gizmo | Pick | None = None
    needs: Mapping[str, tuple[Any, ...]] = dataclasses.field(default_factory=dict, hash=False)
    of_files: bool = False


def knob(  # noqa: PLR0917
    default: Any,
    hint: str,
    low: float | None = None,
    high: float | None = None,
    *,
    unit: str = "",
    step: float | None = None,
    label: str | None = None,
    parts: tuple[str, ...] = (),
    by: Gizmo | Pick | None = None,
    of_files: bool = False,
    read_with: Mapping[str, tuple[Any, ...]] | None = None,
) -> Any:
    """Return a field of `Params`: its default, and how it is shown and set (see `Knob`).

    There is no `needs`: a run that does not read the field leaves the control without effect, and a
    page shows it so. A file says in `read_with` which choices read it; who hands it over gets the
    first of them.
    """
    shown = Knob(
        hint,
        low,
        high,
        unit,
        step=step,
        label=label,
        parts=parts,
        by=by,
        of_files=of_files,
        needs=read_with or {},
    )
    return dataclasses.field(default=default, metadata={"knob": shown})


@dataclass_transform(frozen_default=True, kw_only_default=True)  # a knob is a default, to a checker
class Params:
    """The inputs of a lesson. A subclass is a frozen dataclass by itself: `angle: float =
    knob(30, "How far", 0, 90)`.
    """

    def __init_subclass__(cls, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        dataclass(frozen=True, kw_only=True)(cls)
