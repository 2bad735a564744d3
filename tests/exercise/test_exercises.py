"""Holds every exercise of the catalogue to the same promises; a new one is covered without an edit
here.
"""

import ast
import sys

import jaxtyping
import numpy as np
import pytest

from workbench.authoring.exercise_promises import OF_EXERCISES
from workbench.authoring.promises import Subject
from workbench.exercise.finding import exercises, exercises_of
from workbench.exercise.grading import grade_function
from workbench.exercise.model import Exercise
from workbench.exercise.reports import terminal
from workbench.exercise.sandbox import StudentError
from workbench.exercise.starter import sample, starter
from workbench.lesson import catalog

EXERCISES = list(exercises().values())


def named(value) -> str:
    return str(getattr(value, "name", getattr(value, "__name__", value))).replace(" ", "-")


@pytest.fixture(params=EXERCISES, ids=named)
def exercise(request) -> Exercise:
    return request.param


def found(report) -> str:
    """What to read when a test fails."""
    return terminal(report)


def test_names_are_unique():
    listed = [exercise.name for lesson in catalog().values() for exercise in exercises_of(lesson)]
    assert len(listed) == len(set(listed))


@pytest.mark.parametrize("promise", OF_EXERCISES, ids=named)
def test_it_keeps_its_promises(exercise, promise, monkeypatch):
    # checked shapes raise what no contract names
    monkeypatch.setattr(jaxtyping.config, "jaxtyping_disable", True)
    wrong = [
        line for line in promise(Subject(catalog()[exercise.lesson]), exercise) if line is not None
    ]
    assert not wrong, "\n".join(wrong)


def test_who_sees_only_public_checks_is_not_told_that_all_is_done(exercise):
    report = grade_function(exercise.reference, exercise, hidden=False)
    assert report.is_full, found(report)
    assert f"hidden {len(report.not_run)} not run here" in terminal(report)


def test_the_starter_imports_nothing_but_numpy(exercise):
    imports = [
        node
        for node in ast.walk(ast.parse(starter(exercise)))
        if isinstance(node, (ast.Import, ast.ImportFrom))
    ]
    assert [ast.unparse(node) for node in imports] == ["import numpy as np"]


def test_the_sample_solution_imports_nothing_but_numpy_and_the_standard_library(exercise):
    """That it earns full marks by itself is promised above."""
    tree = ast.parse(sample(exercise))
    imported = [node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
    imported += [
        alias.name
        for node in ast.walk(tree)
        if isinstance(node, ast.Import)
        for alias in node.names
    ]
    assert {str(name).partition(".")[0] for name in imported} <= {"numpy", *sys.stdlib_module_names}


# alignment is judged in degrees and metres --------------------------------------------------------


def ends_swapped(p_target, p_source):
    """Half a turn off about the cloud's shortest axis: for a rod it fits nearly as well, by nearest
    neighbours.
    """
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
    return np.vstack(
        [np.column_stack([Q @ T[:3, :3], c + Q @ (T[:3, 3] - c)]), [0.0, 0.0, 0.0, 1.0]]
    )


def test_half_a_degree_off_is_half_right():
    report = grade_function(half_a_degree_off, exercises()["align_rigid"])
    assert report.outcomes[0].verdict.share == 0.5, found(report)
    assert 0.2 * report.possible <= report.points <= 0.6 * report.possible, found(report)


def test_a_mistake_is_recognised_where_the_contract_leaves_the_answer_open():
    """Transposed, but with another SVD: on a line of points the two are turned differently about
    it.
    """
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
        T[:3, :3] = U @ Vt
        T[:3, 3] = c_target - U @ Vt @ c_source
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
