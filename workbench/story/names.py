"""What a story may name: a lesson's runs, steps, cameras, knobs and questions. What it lacks is
an author's error.
"""

import re
from collections.abc import Mapping
from typing import Any

from workbench.errors import AuthorError, not_among
from workbench.knobs import ParamField, fields_of
from workbench.lesson import Lesson, Question, View
from workbench.machinery.authors import place
from workbench.scene import PALETTE
from workbench.story.model import StepName

MOMENT = re.compile(r"(?P<run>[\w-]+)(?:@(?P<step>[\w-]+))?")
"""A run, and a step of it: `flat@stop`."""

PAGE_IDS = frozenset(
    [
        "again",
        "around",
        "article",
        "aside",
        "back",
        "bar",
        "begin",
        "caption",
        "count",
        "course",
        "difference",
        "dots",
        "drawer",
        "exercise",
        "help",
        "help-keys",
        "labels",
        "large",
        "legend",
        "loop",
        "main-chart",
        "map",
        "marks",
        "move",
        "notice",
        "open",
        "pin",
        "places",
        "plate",
        "reference",
        "scene",
        "set",
        "side",
        "speed",
        "stage",
        "step",
        "story",
        "story-around",
        "story-chart",
        "story-top",
        "text",
        "theme",
        "third-parties",
        "this-run",
        "tiles",
        "to-bench",
        "to-story",
        "tools",
        "toy",
        "view",
        "wait",
    ]
)
"""What the page's own parts are called: no scene may be called so, since its address is its id."""


class Names:
    """The names of a lesson, for the story in its page.md.

    Args:
        lesson: Whose.
        home: `live`, or `site` for what cannot compute.
    """

    def __init__(self, lesson: Lesson, home: str):
        self.lesson, self.home = lesson, home
        self.fields: Mapping[str, ParamField] = {
            field.name: field for field in fields_of(lesson.params)
        }
        self.questions: Mapping[str, Question] = {
            question.name: question for question in lesson.questions
        }
        self._swept = {
            (sweep.knob, run_name(lesson, lesson.run_params(sweep.run))) for sweep in lesson.sweeps
        }

    def wrong(self, line: int, problem: str) -> AuthorError:
        """Return the error of a line of page.md."""
        return AuthorError(
            f"lesson {self.lesson.name}: {place(str(self.lesson.page), line)}: {problem}"
        )

    def run(self, name: str, line: int) -> str:
        """Return the name by which all homes know a run: what has equal params is one."""
        params = self.params_of(name)
        if params is None:
            known = (
                "default",
                *(run.name for run in (*self.lesson.presets, *self.lesson.questions)),
            )
            raise self.wrong(line, f"there is no run {name!r}; {not_among(name, known)}")
        return run_name(self.lesson, params)

    def params_of(self, name: str) -> Any:
        """Return the params of a run, None where there is none of that name."""
        if name == "default":
            return self.lesson.params()
        runs = (*self.lesson.presets, *self.lesson.questions)
        return next((run.params for run in runs if run.name == name), None)

    def step(self, written: str, line: int) -> StepName:
        """Return a step as it is written: an index, `start`, `stop`, or `-1`, with or without
        `@` before it.
        """
        text = written.removeprefix("@")
        if text == "start":
            return 0
        if text == "stop":
            return "stop"
        if not re.fullmatch(r"-?\d{1,6}", text):
            raise self.wrong(
                line, f"{written!r} is no step; write a number, start, stop, or -1 for the last one"
            )
        return int(text)

    def moment(self, written: str, line: int) -> tuple[str, StepName | None]:
        """Return run and step of a text such as `flat@stop`; None where it names no step."""
        match = MOMENT.fullmatch(written)
        if match is None:
            raise self.wrong(line, f"{written!r} names no run; write run:preset or run:preset@step")
        step = None if match["step"] is None else self.step(match["step"], line)
        return self.run(match["run"], line), step

    def opening(self, run: str) -> StepName:
        """Return the step where a run opens that is named without one."""
        preset = next((preset for preset in self.lesson.presets if preset.name == run), None)
        return 0 if preset is None or preset.step is None else preset.step

    def view(self, name: str, line: int) -> str:
        """Return the name of a camera that there is."""
        known = views_of(self.lesson)
        if name and name not in known:
            raise self.wrong(line, f"there is no camera {name!r}; {not_among(name, known)}")
        return name

    def knob(self, name: str, line: int) -> ParamField:
        """Return a field of Params that there is."""
        if name not in self.fields:
            raise self.wrong(line, f"there is no knob {name!r}; {not_among(name, self.fields)}")
        return self.fields[name]

    def ends(self, name: str, given: Mapping[str, str], line: int) -> dict[str, str]:
        """Return the ends of a knob's values under the hand, as attributes, where they are given:
        `low` and `high` within the knob's own.
        """
        knob = self.knob(name, line).knob
        ends = {end: given[end] for end in ("low", "high") if end in given}
        if ends and not _within(ends, knob.low, knob.high):
            raise self.wrong(line, f"low and high of {name!r} are numbers of the knob's own range")
        return {f"data-{end}": value for end, value in ends.items()}

    def question(self, name: str, line: int) -> Question:
        """Return a question that there is."""
        if name not in self.questions:
            raise self.wrong(
                line, f"there is no question {name!r}; {not_among(name, self.questions)}"
            )
        return self.questions[name]

    def role(self, name: str, line: int) -> str:
        """Return the role of a colour that there is."""
        if name not in PALETTE:
            raise self.wrong(line, f"there is no colour role {name!r}; {not_among(name, PALETTE)}")
        return name

    def can_turn(self, knob: str, run: str) -> bool:
        """Tell whether this home can set a knob of a run: a live one computes, another has the
        values of its sweep.
        """
        return self.home == "live" or (knob, run) in self._swept


def _within(ends: Mapping[str, str], low: float | None, high: float | None) -> bool:
    """Tell whether the ends that are given leave a range within low and high."""
    if low is None or high is None:
        return False
    try:
        first = float(ends.get("low", low))
        last = float(ends.get("high", high))
    except ValueError:
        return False
    return low <= first < last <= high


def run_name(lesson: Lesson, params: Any) -> str:
    """Return the name of a run by its params, as all homes tell it: `default`, else a preset, else
    a question.

    It is empty where none has these params.
    """
    if params == lesson.params():
        return "default"
    named = (*lesson.presets, *lesson.questions)
    return next((run.name for run in named if run.params == params), "")


def views_of(lesson: Lesson) -> dict[str, View]:
    """Return the cameras that a story may name: the lesson's, and those of its presets by the
    presets' names.
    """
    own = {preset.name: preset.view for preset in lesson.presets if preset.view is not None}
    return {"default": lesson.view, **own, **lesson.views}
