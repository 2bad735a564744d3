import pytest

from tests.fake import lesson
from workbench.errors import InputError
from workbench.lesson import course
from workbench.run.questions import answer
from workbench.run.timeline import Timelines

NUMBER, CHOICE = lesson.questions
KEPT = Timelines()


@pytest.mark.parametrize(
    ("question", "given", "right", "truth"),
    [
        (NUMBER, 0.005, True, "0 m"),
        (NUMBER, "0.005", True, "0 m"),
        (NUMBER, 0.5, False, "0 m"),
        (NUMBER, None, False, "0 m"),
        (NUMBER, float("nan"), False, "0 m"),
        (CHOICE, "the second", True, "the second"),
        (CHOICE, "the first", False, "the second"),
        (CHOICE, None, False, "the second"),
    ],
)
def test_a_prediction_is_compared_with_the_run(question, given, right, *, truth):
    answered = answer(lesson, question, given, timelines=KEPT)
    assert (answered.right, answered.truth) == (right, truth)
    assert answered.step == 5
    assert len(KEPT) == 1


@pytest.mark.parametrize(
    ("question", "given", "reply"),
    [
        (NUMBER, 1.0, "That is where it starts."),
        (NUMBER, 0.5, ""),
        (NUMBER, 0.0, ""),
        (NUMBER, None, ""),
        (CHOICE, "the first", "It only looks larger."),
        (CHOICE, "the second", ""),
        (CHOICE, None, ""),
    ],
)
def test_a_known_wrong_answer_is_answered_by_name(question, given, reply):
    assert answer(lesson, question, given, timelines=KEPT).reply == reply


@pytest.mark.parametrize(
    ("question", "given", "words"),
    [
        (CHOICE, "perhaps", "choose one"),
        (CHOICE, 7, "choose one"),
        (NUMBER, "much", "a number"),
        (NUMBER, [], "a number"),
    ],
)
def test_what_is_no_answer_to_a_question_is_refused(question, given, words):
    with pytest.raises(InputError, match=words):
        answer(lesson, question, given, timelines=KEPT)


@pytest.mark.parametrize("of_course", course().values(), ids=lambda of_course: of_course.name)
def test_every_question_of_the_course_knows_its_wrong_answers(of_course):
    for question in of_course.questions:
        if question.choices:
            silent = [text for i, text in enumerate(question.choices) if not question.reply(i)]
            # the right one; `validate` holds which it is
            assert len(silent) == 1, (question.name, silent)
        else:
            assert question.wrong, question.name
