"""The HTML document of the page, the same in every home: what a home cannot do is not in it."""

import json
from collections.abc import Mapping
from html import escape
from pathlib import Path
from typing import Any

from workbench.lesson import Lesson
from workbench.page.article import PLACE
from workbench.page.lessons import lesson_data
from workbench.session import SPEEDS

STATIC = Path(__file__).with_name("static")
STYLES = ("page.css", "course.css")
SCRIPTS = (
    "tools.js", "curves.js", "stage.js", "transport.js", "beside.js", "article.js", "knobs.js", "text.js", "take.js",
    "course.js", "page.js",
)  # fmt: skip
RECORDED = ("viserfile.js", "feed.js", "ghosts.js", "shelf.js", "sweeps.js", "recorded.js")
"""The scripts that feed the page from recorded runs, on a site and in a notebook."""
VERBS = (
    ("first", "First step (Home)", "M4 3h2v10H4zM14 3v10L6.5 8z"),
    ("back", "Step back (P)", "M12 3v10L4 8z"),
    ("play", "Play (K)", "M4 2.5v11L13.5 8z"),
    ("next", "Next step (N)", "M4 3v10l8-5z"),
    ("last", "Last step (End)", "M10 3h2v10h-2zM2 3v10l7.5-5z"),
)
"""Verb, what it is called, and its sign as the path of a 16 x 16 picture."""


def lesson_document(
    lesson: Lesson,
    article: str,
    *,
    home: str,
    root: str,
    source: str,
    head: str = "",
    more: Mapping[str, Any] | None = None,
    alone: tuple[str, str] | None = None,
    still: str = "",
) -> str:
    """Return the document of a lesson.

    Args:
        lesson: What it is about.
        article: Its text as HTML, with PLACE where the questions belong.
        home: `live`, `site` or `notebook`.
        root: The relative address of the folder with the page's own files.
        source: The file name of the script that feeds the page in this home.
        head: More HTML for the head.
        more: What else the scripts need: name of a constant -> plain data.
        alone: Of a page that shows one run and no article, its title and the address of the lesson's page.
        still: The address of a picture that stands for the scene where no script runs.
    """
    data = lesson_data(lesson) | ({} if home == "live" else {"knobs": []})
    scripts = (*(RECORDED if source in RECORDED else (source,)), *SCRIPTS)
    constants = {"LESSON": data} | dict(more or {})
    heading = f"{lesson.title}: {alone[0]}" if alone else lesson.title
    text = _alone(heading, alone[1]) if alone else _article(lesson, article, home, data)
    shown = _stage(home, data, bool(lesson.sweeps) and not alone, still)
    return (
        f"{document_head(heading, lesson.summary, root, head)}"
        f'<body{" class=alone" if alone else ""} data-home="{home}" data-lesson="{escape(lesson.name)}">'
        f'<a class="skip" href="#stage">To the stage</a><main>{text}{shown}</main>'
        f"<script>{''.join(f'const {name} = {in_script(value)};' for name, value in constants.items())}</script>"
        + "".join(f'<script src="{root}{name}"></script>' for name in scripts)
        + "</body></html>\n"
    )


def _article(lesson: Lesson, article: str, home: str, data: dict[str, Any]) -> str:
    questions = "".join(_question(question) for question in data["questions"])
    presets = "".join(
        f'<li><button type="button" data-run="{escape(preset["name"])}" aria-pressed="false">{escape(preset["title"])}'
        f"<small>{escape(preset['line'])}</small></button></li>"
        for preset in data["presets"]
    )
    chosen = f'<section class="s-runs"><h2>Experiments</h2><ul class="runs">{presets}</ul></section>' if presets else ""
    return (
        f'<article id="article">{_top("Geometry workbench", _course(home))}'
        f'<div class="wb">{article.replace(PLACE, questions)}</div>{chosen}'
        '<details id="text"><summary>Text of this run</summary><p></p><ol start="0"></ol></details>'
        f'<nav id="around" aria-label="Lessons before and after" data-address="{_lesson(home)}"></nav></article>'
    )


