"""What only a live page can do is found where a text asks for it, and the same words are left alone
where they do not.
"""

from dataclasses import dataclass, replace
from typing import Annotated

import pytest

from tests import fake
from workbench.authoring.live_words import live_words, on_page
from workbench.knobs import Knob
from workbench.lesson import Sweep


@dataclass(frozen=True)
class Params:
    noise: Annotated[float, Knob("How far points stray", 0, 1)] = 0.1
    max_distance: Annotated[float, Knob("The gate", 0, 1)] = 0.1
    points: Annotated[int, Knob("How many", 1, 9)] = 5


LESSON = replace(
    fake.lesson, params=Params, presets=(), questions=(), sweeps=(Sweep("points", (1, 5, 9)),)
)


def said(text: str) -> list[str]:
    return [words for _, words in live_words(text, LESSON)]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("Click a pixel.", "Click"),
        ("See what the one you click gathers.", "click"),
        ("Where the scene can be clicked, choose another.", "clicked"),
        ("One point is moved away: drag it.", "drag it"),
        ("- [One stray point](run:stray): then drag\n  [the start](run:start) away.", "drag the"),
        ("Drag [[origin|the origin]] and see.", "Drag the"),
        ("The start can be dragged.", "can be dragged"),
        ("Hand over a scan.", "Hand over a scan"),
        ("Or move the camera yourself.", "move the camera yourself"),
        ("Turn the left knob.", "Turn the left knob"),
        ("Raise `noise`, and look.", "`noise`"),
        ("It shrinks with “Max distance”.", "“Max distance”"),
        ("Look at the end; then turn the noise to 0.5.", "turn the noise"),
        ("| a | b |\n|---|---|\n| c | lower the max distance |", "lower the max distance"),
    ],
)
def test_what_a_text_asks_for_is_found(text, words):
    assert said(text) == [words]


@pytest.mark.parametrize(
    "text",
    [
        "Outliers drag the line away, and what drags it is their square.",
        "The relay gives a click every second; two clicks are a pulse.",
        (
            "Turn both cameras until their axes are parallel; turn it round, and lines give the"
            " motion."
        ),
        "Turn the frame by half a turn, set entries to 0, and lower the cost.",
        "Turn the `points` up: this knob is published. Raise the points to 9.",
        "Where noise is high, the noise decides. More noise, less certainty.",
        "A torus has one handle; a surface with a handle has more.",
        "The formula $click + \\text{drag it}$ and\n\n```\nclick(noise)\n```\n",
        "Own scans: `--scan FILE` holds `points` and `noise`.",
        "[Drag-free](run:drag) motion: drag is a force.",
        "A map is made by hand, handed over from one step to the next.",
    ],
)
def test_the_same_words_are_left_alone_where_nobody_is_asked(text):
    assert said(text) == []


def test_of_two_wordings_the_published_one_is_looked_at_and_lines_are_those_of_the_file(tmp_path):
    page = tmp_path / "page.md"
    page.write_text(
        "# A\n\n{{live: Click\n\none.}}{{site:\nChoose a run.}} Then\ndrag it.\n\n{{site: Click"
        " it.}}\n"
    )
    assert list(on_page(replace(LESSON, page=page))) == [(7, "drag it"), (9, "Click")]
