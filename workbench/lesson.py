"""A lesson: a page, Params, `run`, `draw`, presets and questions, as one value; and the catalogue
of all lessons.
"""

import functools
import importlib
import importlib.metadata
import importlib.util
import inspect
import pkgutil
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import ModuleType
from typing import Any, Generic, TypeVar

import numpy as np

from workbench.errors import AuthorError, InputError, LeftOutWarning, not_among
from workbench.knobs import fields_of, validated
from workbench.machinery.authors import at
from workbench.scene import Scene

P = TypeVar("P")
S = TypeVar("S")


@dataclass(frozen=True)
class View:
    """How the scene is first seen: the eye, what it looks at, metres; +Z is up unless `up` says
    otherwise.

    `grid` is the spacing of the ground grid in metres at height `grid_height` along `up`; None
    draws none. `axes` draws the world's axes, labelled, at the origin.
    """

    eye: tuple[float, float, float] = (2.0, -2.0, 1.5)
    target: tuple[float, float, float] = (0.0, 0.0, 0.0)
    up: tuple[float, float, float] = (0.0, 0.0, 1.0)
    grid: float | None = 0.5
    grid_height: float = 0.0
    fov_degrees: float = 45.0
    axes: bool = True

    def __post_init__(self) -> None:
        numbers = np.array([*self.eye, *self.target, *self.up])
        if numbers.shape != (9,) or not np.isfinite(numbers).all():
            raise ValueError("a View's eye, target and up are three finite numbers each")
        if self.eye == self.target or not any(self.up):
            raise ValueError("a View's eye is apart from its target, and its up has a length")

    def seen_from(self) -> np.ndarray:
        """Return the eye, moved aside by a thousandth of its distance where it looks along `up`.

        Straight down or up no direction of the picture would be decided: +y points up in it then,
        +z where y is vertical itself (-z from above, so that +x is on the right).
        """
        eye, target, up = (np.array(triple, float) for triple in (self.eye, self.target, self.up))
        away, up = eye - target, up / np.linalg.norm(up)
        aside = np.cross(away, up)
        if np.linalg.norm(aside) > 1e-3 * np.linalg.norm(away):
            return eye
        above = np.sign(away @ up)
        upwards = (
            np.array([0.0, 1.0, 0.0])
            if abs(up[1]) < 0.9
            else np.array([0.0, 0.0, -above * np.sign(up[1])])
        )
        return eye - above * 2e-3 * np.linalg.norm(away) * upwards

    def facing(self, right: float, up: float, nearer: float = 0.0) -> np.ndarray:
        """Return the pose (4, 4) of a picture that stands upright before the eye, metres right of
        and above the target.
        """
        ahead = np.array(self.target) - self.seen_from()
        axes = [np.cross(ahead, self.up), np.cross(ahead, np.cross(ahead, self.up)), ahead]
        pose = np.eye(4)
        pose[:3, :3] = np.column_stack([axis / np.linalg.norm(axis) for axis in axes])
        pose[:3, 3] = np.array(self.target) + pose[:3, :3] @ (right, -up, -nearer)
        return pose


@dataclass(frozen=True)
class Preset(Generic[P]):
    """A named set of params: what to look for, and why it happens, in one line.

    `step` is where it opens: an index, negative counts from the end; None opens at the lesson's
    first step worth seeing. `view` is its own camera, where the lesson's does not show what it is
    about. `breaks` says that it goes wrong on purpose: its captions stay calm.
    """

    name: str
    title: str
    line: str
    params: P
    step: int | None = None
    view: View | None = None
    breaks: bool = False


@dataclass(frozen=True)
class Sweep:
    """One param of the default run at several values: a knob on pages that cannot compute too.

    `knob` is the name of a field of Params, `values` what it takes, in the order in which they are
    shown.
    """

    knob: str
    values: tuple[Any, ...]


class Choice(str):
    """A text to choose as the answer of a question, and `why`: what is said to those who chose it
    though it is wrong.
    """

    why: str

    def __new__(cls, text: str, why: str = "") -> "Choice":
        """Return the text with what is said to those who chose it wrongly."""
        choice = super().__new__(cls, text)
        choice.why = why
        return choice


@dataclass(frozen=True)
class Question(Generic[P, S]):
    """Predict before reveal: a question whose right answer is read off a run.

    Args:
        name: Its key in a browser's memory.
        text: The question.
        choices: The possible answers, plain texts or `Choice`s; empty means a number is asked for.
        answer: Reads the right answer off the run's states: an index into choices, or a number.
        why: The sentence shown after answering, computed from the same states.
        params: The run that answers it.
        unit: The unit asked for, for numbers.
        tolerance: How far off a number still counts as right.
        step: Where the revealed run opens; None is its last step.
        wrong: Known wrong numbers as (lowest, highest, what is said to those who gave one); none is
            within the tolerance.
    """

    name: str
    text: str
    answer: Callable[[Sequence[S]], float]
    why: Callable[[Sequence[S]], str]
    params: P
    choices: tuple[str, ...] = ()
    unit: str = ""
    tolerance: float = 0.0
    step: int | None = None
    wrong: tuple[tuple[float, float, str], ...] = ()

    def reply(self, given: float) -> str:
        """Return what is said to a known wrong answer, a number or the index of a choice; nothing
        where it is not known.
        """
        if self.choices:
            return getattr(self.choices[int(given)], "why", "")
        return next((words for low, high, words in self.wrong if low <= given <= high), "")


