"""Reads the story of a lesson out of its page.md: scenes under headings with a name, `## Match
{#match run=flat}`.

The first scene may be the page's first heading itself. A scene's attributes are `run`, `step`,
`camera`, `chart` and `hide`; a line such as `{step=1}` or `{play=0:stop}` before a block moves the
stage from there on. A block `::: {.ask #question}` asks, `::: {.what-if}` offers other runs. `##
Your turn {.turn}` hands over; what follows `## For reference {.reference}` is folded.
"""

import re
from dataclasses import dataclass, field, replace
from html import escape
from typing import Any

from workbench.lesson import Lesson
from workbench.story.attributes import BRACES, HEADING, Attributes
from workbench.story.cards import asked, what_if
from workbench.story.markdown import CARD, Block, Section, blocks, in_home, sections
from workbench.story.model import StagePlace, StepName, Story, TextScene
from workbench.story.names import PAGE_IDS, Names
from workbench.story.words import Found, Words, count, element
from workbench.words.typeset import inline_html, typesetting

BEAT_TAGS = {
    "paragraph_open": "p",
    "bullet_list_open": "ul",
    "ordered_list_open": "ol",
    "blockquote_open": "aside",
}


ASKED = re.compile(r"(?m)^::: \{\.ask #([\w-]+)\}\n:::\n?")
"""Where a page without a story asks a question, by its name."""


_read: dict[tuple[str, str], tuple[Lesson, str, Story]] = {}
"""The story of each lesson's name and home, with the lesson and the text that it was read of: a
publish asks for it with every run.
"""


def has_story(lesson: Lesson) -> bool:
    """Tell whether page.md tells a story: whether a heading of it has a name in braces."""
    headings = re.findall(r"(?m)^#{1,2}\s.*\{[^{}\n]*#[\w-]+[^{}\n]*\}\s*$", lesson.text())
    return lesson.page is not None and bool(headings)


def story_of(lesson: Lesson, home: str) -> Story | None:
    """Return the story of a lesson as a home, `live` or `site`, has it; None where it has none.

    Raises:
        AuthorError: If page.md names what the lesson does not have; with file and line.
    """
    if not has_story(lesson):
        return None
    text = lesson.text()
    known, read, story = _read.get((lesson.name, home), (None, "", None))
    if known is lesson and read == text:
        return story
    with typesetting(lesson.page):
        story = _Reader(Names(lesson, home)).read(sections(in_home(text, home)))
    _read[lesson.name, home] = (lesson, text, story)
    return story


def bench_text(lesson: Lesson) -> str:
    """Return what the workbench of a lesson with a story says: title, summary and what is for
    reference, Markdown.
    """
    folded: list[str] = []
    for part in sections(lesson.text()):
        if "reference" in part.attributes.classes:
            folded.append(part.text)
        elif folded:
            folded.append(f"## {part.title}\n{part.text}")
    text = re.sub(r"(?m)^### ", "## ", "\n".join(folded))
    text = text.replace("@start)", "@0)").replace("@stop)", "@-1)")
    return f"# {lesson.title}\n\n{lesson.summary}\n\n{text}"


def plain_text(lesson: Lesson) -> str:
    """Return page.md without attributes and cards: Markdown for a reader that shows neither,
    such as a recording's.
    """
    if not has_story(lesson):
        return ASKED.sub("", lesson.text())
    text = re.sub(rf"\[([^\]\n]+)\]{BRACES.pattern}", r"\1", lesson.text())
    text = re.sub(r"(?m)^:::.*\n?", "", text)
    return re.sub(rf"(?m)[ \t]*{BRACES.pattern}[ \t]*$", "", text)


@dataclass
class _Scene:
    """A scene while it is read."""

    name: str
    here: StagePlace
    beats: list[StagePlace] = field(default_factory=list)
    html: list[str] = field(default_factory=list)
    words: int = 0
    questions: list[str] = field(default_factory=list)
    found: Found = field(default_factory=Found)
    is_later: bool = False

    def beat(self, line: int) -> int:
        """Return the index of the beat where the words stand now; those with the same place are
        one.
        """
        if not self.beats or self.beats[-1] != self.here:
            self.beats.append(self.here)
            self.found.places.append((self.here, line))
        return len(self.beats) - 1


