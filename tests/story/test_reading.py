"""page.md as a story: scenes, beats, what its words name, and errors with their line."""

import re
from dataclasses import replace
from pathlib import Path

import pytest

from tests.story.hill import lesson
from workbench.certain import sure
from workbench.errors import AuthorError
from workbench.page.article import article_html
from workbench.page.document import lesson_document
from workbench.story import has_story, plain_text, story_data, story_of
from workbench.story.names import PAGE_IDS

STATIC = Path(__file__).parents[2] / "workbench" / "page" / "static"


def with_page(tmp_path, text):
    page = tmp_path / "page.md"
    page.write_text(text, encoding="utf-8")
    return replace(lesson, page=page)


def told(tmp_path, text, home="live"):
    return sure(story_of(with_page(tmp_path, text), home))


def beats(story, scene=0):
    return [(place.run, place.start, place.step) for place in story.scenes[scene].beats]


def test_a_page_without_a_named_heading_tells_no_story(tmp_path):
    assert has_story(lesson)
    unnamed = with_page(tmp_path, "# Title\n\n## Match\n\nWords {not a name}.")
    assert story_of(unnamed, "live") is None


def test_it_is_read_once_and_anew_when_its_page_or_its_lesson_changes(tmp_path):
    edited = with_page(tmp_path, "# T\n\n## A {#a}\n\nOne.\n")
    first = sure(story_of(edited, "live"))
    assert story_of(edited, "live") is first
    site = sure(story_of(edited, "site"))
    assert site is not first
    assert story_of(edited, "live") is first
    sure(edited.page).write_text("# T\n\n## B {#b}\n\nTwo.\n", encoding="utf-8")
    assert [scene.name for scene in sure(story_of(edited, "live")).scenes] == ["b"]
    other = replace(edited, title="Another")
    assert sure(story_of(other, "site")).scenes[0].name == "b"


def test_scenes_stand_in_order_with_their_names_and_titles():
    story = sure(story_of(lesson, "live"))
    assert [(scene.name, scene.title) for scene in story.scenes] == [
        ("hill", "The hill"),
        ("downhill", "A step goes downhill"),
        ("starts", "Where it starts decides"),
        ("turn", "Your turn"),
    ]
    assert story.title == "Rolling down"
    assert [scene.is_turn for scene in story.scenes] == [False, False, False, True]


def test_a_line_of_attributes_moves_the_stage_from_there_on(tmp_path):
    story = told(
        tmp_path, "## A {#a run=far}\n\nOne.\n\n{step=2}\nTwo.\n\nStill two.\n\n{step=stop}\nEnd.\n"
    )
    assert beats(story) == [("far", None, 0), ("far", None, 2), ("far", None, "stop")]
    assert re.findall(r'<p data-beat="(\d)">', story.html) == ["0", "1", "1", "2"]


def test_what_is_played_once_rests_at_its_end(tmp_path):
    story = told(tmp_path, "## A {#a}\n\n{play=0:stop}\nIt rolls.\n\nIt rests.\n")
    assert beats(story) == [("default", 0, "stop"), ("default", None, "stop")]


def test_behind_a_question_stands_what_its_answer_shows(tmp_path):
    text = "## A {#a run=far camera=side}\n\nOne.\n\n::: {.ask #second step=2}\n:::\n\nSeen.\n"
    story = told(tmp_path, text)
    assert beats(story) == [("far", None, 0), ("far", None, 2), ("far", None, "stop")]
    assert '<p class="later" data-beat="2">' in story.html
    start = story_data(lesson, story)["starts"]["second"]
    assert (start["run"], start["step"], start["view"]) == ("far", 2, "side")
    seen = start["seen"]
    assert (seen["run"], seen["step"], seen["view"]) == ("far", "stop", "side")


def test_runs_are_named_as_every_home_names_them(tmp_path):
    story = told(tmp_path, "## A {#a run=where}\n\nOne. [Far](run:second@-1)\n")
    assert story.scenes[0].beats[0].run == "default"  # the question's params are those by default
    assert 'data-go="far@-1"' in story.html  # and of the other, those of a preset


def test_numbers_under_the_hand_and_numbers_of_the_run():
    live, site = (sure(story_of(lesson, home)).html for home in ("live", "site"))
    assert '<span class="num" data-steps="place" data-unit=" m">−2.0 m</span>' in live
    assert '<span class="value" data-value="height" data-at="default@1">' in live
    assert '<span class="num" data-knob="share" data-unit="">0.10</span>' in site  # it has a sweep


def test_a_knob_without_a_sweep_is_plain_text_on_a_site(tmp_path):
    text = "## A {#a}\n\nFrom [−0.5 m]{knob=start}.\n"
    assert 'data-knob="start"' in told(tmp_path, text).html
    assert '<p data-beat="0">From −0.5 m.</p>' in told(tmp_path, text, "site").html


