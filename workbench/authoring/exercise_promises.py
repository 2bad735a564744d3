"""What every exercise promises, each as a function that looks and tells, as in `promises`."""

import inspect
import re
import tempfile
import warnings
from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np

from workbench.authoring.promises import Found, Subject
from workbench.exercise.grading import Outcome, Report, grade_file, grade_function
from workbench.exercise.model import Exercise, Function
from workbench.exercise.starter import sample, starter, write_starter
from workbench.knobs import fields_of
from workbench.lesson import Lesson
from workbench.machinery.authors import at

LEAST_CHECKS, LEAST_MISTAKES, LEAST_ALTERNATIVES, LEAST_EXAMPLES = 4, 3, 1, 2
TASK = (40, 600)
SENTENCE = (30, 300)
SAYS_BOTH = re.compile(
    r"\bright is\b|the contract asks for|asked for were|changed an array|\braised \w+|not"
    r" written|took more"
)
"""What the message of a check that failed has: what came and what is right, or what went wrong."""
ALIKE = re.compile(r"is (\([^()]*\)|[^\s,]+), right is (\([^()]*\)|[^\s,]+?)[.;:]?(?=\s|$)")
"""What came and what is right, as a message writes them; it writes them so that they differ."""
WIDEST = 125
LONGEST = 200
"""After how many steps a run that has not called a function is taken for one that never does."""
OF_EXERCISES: list[Callable[[Subject, Exercise], Found]] = []


def promise(function: Callable[[Subject, Exercise], Found]) -> Callable[[Subject, Exercise], Found]:
    """Add a function to what every exercise promises."""
    OF_EXERCISES.append(function)
    return function


def who(exercise: Exercise) -> str:
    """Return how a line about an exercise begins: its name, and where its contract stands."""
    return f"exercise {exercise.name}: {at(exercise.reference)}"


@promise
def it_is_complete(subject: Subject, exercise: Exercise) -> Found:
    """It has a task, a contract with examples, public checks before hidden ones, mistakes, and
    another right solution.
    """
    counts = {
        "checks": (len(exercise.checks), LEAST_CHECKS),
        "mistakes": (len(exercise.mistakes), LEAST_MISTAKES),
        "alternatives": (len(exercise.alternatives), LEAST_ALTERNATIVES),
        "examples in its contract": (len(exercise.contract.examples), LEAST_EXAMPLES),
    }
    for part, (count, least) in counts.items():
        yield (
            f"{who(exercise)}it has {count} {part}; wanted are {least} or more"
            if count < least
            else None
        )
    public = [check.public for check in exercise.checks]
    yield (
        None
        if {True, False} == set(public)
        else f"{who(exercise)}it needs public checks and hidden ones"
    )
    yield (
        None
        if public == sorted(public, reverse=True)
        else f"{who(exercise)}public checks stand before hidden ones"
    )
    length = len(exercise.task)
    wrong = (
        f"{who(exercise)}the task (the file's docstring) has {length} characters; wanted are"
        f" {TASK[0]} to {TASK[1]}"
    )
    yield None if TASK[0] <= length <= TASK[1] else wrong
    yield (
        None
        if inspect.getdoc(exercise.reference)
        else f"{who(exercise)}the contract has no docstring"
    )


@promise
def the_function_drives_the_lesson(subject: Subject, exercise: Exercise) -> Found:
    """Some run of the lesson calls the student's function."""
    subject.tell(f"exercise {exercise.name} in the lesson's runs")
    driven = any(_drives(subject.lesson, exercise, params) for params in _variants(subject.lesson))
    slot = exercise.contract.slot
    where = (
        f"{who(exercise)}no run of lesson {subject.lesson.name} calls its keyword {slot!r} in the"
        " first steps"
    )
    yield None if driven else f"{where}: not the default, no preset, at no choice"


@promise
def the_run_that_is_opened_calls_the_function(subject: Subject, exercise: Exercise) -> Found:
    """The run at which a student's function is watched first calls it."""
    subject.tell(f"exercise {exercise.name} in the run that is opened")
    lesson = subject.lesson
    preset = exercise.contract.preset
    params = lesson.params() if preset is None else lesson.preset(preset).params
    run = "the default run" if preset is None else f"preset {preset!r}"
    never = (
        f"{who(exercise)}{run}, where a student's function is watched first, does not call it in"
        f" {LONGEST} steps"
    )
    yield (
        None
        if _drives(lesson, exercise, params, steps=LONGEST)
        else f"{never}; `preset=` of the contract names one that does"
    )


