"""A story on a site: both faces in one page, and how much it loads before its first what-if."""

import gzip
import re

import pytest

from tests.story.hill import lesson
from workbench.lesson import catalog
from workbench.page.bundles import FONTS, MATH_FONT, SITE_STORY, STATIC, STORY_STYLES, bundle
from workbench.publish import site
from workbench.publish.pages import lesson_page
from workbench.publish.runs import _all_runs, client_script, recorded, run_script, runs_of
from workbench.run.timeline import Timeline
from workbench.story import has_story, story_of
from workbench.words.typeset import math_font

BUDGET = 1_500_000
"""Bytes of a story on a site before its first what-if, as a static server sends them: compressed
where that helps.
"""
TOLD = [name for name, entry in catalog().items() if has_story(entry)]


@pytest.fixture(scope="module")
def out(tmp_path_factory):
    folder = tmp_path_factory.mktemp("told") / "site"
    site.publish(folder, [lesson])
    return folder


def test_a_page_has_both_faces_and_one_stage(out):
    page = (out / "hill" / "index.html").read_text(encoding="utf-8")
    assert (
        page.count('id="stage"')
        == page.count('<div id="story">')
        == page.count('<article id="article">')
        == 1
    )
    assert re.findall(r'<section class="scene[^"]*" id="(\w+)"', page) == [
        "hill",
        "downhill",
        "starts",
        "turn",
    ]
    assert 'data-face="story"' in page
    assert page.index("const STORY") > page.index("const LESSON")
    assert re.findall(r'src="../page/([^"]+)"', page) == [SITE_STORY]
    assert page.count('class="question"') == 0, "its questions stand in their scenes"


def test_its_letters_styles_and_scripts_are_there(out):
    for name in (*FONTS, STORY_STYLES, SITE_STORY):
        assert (out / "page" / name).stat().st_size > 0
    assert "Source Serif" in (out / "page" / "third-parties.txt").read_text(encoding="utf-8")


def test_a_run_alone_has_the_workbench_only(out):
    page = (out / "hill" / "runs" / "far.html").read_text(encoding="utf-8")
    assert 'data-face="bench"' in page
    assert "STORY" not in page


def test_the_page_tells_no_answer(out):
    page = (out / "hill" / "index.html").read_text(encoding="utf-8")
    assert "The valley on the left is deeper." not in page
    assert "The left one is deeper." not in page


@pytest.mark.parametrize("name", TOLD)
def test_a_story_loads_little_before_its_first_what_if(name):
    told = catalog()[name]
    story = story_of(told, "site")
    assert story is not None
    known = recorded(told, runs_of(told)[0], root="../", runs="runs/", answers={})
    texts = [lesson_page(told, known), client_script(), bundle(STORY_STYLES), bundle(SITE_STORY)]
    by_name = {run.name: run for run in _all_runs(told)}
    for run in story.runs_before_what_ifs():
        timeline = Timeline(told, by_name[run].params).complete()
        texts.append(run_script(told, by_name[run], timeline))
    weight = sum(len(gzip.compress(text.encode(), 6)) for text in texts)
    weight += sum((STATIC / font).stat().st_size for font in FONTS) + len(math_font())
    assert weight < BUDGET, f"{name}: {weight / 1e6:.2f} MB ({MATH_FONT} included)"