class _Reader:
    def __init__(self, names: Names):
        self._names = names
        self._scenes: list[TextScene] = []
        self._starts: dict[str, tuple[StagePlace, StagePlace]] = {}
        self._lines: dict[str, int] = {}  # of the scenes, by name

    def read(self, parts: list[Section]) -> Story:
        """Return the story of a page's sections."""
        title = self._names.lesson.title
        opening: Section | None = None
        reference: list[Section] = []
        for part in parts:
            given = part.attributes
            if part.level == 1:
                title = _plain(part.title)
                self._no_fields(given, part.line)
            if reference or "reference" in given.classes:
                reference.append(part)
            elif "turn" in given.classes:
                self._scenes.append(self._scene(part, given.name or "turn", None, is_turn=True))
            elif given.name:
                self._scenes.append(self._scene(part, given.name, opening))
                opening = None
            elif part.level == 1:
                opening = part
            elif part.level == 2:
                raise self._names.wrong(
                    part.line, f"the scene {part.title!r} has no name; write ## ... {{#name}}"
                )
        folded = self._reference(reference) if reference else ""
        return Story(title, tuple(self._scenes), folded, self._starts)

    def _no_fields(self, given: Attributes, line: int) -> None:
        for name in ("chapter", "minutes"):
            if name in given.values:
                raise self._names.wrong(line, f"{name} is said by the lesson: Lesson({name}=...)")

    def _scene(
        self, part: Section, name: str, opening: Section | None, *, is_turn: bool = False
    ) -> TextScene:
        if name in self._lines:
            raise self._names.wrong(
                part.line, f"line {self._lines[name]} has a scene {name!r} already"
            )
        if name in PAGE_IDS:
            raise self._names.wrong(
                part.line, f"the page has a part {name!r} of its own; give the scene another name"
            )
        self._lines[name] = part.line
        here = self._moved(StagePlace(), part.attributes, part.line)
        scene = _Scene(name, here)
        title = part.attributes.values.get("title") or _plain(part.title)
        if opening is not None:
            scene.html.append(f"<h1>{inline_html(opening.title)}</h1>")
            self._blocks(scene, opening, lead=True)
        level = f"h{part.level}"
        scene.html.append(f'<{level} tabindex="-1">{inline_html(part.title)}</{level}>')
        scene.words += len(title.split())
        self._blocks(scene, part, lead=part.level == 1)
        scene.beat(part.line)  # a scene without a word has its place all the same
        given = {"class": "scene turn" if is_turn else "scene", "id": name, "data-title": title}
        return TextScene(
            name=name,
            title=title,
            html=element("section", given, "".join(scene.html)),
            beats=tuple(scene.beats),
            words=scene.words,
            questions=tuple(scene.questions),
            line=part.line,
            told=scene.found.told(),
            is_turn=is_turn,
        )

    def _blocks(self, scene: _Scene, part: Section, *, lead: bool = False) -> None:
        for block in blocks(part):
            if block.kind == f"container_{CARD}_open":
                self._card(scene, block)
            else:
                self._words(scene, block, lead=lead and block.kind == "paragraph_open")
                lead = False

    def _words(self, scene: _Scene, block: Block, *, lead: bool) -> None:
        if block.text().startswith("{"):
            raise self._names.wrong(
                block.line, f"{block.text().splitlines()[0]!r} is not read as attributes"
            )
        scene.here = self._moved(scene.here, block.attributes, block.line)
        Words(self._names, scene.name, scene.found).resolve(block, scene.here)
        beat = scene.beat(block.line)
        scene.here = scene.here.come_to_rest()
        scene.words += count(block)
        classes = [
            *block.attributes.classes,
            *(["lead"] if lead else []),
            *(["later"] if scene.is_later else []),
        ]
        given: dict[str, Any] = {"class": " ".join(classes), "data-beat": beat}
        tag = BEAT_TAGS.get(block.kind)
        if tag is None:
            kind = "formula" if block.kind.startswith("math_block") else "block"
            given = {"class": " ".join([kind, *classes]), "data-beat": beat, "tabindex": "0"}
            scene.html.append(element("div", given, block.html()))
            return
        inside = Block(block.kind, block.attributes, block.tokens[1:-1], block.line).html()
        scene.html.append(element(tag, given, inside))

    def _card(self, scene: _Scene, block: Block) -> None:
        if "ask" in block.attributes.classes:
            self._ask(scene, block)
        elif "what-if" in block.attributes.classes:
            beat = scene.beat(block.line)
            scene.html.append(
                what_if(block, self._names, scene.found, beat=beat, later=scene.is_later)
            )
        else:
            raise self._names.wrong(
                block.line, "a block between ::: is {.ask #question} or {.what-if}"
            )

    def _ask(self, scene: _Scene, block: Block) -> None:
        given = block.attributes
        question = self._names.question(given.name, block.line)
        if question.name in self._starts:
            raise self._names.wrong(block.line, f"the question {question.name!r} is asked already")
        run, at = self._names.moment(given.values.get("run", question.name), block.line)
        step = question.start if at is None else at
        moved = Attributes(values={key: text for key, text in given.values.items() if key != "run"})
        start = self._moved(replace(scene.here, run=run, step=step, start=None), moved, block.line)
        seen: StepName = "stop" if question.step is None else question.step
        scene.here = start
        flag = "flag" in given.classes or bool(question.mark)
        scene.html.append(asked(question, scene.beat(block.line), flag=flag))
        scene.here = replace(start, run=self._names.run(question.name, block.line), step=seen)
        self._starts[question.name] = start, scene.here
        scene.questions.append(question.name)
        scene.is_later = True

    def _moved(self, here: StagePlace, given: Attributes, line: int) -> StagePlace:
        """Return the place to which attributes move the stage."""
        values = dict(given.values)
        if "run" in values:
            run, at = self._names.moment(values["run"], line)
            here = replace(here, run=run, step=0 if at is None else at)
        if "step" in values:
            here = replace(here, step=self._names.step(values["step"], line))
        if "play" in values:
            start, _, end = values["play"].partition(":")
            here = replace(
                here,
                start=self._names.step(start, line),
                step=self._names.step(end or "stop", line),
            )
        if "camera" in values:
            here = replace(here, view=self._names.view(values["camera"], line))
        if "chart" in values:
            here = replace(here, chart=values["chart"])
        if "hide" in values:
            here = replace(here, hide=tuple(name for name in values["hide"].split(",") if name))
        return here

    def _reference(self, parts: list[Section]) -> str:
        """Return what is folded, its links as links to places of the story."""
        notes = Found()
        inside = []
        for part in parts:
            if part is not parts[0]:
                inside.append(f"<h3>{inline_html(part.title)}</h3>")
            for block in blocks(part):
                Words(self._names, "reference", notes).resolve(block, StagePlace())
                inside.append(block.html())
        title = _plain(parts[0].title)
        return (
            f'<details class="reference" id="reference"><summary>{escape(title)}</summary>'
            f'<div class="wb">{"".join(inside)}</div></details>'
        )


def _plain(markdown: str) -> str:
    """Return a heading's words without the signs of Markdown."""
    parts = HEADING.match(markdown)
    return re.sub(r"[*_`$]", "", parts["words"] if parts else markdown)
