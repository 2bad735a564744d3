"""No text that stands before a prediction tells its answer; `tests.spoilers` says what is looked at
and by which rules.

A page may teach the principle from which an answer follows; it may not state the case that a
question asks about.
"""

import importlib
from typing import Any

import pytest

from tests.spoilers import Passage, by_choice, by_number, spoilers
from workbench.lesson import Question, catalog

ASKED = [(name, question) for name, lesson in catalog().items() for question in lesson.questions]


def listed(name: str) -> Any:
    """What is listed by hand for a lesson."""
    return importlib.import_module(f"tests.giveaways.{name}")


@pytest.mark.parametrize(
    ("name", "question"), [pytest.param(n, q, id=f"{n}-{q.name}") for n, q in ASKED]
)
def test_nothing_before_a_prediction_tells_its_answer(name, question):
    of_lesson = listed(name)
    giveaways = of_lesson.GIVEAWAYS.get(question.name, ())
    findings = spoilers(
        name,
        question,
        giveaways,
        innocent=getattr(of_lesson, "INNOCENT", {}).get(question.name, ""),
    )
    assert not findings, "\n".join(["the answer is given away:", *findings])


@pytest.mark.parametrize("name", catalog())
def test_for_every_question_somebody_thought_of_what_would_tell_its_answer(name):
    names = {question.name for question in catalog()[name].questions}
    assert set(listed(name).GIVEAWAYS) == names
    assert set(getattr(listed(name), "INNOCENT", {})) <= names


def question(
    text: str, unit: str = "", tolerance: float = 0.0, *, choices: tuple[str, ...] = ()
) -> Question:
    return Question(
        "q", text, lambda states: 0.0, lambda states: "", "a run", choices, unit, tolerance
    )


MATCHES = "How many percent of the first matches are right (within two point spacings)?"
FAR = "The source starts 120° away. What will ICP do?"
FAR_CHOICES = (
    "Come home, only more slowly",
    "Stop because the RMSE rises",
    "Lower the RMSE to the end and be wrong",
)
PLANE = (
    "From 35°, point-to-point takes 61 iterations to its stop. How many does point-to-plane take?"
)


HOW_MANY = question(MATCHES, unit="%", tolerance=8.0)
STEPS = question(PLANE, tolerance=3.0)
HIGH = question("How high is the camera above ground?", unit="m", tolerance=0.1)
TURNS = question("In how many directions does it turn?", tolerance=0.5)
WHAT = question(FAR, choices=FAR_CHOICES)


@pytest.mark.parametrize(
    ("asked", "right", "text", "run", "told"),
    [
        (HOW_MANY, 2.0, "Read how many matches are right: 2 % at first.", None, True),
        (HOW_MANY, 2.0, "One in fifty of the matches is right.", None, True),
        (HOW_MANY, 2.0, "Half of the matches are right.", None, False),
        (HOW_MANY, 2.0, "Match 2 keeps 90 % of the points.", "a run", False),
        (STEPS, 10.0, "Point-to-plane takes a sixth of the iterations.", None, True),
        (STEPS, 10.0, "Point-to-plane stops after ten iterations.", None, True),
        (STEPS, 10.0, "Point-to-plane stops within 10 mm.", None, False),
        (HIGH, 1.7, "The camera is 170 cm above ground.", None, True),
        (HIGH, 1.7, "The wall is 1.7 m long.", None, False),
        (HIGH, 1.7, "The camera of this run is 1.7 m above ground.", "another run", True),
        (TURNS, 2.0, "A 2-D picture of a turn in one direction", None, False),
        (WHAT, 2.0, "120° away: settled and wrong", "a run", True),
        (WHAT, 2.0, "120° away: does it come home?", "a run", False),
        (WHAT, 2.0, "A fit of the wrong kind", None, False),
    ],
)
def test_the_rules_tell_a_spoiler_from_a_coincidence(asked, right, text, *, run, told):
    rule = by_choice if asked.choices else by_number
    assert bool(list(rule(asked, right, [Passage("here", text, run)]))) is told