def _alone(heading: str, lesson_page: str) -> str:
    return f'<header id="article"><h1>{escape(heading)}</h1>{_top("The lesson", lesson_page)}</header>'


def _top(words: str, address: str) -> str:
    return (
        f'<nav class="top"><a href="{address}">{words}</a>'
        '<button type="button" id="theme" title="Light or dark (T)">◐</button>'
        '<button type="button" id="help" title="Keys (?)">?</button></nav>'
    )


def in_script(value: Any) -> str:
    """Return JSON that may stand in a script."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def document_head(title: str, summary: str, root: str, more: str) -> str:
    """Return the head of a document of ours."""
    return (
        '<!doctype html><html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f'<title>{escape(title)}</title><meta name="description" content="{escape(summary)}">'
        f'<link rel="icon" href="data:,">'
        + "".join(f'<link rel="stylesheet" href="{root}{name}">' for name in (*STYLES, "math.css"))
        + f"{more}</head>"
    )


def _course(home: str) -> str:
    return "?" if home == "live" else "../index.html"


def _lesson(home: str) -> str:
    return "?lesson=LESSON" if home == "live" else "../LESSON/index.html"


def _stage(home: str, data: dict[str, Any], swept: bool, still: str) -> str:
    buttons = "".join(
        f'<button type="button" data-act="{verb}" title="{title}" aria-label="{title}">'
        f'<svg viewBox="0 0 16 16" aria-hidden="true"><path d="{sign}"/></svg></button>'
        for verb, title, sign in VERBS
    )
    speeds = "".join(f'<option value="{s:g}"{" selected" if s == 1 else ""}>{s:g}×</option>' for s in SPEEDS)
    moved = (
        '<button type="button" id="move" aria-pressed="false" title="Handles in the scene (H)">Move it yourself</button>'
        if any(knob["by"] == "gizmo" for knob in data["knobs"])
        else ""
    )
    knobs = (
        '<button type="button" id="set" aria-expanded="false" aria-controls="drawer">Knobs</button>'
        if home == "live" or swept
        else ""
    )
    drawer = '<aside id="drawer" aria-label="Knobs" hidden></aside>' if knobs else ""
    more = (
        f"{moved if home == 'live' else ''}{knobs}"
        '<button type="button" id="pin" aria-pressed="false" title="Keep this run behind the next (I)">Pin</button>'
        '<button type="button" id="take" title="Link, recording, embedding">Share</button>'
    )
    picture = f'<noscript><img src="{escape(still)}" alt="A step of this lesson"></noscript>' if still else ""
    return (
        '<section id="stage" aria-label="Stage"><div id="view"><div id="scene" aria-busy="true"></div>'
        f"{picture}"
        f'<div id="legend"></div>{drawer}</div>'
        f'<div id="bar" role="group" aria-label="Steps">{buttons}'
        '<input id="step" type="range" min="0" max="0" value="0" aria-label="Step"><output id="count"></output>'
        f'<select id="speed" aria-label="Speed">{speeds}</select>{more}</div>'
        '<p id="caption" role="status" aria-live="polite" tabindex="0"></p>'
        '<div id="tiles" role="group" aria-label="Curves, pictures and code of this step"></div>'
        '<div id="large" role="dialog" aria-label="Enlarged" hidden></div></section>'
    )


def _question(question: dict[str, Any]) -> str:
    name = escape(question["name"])
    if question["choices"]:
        inputs = "".join(
            f'<label><input type="radio" name="given" value="{escape(choice)}"> {escape(choice)}</label>'
            for choice in question["choices"]
        )
    else:
        unit = escape(f" ({question['unit']})") if question["unit"] else ""
        inputs = f'<label>Your prediction{unit} <input type="number" step="any" name="given"></label>'
    return (
        f'<form class="question" data-question="{name}"><fieldset><legend>{question["html"]}</legend>{inputs}</fieldset>'
        '<button type="submit" value="answer">Answer</button> '
        '<button type="submit" value="skip">Skip and show me</button><output aria-live="polite"></output></form>'
    )
