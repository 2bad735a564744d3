"""Runs of the distances lesson that its tests share, and what they read off them."""

from lessons.distances import questions
from lessons.distances.lesson import lesson
from tests.runs import finished


def states(params):
    return finished("distances", params).states()


def preset(name):
    return lesson.preset(name).params


def now(kind, params, step=-1):
    result = states(params)[step].now
    assert isinstance(result, kind)
    return result


def goal(params) -> tuple[float, float]:
    return questions.to_goal(states(params))
