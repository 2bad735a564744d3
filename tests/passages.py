"""What is read before a question is answered: every text of a lesson, cut into passages, each with
the run that it speaks of.

What is looked at (`passages`): every paragraph, list item and table row of page.md (of a story
those above the question's card: what follows comes after the answer), the title and summary, each
preset's title and line, each question's text, each knob's label, hint, choices and default, and the
captions that are seen before anybody moves: of the default run where it opens, and of each preset
where it opens.
"""

import functools
import html
import itertools
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from tests.runs import finished
from workbench.knobs import fields_of
from workbench.lesson import Lesson, Preset, catalog
from workbench.story import ASKED, has_story
from workbench.words.typeset import inline_html, page_html

ATTRIBUTES = re.compile(r"\{[#.:\w][^{}]*\}|^:::.*$", re.MULTILINE)
"""What page.md says to the page alone."""


@dataclass(frozen=True)
class Passage:
    """One piece of text that is seen before answering: where it stands, its words, and whose run it
    speaks of.
    """

    where: str
    text: str
    params: Any = None  # of the run it speaks of, where it speaks of one
    question: str = ""


@functools.cache
def passages(name: str) -> tuple[Passage, ...]:
    """Return every text of a lesson that is seen before a question is answered."""
    lesson = catalog()[name]
    return tuple(_passages(lesson, ASKED.sub("", lesson.text())))


@functools.cache
def before(name: str, question: str) -> tuple[Passage, ...]:
    """Return every text that is seen before a question: of a story what stands above its card."""
    lesson = catalog()[name]
    above, card, _ = lesson.text().partition(f"{{.ask #{question}")
    if not has_story(lesson):
        return passages(name)
    assert card, f"{name}: page.md does not ask {question}"
    return tuple(_passages(lesson, ATTRIBUTES.sub("", above)))


def _passages(lesson: Lesson, page: str) -> Iterator[Passage]:
    captions = facts(lesson.name)[0]
    default = lesson.params()
    yield Passage("title and summary", f"{lesson.title}. {lesson.summary}")
    for block in blocks(page_html(page)):
        yield from (Passage("page.md", text, params) for text, params in _by_preset(lesson, block))
    for preset in lesson.presets:
        yield Passage(f"preset {preset.name}", f"{preset.title}. {preset.line}", preset.params)
        shown = captions[preset.params, opens(lesson, preset)]
        yield Passage(f"caption where {preset.name} opens", shown, preset.params)
    yield Passage("caption where the page opens", captions[default, lesson.opens], default)
    for question in lesson.questions:
        yield Passage(
            f"question {question.name}", plain(inline_html(question.text)), None, question.name
        )
    for field in fields_of(lesson.params):
        value = (
            ", ".join(map(str, field.default))
            if isinstance(field.default, tuple)
            else str(field.default)
        )
        shown = (
            f"{field.label}: {field.knob.hint}. {', '.join(field.choices)}. {field.label}: {value}"
            f" {field.knob.unit}"
        )
        yield Passage(f"knob {field.name}", shown)


def blocks(page: str) -> list[str]:
    """Return the paragraphs, list items, headings and table rows of a page, as they read."""
    parts = re.split(
        r"</?(?:p|li|tr|h\d|ul|ol|table|thead|tbody|section|pre|blockquote)\b[^>]*>", page
    )
    return [text for text in map(plain, parts) if text]


def plain(markup: str) -> str:
    """Return the words of HTML, formulas included."""
    text = html.unescape(re.sub(r"<[^>]*>", "", re.sub(r"</(td|th)>", " | ", markup)))
    return re.sub(r"[\s\u2061-\u2064]+", " ", text).strip(" |")


def _by_preset(lesson: Lesson, text: str) -> Iterator[tuple[str, Any]]:
    """Cut a text where it names a preset, by the title or its words up to a colon; each piece with
    that preset's params.
    """
    starts: dict[int, Any] = {0: None}
    for preset in lesson.presets:
        at = text.lower().find(preset.title.split(":")[0].lower())
        if at >= 0 and len(preset.title.split(":")[0]) > 4:
            starts[at] = preset.params
    cuts = [*sorted(starts), len(text)]
    for here, end in itertools.pairwise(cuts):
        yield text[here:end], starts[here]


def read(name: str, question: str, innocent: str) -> Iterator[Passage]:
    """Yield the passages that stand before a question, without what the rules would misread."""
    for passage in before(name, question):
        yield replace(
            passage, text=re.sub(innocent or "(?!)", "…", passage.text, flags=re.IGNORECASE)
        )


@functools.cache
def facts(name: str) -> tuple[dict[tuple[Any, int], str], dict[str, float]]:
    """Return a lesson's captions where a run opens, by params and step, and the right answers; each
    run is made once.
    """
    lesson = catalog()[name]
    opened = {(preset.params, opens(lesson, preset)) for preset in lesson.presets} | {
        (lesson.params(), lesson.opens)
    }
    captions: dict[tuple[Any, int], str] = {}
    answers: dict[str, float] = {}
    for params in dict.fromkeys(
        [question.params for question in lesson.questions] + [params for params, _ in opened]
    ):
        asked = [question for question in lesson.questions if question.params == params]
        timeline = finished(name, params)
        captions |= {
            (params, step): timeline[step].caption.text for of, step in opened if of == params
        }
        answers |= {question.name: question.answer(timeline.states()) for question in asked}
    return captions, answers


def opens(lesson: Lesson, preset: Preset) -> int:
    return lesson.first_step if preset.step is None else preset.step
