"""Holds every exercise of the catalogue to the same promises; a new one is covered without an edit here."""

import ast
import inspect
import sys
from collections.abc import Callable

import numpy as np
import pytest

from workbench.exercise.grading import grade_file, grade_function
from workbench.exercise.model import Exercise, Mistake
from workbench.exercise.reports import terminal
from workbench.exercise.starter import exercises, starter, write_starter
from workbench.lesson import catalog

EXERCISES = list(exercises().values())
MISTAKES = [(exercise, mistake) for exercise in EXERCISES for mistake in exercise.mistakes]
ALTERNATIVES = [(exercise, function) for exercise in EXERCISES for function in exercise.alternatives]


def named(value) -> str:
    return str(getattr(value, "name", getattr(value, "__name__", value))).replace(" ", "-")


@pytest.fixture(params=EXERCISES, ids=named)
def exercise(request) -> Exercise:
    return request.param


def found(report) -> str:
    """What to read when a test fails."""
    return terminal(report)


def test_names_are_unique():
    listed = [exercise.name for lesson in catalog().values() for exercise in lesson.exercises]
    assert len(listed) == len(set(listed))


def test_it_is_complete(exercise):
    lesson = catalog()[exercise.lesson]
    slots = list(inspect.signature(lesson.run).parameters)[1:]
    assert exercise.slot in slots
    assert exercise.reference.__name__ == exercise.name, "messages name the reference"
    assert len(exercise.checks) >= 4
    public = [check.public for check in exercise.checks]
    assert public == sorted(public, reverse=True), "public checks come first"
    assert True in public
    assert False in public
    assert len({mistake.name for mistake in exercise.mistakes}) == len(exercise.mistakes) >= 3
    assert len(exercise.alternatives) >= 1
    assert len(exercise.examples) >= 2
    assert 40 <= len(exercise.task) <= 600
    assert inspect.getdoc(exercise.reference)


def test_the_reference_gets_full_marks(exercise):
    report = grade_function(exercise.reference, exercise)
    assert report.is_full, found(report)
    assert report.mistake is None
    assert report.points == pytest.approx(exercise.points)


@pytest.mark.parametrize(("exercise", "function"), ALTERNATIVES, ids=named)
def test_other_right_solutions_get_full_marks(exercise, function):
    report = grade_function(function, exercise)
    assert report.is_full, found(report)


@pytest.mark.parametrize(("exercise", "mistake"), MISTAKES, ids=named)
def test_a_mistake_is_not_full_marks_and_is_named(exercise: Exercise, mistake: Mistake):
    report = grade_function(mistake.function, exercise)
    assert report.points < report.possible, found(report)
    assert report.mistake is not None, found(report)
    assert report.mistake.name == mistake.name, found(report)
    assert 30 <= len(mistake.sentence) <= 300
    lost = [outcome.verdict.message for outcome in report.outcomes if outcome.verdict.share < 1.0]
    assert all(len(message) >= 20 for message in lost), lost


@pytest.mark.parametrize(("exercise", "mistake"), MISTAKES, ids=named)
def test_who_sees_only_public_checks_is_not_told_that_all_is_done(exercise: Exercise, mistake: Mistake):
    report = grade_function(mistake.function, exercise, hidden=False)
    assert f"hidden {len(report.not_run)} not run here" in terminal(report)


def test_the_examples_are_true(exercise):
    known = {"np": np, "array": np.array, "nan": np.nan, exercise.name: exercise.reference}
    for call, result in exercise.examples:
        assert call.startswith(f"{exercise.name}(")
        np.testing.assert_allclose(eval(call, known), eval(result, known), atol=5e-4, rtol=5e-4, err_msg=call)


def test_the_starter_runs_says_its_contract_and_earns_nothing(exercise, tmp_path):
    path = write_starter(exercise, tmp_path)
    text = path.read_text(encoding="utf-8")
    assert max(map(len, text.splitlines())) <= 125
    assert all(call in text for call, _ in exercise.examples)
    report = grade_file(path, exercise)
    assert report.points == 0, found(report)
    assert report.mistake is None, found(report)
    for outcome in report.outcomes:
        assert f"{exercise.name} is not written yet" in outcome.verdict.message


def test_the_starter_imports_nothing_but_numpy(exercise):
    imports = [
        node for node in ast.walk(ast.parse(starter(exercise))) if isinstance(node, (ast.Import, ast.ImportFrom))
    ]
    assert [ast.unparse(node) for node in imports] == ["import numpy as np"]


def test_a_right_file_gets_full_marks_in_a_process_of_its_own(exercise, tmp_path):
    path = tmp_path / f"my_{exercise.name}.py"
    function = exercise.alternatives[0]
    path.write_text(f"{standalone(function)}\n\n{exercise.name} = {function.__name__}\n", encoding="utf-8")
    report = grade_file(path, exercise)
    assert report.is_full, found(report)


def standalone(function: Callable) -> str:
    """Return the source of a function and of what it uses in its own module, without the workbench."""
    module = ast.parse(inspect.getsource(sys.modules[function.__module__]))
    parts: dict[str, ast.stmt] = {}
    for statement in module.body:
        if isinstance(statement, (ast.FunctionDef, ast.ClassDef)):
            parts[statement.name] = statement
        elif isinstance(statement, ast.Assign):
            names = [node.id for target in statement.targets for node in ast.walk(target) if isinstance(node, ast.Name)]
            parts |= dict.fromkeys(names, statement)
        elif isinstance(statement, ast.Import):
            parts |= {alias.asname or alias.name: statement for alias in statement.names}
    used: set[str] = set()
    waiting = [function.__name__]
    while waiting:
        name = waiting.pop()
        if name in parts and name not in used:
            used.add(name)
            waiting += [node.id for node in ast.walk(parts[name]) if isinstance(node, ast.Name)]
    chosen = [statement for statement in module.body if any(parts[name] is statement for name in used)]
    return "\n\n".join(["from __future__ import annotations", *map(ast.unparse, chosen)])


# what no exercise lets pass -------------------------------------------------------------------------------------------


def test_a_function_that_returns_nothing_earns_nothing(exercise):
    report = grade_function(lambda *args: None, exercise)
    assert report.points == 0, found(report)


def test_a_function_that_changes_its_input_is_told_so(exercise):
    def spoiling(*args):
        answer = exercise.reference(*args)
        for arg in args:
            if isinstance(arg, np.ndarray):
                arg += 1
        return answer

    report = grade_function(spoiling, exercise)
    assert 0 < report.points < report.possible, found(report)
    assert "changed" in " ".join(outcome.verdict.message for outcome in report.outcomes)
