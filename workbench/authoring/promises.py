"""What every lesson promises, each as a function that looks and tells: what holds, and in sentences
what does not.

A promise yields None for everything that it found to hold, and one line for everything that does
not; the line names the lesson's file, line, preset, question, knob or scene path. `workbench
validate` and the tests of the course run the same.
"""

import inspect
import re
import time
from collections.abc import Callable, Iterator
from typing import Any, TypeAlias

from workbench.authoring.live_words import live_words
from workbench.errors import InputError
from workbench.lesson import Lesson, Preset, Question
from workbench.machinery.authors import at
from workbench.run.questions import Answer, answer
from workbench.run.timeline import Timeline
from workbench.scene import Scene, in_space, same
from workbench.words.typeset import inline_html

Found: TypeAlias = Iterator[str | None]
"""None for each thing that holds, a line for each that does not."""

CAPTION = (10, 340)
"""What a phone shows of a caption without a need to scroll."""
LINE = (20, 220)
LEAST_PRESETS = 3
ONLY_LIVE = "a published page and a notebook cannot do it"
MOST_STEPS = 12
"""Steps looked at where a run at the end of a range would take long."""
SECONDS = 60.0
NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,99}")
"""What can be a folder, a file and a part of an address on any system."""
OF_LESSONS: list[Callable[["Subject"], Found]] = []


class Subject:
    """A lesson that is looked at, and its runs.

    Args:
        lesson: The lesson.
        whole: Returns a finished run at these params; by default it is made here, kept, and cut
            after `seconds`.
        seconds: How long one run may take.
        tell: Told what is run now, again at every step.
    """

    def __init__(
        self,
        lesson: Lesson,
        whole: Callable[[Any], Timeline] | None = None,
        *,
        seconds: float = SECONDS,
        tell: Callable[[str], object] = lambda doing: None,
    ):
        self.lesson = lesson
        self.who = f"lesson {lesson.name}"
        self.tell = tell
        self._whole, self._seconds = whole, seconds
        self._kept: dict[Any, Timeline] = {}

    def whole(self, params: Any, doing: str) -> Timeline:
        """Return the run at these params, computed to its end or until it has taken too long, which
        `stopped` says.
        """
        if self._whole is not None:
            return self._whole(params)
        if params not in self._kept:
            if len(self._kept) >= 4:
                self._kept.pop(next(iter(self._kept)))
            self._kept[params] = self.fresh(params, doing)
        return self._kept[params]

    def fresh(self, params: Any, doing: str, steps: int | None = None) -> Timeline:
        """Return a new run at these params, or its first steps."""
        timeline = Timeline(self.lesson, params)
        end = time.monotonic() + self._seconds
        self.tell(doing)
        while (steps is None or len(timeline) < steps) and timeline.extend():
            self.tell(f"{doing}, after step {len(timeline) - 1}")
            if time.monotonic() > end and not timeline.finished:
                timeline.stopped = (
                    f"{self.who}: {at(self.lesson.run)}the run takes over {self._seconds:g} s; "
                )
                timeline.stopped += f"it is at step {len(timeline) - 1}"
                timeline.finished = True
        return timeline

    def default(self) -> Timeline:
        """Return the default run."""
        return self.whole(self.lesson.params(), "the default run")


def promise(function: Callable[[Subject], Found]) -> Callable[[Subject], Found]:
    """Add a function to what every lesson promises."""
    OF_LESSONS.append(function)
    return function


@promise
def the_default_run_ends_well(subject: Subject) -> Found:
    """The default run comes to its end by itself, in two steps or more, and opens at one of
    them.
    """
    lesson = subject.lesson
    run = subject.default()
    yield run.stopped
    if run.stopped is None:
        few = (
            f"{subject.who}: {at(lesson.run)}the default run has {len(run)} step; a lesson shows"
            " two or more"
        )
        yield few if len(run) < 2 else None
        yield opens(run, subject.who, lesson.first_step)
        yield opens(run, subject.who, lesson.opens)


