"""The words of a page that light a thing of the scene name one that is drawn."""

import re

import pytest

from tests.runs import finished
from workbench.lesson import catalog
from workbench.page.article import article_html


@pytest.mark.parametrize("name", catalog())
def test_every_term_names_a_thing_that_some_run_of_the_page_draws(name):
    lesson = catalog()[name]
    named = set(re.findall(r'data-thing="([^"]+)"', article_html(lesson, lambda run, step: "")))
    drawn: set[str] = set()
    for params in (lesson.params(), *(preset.params for preset in lesson.presets)):
        if named <= drawn:
            break
        drawn |= {path for step in finished(name, params).known() for path in step.scene}
    assert not named - drawn
