"""Every link of every lesson's article leads to a step that exists, and every term to a thing that
some run draws.
"""

import re

import pytest

from tests.runs import finished
from workbench.lesson import Lesson, catalog
from workbench.page.article import article_html

LESSONS = [pytest.param(lesson, id=name) for name, lesson in catalog().items()]
LINK = re.compile(r'data-run="([^"]*)"(?: data-step="(-?\d+)")?>')


def led_to(lesson: Lesson) -> list[tuple[str, int | None]]:
    text = article_html(lesson, lambda run, step: "", "live")
    return [(run, int(step) if step else None) for run, step in LINK.findall(text)]


@pytest.mark.parametrize("lesson", LESSONS)
def test_a_link_leads_to_a_step_that_exists(lesson):
    for run, step in led_to(lesson):
        params = lesson.params() if run in ("", "default") else lesson.preset(run).params
        length = len(finished(lesson.name, params))
        assert step is None or -length <= step < length, (
            f"{run or 'this'}@{step}: its run has {length} steps"
        )


@pytest.mark.parametrize("lesson", LESSONS)
def test_a_term_names_a_thing_that_is_drawn(lesson):
    terms = set(
        re.findall(r'data-thing="([^"]*)"', article_html(lesson, lambda run, step: "", "live"))
    )
    drawn: set[str] = set()
    for params in (lesson.params(), *(preset.params for preset in lesson.presets)):
        if terms <= drawn:
            break
        paths = {path for step in finished(lesson.name, params).known() for path in step.scene}
        # a term may light all below one name
        drawn |= paths | {path.rpartition("/")[0] for path in paths}
    assert not terms - drawn
