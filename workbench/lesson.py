"""A lesson as one value: page, inputs, setup, run, draw, presets, questions; and the catalogue."""

import functools
import importlib
import importlib.metadata
import importlib.util
import pkgutil
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import ModuleType
from typing import Any, Concatenate, Generic, TypeVar

from workbench import chapters, form1
from workbench.cached import cached
from workbench.captions import say
from workbench.errors import AuthorError, InputError, LeftOutWarning, not_among
from workbench.form import Form, Look, Slot, States, keywords_of, mistakes
from workbench.knobs import Gizmo, Params, Pick, fields_of, knob, validated
from workbench.moved import moved
from workbench.presets import Choice, Preset, Question, Sweep
from workbench.scene import Scene
from workbench.view import View

__all__ = [
    "Choice",
    "Gizmo",
    "Lesson",
    "Look",
    "Params",
    "Pick",
    "Preset",
    "Question",
    "Slot",
    "States",
    "Sweep",
    "View",
    "cached",
    "catalog",
    "course",
    "find",
    "knob",
    "lesson_in",
    "place_of",
    "say",
]

P = TypeVar("P")
S = TypeVar("S")


@dataclass(frozen=True, kw_only=True)
class Lesson(Generic[P, S]):
    """One topic, whole.

    With `setup`, `run` takes the params and the subject, and `draw` takes a `Look`. Without, the
    lesson has the first form: `run(params)` and `draw(state)`.

    Args:
        name: Its folder's name and its name in links and commands.
        title: The heading.
        summary: One line for the course page.
        page: Path of page.md; without one the summary is the page.
        params: The Params class; `params()` is the default run.
        setup: Makes the subject of the params: what does not change while the run goes on.
        run: Yields states; takes params, subject and, by keyword, the functions an exercise may
            replace.
        draw: What one step looks like.
        slots: The names of these functions, where `run` passes on `**slots` and does not name them
            itself.
        order: The place in its chapter.
        chapter: The chapter of the course that it belongs to: Move, Estimate, See, Measure, Connect
            or Learn. Without one it stands behind them all.
        minutes: How long it takes to go through.
        view: How the scene is first seen.
        views: Cameras of a story, by name.
        view_for: How runs of some params are first seen, where the presets' cameras do not say it;
            None lets them.
        presets: Named runs worth seeing.
        questions: What a student predicts before looking.
        first_step: The step that shows most of the default run (negative counts from the end): its
            still, and where presets open that name none.
        opening: Where the default run opens; None is `first_step`.
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
    run: Callable[Concatenate[P, ...], Iterator[S]]
    draw: Callable[[S], Scene] | Callable[[Look[P, Any, S]], Scene]
    setup: Callable[[P], Any] | None = None
    slots: tuple[str, ...] = ()
    order: int
    chapter: str = ""
    minutes: int = chapters.MINUTES
    view: View = field(default_factory=View)
    views: Mapping[str, View] = field(default_factory=dict)
    view_for: Callable[[P], View | None] | None = None
    presets: tuple[Preset[P], ...] = ()
    questions: tuple[Question[P, S], ...] = ()
    first_step: int = 0
    opening: int | None = None
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

    @property
    def opens(self) -> int:
        """The step at which the default run opens, negative from the end."""
        return self.first_step if self.opening is None else self.opening

    def _mistakes(self) -> Iterator[str]:
        """Yield what is wrong with the values given: ends of lines that begin with its name."""
        if self.page is not None and not isinstance(self.page, Path):
            finds = "Path(__file__).with_name(...) finds it beside the lesson"
            yield f": page is a Path, not {self.page!r}: {finds}"
        if self.chapter not in ("", *chapters.NAMES):
            yield f": chapter is one of {', '.join(chapters.NAMES)}, not {self.chapter!r}"
        if not isinstance(self.minutes, int) or self.minutes < 1:
            yield f": minutes is a whole number of minutes, not {self.minutes!r}"
        if self.setup is None:
            yield from form1.mistakes(self.run, self.draw)
        else:
            yield from mistakes(self.setup, self.run, self.draw)
        places: dict[str, str] = {}
        presets = [(f"preset {i}", "preset", preset) for i, preset in enumerate(self.presets, 1)]
        questions = [
            (f"question {i}", "question", question) for i, question in enumerate(self.questions, 1)
        ]
        for place, _, run in [*presets, *questions]:
            if run.name in places:
                both = f"{places[run.name]} and {place}"
                yield f": {both} share the name {run.name!r}; each is a run of the page"
            places[run.name] = place
        for _, kind, run in [*presets, *questions]:
            try:
                self.validated(run.params)
            except InputError as error:
                yield f", {kind} {run.name!r}: {error}"

        for i, sweep in enumerate(self.sweeps, 1):
            if not sweep.values:
                yield f", sweep {i}: has no values"
            try:
                self.swept(sweep)
            except (InputError, TypeError) as error:
                yield f", sweep {i} of {sweep.knob!r}: {error}"

    @property
    def form(self) -> Form[P, Any, S]:
        """Its functions, in the form that everything is built on."""
        if self.setup is None:
            return form1.form_of(self.run, self.draw)
        slots = self.slots or tuple(keywords_of(self.run))
        draw: Any = self.draw
        return Form(setup=self.setup, run=self.run, draw=draw, slots=slots)

    def swept(self, sweep: Sweep) -> tuple[P, ...]:
        """Return the params of a sweep's runs: those of its run, with its knob at each value."""
        base: Any = self.run_params(sweep.run)
        runs = (replace(base, **{sweep.knob: value}) for value in sweep.values)
        return tuple(self.validated(params) for params in runs)

    def run_params(self, name: str) -> P:
        """Return the params of a run by its name: `default`, or a preset's.

        Raises:
            InputError: If there is no such preset; lists those there are.
        """
        return self.params() if name == "default" else self.preset(name).params

    def view_of(self, params: P) -> View:
        """Return how a run of these params is first seen: by its preset's camera if it has one."""
        preset = self.preset_of(params)
        return self.usual_view(params) if preset is None or preset.view is None else preset.view

    def usual_view(self, params: P) -> View:
        """Return how a run of these params is first seen if it is no preset with its own camera.

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
            key=lambda pair: [getattr(pair[0], name) == getattr(params, name) for name in choices],
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


def folders() -> list[str]:
    """Return the folders of the `lessons` package; none is imported."""
    lessons = importlib.import_module("lessons")
    return [name for _, name, is_folder in pkgutil.iter_modules(lessons.__path__) if is_folder]


def is_of_course(lesson: Lesson) -> bool:
    """Tell whether a lesson is one of the `lessons` package, and as it is there."""
    return lesson.params.__module__.startswith("lessons.") and catalog().get(lesson.name) is lesson


def _lesson_of(folder: str) -> Lesson | None:
    """Return the lesson in a folder of the `lessons` package; None where there is none."""
    place = f"lessons.{folder}.lesson"
    has_one = importlib.util.find_spec(place) is not None
    return lesson_in(importlib.import_module(place)) if has_one else None


@functools.cache
def course() -> Mapping[str, Lesson]:
    """Return the lessons of the `lessons` package by name, in course order.

    Raises:
        InputError: If two of them have one name; tells both places.
    """
    lessons = list[Lesson]()
    places = dict[str, str]()
    for folder in folders():
        lesson = _lesson_of(folder)
        if lesson is None:
            continue
        if lesson.name in places:
            both = f"{places[lesson.name]} and lessons.{folder}"
            raise InputError(f"{both} are both named {lesson.name!r}: rename one")
        lessons.append(lesson)
        places[lesson.name] = f"lessons.{folder}"
    return _in_order(lessons)


class Catalog(Mapping[str, Lesson]):
    """All lessons by name, in course order: those of the course and those of installed third
    parties.

    A lesson of the course that is asked for by name is imported alone: all of them take seconds.

    Attributes:
        asked: Lessons that were asked for by name.
    """

    def __init__(self) -> None:
        self.asked: dict[str, Lesson] = {}

    def __getitem__(self, name: str) -> Lesson:
        if name not in self.asked:
            lesson = _lesson_of(name) if name in folders() else None
            alone = None if lesson is None or lesson.name != name else lesson
            self.asked[name] = alone or self._whole[name]
        return self.asked[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._whole)

    def __len__(self) -> int:
        return len(self._whole)

    @functools.cached_property
    def _whole(self) -> Mapping[str, Lesson]:
        lessons = dict(course())
        places = {name: f"lessons.{name}" for name in course()}
        for entry in importlib.metadata.entry_points(group="workbench.lessons"):
            place = f"{entry.name} ({entry.value})"
            try:
                lesson = lesson_in(importlib.import_module(entry.module), entry.attr or "lesson")
                if lesson.name in lessons:
                    raise InputError(f"its name {lesson.name!r} is taken by {places[lesson.name]}")
            except (
                Exception,
                SystemExit,
            ) as error:  # somebody else's lesson must not take the course down
                warnings.warn(LeftOutWarning(f"lesson {place} is left out: {error}"), stacklevel=1)
            else:
                lessons[lesson.name], places[lesson.name] = lesson, place
        return _in_order(lessons.values())


@functools.cache
def catalog() -> Catalog:
    """Return all lessons by name, in course order.

    A third party registers a lesson under the entry-point group `workbench.lessons`, as `name =
    "module:lesson"`. One that cannot be loaded, or whose name is taken, is left out with a warning;
    the course itself is always whole.
    """
    return Catalog()


def place_of(lesson: Lesson) -> tuple[int, float, str]:
    """Return what lessons are sorted by in the course: chapter, place in it, name."""
    return chapters.place(lesson.chapter, lesson.order, lesson.name)


def _in_order(lessons: Iterable[Lesson]) -> Mapping[str, Lesson]:
    return {lesson.name: lesson for lesson in sorted(lessons, key=place_of)}


def find(name: str) -> Lesson:
    """Return a lesson by its name in the catalogue. Nothing is run: the name may come out of a file
    or a link.

    Raises:
        InputError: If there is no such lesson; lists those there are.
    """
    lessons = catalog()
    name = name if name in lessons else moved(name, None, {}).lesson
    if name not in lessons:
        raise InputError(f"no lesson is named {name[:80]!r}; {not_among(name, lessons)}")
    return lessons[name]


def lesson_in(module: ModuleType, value: str = "lesson") -> Lesson:
    """Return the lesson that a module defines under a name.

    Raises:
        InputError: If there is none.
    """
    lesson = getattr(module, value, None)
    if not isinstance(lesson, Lesson):
        raise InputError(f"it defines no value `{value}` of type Lesson")
    return lesson
