"""The first form of a lesson, `run(params)` and `draw(state)`, made into the second.

No other module knows of it. A lesson of the first form has no `setup`. Its states carry all that
`draw` needs, so its subject is None, and its knobs say by `needs` when they have no effect.
"""

import inspect
from collections.abc import Callable, Iterator
from typing import Any

from workbench.cached import plain
from workbench.form import Form, Look, not_called_with
from workbench.knobs import fields_of
from workbench.scene import Scene


def form_of(run: Callable[..., Iterator[Any]], draw: Callable[[Any], Scene]) -> Form:
    """Return the second form of a lesson of the first."""

    def run_on(params: Any, subject: None, **slots: Callable) -> Iterator[Any]:
        for name in _with_effect(params):
            getattr(params, name)  # noted as read
        return run(plain(params), **slots)

    def draw_now(look: Look) -> Scene:
        return draw(look.now)

    try:
        slots = tuple(inspect.signature(run).parameters)[1:]
    except (TypeError, ValueError):  # a function of C says nothing of its arguments
        slots = ()
    return Form(
        setup=_nothing, run=run_on, draw=draw_now, slots=slots, inputs=("params",), notes=False
    )


def mistakes(run: Any, draw: Any) -> Iterator[str]:
    """Yield what is wrong with a lesson's functions, as ends of lines that begin with its name."""
    yield from not_called_with(
        run, 1, "run takes the params and, by keyword, functions that have defaults"
    )
    yield from not_called_with(draw, 1, "draw takes one state")


def _nothing(params: Any) -> None:
    """Return the subject of a lesson of the first form."""


def _with_effect(params: Any) -> list[str]:
    """Return the fields whose knobs have all that they need."""
    bare = plain(params)
    return [
        field.name
        for field in fields_of(type(bare))
        if all(getattr(bare, name) in wanted for name, wanted in field.knob.needs.items())
    ]