def test_a_number_under_the_hand_may_have_ends_of_its_own(tmp_path):
    text = "## A {#a}\n\nFrom [−0.5 m]{knob=start low=-1 high=0.5}.\n"
    assert 'data-unit=" m" data-low="-1" data-high="0.5"' in told(tmp_path, text).html


def test_what_is_for_one_home_keeps_the_lines_of_the_rest(tmp_path):
    text = "## A {#a}\n\n{{live: Drag\nit.}}\n\nSee [x](run:nowhere).\n"
    for home in ("live", "site"):
        with pytest.raises(AuthorError, match=r"page\.md, line 6: there is no run 'nowhere'"):
            told(tmp_path, text, home)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("## A {#a run=nope}\n\nx", "line 1: there is no run 'nope'"),
        ("## A {#a camera=frnt}\n\nx", "line 1: there is no camera 'frnt'; did you mean front"),
        ("## A {#a}\n\nx\n\n{step=two}\ny", "line 6: 'two' is no step"),
        ("## A {#a}\n\nx [1]{knob=speed}", "line 3: there is no knob 'speed'"),
        ("## A {#a}\n\nx [1]{knob=start low=a}", "line 3: low and high of 'start' are numbers"),
        ("## A {#a}\n\nx [1]{knob=start high=99}", "line 3: low and high of 'start' are numbers"),
        ("## A {#a}\n\nx\ny [b]{.blue}", "line 4: there is no colour role 'blue'"),
        ("## A {#a}\n\n::: {.ask #why}\n:::", "line 3: there is no question 'why'"),
        ("## A {#a}\n\n::: {.ask #second}\n:::\n\n::: {.ask #second}\n:::", "line 6: the question"),
        ("## A {#a}\n\nx\n\n## B\n\ny", "line 5: the scene 'B' has no name"),
        ("## A {#a}\n\nx\n\n## B {#a}\n\ny", "line 5: line 1 has a scene 'a' already"),
        ("## A {#a}\n\n::: {.what-if}\n### T\nOnly words.\n:::", "line 3: a what-if has a title"),
        ("## A {#a}\n\n::: {.note}\n:::", "line 3: a block between ::: is"),
        ("## A {#a}\n\n{step=1 and}\nWords.", "line 3: '{step=1 and}' is not read as attributes"),
    ],
)
def test_what_the_lesson_does_not_have_is_told_with_its_line(tmp_path, text, message):
    with pytest.raises(AuthorError, match=re.escape(message)):
        told(tmp_path, text)


def test_words_are_counted_without_questions_what_ifs_and_formulas(tmp_path):
    text = (
        "## Two words {#a}\n\nThree more words.\n\n$$ a = b $$\n\n::: {.ask #second}\n:::\n\n"
        "::: {.what-if}\n### Not this\nNor this.\n[go](run:far)\n:::\n"
    )
    assert told(tmp_path, text).scenes[0].words == 5


def test_what_is_for_reference_is_folded_and_its_links_lead_somewhere():
    html = sure(story_of(lesson, "live")).reference
    assert html.startswith(
        '<details class="reference" id="reference"><summary>For reference</summary>'
    )
    assert 'data-go="far@-1"' in html
    assert "<h3>Pitfalls</h3>" in html


def test_a_recording_has_the_words_without_attributes():
    text = plain_text(lesson)
    assert "{" not in text.replace("{{live", "")
    assert ":::" not in text
    assert "A ball lies on a curve." in text
    assert "## A step goes downhill\n" in text
    assert r"$$ x \leftarrow x - a\,f'(x) . $$" in text


def own_ids():
    """The ids of the parts of a page: of its document, and of what its scripts look for."""
    page = lesson_document(
        lesson, article_html(lesson, lambda *_: "?", "live"), home="live", root="page/"
    )
    ids = set(re.findall(r'\sid="([\w-]+)"', page))
    for script in STATIC.glob("*.js"):
        ids |= set(re.findall(r'\$\("#([\w-]+)', script.read_text(encoding="utf-8")))
    return ids - {scene.name for scene in sure(story_of(lesson, "live")).scenes}


def test_no_scene_takes_the_id_of_a_part_of_the_page(tmp_path):
    missing = own_ids() - PAGE_IDS
    assert missing == set(), "a scene of that name would hide it, or be hidden with it"
    with pytest.raises(AuthorError, match="the page has a part 'back' of its own"):
        told(tmp_path, "## A {#back run=far}\n\nOne.\n")


def test_a_what_if_behind_a_question_waits_for_its_answer(tmp_path):
    asked = "::: {.ask #second run=far}\n:::\n\n"
    card = "::: {.what-if}\n### From afar\n[far](run:far)\n:::\n\n"
    before, after = re.findall(
        r'class="(what-if[^"]*)"',
        told(tmp_path, f"## A {{#a run=far}}\n\n{card}{asked}{card}").scenes[0].html,
    )
    assert (before, after) == ("what-if", "what-if later")
