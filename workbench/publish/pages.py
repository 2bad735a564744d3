"""The HTML of a published site. Whatever comes from a lesson or its params is escaped or typeset
here.
"""

import base64
import json
import re
from collections.abc import Mapping
from html import escape
from pathlib import Path
from typing import Any

from workbench.exercise.finding import exercises_of
from workbench.lesson import Lesson, Question, is_of_course
from workbench.page.about import footer_html
from workbench.page.article import article_html
from workbench.page.bundles import COMPUTING
from workbench.page.course import Card, course_document
from workbench.page.document import in_script, lesson_document
from workbench.page.exercise import exercises_html
from workbench.picture.stills import stills_of, with_stills
from workbench.publish.manifest import Listed
from workbench.publish.runs import PAGE, question_run
from workbench.run.questions import answer
from workbench.run.timeline import Timelines
from workbench.story import story_of
from workbench.words.typeset import page_html

LESSONS = "lessons.js"
"""The file of a site that names all its lessons."""


def course_page(lessons: Mapping[str, Listed], head: str = "") -> str:
    """Return the page of the course: all lessons by name, in order."""
    return course_document(
        [
            Card(
                name=name,
                title=lesson.title,
                summary=lesson.summary,
                needs=lesson.needs,
                chapter=lesson.chapter,
                minutes=lesson.minutes,
                address=f"{name}/index.html",
                picture=f"{name}/picture.webp",
            )
            for name, lesson in lessons.items()
        ],
        root=f"{PAGE}/",
        head=head,
        footer=footer_html(""),
    )


def lessons_script(lessons: Mapping[str, Listed]) -> str:
    """Return the script that tells a lesson's page which lessons there are."""
    course = [
        {"name": name, "title": lesson.title, "needs": lesson.needs}
        for name, lesson in lessons.items()
    ]
    return f"const COURSE = {in_script(course)};\n"


def moment(run: str, step: int | None) -> str:
    """Return the address, on a lesson's page, of a step of a run; without a name, of the default
    run.
    """
    return f"#run={run or 'default'}" + ("" if step is None else f"&step={step}")


def lesson_page(
    lesson: Lesson,
    known: Mapping[str, Any],
    head: str = "",
    *,
    computes: Mapping[str, Any] | None = None,
) -> str:
    """Return a lesson's page.

    Args:
        lesson: What it teaches.
        known: What the page knows of its runs.
        head: More for the head, such as a canonical address.
        computes: What it can compute with; None where it cannot.
    """
    head = f'{head}<script src="../{LESSONS}"></script>'
    more: dict[str, Any] = {"RECORDED": known}
    if computes is not None:
        style, *scripts, _, _ = COMPUTING
        head += f'<link rel="stylesheet" href="../{PAGE}/{style}">'
        head += "".join(f'<script src="../{PAGE}/{script}"></script>' for script in scripts)
        more["PYTHON"] = computes
    story = story_of(lesson, "site")
    stills = stills_of(lesson)
    figures = "".join(still.html() for still in stills)
    pictures = f'<section class="stills"><h2>Experiments in pictures</h2>{figures}</section>'
    return lesson_document(
        lesson,
        article_html(lesson, moment, "site"),
        home="site",
        root=f"../{PAGE}/",
        ending=exercises_html(exercises_of(lesson)) + ("" if story else pictures),
        head=head,
        more=more,
        still="picture.webp",
        story=None if story is None else with_stills(story, stills),
        footer=footer_html("../", ours=is_of_course(lesson)),
    )


def accessibility_html() -> str:
    """Return the statement of docs/accessibility.md as HTML; empty where the documentation is not
    installed.
    """
    package = Path(__file__).parents[1]
    files = [folder / "docs" / "accessibility.md" for folder in (package, package.parent)]
    file = next((file for file in files if file.is_file()), None)
    if file is None:
        return ""
    return page_html(re.sub("(?m)^#", "##", file.read_text(encoding="utf-8")))


def replies(question: Question) -> list[tuple[float, float, str]] | dict[str, str]:
    """Return what is said to known wrong answers: by the text of a choice, else as (lowest,
    highest, words).
    """
    if question.choices:
        return {text: question.reply(i) for i, text in enumerate(question.choices)}
    return list(question.wrong)


def answers(lesson: Lesson, timelines: Timelines) -> dict[str, str]:
    """Return what is told when a question is answered, by its name: base64, so that nobody reads it
    by the way.
    """
    encoded = {}
    for question in lesson.questions:
        told = answer(lesson, question, None, timelines=timelines)
        kept = {
            "truth": told.truth,
            "right": told.truth if question.choices else [told.value, question.tolerance],
            "why": told.why,
            "replies": replies(question),
            "run": question_run(lesson, question),
            "step": told.step,
        }
        encoded[question.name] = base64.b64encode(json.dumps(kept).encode()).decode()
    return encoded


def leading_on(title: str, address: str) -> str:
    """Return the page of a run that is in another lesson now: it leads there by itself, or by
    its link.
    """
    place = escape(address)
    return (
        '<!doctype html><html lang="en"><head><meta'
        f' charset="utf-8"><title>{escape(title)}</title><meta http-equiv="refresh" content="0;'
        f' url={place}"><link rel="icon" href="data:,"></head><body><p>This run is part of <a'
        f' href="{place}">{escape(title)}</a> now.</p></body></html>\n'
    )
