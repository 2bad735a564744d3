"""A run in a notebook: one frame that needs nothing else, and the same told as text."""

import re
from html import unescape

import pytest

import workbench
from tests import fake
from workbench.errors import InputError
from workbench.lesson import catalog
from workbench.timeline import Timeline


@pytest.fixture(scope="module")
def shown():
    return workbench.replay("icp", start_angle=60, steps=3)


def test_as_text_it_is_the_last_caption_its_numbers_and_the_command(shown):
    here = Timeline(catalog()["icp"], catalog()["icp"].params(start_angle=60.0))
    while len(here) < 3:
        here.extend()
    caption, numbers, command = repr(shown).split("\n")
    assert caption == f"Iterative closest point, step 2 of 2: {here[2].caption.text}"
    assert "RMSE" in numbers
    assert command == "Live: workbench show icp --start-angle=60"
    bundle = shown._repr_mimebundle_()
    assert bundle["text/plain"] == repr(shown)
    assert bundle["text/html"] == shown._repr_html_()


def test_the_frame_asks_for_nothing_and_has_the_text_where_no_frame_is_shown(shown):
    html = shown._repr_html_()
    assert html.count("<iframe") == 1
    assert 'height="640"' in html
    assert html.endswith("</iframe>")
    document = unescape(re.search(r'srcdoc="([^"]*)"', html)[1])  # type: ignore[index]
    assert not re.search(r'<(script|link|img|iframe)[^>]*(src|href)="(?!data:)', document.partition("viserPage(")[0])
    assert unescape(html[html.index("border-radius") :].partition(">")[2].removesuffix("</iframe>")) == repr(shown)


def test_nothing_is_printed(capfd):
    workbench.replay("icp", steps=1)._repr_html_()
    assert capfd.readouterr() == ("", "")


def test_a_lesson_may_be_given_itself_and_params_start_from_a_preset():
    preset = fake.lesson.presets[0]
    assert workbench.replay(fake.lesson, preset=preset.name).params == preset.params
    assert len(workbench.replay(fake.lesson).timeline) == len(Timeline(fake.lesson, fake.Params()).complete())


@pytest.mark.parametrize(
    ("wrong", "why"),
    [
        ({"lesson": "nothing"}, "no lesson is named 'nothing'"),
        ({"lesson": "icp", "preset": "nothing"}, "no preset 'nothing'"),
        ({"lesson": "icp", "angle": 3}, "unknown parameter 'angle'"),
        ({"lesson": "icp", "start_angle": 1000}, "start_angle = 1000"),
        ({"lesson": "icp", "steps": 0}, "1 or more"),
        ({"lesson": "icp", "height": 10}, "pixels or more"),
    ],
)
def test_what_cannot_be_shown_is_said_in_one_line(wrong, why):
    with pytest.raises(InputError, match=why) as error:
        workbench.replay(**wrong)
    assert "\n" not in str(error.value)
