"""The map of the course: who builds on whom, in columns, and never a lesson that waits for
itself.
"""

import re

from workbench.lesson import course
from workbench.page.map import columns, course_map

NEEDS = {
    "a": (),
    "b": ("a",),
    "c": (),
    "d": ("b", "c"),
    "e": ("a", "nowhere"),
    "f": ("g",),
    "g": ("f",),
}


def test_a_lesson_stands_right_of_all_that_it_needs():
    placed = columns(NEEDS)
    at = {name: i for i, column in enumerate(placed) for name in column}
    assert sorted(at) == sorted(NEEDS)
    assert [at[name] for name in "abcde"] == [0, 1, 0, 2, 1]
    assert (
        at["f"] < at["g"]
    )  # a ring of needs: the one that stands first in the course waits for nobody


def test_the_map_links_every_lesson_and_draws_every_need_once():
    names = {name: f"<{name}>" for name in NEEDS}
    html = course_map(names, NEEDS, {name: f"?lesson={name}&x" for name in NEEDS})
    assert re.findall(r'href="\?lesson=(\w)&amp;x"', html) == [
        name for column in columns(NEEDS) for name in column
    ]
    assert "&lt;a&gt;" in html
    assert "<a>" not in html
    assert html.count("<path ") == 6  # all but the one that is nowhere, the ring's two included
    assert course_map({"a": "A"}, {"a": ()}, {"a": ""}) == ""


def test_the_course_puts_every_lesson_after_what_it_needs():
    lessons = list(course().values())
    for i, lesson in enumerate(lessons):
        assert set(lesson.needs) <= {one.name for one in lessons[:i]}, lesson.name
