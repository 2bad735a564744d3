"""The HTML of a published site. Whatever comes from a lesson or its params is escaped or typeset here."""

import json
from collections.abc import Mapping
from html import escape

from workbench.lesson import Lesson, Question
from workbench.page.article import PLACE, article_html
from workbench.page.document import SPEEDS
from workbench.publish.ledger import Listed
from workbench.questions import answer
from workbench.recording import file_name
from workbench.timeline import Timelines
from workbench.typeset import inline_html

HEAD = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<meta name="description" content="{summary}">
<link rel="icon" href="data:,">
<link rel="stylesheet" href="{root}site.css">
<link rel="stylesheet" href="{root}math.css">
{extra}</head>
"""
TOP = """<a class="skip" href="#main">To the content</a>
<header class="top"><a href="{root}index.html">Geometry workbench</a>{here}</header>
"""


def course_page(lessons: Mapping[str, Listed], extra: str = "") -> str:
    """Return the page of the course: all lessons by name, in order."""
    cards = "".join(
        f'<div class="card"><h2>{number}. <a href="{name}/index.html">{escape(lesson.title)}</a></h2>'
        f"<div>{escape(lesson.summary)}</div></div>\n"
        for number, (name, lesson) in enumerate(lessons.items(), 1)
    )
    head = HEAD.format(
        title="Geometry workbench", summary="Algorithms of 3D vision, step by step", root="", extra=extra
    )
    return (
        f"{head}<body>{TOP.format(root='', here='')}"
        '<main id="main" class="course"><h1>Geometry workbench</h1>'
        "<p>Every lesson is one algorithm that you can watch, step back through and break. Predict first, then look.</p>"
        f"{cards}</main></body></html>\n"
    )


def lesson_page(lesson: Lesson, runs: Mapping[str, tuple[str, str]], timelines: Timelines, extra: str = "") -> str:
    """Return a lesson's page.

    Args:
        lesson: What it teaches.
        runs: Run name -> (title, line), the default first.
        timelines: Where the runs that answer the questions are kept.
        extra: More for the head, such as a canonical address.
    """
    text = article_html(lesson, lambda run, step: f"runs/{run or 'default'}.html")
    questions = "".join(_question(lesson, question, timelines) for question in lesson.questions)
    buttons = "".join(
        f'<li><button type="button" data-run="{escape(name)}" aria-pressed="false">{escape(title)}'
        f"<small>{escape(line)}</small></button></li>"
        for name, (title, line) in runs.items()
    )
    head = HEAD.format(title=escape(lesson.title), summary=escape(lesson.summary), root="../", extra=extra)
    player = _player("default", root="../", runs="runs/", recording=file_name(lesson, None))
    return (
        f"{head}<body>{TOP.format(root='../', here=f'<span>{escape(lesson.title)}</span>')}"
        f'<main id="main"><div class="wb">{text.replace(PLACE, questions)}</div>'
        f'<div id="stage"><section aria-label="Replay">{player}</section>'
        f'<h2>Runs</h2><ul class="runs">{buttons}</ul></div></main>'
        '<script src="../player.js"></script></body></html>\n'
    )


def embed_page(lesson: Lesson, name: str, title: str, recording: str) -> str:
    """Return the page of one run alone, for an iframe on a slide or a learning platform."""
    head = HEAD.format(
        title=f"{escape(lesson.title)}: {escape(title)}", summary=escape(lesson.summary), root="../../", extra=""
    )
    player = _player(name, root="../../", runs="", recording=recording)
    return (
        f'{head}<body class="embed"><main id="main">'
        f'<h1 class="skip">{escape(lesson.title)}: {escape(title)}</h1>{player}</main>'
        '<script src="../../player.js"></script></body></html>\n'
    )


def _player(run: str, *, root: str, runs: str, recording: str) -> str:
    speeds = "".join(
        f'<option value="{s:g}"{" selected" if s == 1 else ""}>{s:g} step{"" if s == 1 else "s"} a second</option>'
        for s in SPEEDS
    )
    buttons = "".join(
        f'<button type="button" data-act="{verb}"{" id=play" if verb == "play" else ""}>{verb.title()}</button>'
        for verb in ("first", "back", "play", "next", "last")
    )
    return (
        f'<div id="player" data-open="{escape(run)}" data-root="{root}" data-runs="{runs}"><div><div id="scene"></div>'
        '<p id="caption" role="status" aria-live="polite"></p><div id="legend"></div>'
        f'<div class="controls"><span id="count"></span>{buttons}'
        '<input id="step" type="range" min="0" max="0" value="0" aria-label="Step">'
        f'<select id="speed" aria-label="Speed">{speeds}</select></div>'
        '<details class="take"><summary>Take this run along</summary>'
        f'<p><a id="rrd" href="{runs}{escape(recording)}" download="{escape(recording)}">Recording for Rerun (.rrd)</a> · '
        f'<a id="embed" href="{runs}{escape(run)}.html">this run alone</a></p>'
        'Live, where the workbench is installed:<pre id="reopen"></pre>'
        'In a page of your own:<pre id="iframe-line"></pre></details>'
        '</div><div id="beside" tabindex="0" role="region" aria-label="Curves and pictures of this step">'
        '<div id="series"></div><div id="things"></div></div></div>'
    )


def _question(lesson: Lesson, question: Question, timelines: Timelines) -> str:
    found = answer(lesson, question, None, timelines)
    right = found.truth if question.choices else [found.value, question.tolerance]
    kept = {
        "truth": found.truth,
        "right": right,
        "why": found.why,
        "run": question_run(lesson, question),
        "step": found.step,
    }
    if question.choices:
        inputs = "".join(
            f'<label><input type="radio" name="given" value="{escape(choice)}"> {escape(choice)}</label>'
            for choice in question.choices
        )
    else:
        unit = escape(f" ({question.unit})") if question.unit else ""
        inputs = f'<label>Your prediction{unit} <input type="number" step="any" name="given"></label>'
    return (
        f'<form class="question" data-answer="{escape(json.dumps(kept))}"><fieldset>'
        f"<legend>{inline_html(question.text)}</legend>{inputs}</fieldset>"
        '<button type="submit" value="answer">Answer</button> <button type="submit" value="skip">Skip and show me</button>'
        '<output aria-live="polite"></output></form>'
    )


def question_run(lesson: Lesson, question: Question) -> str:
    """Return the name of the run that answers a question: of the default, a preset or an earlier question if the same."""
    if question.params == lesson.params():
        return "default"
    preset = lesson.preset_of(question.params)
    if preset is not None:
        return preset.name
    return next(other.name for other in lesson.questions if other.params == question.params)
