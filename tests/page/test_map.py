"""The map of the course: who builds on whom, in columns, and never a lesson that waits for
itself.
"""

import re
from itertools import combinations

from workbench.chapters import NAMES
from workbench.lesson import course
from workbench.page.map import HEIGHT, WIDTH, course_map, depths, rows

NEEDS = {
    "a": (),
    "b": ("a",),
    "c": (),
    "d": ("b", "c"),
    "e": ("a", "nowhere"),
    "f": ("g",),
    "g": ("f",),
}
CHAPTERS = {"One": ["a", "b", "c"], "Two": ["d", "e"], "More": ["f", "g"]}


def drawn(names, needs=NEEDS, chapters=CHAPTERS) -> str:
    return course_map(
        names, needs, {name: f"?lesson={name}&x" for name in needs}, chapters=chapters
    )


def course_drawn() -> tuple[dict[str, tuple[str, ...]], dict[str, list[str]]]:
    lessons = course().values()
    needs = {lesson.name: lesson.needs for lesson in lessons}
    return needs, {
        name: [member.name for member in lessons if member.chapter == name] for name in NAMES
    }


def test_a_lesson_stands_right_of_all_that_it_needs():
    at = depths(NEEDS)
    assert [at[name] for name in "abcde"] == [0, 1, 0, 2, 1]
    # a ring of needs: the one that stands first in the course waits for nobody
    assert at["f"] < at["g"]


def test_every_lesson_has_a_place_of_its_own_in_the_band_of_its_chapter():
    needs, chapters = course_drawn()
    for wanted, parts in ((NEEDS, CHAPTERS), (needs, chapters)):
        row, bands = rows(wanted, parts)
        column = depths(wanted)
        assert len({(column[name], row[name]) for name in wanted}) == len(wanted)
        assert all(
            row[name] in bands[chapter] for chapter, names in parts.items() for name in names
        )
        assert sorted(at for band in bands.values() for at in band) == list(
            range(max(row.values()) + 1)
        )


def test_the_map_links_every_lesson_and_draws_every_need_once():
    html = drawn({name: f"<{name}>" for name in NEEDS})
    assert sorted(re.findall(r'href="\?lesson=(\w)&amp;x"', html)) == sorted(NEEDS)
    assert "&lt;a&gt;" in html
    assert "<a>" not in html
    ways = re.findall(r'data-way="(\w) (\w)"', html)
    assert sorted(ways) == [("a", "b"), ("a", "e"), ("b", "d"), ("c", "d"), ("f", "g")]
    assert drawn({"a": "A"}, {"a": ()}, {"One": ["a"]}) == ""


def test_no_two_lines_from_different_lessons_lie_on_each_other():
    needs, chapters = course_drawn()
    html = drawn({name: name for name in needs}, needs, chapters)
    upright = []
    for need, path in re.findall(r'data-way="(\w+) \w+" d="([^"]*)"', html):
        turn = re.search(r"Q(\d+) (\d+) .*?Q\d+ (\d+) ", path)
        if turn is not None:
            x, *ends = map(int, turn.groups())
            upright.append((need, x, *sorted(ends)))
    assert len(upright) > 8
    for (need, x, low, high), (other, x_other, low_other, high_other) in combinations(upright, 2):
        assert need == other or x != x_other or high <= low_other or high_other <= low, (
            need,
            other,
        )


def test_no_line_passes_behind_a_lesson():
    needs, chapters = course_drawn()
    for wanted, parts in ((NEEDS, CHAPTERS), (needs, chapters)):
        html = drawn({name: name for name in wanted}, wanted, parts)
        boxes = {
            name: (int(x), int(y))
            for name, x, y in re.findall(r'data-name="(\w+)"[^>]*><rect x="(\d+)" y="(\d+)"', html)
        }
        for need, other, path in re.findall(r'data-way="(\w+) (\w+)" d="([^"]*)"', html):
            end = boxes[other][1] + HEIGHT // 2
            start = (
                int(re.findall(r"V\d+Q(\d+)", path)[0]) if "V" in path else boxes[need][0] + WIDTH
            )
            behind = [
                name
                for name, (x, y) in boxes.items()
                if y < end < y + HEIGHT and start < x + WIDTH and x < boxes[other][0]
            ]
            assert behind == [], (need, other)


def test_a_long_title_has_two_lines_and_is_read_as_one():
    html = drawn(dict.fromkeys(NEEDS, "Coordinates and their poles"))
    assert html.count("<tspan") == 2 * len(NEEDS)
    assert "Coordinates and their poles" in re.sub(r"<[^>]*>", "", html)


def test_the_course_puts_every_lesson_after_what_it_needs():
    lessons = list(course().values())
    for i, lesson in enumerate(lessons):
        assert set(lesson.needs) <= {earlier.name for earlier in lessons[:i]}, lesson.name
