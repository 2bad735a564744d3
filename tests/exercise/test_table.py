"""What students hand in gets what it deserves: right solutions in any style full marks, wrong ones
less and a true word.
"""

import re

import pytest

from tests.exercise.table import FOLDER, Graded, complaints, graded, graded_strangers
from workbench.exercise.finding import exercises

EXERCISES = list(exercises().values())
LEAST_RIGHT, LEAST_WRONG = 4, 8
TOLD_VAGUELY = {"wrong_equal_points_have_no_frame"}
"""Those that a check tells without both numbers."""


@pytest.fixture(scope="module")
def every() -> dict[str, list[Graded]]:
    return {}


@pytest.mark.parametrize("exercise", EXERCISES, ids=lambda exercise: exercise.name)
def test_what_students_hand_in_gets_what_it_deserves(exercise, every):
    solutions = every.setdefault(exercise.name, list(graded(exercise)))
    assert sum(solution.is_right for solution in solutions) >= LEAST_RIGHT
    assert sum(not solution.is_right for solution in solutions) >= LEAST_WRONG
    assert not complaints(solutions), "\n\n".join(complaints(solutions))
    assert {solution.name for solution in solutions if solution.fate == "vague"} <= TOLD_VAGUELY


def test_right_answers_of_people_who_saw_no_checks_have_full_marks():
    solutions = list(graded_strangers())
    assert {solution.report.exercise.name for solution in solutions} == {
        exercise.name for exercise in EXERCISES
    }
    assert len(solutions) >= 60
    assert not complaints(solutions), "\n\n".join(complaints(solutions))


def test_every_exercise_has_its_file():
    assert {path.stem for path in FOLDER.glob("*.py")} == {exercise.name for exercise in EXERCISES}


def test_no_solution_is_handed_in_twice():
    for path in FOLDER.glob("*.py"):
        bodies = re.split(
            r"^def \w+\(.*\):\n", path.read_text(encoding="utf-8"), flags=re.MULTILINE
        )[1:]
        assert len(bodies) == len(set(bodies)), path.name
