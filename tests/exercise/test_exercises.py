"""Holds every exercise of the catalogue to the same promises; a new one is covered without an edit here."""

import ast
import inspect
import sys
from collections.abc import Callable
from dataclasses import replace
from itertools import islice, product

import jaxtyping
import numpy as np
import pytest

from workbench.exercise.finding import exercises, exercises_of
from workbench.exercise.grading import grade_file, grade_function
from workbench.exercise.model import Exercise, Mistake
from workbench.exercise.reports import terminal
from workbench.exercise.sandbox import StudentError
from workbench.exercise.starter import starter, write_starter
from workbench.knobs import fields_of
from workbench.lesson import catalog

EXERCISES = list(exercises().values())
MISTAKES = [(exercise, mistake) for exercise in EXERCISES for mistake in exercise.mistakes]
ALTERNATIVES = [(exercise, function) for exercise in EXERCISES for function in exercise.alternatives]


def named(value) -> str:
    return str(getattr(value, "name", getattr(value, "__name__", value))).replace(" ", "-")


@pytest.fixture(params=EXERCISES, ids=named)
def exercise(request) -> Exercise:
    return request.param


class CalledError(Exception):
    pass


def called(*args):
    raise CalledError


def variants(lesson):
    """The default run, then each choice of each knob, then the presets."""
    yield lesson.params()
    for field in fields_of(lesson.params):
        for value in field.choices:
            yield replace(lesson.params(), **{field.name: value})
    yield from (preset.params for preset in lesson.presets)


def drives(exercise, params) -> bool:
    try:
        for _ in islice(catalog()[exercise.lesson].run(params, **{exercise.contract.slot: called}), 12):
            pass
    except CalledError:
        return True
    return False


def found(report) -> str:
    """What to read when a test fails."""
    return terminal(report)


def test_names_are_unique():
    listed = [exercise.name for lesson in catalog().values() for exercise in exercises_of(lesson)]
    assert len(listed) == len(set(listed))


def test_it_is_complete(exercise):
    lesson = catalog()[exercise.lesson]
    slots = list(inspect.signature(lesson.run).parameters)[1:]
    assert exercise.contract.slot in slots
    assert exercise.reference.__name__ == exercise.name, "messages name the reference"
    assert len(exercise.checks) >= 4
    public = [check.public for check in exercise.checks]
    assert public == sorted(public, reverse=True), "public checks come first"
    assert True in public
    assert False in public
    assert len({mistake.name for mistake in exercise.mistakes}) == len(exercise.mistakes) >= 3
    assert len(exercise.alternatives) >= 1
    assert len(exercise.contract.examples) >= 2
    assert 40 <= len(exercise.task) <= 600
    assert inspect.getdoc(exercise.reference)


def test_the_student_s_function_drives_the_lesson(exercise):
    assert any(drives(exercise, params) for params in variants(catalog()[exercise.lesson]))


def test_the_reference_gets_full_marks(exercise, monkeypatch):
    monkeypatch.setattr(jaxtyping.config, "jaxtyping_disable", True)  # checked shapes raise what no contract names
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


def test_who_sees_only_public_checks_is_not_told_that_all_is_done(exercise):
    report = grade_function(exercise.reference, exercise, hidden=False)
    assert report.is_full, found(report)
    assert f"hidden {len(report.not_run)} not run here" in terminal(report)


def test_the_examples_are_true(exercise):
    known = {"np": np, "array": np.array, "nan": np.nan}
    for (call, result), function in product(exercise.contract.examples, (exercise.reference, *exercise.alternatives)):
        assert call.startswith(f"{exercise.name}(")
        known[exercise.name] = function
        np.testing.assert_allclose(eval(call, known), eval(result, known), atol=5e-4, rtol=5e-4, err_msg=call)


def test_the_starter_runs_says_its_contract_and_earns_nothing(exercise, tmp_path):
    path = write_starter(exercise, tmp_path)
    text = path.read_text(encoding="utf-8")
    assert max(map(len, text.splitlines())) <= 125
    assert all(call in text for call, _ in exercise.contract.examples)
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
    """Return the source of a function and of what it uses in its file and its folder's, without the workbench."""
    places = (function.__module__.rpartition(".")[0], function.__module__)
    body = [statement for place in places for statement in ast.parse(inspect.getsource(sys.modules[place])).body]
    parts: dict[str, ast.stmt] = {}
    for statement in body:
        if isinstance(statement, (ast.FunctionDef, ast.ClassDef)):
            statement.decorator_list = []
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
    chosen = [statement for statement in body if any(parts[name] is statement for name in used)]
    return "\n\n".join(["from __future__ import annotations", *map(ast.unparse, chosen)])


# what no exercise lets pass -------------------------------------------------------------------------------------------


