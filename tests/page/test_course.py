"""The course page: chapters in order, what a card says, and what the page weighs before its
pictures.
"""

import re
from dataclasses import replace

import pytest

from tests import fake
from workbench.chapters import CHAPTERS, MORE, NAMES, chapter_of, place
from workbench.lesson import Lesson, catalog, course, place_of
from workbench.page.bundles import FONTS, FRONT_SCRIPTS, FRONT_STYLES, STATIC, bundle
from workbench.page.course import FRONT_DARK, FRONT_LIGHT, Card, course_document
from workbench.viewer.documents import course_page

TODAY = {
    "Move": ["transforms", "rotations", "coordinates"],
    "Estimate": ["pairs", "icp", "axes", "fitting", "ransac"],
    "See": ["pinhole", "calibration", "pose", "features", "epipolar", "disparity"],
    "Measure": ["representations", "measures", "curvature", "distances", "chamfer_emd"],
    "Connect": ["graphs"],
    "Learn": ["learning"],
}
"""The lessons of the course by chapter, in order."""
BUDGET = 300_000


def card(name: str, **given) -> Card:
    usual = {
        "title": name.title(),
        "summary": "",
        "needs": (),
        "address": f"{name}/",
        "picture": "p.webp",
    }
    return Card(name=name, **(usual | given))


def test_the_course_is_told_in_six_chapters():
    assert list(TODAY) == list(NAMES)
    chapters = {
        name: [lesson.name for lesson in course().values() if lesson.chapter == name]
        for name in NAMES
    }
    assert chapters == TODAY
    assert [name for names in TODAY.values() for name in names] == list(course())


def test_a_lesson_without_a_chapter_stands_behind_them_all():
    assert chapter_of("") is MORE
    assert chapter_of("move") is MORE
    theirs = replace(fake.lesson, order=1)
    ours = course()["learning"]
    assert place_of(ours) < place_of(theirs)
    assert place_of(replace(theirs, chapter="Learn")) < place_of(ours), "there its order counts"
    html = course_page({**catalog(), "fake": theirs})
    assert re.findall(r'<section class="chapter[^"]*" id="([\w-]+)"', html) == [
        *(chapter.address for chapter in CHAPTERS),
        MORE.address,
    ]
    assert re.findall(r'data-card="(\w+)"', html)[-1] == "fake"


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (
            {"chapter": "move"},
            (
                "lesson fake: chapter is one of Move, Estimate, See, Measure, Connect, Learn, not"
                " 'move'"
            ),
        ),
        ({"minutes": 0}, "minutes is a whole number of minutes, not 0"),
        ({"minutes": 12.5}, "minutes is a whole number of minutes, not 12.5"),
    ],
)
def test_a_chapter_is_one_of_six_words(given, message):
    with pytest.raises(ValueError, match=message):
        replace(fake.lesson, **given)


def test_a_card_says_how_long_it_takes_and_what_it_builds_on():
    first = card("a", title="RANSAC", chapter="See", minutes=25)
    second = card("b", title="<B>", chapter="See", needs=("a", "c", "gone"), summary="1 < 2")
    third = card("c", title="The pinhole camera", chapter="Move")
    cards = sorted([first, second, third], key=lambda entry: place(entry.chapter, 1, entry.name))
    html = course_document(cards, root="page/")
    facts = re.findall(r'<p class="facts">([^<]*)<', html)
    assert facts == ["20 min", "25 min", "20 min · after RANSAC, the pinhole camera"]
    assert "1 &lt; 2" in html
    assert "<B>" not in html
    assert re.findall(r'<nav class="line".*?</nav>', html)[0].count("<a ") == 2
    assert 'id="begin" href="c/">Start here: The pinhole camera</a>' in html


def test_a_course_without_lessons_is_a_page_all_the_same():
    html = course_document([], root="page/", trouble="no lesson <is> here")
    assert "no lesson &lt;is&gt; here" in html
    assert "Start here" not in html
    assert 'class="line"' not in html


def test_the_page_is_light_before_its_pictures():
    html = course_page(catalog())
    files = {
        name.partition("/")[2] for name in re.findall(r'(?:href|src)="(page/[\w.-]+)"', html)
    } - {"third-parties.txt", "front-still.webp"}  # the loop comes where motion is allowed
    for names in (FRONT_LIGHT, FRONT_DARK):
        assert sum((STATIC / name).stat().st_size for name in names) < BUDGET
    assert files == {FRONT_STYLES, FRONT_SCRIPTS, "icon.svg", "unscripted.css"}
    weight = len(html.encode()) + sum(len(bundle(name)) for name in (FRONT_STYLES, FRONT_SCRIPTS))
    assert weight + (STATIC / FONTS[0]).stat().st_size < BUDGET / 2


def test_the_summaries_are_sentences():
    for lesson in course().values():
        assert isinstance(lesson, Lesson)
        assert lesson.summary.endswith("."), lesson.name
        assert len(lesson.summary) <= 115, lesson.name
