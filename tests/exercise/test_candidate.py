"""A function under test: what it is asked, what of its answers is taken, what a student is told."""

import numpy as np
import pytest

from workbench.exercise.candidate import Candidate, held_to_contract
from workbench.exercise.student import StudentError


def asked_for(answer, right, *args) -> str:
    """Return what a student is told whose function answers so."""
    with pytest.raises(StudentError) as told:
        Candidate(lambda *_: answer, lambda *_: right)(*args)
    assert told.value.kind == "result"
    return str(told.value)


@pytest.mark.parametrize(
    ("answer", "kind"),
    [
        (None, "nothing"),
        ("a", "a text"),
        (True, "true or false"),
        (3, "a whole number"),
        (np.int32(3), "a whole number"),
        (3.0, "a number"),
        (np.float64(3), "a number"),
        ([1.0, 2.0], "2 values"),
        (np.zeros((2, 4)), "an array (2, 4) of numbers"),
        (np.zeros(2, int), "an array (2,) of whole numbers"),
        (np.zeros(2, np.uint8), "an array (2,) of whole numbers"),
        (np.zeros(2, bool), "an array (2,) of true or false"),
    ],
)
def test_what_came_is_told_in_words(answer, kind):
    message = asked_for(answer, np.zeros((3, 3)), np.zeros(99))
    assert f"returned {kind}; the contract asks for an array (3, 3) of numbers" in message
    assert message.endswith("Is a return missing?") == (kind in ("nothing", "a text"))


@pytest.mark.parametrize(
    ("args", "asked"),
    [
        ((2.0, np.array([1, 2])), " (asked for 2, (1, 2))"),
        ((np.arange(12.0),), f" (asked for ({', '.join(map(str, range(12)))}))"),
        ((np.arange(13.0),), ""),
        ((np.zeros(0),), ""),
        (("near", 3), " (asked for 'near', 3)"),
    ],
)
def test_a_short_question_is_told_with_what_is_wrong_in_the_answer(args, asked):
    assert asked_for(None, 1.0, *args).endswith(f"Is a return missing?{asked}")


@pytest.mark.parametrize(
    ("answer", "right", "plain"),
    [
        (np.float32(2.5), 1.0, 2.5),
        (2, 1.0, 2.0),
        (True, 1.0, 1.0),
        (np.int8(2), 1, 2),
        (np.bool_(True), False, True),
        ([1, 2], np.zeros(2), np.array([1.0, 2.0])),
        (np.array([3, 4], np.uint8), np.zeros(2, int), np.array([3, 4])),
        (np.array([3, 4], np.uint8), np.zeros(2, np.uint8), np.array([3, 4])),
        (np.array([True, False]), np.zeros(2, bool), np.array([True, False])),
        (np.array([3.0, 0.5]), (3, 0.5), (3, 0.5)),
        ([[1, 2], 0.5], (np.zeros(2), 0.0), (np.array([1.0, 2.0]), 0.5)),
    ],
)
def test_an_answer_is_of_the_plain_kind_that_is_asked_for(answer, right, plain):
    got = held_to_contract(answer, right, "f")
    assert type(got) is type(plain)
    for value, wanted in (
        zip(got, plain, strict=True) if isinstance(plain, tuple) else [(got, plain)]
    ):
        assert type(value) is type(wanted)
        assert np.asarray(value).dtype == np.asarray(wanted).dtype
        np.testing.assert_array_equal(value, wanted)


