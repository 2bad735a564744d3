"""What the page of every lesson promises: its parts, its formulas, and that every reference in it
leads somewhere.
"""

import re
from collections.abc import Iterator

from workbench.authoring.live_words import elsewhere, live_words, on_page
from workbench.authoring.new import TEMPLATE, TITLE
from workbench.authoring.promises import ONLY_LIVE, Found, Subject, length_of, opens, promise
from workbench.errors import AuthorError, InputError
from workbench.machinery.authors import place
from workbench.page.article import LINK, TERM, article_html
from workbench.story import has_story
from workbench.words.typeset import page_of

PARTS = ("Conventions", "Watch", "Break it", "Your turn", "Pitfalls", "References")
"""What a page without a story has, among other parts."""
STORY_PARTS = ("Your turn", "Conventions", "Pitfalls", "References")
"""What a page with a story has beside its scenes."""
WORDS = (350, 1100)
LEFTOVER = 60
"""Characters of a line that nobody writes by chance as the scaffold has it."""


@promise
def the_page_has_its_parts(subject: Subject) -> Found:
    """There is a page, long enough and no longer, with the parts that people look for, and its
    pictures are there.
    """
    lesson = subject.lesson
    if lesson.page is None:
        yield (
            f"{subject.who}: it has no page; page=Path(__file__).with_name('page.md') gives it one"
        )
        return
    text = lesson.text()
    where = f"{subject.who}: {lesson.page}"
    tells = has_story(lesson)
    yield None if tells else length_of(f"{where}: the page", len(text.split()), WORDS, unit="words")
    for part in STORY_PARTS if tells else PARTS:
        yield None if part.lower() in text.lower() else f"{where}: the page has no part {part!r}"
    try:
        page_of(text, lesson.page)
        yield None
    except InputError as error:
        yield f"{subject.who}: {error}"


@promise
def nothing_is_asked_for_that_a_published_page_cannot(subject: Subject) -> Found:
    """Where nothing can be computed, no text asks for a click, a drag, a file or a knob that no
    sweep publishes.
    """
    for source, text in elsewhere(subject.lesson).items():
        asked = next(live_words(text, subject.lesson), None)
        yield None if asked is None else f"{subject.who}, {source} says {asked[1]!r}; {ONLY_LIVE}"
    if subject.lesson.page is not None:
        page = str(subject.lesson.page)
        told = [
            f"{place(page, line)}: it says {words!r}" for line, words in on_page(subject.lesson)
        ]
        yield from [
            f"{subject.who}: {line}; {ONLY_LIVE}: write {{{{live: ...}}}}" for line in told
        ] or [None]


@promise
def every_formula_is_read(subject: Subject) -> Found:
    """The page has formulas, and all of them are ones that can be typeset."""
    lesson = subject.lesson
    if lesson.page is None:
        return
    text = lesson.text()
    formulas = re.findall(
        r"<math.*?</math>", page_of(re.sub(r"!\[.*?\]\(.*?\)", "", text), None), re.DOTALL
    )
    yield (
        None
        if formulas
        else f"{subject.who}: {lesson.page}: the page has no formula between $ and $"
    )
    for formula in formulas:
        unknown = re.search(r"\\[a-zA-Z]*", formula)
        if unknown is None:
            yield None
            continue
        line = next((i for i, row in enumerate(text.splitlines(), 1) if unknown[0] in row), 1)
        yield (
            f"{subject.who}: {place(str(lesson.page), line)}: {unknown[0]} is a TeX command that is"
            " not known here"
        )


@promise
def every_reference_of_the_page_leads_somewhere(subject: Subject) -> Found:
    """A link names a run that there is and a step that it has; a term names a thing that some run
    shows.
    """
    lesson = subject.lesson
    if lesson.page is None:
        return
    text = lesson.text()
    default = lesson.params()
    runs = {"default": default, "this": default} | {
        preset.name: preset.params for preset in lesson.presets
    }

    def where(position: int) -> str:
        return f"{subject.who}: {place(str(lesson.page), text.count(chr(10), 0, position) + 1)}"

    links = [(where(match.start()), match[1], match[2]) for match in LINK.finditer(text)]
    sought = {match[1]: where(match.start()) for match in TERM.finditer(text)}
    yield from (
        f"{at}: a link runs {name!r}, which is no preset"
        for at, name, _ in links
        if name not in runs
    )
    for name, params in runs.items():
        steps = [(at, int(step)) for at, linked, step in links if linked == name and step]
        if not steps and not sought:
            continue
        run = subject.whole(params, f"the run {name!r}")
        yield from (opens(run, f"{at}: the link to {name!r}", step) for at, step in steps)
        shown = {path for step in run.known() for path in step.scene}
        sought = {path: at for path, at in sought.items() if not _is_shown(path, shown)}
    yield from (
        f"{at}: [[{path}]] names nothing that a run of the lesson shows"
        for path, at in sought.items()
    )


def _is_shown(path: str, shown: set[str]) -> bool:
    """Whether something is drawn at a path, or below it."""
    return any(drawn == path or drawn.startswith(f"{path}/") for drawn in shown)


@promise
def every_term_of_the_page_is_read(subject: Subject) -> Found:
    """No brackets of a term are left for people to see."""
    if subject.lesson.page is None:
        return
    try:
        html = article_html(subject.lesson, lambda run, step: "", "live")
    except AuthorError:  # of a link or a picture, told by the others
        return
    seen = re.sub(r"<(code|pre|math)\b.*?</\1>", "", html, flags=re.DOTALL)
    left = re.search(r"\[\[[^<\n]{0,40}", seen)
    yield (
        None
        if left is None
        else f"{subject.who}: {subject.lesson.page}: {left[0]!r} is no term: [[path|words]]"
    )


@promise
def nothing_is_left_of_the_scaffold(subject: Subject) -> Found:
    """A lesson that is about something else has no line of the page that `workbench new` wrote."""
    if subject.lesson.page is None or subject.lesson.title == TITLE:
        return
    scaffold = frozenset(_long_lines((TEMPLATE / "page.md").read_text(encoding="utf-8")))
    for number, line in enumerate(subject.lesson.text().splitlines(), 1):
        left = (
            f"{subject.who}: {place(str(subject.lesson.page), number)}: this line is the"
            " scaffold's, not of your lesson"
        )
        yield left if line.strip() in scaffold else None


def _long_lines(text: str) -> Iterator[str]:
    yield from (line.strip() for line in text.splitlines() if len(line.strip()) >= LEFTOVER)
