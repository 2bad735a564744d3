"""The form of a lesson that everything is built on: setup, run, and draw, which gets a `Look`."""

import inspect
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from workbench.machinery.authors import at
from workbench.scene import Scene

P = TypeVar("P")
U = TypeVar("U")
S = TypeVar("S")

Slot = Callable[..., Any]
"""A function that an exercise may put in the place of ours."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Look(Generic[P, U, S]):
    """What `draw` makes a picture of: one step, and what it stands in.

    Args:
        params: The inputs of the run.
        subject: What `setup` made of them.
        now: The state of this step.
        past: The states of the steps before, oldest first.
    """

    params: P
    subject: U
    now: S
    past: Sequence[S] = ()

    @property
    def before(self) -> S | None:
        """The state of the step before; None at the first."""
        return self.past[-1] if self.past else None


class States(tuple[S, ...], Generic[P, U, S]):
    """All states of a run, with its `params` and `subject`: a question reads its answer off it."""

    params: P
    subject: U

    @classmethod
    def of(cls, states: Sequence[S], *, params: P, subject: U) -> "States[P, U, S]":
        """Return the states of a run with these params and this subject."""
        made = cls(states)
        made.params, made.subject = params, subject
        return made


@dataclass(frozen=True, eq=False, kw_only=True)
class Form(Generic[P, U, S]):
    """A lesson's three functions.

    Args:
        setup: Makes the subject of the params: what does not change while the run goes on.
        run: Yields the states; takes params, subject and, by keyword, functions in the place of
            ours.
        draw: The scene of what a `Look` holds.
        slots: The names of these keywords.
        inputs: What the author's own `run` takes beside them, by position.
        notes: Whether it is noted which params are read; else each knob says what it needs.
    """

    setup: Callable[[P], U]
    run: Callable[..., Iterator[S]]
    draw: Callable[[Look[P, U, S]], Scene]
    slots: tuple[str, ...]
    inputs: tuple[str, ...] = ("params", "subject")
    notes: bool = True

    def states(self, params: P, slots: Mapping[str, Slot] | None = None) -> Iterator[S]:
        """Yield the states of a run with functions in the place of ours."""
        yield from self.run(params, self.setup(params), **(slots or {}))


def keywords_of(run: Callable[..., Any]) -> list[str]:
    """Return the names of the keywords of a run."""
    try:
        parameters = inspect.signature(run).parameters.values()
    except (TypeError, ValueError):  # a function of C says nothing of its arguments
        return []
    return [parameter.name for parameter in parameters if parameter.kind is parameter.KEYWORD_ONLY]


def mistakes(setup: Any, run: Any, draw: Any) -> Iterator[str]:
    """Yield what is wrong with a lesson's functions, as ends of lines that begin with its name."""
    yield from not_called_with(setup, 1, "setup takes the params")
    wanted = "run takes the params, the subject and, by keyword, functions that have defaults"
    yield from not_called_with(run, 2, wanted)
    yield from not_called_with(draw, 1, "draw takes one Look")


def not_called_with(function: Any, count: int, wanted: str) -> Iterator[str]:
    """Yield a line where a function cannot be called with so many positional arguments alone."""
    name, _, rest = wanted.partition(" ")
    if not callable(function):
        yield f": {name} is a function, not {function!r}"
        return
    try:
        inspect.signature(function).bind(*[None] * count)
    except TypeError:
        yield f": {at(function)}{name}{inspect.signature(function)} {rest}"
    except ValueError:  # a function of C says nothing of its arguments
        pass