@promise
def the_reference_gets_full_marks(subject: Subject, exercise: Exercise) -> Found:
    """Our own function gets full marks."""
    report = _graded(subject, exercise, exercise.reference)
    yield (
        None if report.is_full else f"{who(exercise)}our own function loses points: {_lost(report)}"
    )


@promise
def other_right_solutions_get_full_marks(subject: Subject, exercise: Exercise) -> Found:
    """Every alternative gets full marks."""
    for function in exercise.alternatives:
        report = _graded(subject, exercise, function)
        name = function.__name__
        yield (
            None
            if report.is_full
            else f"{who(exercise)}{at(function)}{name} is right, and loses points: {_lost(report)}"
        )


@promise
def the_first_alternative_stands_alone(subject: Subject, exercise: Exercise) -> Found:
    """The sample of handouts, a copy of the first alternative beside `import numpy as np`, gets
    full marks.
    """
    if not exercise.alternatives:
        return
    subject.tell(f"the sample solution of exercise {exercise.name}")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / exercise.file
        path.write_text(sample(exercise), encoding="utf-8")
        report = grade_file(path, exercise)
    where = f"{who(exercise)}{at(exercise.alternatives[0])}{exercise.alternatives[0].__name__}"
    why = "handouts copy the first alternative beside `import numpy as np`"
    yield (
        None
        if report.is_full
        else f"{where} does not earn full marks by itself ({why}): {_lost(report)}"
    )


@promise
def every_mistake_is_named(subject: Subject, exercise: Exercise) -> Found:
    """Every known mistake loses points, is recognised, and is told in a sentence; names are not
    used twice.
    """
    names = [item.name for item in exercise.mistakes]
    yield None if len(set(names)) == len(names) else f"{who(exercise)}two mistakes have one name"
    for item in exercise.mistakes:
        where = f"exercise {exercise.name}: {at(item.function)}the mistake {item.name!r}"
        report = _graded(subject, exercise, item.function)
        if report.is_full:
            yield f"{where} gets full marks; a check has to tell it from a right answer"
        elif report.mistake is not item:
            taken = (
                "is not recognised"
                if report.mistake is None
                else f"is taken for {report.mistake.name!r}"
            )
            yield (
                f"{where} {taken}: no check tells it from a right answer and from every other"
                " mistake"
            )
        else:
            yield None
        good = SENTENCE[0] <= len(item.sentence) <= SENTENCE[1]
        wanted = f"wanted are {SENTENCE[0]} to {SENTENCE[1]}"
        yield (
            None if good else f"{where} has a sentence of {len(item.sentence)} characters; {wanted}"
        )
        for outcome in report.outcomes:
            problem = (
                f"says only {outcome.verdict.message!r}; `beside` says what came and what is right"
            )
            vague = (
                f"exercise {exercise.name}: {at(outcome.check.judge)}{outcome.check.name} {problem}"
            )
            yield vague if is_vague(outcome) else None
            where = f"exercise {exercise.name}: {at(outcome.check.judge)}{outcome.check.name}"
            for got, right in ALIKE.findall(outcome.verdict.message):
                alike = f"writes both as {got}; `against` takes the digits that tell them apart"
                yield f"{where} {alike}" if got == right else None


@promise
def the_examples_are_true(subject: Subject, exercise: Exercise) -> Found:
    """What the examples say is what our function and the alternatives return."""
    known: dict[str, Any] = {"np": np, "array": np.array, "nan": np.nan}
    for call, result in exercise.contract.examples:
        if not call.startswith(f"{exercise.name}("):
            yield f"{who(exercise)}the example {call!r} does not call {exercise.name}"
            continue
        for function in (exercise.reference, *exercise.alternatives):
            try:
                value = eval(call, known | {exercise.name: function})
                told = eval(result, known)
                parts = (
                    zip(value, told, strict=True) if isinstance(told, tuple) else [(value, told)]
                )
                true = all(
                    np.allclose(got, wanted, atol=5e-4, rtol=5e-4, equal_nan=True)
                    for got, wanted in parts
                )
                problem = (
                    f"is {' '.join(str(value).split())} by {function.__name__}, and the example"
                    f" says {result}"
                )
            except Exception as error:
                true = False
                problem = f"raises {type(error).__name__}: {error}"
            yield None if true else f"{who(exercise)}{call} {problem}"