@dataclass(frozen=True, kw_only=True)
class Lesson(Generic[P, S]):
    """One topic, whole.

    Args:
        name: Its folder's name and its name in links and commands.
        title: The heading.
        summary: One line for the course page.
        page: Path of page.md; without one the summary is the page.
        params: The Params class; `params()` is the default run.
        run: Yields states; takes params and, by keyword, the functions an exercise may replace.
        draw: What one state looks like.
        order: The place in the course.
        view: How the scene is first seen.
        view_for: How runs of some params are first seen, where the presets' cameras do not say it;
            None lets them.
        presets: Named runs worth seeing.
        questions: What a student predicts before looking.
        first_step: Where the default run opens (negative counts from the end).
        sweeps: Params whose runs are published at several values.
        telling: The chart or title of what tells most beside the scene: it is shown first.
        needs: Names of the lessons it builds on; they stand before it in the course.
        tries: Whether a state only tries what another start would lead to. Such states follow the
            run's own end.
    """

    name: str
    title: str
    summary: str
    page: Path | None = None
    params: type[P]
    run: Callable[[P], Iterator[S]]
    draw: Callable[[S], Scene]
    order: int
    view: View = field(default_factory=View)
    view_for: Callable[[P], View | None] | None = None
    presets: tuple[Preset[P], ...] = ()
    questions: tuple[Question[P, S], ...] = ()
    first_step: int = 0
    sweeps: tuple[Sweep, ...] = ()
    telling: str = ""
    needs: tuple[str, ...] = ()
    tries: Callable[[S], bool] | None = None

    def __post_init__(self) -> None:
        try:
            fields_of(self.params)
        except TypeError as error:
            raise TypeError(f"lesson {self.name}: {error}") from None
        for wrong in self._mistakes():
            raise ValueError(f"lesson {self.name}{wrong}")
        self.text()

    def _mistakes(self) -> Iterator[str]:
        """Yield what is wrong with the values given, as ends of lines that begin with the lesson's
        name.
        """
        if self.page is not None and not isinstance(self.page, Path):
            yield (
                f": page is a Path, not {self.page!r}: Path(__file__).with_name(...) finds it"
                " beside the lesson"
            )
        yield from _not_called_with(
            self.run, "run", "the params and, by keyword, functions that have defaults"
        )
        yield from _not_called_with(self.draw, "draw", "one state")
        places: dict[str, str] = {}
        for what, ones in (("preset", self.presets), ("question", self.questions)):
            for i, one in enumerate(ones, 1):
                if one.name in places:
                    yield (
                        f": {places[one.name]} and {what} {i} share the name {one.name!r}; each is"
                        " a run of the page"
                    )
                places[one.name] = f"{what} {i}"
        for what, one in [("preset", p) for p in self.presets] + [
            ("question", q) for q in self.questions
        ]:
            try:
                self.validated(one.params)
            except InputError as error:
                yield f", {what} {one.name!r}: {error}"

        for i, sweep in enumerate(self.sweeps, 1):
            if not sweep.values:
                yield f", sweep {i}: has no values"
            try:
                self.swept(sweep)
            except (InputError, TypeError) as error:
                yield f", sweep {i} of {sweep.knob!r}: {error}"

    def swept(self, sweep: Sweep) -> tuple[P, ...]:
        """Return the params of a sweep's runs: the default's, with its knob at each of its
        values.
        """
        return tuple(
            self.validated(replace(self.params(), **{sweep.knob: value}))  # type: ignore[type-var]
            for value in sweep.values
        )

    def view_of(self, params: P) -> View:
        """Return how the run of these params is first seen: by its preset's camera where it has
        one.
        """
        preset = self.preset_of(params)
        return self.usual_view(params) if preset is None or preset.view is None else preset.view

    def usual_view(self, params: P) -> View:
        """Return how runs of such params are first seen that are no preset with a camera of its
        own.

        It is the camera of the default or the preset that is most alike in its choices, of which
        the first counts most: who chooses another shape or stage sees it as its presets do.
        """
        view = None if self.view_for is None else self.view_for(params)
        if view is not None:
            return view
        choices = [field.name for field in fields_of(self.params) if field.kind == "choice"]
        known = [
            (self.params(), self.view),
            *((preset.params, preset.view or self.view) for preset in self.presets),
        ]
        return max(
            known,
            key=lambda one: [getattr(one[0], name) == getattr(params, name) for name in choices],
        )[1]

    def text(self) -> str:
        """Return the page, Markdown; title and summary where the lesson has none.

        Raises:
            AuthorError: If the page cannot be read; names the lesson and the path.
        """
        if self.page is None:
            return f"# {self.title}\n\n{self.summary}\n"
        try:
            return self.page.read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            why = getattr(error, "strerror", None) or "not UTF-8 text"
            raise AuthorError(
                f"lesson {self.name}: its page {self.page.absolute()}: {why}"
            ) from None

    def preset(self, name: str) -> Preset[P]:
        """Return a preset by name.

        Raises:
            InputError: If there is none; lists those there are.
        """
        for preset in self.presets:
            if preset.name == name:
                return preset
        known = not_among(name, (preset.name for preset in self.presets))
        raise InputError(f"lesson {self.name} has no preset {name!r}; {known}")

    def preset_of(self, params: P) -> Preset[P] | None:
        """Return the preset that has these params, the first if there are several."""
        return next((preset for preset in self.presets if preset.params == params), None)

    def validated(self, params: P) -> P:
        """Return params when they are this lesson's and in range; raise InputError otherwise."""
        if not isinstance(params, self.params):
            raise InputError(
                f"lesson {self.name} takes {self.params.__name__}, not {type(params).__name__}"
            )
        return validated(params)