@promise
def every_step_says_what_happened(subject: Subject) -> Found:
    """Every step has a caption of a few words, and they are not all the same."""
    where = f"{subject.who}: {at(subject.lesson.draw)}"
    yield from _captions(where, subject.default())
    captions = {step.caption.text for step in subject.default().known()}
    if len(subject.default()) > 1:
        yield (
            f"{where}every step has the caption {min(captions)[:60]!r}"
            if len(captions) == 1
            else None
        )


def _captions(where: str, run: Timeline) -> Found:
    before = None
    for k, step in enumerate(run.known()):
        text = step.caption.text
        yield length_of(
            f"{where}step {k}: the caption {text[:60]!r}", len(text), CAPTION, unit="characters"
        )
        asked = None if text == before else next(live_words(text, run.lesson), None)
        yield (
            None
            if asked is None
            else f"{where}step {k}: the caption says {asked[1]!r}; {ONLY_LIVE}"
        )
        before = text


@promise
def every_step_shows_something_in_space(subject: Subject) -> Found:
    """Every step shows something in space, and what stands at a path stays of one kind."""
    kinds: dict[str, type] = {}
    where = f"{subject.who}: {at(subject.lesson.draw)}"
    for k, step in enumerate(subject.default().known()):
        seen = any(in_space(primitive) for primitive in step.scene.values())
        yield (
            None
            if seen
            else f"{where}step {k} shows nothing in space; a scene has at least one thing there"
        )
        for path, primitive in step.scene.items():
            kind = kinds.setdefault(path, type(primitive))
            if kind is not type(primitive):
                after = type(primitive).__name__
                before = kind.__name__
                yield (
                    f"{where}step {k}: {path!r} is of the kind {after} now, and was of the kind"
                    f" {before}"
                )


@promise
def a_run_is_reproducible(subject: Subject) -> Found:
    """The same params give the same scenes."""
    run = subject.default()
    again = subject.fresh(subject.lesson.params(), "the default run a second time")
    where = f"{subject.who}: {at(subject.lesson.run)}"
    hint = "take all chance from np.random.default_rng(params.seed)"
    if len(run) != len(again):
        yield (
            f"{where}the default run has {len(run)} steps, and {len(again)} when it is run again;"
            f" {hint}"
        )
        return
    for k, (first, second) in enumerate(zip(run.known(), again.known(), strict=True)):
        path = differs(first.scene, second.scene)
        if path is not None:
            yield f"{where}run again, step {k} shows something else at {path!r}; {hint}"
            return
        yield None


@promise
def the_code_of_every_step_can_be_shown(subject: Subject) -> Found:
    """Every step knows the line at which the algorithm stands."""
    for k, step in enumerate(subject.default().known()):
        if step.moment is None:
            yield (
                f"{subject.who}: {at(subject.lesson.run)}step {k} has no line to show; run is a"
                " generator function"
            )
            return
        lines, first = step.moment.source
        inside = first <= step.moment.line < first + len(lines)
        yield (
            None
            if inside
            else f"{subject.who}: {at(step.moment.function)}step {k} stands outside of its function"
        )


@promise
def every_preset_runs_and_promises_something(subject: Subject) -> Found:
    """There are presets; each runs to its end, opens at one of its steps, and says in a line what
    to look for.
    """
    presets = subject.lesson.presets
    few = (
        f"{subject.who}: it has {len(presets)} presets; {LEAST_PRESETS} or more show what there is"
        " to see"
    )
    yield few if len(presets) < LEAST_PRESETS else None
    for preset in presets:
        yield from _preset(subject, preset)


def _preset(subject: Subject, preset: Preset) -> Found:
    label = f"{subject.who}, preset {preset.name!r}"
    yield None if NAME.fullmatch(preset.name) else f"{label}: a name is letters, digits, - and _"
    yield length_of(f"{label}: its line", len(preset.line), LINE, unit="characters")
    run = subject.whole(preset.params, f"preset {preset.name!r}")
    yield None if run.stopped in (None, subject.default().stopped) else f"{label}: {run.stopped}"
    yield from _captions(f"{label}, ", run)
    if run.stopped is None and preset.step is not None:
        yield opens(run, label, preset.step)