@promise
def the_starter_runs_and_earns_nothing(subject: Subject, exercise: Exercise) -> Found:
    """The starter file loads, says which calls are examples, fits the screen, and earns nothing."""
    subject.tell(f"the starter file of exercise {exercise.name}")
    text = starter(exercise)
    wide = max(map(len, text.splitlines()))
    yield (
        f"{who(exercise)}a line of the starter has {wide} characters; wanted are {WIDEST}"
        if wide > WIDEST
        else None
    )
    with tempfile.TemporaryDirectory() as folder:
        report = grade_file(write_starter(exercise, Path(folder)), exercise)
    unwritten = all(
        f"{exercise.name} is not written yet" in outcome.verdict.message
        for outcome in report.outcomes
    )
    earned = f"earns {report.points:g} points" if report.points else f"is told: {_lost(report)}"
    good = report.points == 0 and report.mistake is None and unwritten
    yield None if good else f"{who(exercise)}the starter as it is handed out {earned}"


@promise
def nothing_earns_nothing(subject: Subject, exercise: Exercise) -> Found:
    """A function that returns nothing earns nothing."""
    report = _graded(subject, exercise, lambda *args: None)
    earning = ", ".join(outcome.check.name for outcome in report.outcomes if outcome.points)
    yield (
        f"{who(exercise)}a function that returns nothing earns points: {earning}"
        if earning
        else None
    )


@promise
def who_changes_the_input_is_told_so(subject: Subject, exercise: Exercise) -> Found:
    """A right function that changes the arrays it was given loses some points, and is told why."""
    if not any(
        _is_array(given) for given in inspect.signature(exercise.reference).parameters.values()
    ):
        return

    def spoiling(*args: Any) -> Any:
        result = exercise.reference(*args)
        for arg in args:
            if isinstance(arg, np.ndarray):
                np.add(arg, 1, out=arg, casting="unsafe")  # bits too
        return result

    report = _graded(subject, exercise, spoiling)
    told = any("changed" in outcome.verdict.message for outcome in report.outcomes)
    hint = "a check with `left_alone` tells so"
    yield (
        None if told else f"{who(exercise)}a function that changes its input is not told so; {hint}"
    )
    some = 0 < report.points < report.possible
    yield (
        None
        if some
        else (
            f"{who(exercise)}a function that changes its input gets {report.points:g} of"
            f" {report.possible:g}"
        )
    )


def is_vague(outcome: Outcome) -> bool:
    """Tell whether a check failed without a word on what came and what is right."""
    return outcome.verdict.share < 1.0 and not SAYS_BOTH.search(outcome.verdict.message)


class _CalledError(Exception):
    pass


def _called(*args: Any) -> Any:
    raise _CalledError


def _variants(lesson: Lesson) -> Iterator[Any]:
    """Yield the default params, those of each choice of each knob, and the presets'."""
    yield lesson.params()
    for field in fields_of(lesson.params):
        for value in field.choices:
            yield replace(lesson.params(), **{field.name: value})
    yield from (preset.params for preset in lesson.presets)


def _drives(lesson: Lesson, exercise: Exercise, params: Any, *, steps: int = 12) -> bool:
    try:
        for _ in islice(lesson.form.states(params, {exercise.contract.slot: _called}), steps):
            pass
    except _CalledError:
        return True
    except Exception:  # what a run raises at these params is told by the promises of lessons
        return False
    return False


def _graded(subject: Subject, exercise: Exercise, function: Function) -> Report:
    subject.tell(
        f"grading {getattr(function, '__name__', 'a function')} by exercise {exercise.name}"
    )
    with warnings.catch_warnings(action="ignore"):  # wrong functions divide by zero
        return grade_function(function, exercise)


def _lost(report: Report) -> str:
    outcome = next(
        (outcome for outcome in report.outcomes if outcome.verdict.share < 1.0), report.outcomes[0]
    )
    return f"{outcome.check.name}: {outcome.verdict.message}"


def _is_array(parameter: inspect.Parameter) -> bool:
    annotation = parameter.annotation
    return annotation in (np.ndarray, parameter.empty) or hasattr(annotation, "dim_str")