@pytest.mark.parametrize(
    ("answer", "right", "message"),
    [
        (1.0, 1, "returned float64 values; the contract asks for a whole number"),
        (1, True, "returned int64 values; the contract asks for true or false"),
        (1j, 1.0, "returned complex128 values; the contract asks for a number"),
        (
            np.nan,
            1.0,
            "returned nan; the contract asks for finite numbers. yours is nan, right is",
        ),
        (
            np.array([[1.0, np.inf], [np.nan, 2.0]]),
            np.ones((2, 2)),
            "returned 2 of 4 values not finite; the contract asks for finite numbers. [0, 1] is",
        ),
        (
            np.array([1.0, 2e60]),
            np.ones(2),
            "returned 1 of 2 values too large to be judged; the contract asks for numbers that can"
            " be computed with. [1] is 2e+60, right is 1",
        ),
        ((1.0, np.zeros(2)), (1.0, 2.0), "f[1] returned an array (2,) of numbers"),
        ((1.0, 2.0, 3.0), (1.0, 2.0), "f returned 3 values; the contract asks for 2 values"),
        (1.0, (1.0, 2.0), "f returned a number; the contract asks for 2 values"),
    ],
)
def test_another_kind_is_told_with_the_first_place_where_it_is(answer, right, message):
    with pytest.raises(StudentError) as told:
        held_to_contract(answer, right, "f")
    assert message in str(told.value)


def test_where_the_right_answer_is_infinite_so_may_the_student_s_be():
    right = np.array([1.0, np.inf, np.nan])
    np.testing.assert_array_equal(held_to_contract(right, right, "f"), right)


def test_our_own_function_divides_by_zero_in_silence():
    ours = Candidate(lambda p: np.full(2, np.inf), lambda p: 1.0 / p)
    assert np.isinf(ours(np.zeros(2))).all()
    assert ours.calls[0].right.error == ""


def test_arguments_are_copies_and_who_changes_them_is_noticed():
    def doubling(p, k):
        p *= 2
        return p.sum()

    candidate = Candidate(doubling, lambda p, k: 2.0 * p.sum())
    p = np.ones(3)
    assert candidate(p, 1) == 6.0
    assert p.tolist() == [1, 1, 1]
    assert candidate.changed_inputs
    assert [args[0] is p for args in candidate.changing] == [True]
    candidate.function = lambda p, k: p.sum()
    candidate(p, 1)
    assert not candidate.changed_inputs
    assert len(candidate.changing) == 1


def test_what_was_raised_is_kept_by_python_s_own_name():
    class MineError(IndexError):
        pass

    def failing(kind):
        raise kind("no")

    candidate = Candidate(failing, lambda kind: 1.0)
    for kind, name in ((MineError, "IndexError"), (np.linalg.LinAlgError, "ValueError")):
        with pytest.raises(StudentError) as told:
            candidate(kind)
        assert told.value.error == kind.__name__
        assert "IndexError" in told.value.errors or kind is not MineError
        assert (candidate.calls[-1].answer.value, candidate.calls[-1].answer.error) == (None, name)
    assert candidate.expected == 1.0
    assert str(told.value) == "<lambda> raised LinAlgError: no"


@pytest.mark.parametrize(
    ("error", "kept"),
    [
        (StudentError("x", "raised", "Mine", errors=("Mine", "IndexError")), "IndexError"),
        (StudentError("x", "raised", "Mine"), "Mine"),
        (StudentError("it took too long", "timeout"), "timeout"),
    ],
)
def test_an_error_that_came_from_a_student_s_process_is_kept_by_python_s_own_name(error, kept):
    def failing():
        raise error

    candidate = Candidate(failing, lambda: 1.0)
    with pytest.raises(StudentError) as told:
        candidate()
    assert told.value is error
    assert (candidate.calls[-1].answer.value, candidate.calls[-1].answer.error) == (None, kept)


def test_a_call_is_known_again_by_what_was_asked():
    candidate = Candidate(lambda *args: 1.0, lambda *args: 1.0)
    for args in ((np.zeros(4), 1), (np.zeros(4), 1), (np.zeros((2, 2)), 1), (np.zeros(4, int), 1)):
        candidate(*args)
    first, again, *others = [call.key for call in candidate.calls]
    assert first == again
    assert first not in others
    assert len({hash(key) for key in others}) == 2


def test_where_ours_gives_no_answer_theirs_is_left_as_it_is():
    assert held_to_contract("any", None, "f") == "any"
