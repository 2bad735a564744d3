"""A lesson's article as HTML: its text with links that run things, and the place of its questions.

In page.md, `::: {.ask #name}` and `:::` on lines of their own ask a question there,
`[the last step](run:far@-1)` opens the preset `far` at its last step, `[the last
step](run:this@-1)` goes to a step of the run that is open, and `[[source]]` or `[[source|the
scan]]` names a thing of the scene. `{{live: Drag the slider.}}` and `{{site: Choose a recorded
run.}}` stand in that home only.
"""

import re
from collections.abc import Callable
from html import escape

from workbench.errors import AuthorError
from workbench.lesson import Lesson
from workbench.story import ASKED, bench_text, has_story
from workbench.words.typeset import TERM, page_of, with_terms, wording

_LINK = re.compile(r'<a href="run:([^"@]*)(?:@(-?\d+))?">')
LINK = re.compile(r"\]\(run:([^)@\s]*)(?:@(-?\d+))?\)")
"""A link of a page's text that runs something: the run's name, and the step or nothing."""
PLACE = "<!-- questions -->"
"""Where the questions of a lesson stand in its article that no line of page.md asks."""
QUESTION = re.compile(r"<!-- question ([\w-]+) -->")
"""Where a line of page.md asks one."""
_ASKED = re.compile(r"<p>ask!([\w-]+)!</p>")

Address = Callable[[str, int | None], str]
"""address(run, step) -> what a link to that moment leads to where no script runs."""


def article_html(lesson: Lesson, address: Address, home: str) -> str:
    """Return a lesson's article as a home, `live` or `site`, has it, with QUESTION where it asks
    one, and PLACE where the other questions belong.

    Beside a story, which asks its questions itself, it is what the workbench says; experiments and
    exercises belong at PLACE then.

    Raises:
        AuthorError: If the page names a run or a question that the lesson does not have, or a
            picture that is not there.
    """
    told = has_story(lesson)
    # a table would cut there
    written = TERM.sub(
        lambda match: match[0].replace("|", r"\|"),
        wording(bench_text(lesson) if told else ASKED.sub(r"\nask!\1!\n\n", lesson.text()), home),
    )
    text = page_of(written, lesson.page).replace(
        '<div class="math block">', '<div class="math block" tabindex="0">'
    )
    names = {"this", "default", *(preset.name for preset in lesson.presets)}

    def link(match: re.Match[str]) -> str:
        name = match[1]
        step = None if match[2] is None else int(match[2])
        if name not in names:
            known = ", ".join(preset.name for preset in lesson.presets) or "none"
            raise AuthorError(
                f"{lesson.page}: a link runs {name!r}, which is no preset; there are: {known}"
            )
        name = "" if name == "this" else name
        at = "" if step is None else f' data-step="{step}"'
        return f'<a class="run" href="{escape(address(name, step))}" data-run="{escape(name)}"{at}>'

    text = with_terms(_LINK.sub(link, text))
    if told:
        at = text.find("<section", text.find("</h1>"))
        return text + PLACE if at < 0 else text[:at] + PLACE + text[at:]
    text = _ASKED.sub(lambda match: _question_place(lesson, match[1]), text)
    before, after = _around_predict(text)
    return before + PLACE + after


def _question_place(lesson: Lesson, name: str) -> str:
    if name not in {question.name for question in lesson.questions}:
        known = ", ".join(question.name for question in lesson.questions) or "none"
        raise AuthorError(
            f"{lesson.page}: it asks {name!r}, which is no question; there are: {known}"
        )
    return f"<!-- question {name} -->"


def _around_predict(html: str) -> tuple[str, str]:
    """Split an article where its questions belong: behind the section that asks to predict, else at
    the end.
    """
    start = html.find('<section class="s-predict')
    end = html.find("</section>", start) + len("</section>") if start >= 0 else len(html)
    return html[:end], html[end:]