@promise
def every_question_is_answered_by_its_run(subject: Subject) -> Found:
    """There are questions; the run of each gives a finite answer and a reason, and opens at one of
    its steps.
    """
    yield (
        None
        if subject.lesson.questions
        else f"{subject.who}: it has no question to answer before looking"
    )
    for question in subject.lesson.questions:
        yield from _question(subject, question)


def _question(subject: Subject, question: Question) -> Found:
    label = f"{subject.who}, question {question.name!r}"
    yield None if NAME.fullmatch(question.name) else f"{label}: a name is letters, digits, - and _"
    if not question.choices:
        exact = f"{label}: its tolerance is {question.tolerance:g}; nobody guesses a number exactly"
        yield None if question.tolerance > 0 else exact
    yield None if inline_html(question.text).strip() else f"{label}: it has no text"

    class Runs:
        @staticmethod
        def get(lesson: Lesson, params: Any) -> Timeline:
            return subject.whole(params, f"the run of question {question.name!r}")

    try:
        solution = answer(subject.lesson, question, None, timelines=Runs)  # type: ignore[arg-type]
    except InputError as error:
        message = str(error)
        if message != subject.default().stopped:
            yield message if message.startswith(label) else f"{label}: {message}"
    else:
        yield None if solution.why.strip() else f"{label}: {at(question.why)}why says nothing"
        yield from _known_wrong(label, question, solution)


def _known_wrong(label: str, question: Question, solution: Answer) -> Found:
    """What is said to a wrong answer is said to nobody who is right."""
    if question.choices:
        reply = question.reply(solution.value)
        yield (
            f"{label}: {solution.truth!r} is right, and its why is for who chose it wrongly"
            if reply
            else None
        )
    for low, high, words in question.wrong:
        ends = f"{label}: its wrong answer from {low:g} to {high:g}"
        yield (
            f"{ends} belongs to numbers, and this question has choices"
            if question.choices
            else None
        )
        yield (
            None
            if low <= high and words.strip()
            else f"{ends} wants a lowest number, a highest one, and words"
        )
        nearest = min(max(low, solution.value), high)
        right = abs(nearest - solution.value) <= question.tolerance
        yield (
            f"{ends} meets the right one, {solution.value:g} ± {question.tolerance:g}"
            if right
            else None
        )


@promise
def run_takes_only_keywords_beside_params(subject: Subject) -> Found:
    """`run` takes `params`, its subject, and by keyword functions that have defaults; the name
    can be a folder.
    """
    lesson = subject.lesson
    inputs = subject.lesson.form.inputs
    first, *others = inspect.signature(lesson.run).parameters.values()
    where = f"{subject.who}: {at(lesson.run)}run"
    yield (
        None
        if first.name == "params"
        else f"{where} calls its first argument {first.name!r}; it is 'params'"
    )
    for slot in others[len(inputs) - 1 :]:
        if slot.kind is slot.VAR_KEYWORD and len(inputs) > 1:
            named = (
                f"{where} passes on **{slot.name}; slots=(...) of the lesson names what it can hold"
            )
            yield None if lesson.slots else named
            continue
        good = slot.kind is slot.KEYWORD_ONLY and slot.default is not slot.empty
        wanted = (
            f"beside {' and '.join(inputs)} it takes keywords with defaults: `*, {slot.name}=...`"
        )
        yield None if good else f"{where} takes {slot.name!r}; {wanted}"
    yield (
        None
        if NAME.fullmatch(lesson.name)
        else f"{subject.who}: a lesson's name is letters, digits, - and _"
    )


def opens(run: Timeline, label: str, step: int) -> str | None:
    """Return a line where a run has no such step, beginning with who opens it there."""
    try:
        run.opening(label, step)
    except InputError as error:
        return str(error)
    return None


def length_of(label: str, length: int, wanted: tuple[int, int], *, unit: str) -> str | None:
    """Return a line where something is shorter or longer than wanted."""
    least, most = wanted
    return (
        None
        if least <= length <= most
        else f"{label} has {length} {unit}; wanted are {least} to {most:,}"
    )


def differs(scene: Scene, other: Scene) -> str | None:
    """Return the first path at which two scenes differ, None where they are the same."""
    return next(
        (path for path in {**scene, **other} if not same(scene.get(path), other.get(path))), None
    )
