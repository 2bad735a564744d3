"""Verdicts that many exercises share: what earns how much, and what a student is told."""

import re

import numpy as np
import pytest

from workbench.exercise.judging import (
    SKEWED,
    beside,
    changed,
    degrees_between,
    left_alone,
    motion_verdict,
    refused,
    rotation_verdict,
    worst,
)
from workbench.exercise.model import Verdict, full
from workbench.exercise.student import StudentError

RIGHT = np.eye(4)


def turned(axis: int, degrees: float) -> np.ndarray:
    """Return a turn about a coordinate axis by the right hand."""
    c, s = (part(np.radians(degrees)) for part in (np.cos, np.sin))
    R = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
    return np.roll(R, (axis, axis), (0, 1))


def motion(R: np.ndarray, t: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> np.ndarray:
    return np.vstack([np.column_stack([R, t]), [0.0, 0.0, 0.0, 1.0]])


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("degrees", [1e-7, 0.5, 90.0, 179.0])
def test_an_angle_between_rotations_is_exact_about_every_axis(axis, degrees):
    R = turned((axis + 1) % 3, 77.0)
    assert degrees_between(turned(axis, degrees) @ R, R) == pytest.approx(degrees, rel=1e-6)


@pytest.mark.parametrize(
    ("R", "share", "message"),
    [
        (turned(2, 0.05), 1.0, "Rotation error 0.05 degrees, within 0.1"),
        (turned(2, 1.5), 0.5, "close"),
        (turned(2, 3.0), 0.0, "at most"),
        (np.diag([1.0, 1.0, -1.0]), 0.0, "R mirrors: its determinant is −1, right is 1"),
        (2.0 * np.eye(3), 0.0, "R is no rotation: .* by 3, its determinant is 8, right is 1"),
        (np.diag([2.0, 1.0, -0.5]), 0.0, "R is no rotation: .*determinant is −1, right is 1"),
        (np.diag([2.0, 1.0, 0.5]), 0.0, r"R is no rotation: .* identity by 3\. "),
        ([[1.0, 1, 1], [0, 1, 0], [0, 0, 1]], 0.0, r"R\^T R differs from the identity by 1\. "),
    ],
)
def test_a_rotation_is_judged_by_its_angle_and_must_be_one(R, share, message):
    verdict = rotation_verdict(np.array(R), np.eye(3), "Look.")
    assert verdict.share == share
    assert re.search(message, verdict.message)
    assert share == 1.0 or verdict.message.endswith("Look.")


@pytest.mark.parametrize(
    ("T", "share", "message"),
    [
        (motion(turned(0, 0.05), (5e-4, 0, 0)), 1.0, "Position error 0.0005 m, within 0.001 m."),
        (motion(np.eye(3), (0, 0, 0.01)), 0.5, "The rotation is right; the last column is (0, 0, "),
        (motion(np.eye(3), (0, 0.03, 0)), 0.0, "Position error 0.03 m, at most 0.001 m"),
        (motion(turned(0, 1.0), (0, 0.03, 0)), 0.0, "t is (0, 0.03, 0), right is (0, 0, 0)"),
        (motion(turned(0, 1.0)), 0.5, "Rotation error 1 degrees"),
        (RIGHT + np.eye(4)[[3]].T @ [[0, 0, 0, 1.0]], 0.0, "The last row of T is (0, 0, 0, 2)"),
    ],
)
def test_a_motion_earns_what_the_worse_of_turn_and_place_earns(T, share, message):
    verdict = motion_verdict(T, RIGHT, "Look.")
    assert verdict.share == share
    assert message in verdict.message


def test_a_last_row_is_right_within_rounding():
    for off, share in ((SKEWED, 1.0), (1.01 * SKEWED, 0.0)):
        T = np.eye(4)
        T[3, 0] = off
        assert motion_verdict(T, RIGHT, "Look.").share == share


def test_a_motion_is_judged_where_it_is_farthest_off():
    """A small turn takes a far point far."""
    T = motion(turned(2, 0.05))
    assert motion_verdict(T, RIGHT, "Look.").share == 1.0
    p = np.array([[0.0, 0.0, 0.0], [10.0, 0.0, 0.0]])
    assert motion_verdict(T, RIGHT, "Look.", p=p).share == 0.5
    p = np.array([[100.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    assert motion_verdict(T, RIGHT, "Look.", p=p).share == 0.0


def raising(error: Exception):
    def function(value):
        raise error

    return function


@pytest.mark.parametrize(
    ("error", "errors", "share"),
    [
        ("ValueError", (), 1.0),
        ("LinAlgError", ("LinAlgError", "ValueError"), 1.0),
        ("IndexError", (), 0.5),
    ],
)
def test_a_call_that_asks_for_an_error_wants_that_one(error, errors, share):
    student = raising(StudentError("no", "raised", error, errors=errors))
    verdict = refused(student, np.zeros(0), what="No point")
    assert verdict.share == share
    assert verdict.message.startswith("No point ")


@pytest.mark.parametrize("error", ["", "NotImplementedError", "ImportError"])
def test_who_did_not_come_to_look_has_refused_nothing(error):
    with pytest.raises(StudentError):
        refused(raising(StudentError("no", "raised", error)), 0, what="No point")


LONG = np.array([1_000_000, *6 * [10_000], *5 * [100_000]])
"""Told in 80 characters, as many as are told whole."""


@pytest.mark.parametrize(
    ("value", "message"),
    [
        (None, "gave nothing"),
        (np.zeros(2), "gave an answer ([0. 0.])"),
        (np.zeros(20), "gave an answer ([0. 0. 0. ... 0. 0. 0.])"),
        (LONG, f"gave an answer ([{' '.join(map(str, LONG))}])"),
        (10 * LONG, f"gave an answer ([{' '.join(map(str, 10 * LONG))[:76]}...)"),
    ],
)
def test_an_answer_where_an_error_was_asked_for_is_told(value, message):
    verdict = refused(lambda _: value, 0, what="No point")
    assert verdict.share == 0.0
    assert message in verdict.message
    assert len(refused(lambda _: np.arange(999.0).reshape(9, 111), 0, what="").message) < 150


def test_inputs_left_alone_by_a_wrong_answer_earn_nothing():
    assert left_alone(abs, full("Right.")).share == 1.0
    assert left_alone(abs, Verdict(0.5, "Half.")).share == 0.0
    assert "Half." in left_alone(abs, Verdict(0.5, "Half.")).message


@pytest.mark.parametrize(
    ("args", "message"),
    [
        ((np.ones(2), np.array([[np.nan]])), "an array with nan in it that"),
        ((np.ones(2), np.array([np.inf, 1.0])), "an array with inf in it that"),
        ((np.ones(2), np.zeros((0, 3))), "an array without entries that"),
        ((np.ones((2, 3)), 1.0, "a"), "an array that"),
        ((np.array(["a"]), [1.0]), "an array that"),
    ],
)
def test_who_changed_an_array_is_told_which_kind(args, message):
    verdict = changed(args)
    assert verdict.share == 0.0
    assert message in verdict.message


@pytest.mark.parametrize(
    ("got", "right", "message"),
    [
        ([1.0, 2.0], [1.0, 2.0], "Look."),
        ([1.0], [1.0, 2.0], "Look."),
        ([], [], "Look."),
        ([np.nan, 1.0], [np.nan, 1.0], "Look."),
        ([np.inf, 1.0], [np.inf, 2.0], "Yours is (inf, 1), right is (inf, 2). Look."),
        ([np.nan, 1.0, 0, 0, 9], [0.0, 1.0, 0, 0, 0], "[0] is nan, right is 0. Look."),
        ([0.0, 1.0, 9, 0, 0], [0.0, 1.0, 0, 0, 0], "[2] is 9, right is 0. Look."),
        ([0.5, 1.0, 0, -9, 2], [0.0, 1.0, 0, 0, 0], "[3] is −9, right is 0. Look."),
        ([0.0, 1, 9, 0], [0.0, 1, 0, 0], "Yours is (0, 1, 9, 0), right is (0, 1, 0, 0). Look."),
        (3.0, 4.0, "Yours is 3, right is 4. Look."),
        ([3.0, 1.0], [4.0, 1.0], "Yours is (3, 1), right is (4, 1). Look."),
        ([[1.0, 2], [3, 9], [5, 6]], [[1.0, 2], [3, 4], [5, 6]], "Row 1 is (3, 9), right is"),
        ([[1.0, 2], [3, 9]], [[1.0, 2], [3, 4]], "[1, 1] is 9, right is 4. Look."),
        ([[1.0, 2, 3, 9]] * 2, [[1.0, 2, 3, 4]] * 2, "[0, 3] is 9, right is 4. Look."),
    ],
)
def test_a_hint_stands_behind_the_two_numbers_that_differ_most(got, right, message):
    assert beside(got, right, "Look.").startswith(message)


def test_a_hint_names_what_it_tells_of():
    rows = np.arange(6.0).reshape(3, 2)
    assert beside(rows + np.array([[0], [1], [0]]), rows, "", "A").startswith(
        "A[1] is (3, 4), right is"
    )
    assert beside(rows[0] + 1, rows[0], "", "t").startswith("t is (1, 2), right is (0, 1)")


def test_of_verdicts_the_one_that_earns_least_is_told():
    verdicts = [full("One."), Verdict(0.5, "Two."), Verdict(0.5, "Three.")]
    assert worst(verdicts).message == "Two."