@functools.cache
def course() -> Mapping[str, Lesson]:
    """Return the lessons of the `lessons` package by name, in course order.

    Raises:
        InputError: If two of them have one name; tells both places.
    """
    found, places = list[Lesson](), dict[str, str]()
    lessons = importlib.import_module("lessons")
    for info in pkgutil.iter_modules(lessons.__path__, "lessons."):
        if info.ispkg and importlib.util.find_spec(f"{info.name}.lesson") is not None:
            lesson = lesson_in(importlib.import_module(f"{info.name}.lesson"))
            if lesson.name in places:
                raise InputError(
                    f"{places[lesson.name]} and {info.name} are both named {lesson.name!r}:"
                    " rename one"
                )
            found.append(lesson)
            places[lesson.name] = info.name
    return _in_order(found)


@functools.cache
def catalog() -> Mapping[str, Lesson]:
    """Return all lessons by name, in course order: those of the course and those of installed third
    parties.

    A third party registers a lesson under the entry-point group `workbench.lessons`, as `name =
    "module:lesson"`. One that cannot be loaded, or whose name is taken, is left out with a warning;
    the course itself is always whole.
    """
    found, places = dict(course()), {name: f"lessons.{name}" for name in course()}
    for entry in importlib.metadata.entry_points(group="workbench.lessons"):
        place = f"{entry.name} ({entry.value})"
        try:
            lesson = lesson_in(importlib.import_module(entry.module), entry.attr or "lesson")
            if lesson.name in found:
                raise InputError(f"its name {lesson.name!r} is taken by {places[lesson.name]}")
        except (
            Exception,
            SystemExit,
        ) as error:  # somebody else's lesson must not take the course down
            warnings.warn(LeftOutWarning(f"lesson {place} is left out: {error}"), stacklevel=1)
        else:
            found[lesson.name], places[lesson.name] = lesson, place
    return _in_order(found.values())


def _in_order(lessons: Iterable[Lesson]) -> Mapping[str, Lesson]:
    return {
        lesson.name: lesson
        for lesson in sorted(lessons, key=lambda lesson: (lesson.order, lesson.name))
    }


def find(name: str) -> Lesson:
    """Return a lesson by its name in the catalogue. Nothing is run: the name may come out of a file
    or a link.

    Raises:
        InputError: If there is no such lesson; lists those there are.
    """
    lessons = catalog()
    if name not in lessons:
        raise InputError(f"no lesson is named {name[:80]!r}; {not_among(name, lessons)}")
    return lessons[name]


def _not_called_with(function: Any, name: str, wanted: str) -> Iterator[str]:
    """Yield a line where a function cannot be called with one positional argument alone."""
    if not callable(function):
        yield f": {name} is a function, not {function!r}"
        return
    try:
        inspect.signature(function).bind(None)
    except TypeError:
        yield f": {at(function)}{name}{inspect.signature(function)} takes {wanted}"
    except ValueError:  # a function of C says nothing of its arguments
        pass


def lesson_in(module: ModuleType, value: str = "lesson") -> Lesson:
    """Return the lesson that a module defines under a name.

    Raises:
        InputError: If there is none.
    """
    lesson = getattr(module, value, None)
    if not isinstance(lesson, Lesson):
        raise InputError(f"it defines no value `{value}` of type Lesson")
    return lesson
