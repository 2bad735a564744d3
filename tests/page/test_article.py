"""Links of an article run what they name, terms name things of the scene, and nothing of it can be
forged.
"""

from dataclasses import replace

import pytest

from tests import fake
from tests.runs import finished
from workbench.errors import AuthorError
from workbench.lesson import catalog
from workbench.page.article import PLACE, article_html
from workbench.page.document import in_script, lesson_document
from workbench.page.lessons import lesson_data


def written(tmp_path, text: str):
    page = tmp_path / "page.md"
    page.write_text(text, encoding="utf-8")
    return replace(fake.lesson, page=page)


def address(run: str, step: int | None) -> str:
    return f"?run={run}&step={step}"


def test_a_link_runs_a_preset_at_a_step_and_leads_there_without_a_script(tmp_path):
    text = article_html(
        written(
            tmp_path, "See [its end](run:half@-1), [here](run:this@3) and [anew](run:default)."
        ),
        address,
        "live",
    )
    assert (
        '<a class="run" href="?run=half&amp;step=-1" data-run="half" data-step="-1">its end</a>'
        in text
    )
    assert 'data-run="" data-step="3">here</a>' in text
    assert 'data-run="default">anew</a>' in text


def test_a_link_to_no_preset_is_told_with_those_there_are(tmp_path):
    with pytest.raises(AuthorError, match=r"'nope', which is no preset; there are: .*half"):
        article_html(written(tmp_path, "[x](run:nope@2)"), address, "live")


def test_a_term_names_a_thing_of_the_scene_and_arrays_stay_arrays(tmp_path):
    text = article_html(
        written(tmp_path, "The [[cloud/moved|moved cloud]] of `[[1, 0], [0, 1]]` and [[grid]]."),
        address,
        "live",
    )
    assert '<span class="term" tabindex="0" data-thing="cloud/moved">moved cloud</span>' in text
    assert 'data-thing="grid">grid</span>' in text
    table = article_html(
        written(tmp_path, "| a | b |\n|---|---|\n| [[cloud|blue dots]] | c |"), address, "live"
    )
    assert '<td><span class="term" tabindex="0" data-thing="cloud">blue dots</span></td>' in table
    assert "<td>c</td>" in table
    assert "[[1, 0], [0, 1]]" in text


def test_a_home_has_its_own_wording(tmp_path):
    lesson = written(tmp_path, "One vertex{{live:; *click* another}}. {{site: Choose\na run.}}")
    live, site = (article_html(lesson, address, home) for home in ("live", "site"))
    assert "One vertex; <em>click</em> another." in live
    assert "Choose" not in live
    assert "One vertex. Choose\na run." in site
    assert "{{" not in live + site


def test_questions_stand_in_the_section_that_asks_to_predict(tmp_path):
    text = article_html(
        written(tmp_path, "# A\n\n## Predict\n\nGuess.\n\n## After\n\nMore."), address, "live"
    )
    assert text.index("Guess.") < text.index(PLACE) < text.index("After")


def test_a_question_stands_where_a_line_of_the_text_asks_it(tmp_path):
    name = fake.lesson.questions[0].name
    lesson = written(tmp_path, f"# Fake\n\nBefore.\n\n::: {{.ask #{name}}}\n:::\n\nAfter.\n")
    text = article_html(lesson, address, "live")
    assert text.index("Before.") < text.index(f"<!-- question {name} -->") < text.index("After.")
    document = lesson_document(lesson, text, home="live", root="")
    card = f'data-question="{name}"'
    assert document.count(card) == 1
    assert document.index("Before.") < document.index(card) < document.index("After.")


def test_a_line_that_asks_no_question_is_told_with_those_there_are(tmp_path):
    with pytest.raises(AuthorError, match=r"'nope', which is no question; there are: "):
        article_html(written(tmp_path, "::: {.ask #nope}\n:::\n"), address, "live")


def test_experiments_are_folded_where_the_text_links_each_of_them(tmp_path):
    links = [f"[x](run:{preset.name})" for preset in fake.lesson.presets]
    for text, folded in ((links, True), (links[1:], False)):
        lesson = written(tmp_path, " ".join(text))
        document = lesson_document(
            lesson, article_html(lesson, address, "live"), home="live", root=""
        )
        assert ("<summary>All experiments</summary>" in document) is folded
        assert ("<h2>Experiments</h2>" in document) is not folded
        assert all(
            f'<button type="button" data-run="{experiment.name}"' in document
            for experiment in lesson.presets
        )


@pytest.mark.parametrize("lesson", catalog().values(), ids=lambda lesson: lesson.name)
def test_the_document_of_every_lesson_has_its_text_and_no_answer(lesson):
    page = lesson_document(lesson, article_html(lesson, address, "live"), home="live", root="page/")
    assert page.count("<form") == len(lesson.questions)
    assert all(f'data-run="{preset.name}"' in page for preset in lesson.presets)
    script = in_script(lesson_data(lesson))
    for question in lesson.questions:
        why = str(question.why(finished(lesson.name, question.params).states()))
        assert why not in page
        assert in_script(why)[1:-1] not in script


def test_what_a_lesson_says_cannot_end_the_script_or_an_attribute():
    evil = replace(fake.lesson, title='</script><script>"evil"', summary='"><img src=x>')
    page = lesson_document(evil, "", home="live", root="page/")
    assert '<script>"evil' not in page
    assert "<img src=x>" not in page