def test_a_function_that_returns_nothing_earns_nothing(exercise):
    report = grade_function(lambda *args: None, exercise)
    assert report.points == 0, found(report)


def test_a_function_that_changes_its_input_is_told_so(exercise):
    taken = [parameter.annotation for parameter in inspect.signature(exercise.reference).parameters.values()]
    if not any(hasattr(annotation, "dim_str") for annotation in taken):
        pytest.skip(f"{exercise.name} is given numbers only, which nobody can change")

    def spoiling(*args):
        answer = exercise.reference(*args)
        for arg in args:
            if isinstance(arg, np.ndarray):
                arg += 1
        return answer

    report = grade_function(spoiling, exercise)
    assert 0 < report.points < report.possible, found(report)
    assert "changed" in " ".join(outcome.verdict.message for outcome in report.outcomes)


# alignment is judged in degrees and metres ----------------------------------------------------------------------------


def ends_swapped(p_target, p_source):
    """Half a turn off about the cloud's shortest axis: for a rod it fits nearly as well, by nearest neighbours."""
    T = exercises()["align_rigid"].reference(p_target, p_source)
    R_target = np.linalg.svd(p_target - p_target.mean(0))[2].T
    R_half = R_target @ np.diag([-1.0, -1.0, 1.0]) @ R_target.T
    R_170 = R_half @ small_turn(10.0)
    out = np.eye(4)
    out[:3, :3] = R_170 @ T[:3, :3]
    out[:3, 3] = p_target.mean(0) - out[:3, :3] @ p_source.mean(0)
    return out


def small_turn(degrees: float) -> np.ndarray:
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


def centroids_only(p_target, p_source):
    T = np.eye(4)
    T[:3, 3] = p_target.mean(0) - p_source.mean(0)
    return T


@pytest.mark.parametrize("cheat", [ends_swapped, centroids_only])
def test_a_small_residual_earns_nothing_for_a_wrong_pose(cheat):
    exercise = exercises()["align_rigid"]
    report = grade_function(cheat, exercise, hidden=False)
    assert report.points == 0, found(report)
    assert "degrees" in report.outcomes[0].verdict.message


def half_a_degree_off(p_target, p_source):
    T = exercises()["align_rigid"].reference(p_target, p_source)
    c = p_target.mean(0)
    Q = small_turn(0.5)
    return np.vstack([np.column_stack([Q @ T[:3, :3], c + Q @ (T[:3, 3] - c)]), [0.0, 0.0, 0.0, 1.0]])


def test_half_a_degree_off_is_half_right():
    report = grade_function(half_a_degree_off, exercises()["align_rigid"])
    assert report.outcomes[0].verdict.share == 0.5, found(report)
    assert 0.2 * report.possible <= report.points <= 0.6 * report.possible, found(report)


def test_a_mistake_is_recognised_where_the_contract_leaves_the_answer_open():
    """Transposed, but with another SVD: on a line of points the two are turned differently about it."""
    exercise = exercises()["align_rigid"]
    right = exercise.alternatives[1]

    def transposed(p_target, p_source):
        T = right(p_target, p_source)
        T[:3, :3] = T[:3, :3].T
        T[:3, 3] = p_target.mean(0) - T[:3, :3] @ p_source.mean(0)
        return T

    report = grade_function(transposed, exercise)
    assert report.mistake is not None, found(report)
    assert report.mistake.name == "rotation transposed"


def test_a_mistake_is_recognised_beside_a_forgotten_error():
    def clockwise(axis, angle):
        a = np.asarray(axis) / np.linalg.norm(axis)
        K = -np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
        return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K

    report = grade_function(clockwise, exercises()["rotation_from_axis_angle"])
    assert report.mistake is not None, found(report)
    assert report.mistake.name == "clockwise"


def test_one_of_two_mistakes_is_named():
    def transposed_and_mirrored(p_target, p_source):
        c_target, c_source = p_target.mean(0), p_source.mean(0)
        U, _, Vt = np.linalg.svd((p_source - c_source).T @ (p_target - c_target))
        T = np.eye(4)
        T[:3, :3], T[:3, 3] = U @ Vt, c_target - U @ Vt @ c_source
        return T

    report = grade_function(transposed_and_mirrored, exercises()["align_rigid"])
    assert report.mistake is not None, found(report)
    assert report.mistake.name == "rotation transposed"


def test_a_right_function_is_told_of_no_mistake_where_a_check_fails_by_chance():
    exercise = exercises()["invert_rigid"]
    calls = []

    def once_late(T):
        calls.append(T)
        if len(calls) == 1:
            raise StudentError("too slow", "timeout")
        return exercise.reference(T)

    report = grade_function(once_late, exercise)
    assert not report.is_full
    assert report.mistake is None
