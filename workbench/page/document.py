"""The HTML document of the page, the same in every home: what a home cannot do is not in it."""

import json
from collections.abc import Mapping
from html import escape
from typing import Any

from workbench.knobs import fields_of
from workbench.lesson import Lesson
from workbench.page import bundles
from workbench.page.article import PLACE, QUESTION
from workbench.page.lessons import lesson_data
from workbench.story import Story, story_data

COURSE = "Geometry workbench"
"""The name of the course, in the title of every page."""
STANDS_STILL = (
    "This page needs JavaScript to move: with it the scene turns, steps and plays, questions are"
    " answered, and experiments open. Without it there are the text and pictures."
)
_CLOSED = r"<\/script"
"""How a script says that end of itself."""
SPEEDS = (0.5, 1.0, 2.0, 4.0, 8.0)
"""Steps a second of Play, as a page offers them."""
VERBS = (
    ("first", "First step (Home)", "M1 3h2v10H1zM9 3v10L3.5 8zM15 3v10L9.5 8z"),
    ("back", "Step back (P)", "M10 3v10L3 8zM11.5 3h2v10h-2z"),
    ("play", "Play (K)", "M4 2.5v11L13.5 8z"),
    ("next", "Next step (N)", "M2.5 3h2v10h-2zM6 3v10l7-5z"),
    ("last", "Last step (End)", "M1 3v10l5.5-5zM7 3v10l5.5-5zM13 3h2v10h-2z"),
)
"""Verb, what it is called, and its sign as the path of a 16 x 16 picture."""


def lesson_document(
    lesson: Lesson,
    article: str,
    *,
    home: str,
    root: str | None,
    head: str = "",
    opening: str = "",
    ending: str = "",
    more: Mapping[str, Any] | None = None,
    alone: tuple[str, str] | None = None,
    still: str = "",
    story: Story | None = None,
    footer: str = "",
) -> str:
    """Return the document of a lesson: its story, where one is told, and its workbench.

    Args:
        lesson: What it is about.
        article: Its text as HTML, with PLACE where the questions belong.
        home: `live`, `site` or `notebook`.
        root: The relative address of the folder with the page's own files; None puts them all into
            the document.
        head: More HTML for the head.
        opening: What stands before the text, as HTML.
        ending: What stands behind the text and its experiments, as HTML.
        more: What else the scripts need: name of a constant -> plain data.
        alone: Of a page that shows one run and no article, its title and the address of the
            lesson's page, if it has one.
        still: The address of a picture that stands for the scene where no script runs.
        story: The lesson's story; only for a document with a root.
        footer: What stands under its words, as HTML; of one run alone, in its heading.
    """
    data = lesson_data(lesson) | ({} if home == "live" else {"knobs": []})
    told = story is not None
    dressed = root is not None and not alone and not told
    constants = (
        {"LESSON": data}
        | ({} if story is None else {"STORY": story_data(lesson, story)})
        | dict(more or {})
    )
    heading = f"{lesson.title}: {alone[0]}" if alone else lesson.title
    text = (
        _alone(heading, alone[1], footer)
        if alone
        else _article(article, home, data, opening=opening, ending=ending, footer=footer, told=told)
    )
    start = document_head(
        heading,
        lesson.summary,
        root,
        styles=_styles(root, alone=bool(alone), told=told),
        more=head,
    )
    face = "story" if told else "bench"
    dress = " data-dress" if dressed else ""
    return (
        f'{start}<body{" class=alone" if alone else ""} data-home="{home}"'
        f' data-lesson="{escape(lesson.name)}" data-face="{face}"{dress}>'
        f"{_face(lesson, story)}"
        f'<a class="skip" href="#stage">To the stage</a><main>{_told(story, footer)}{text}'
        f'<div id="side">{_stage(still, dressed=dressed)}</div></main>'
        + _third_parties(root)
        + f"<script>{''.join(f'const {name} = {in_script(value)};' for name, value in constants.items())}</script>"  # noqa: E501
        + scripts_html(root, _scripts(root, home, alone=bool(alone), told=told))
        + "</body></html>\n"
    )


def _styles(root: str | None, *, alone: bool, told: bool) -> str:
    """Return the name of the bundle with a page's styles."""
    if alone:
        return bundles.NOTEBOOK_STYLES if root is None else bundles.RUN_STYLES
    if root is None:
        return bundles.RUN_STYLES
    return bundles.STORY_STYLES if told else bundles.BENCH_STYLES


def _scripts(root: str | None, home: str, *, alone: bool, told: bool) -> str:
    """Return the name of the bundle with a page's scripts."""
    if root is None:
        return bundles.NOTEBOOK_SCRIPTS
    if home == "live":
        return bundles.LIVE_STORY if told else bundles.LIVE_BENCH
    if alone:
        return bundles.RUN_SCRIPTS
    return bundles.SITE_STORY if told else bundles.SITE_BENCH


def _told(story: Story | None, footer: str) -> str:
    return "" if story is None else f'<div id="story">{story.html}</div>{footer}'


def _face(lesson: Lesson, story: Story | None) -> str:
    """Return the script that opens the workbench where the address names a run, a step or a
    param; before any picture.
    """
    if story is None:
        return ""
    keys = in_script(["preset", "step", *(field.name for field in fields_of(lesson.params))])
    return (
        "<script>if (new URLSearchParams(location.hash.slice(1)).has('run') || "
        f"{keys}.some((key) => new URLSearchParams(location.search).has(key))) "
        "document.body.dataset.face = 'bench';</script>"
    )


def _third_parties(root: str | None) -> str:
    """Return the licences of what is in a document that stands alone; another has them in a file
    beside it.
    """
    if root is not None:
        return ""
    text = (bundles.STATIC / bundles.THIRD_PARTIES).read_text(encoding="utf-8")
    return f'<script type="text/plain" id="third-parties">{text}</script>'


def scripts_html(root: str | None, name: str) -> str:
    """Return what loads the scripts of a bundle, or has them in itself."""
    if root is not None:
        return f'<script src="{root}{name}"></script>'
    texts = (bundles.part(file, inside=True) for file in bundles.BUNDLES[name])
    return "".join(f"<script>{text.replace('</script', _CLOSED)}</script>" for text in texts)


def _styles_html(root: str | None, name: str) -> str:
    """Return what loads the styles of a bundle, or has them in itself."""
    if root is not None:
        return f'<link rel="stylesheet" href="{root}{name}">'
    texts = (bundles.part(file, inside=True) for file in bundles.BUNDLES[name])
    return "".join(f"<style>{text}</style>" for text in texts)


def _article(
    article: str,
    home: str,
    data: dict[str, Any],
    *,
    opening: str,
    ending: str,
    footer: str,
    told: bool,
) -> str:
    """Return the text of the workbench; beside a story its experiments and exercises come first."""
    cards = {question["name"]: _question(question) for question in data["questions"]}
    placed = set(QUESTION.findall(article))
    article = QUESTION.sub(lambda match: cards[match[1]], article)
    questions = "".join(card for name, card in cards.items() if name not in placed)
    presets = "".join(
        f'<li><button type="button" data-run="{escape(preset["name"])}"'
        f' aria-pressed="false">{escape(preset["title"])}'
        f"<small>{escape(preset['line'])}</small></button></li>"
        for preset in data["presets"]
    )
    chosen = (
        f'<section class="s-runs"><h2>Experiments</h2><ul class="runs">{presets}</ul></section>'
        if presets
        else ""
    )
    folded = (
        '<details class="s-runs"><summary>All experiments</summary>'
        f'<ul class="runs">{presets}</ul></details>'
    )
    spoken = all(f'data-run="{escape(preset["name"])}"' in article for preset in data["presets"])
    before, _, after = article.partition(PLACE)
    if told:
        words = f'<div class="wb">{before}</div>{chosen}{ending}<div class="wb">{after}</div>'
    else:
        experiments = folded if spoken and presets else chosen
        words = f'<div class="wb">{article.replace(PLACE, questions)}</div>{experiments}{ending}'
    return (
        f'<article id="article">{_top(COURSE, _course(home))}{opening}{words}<section'
        ' class="s-run" id="this-run" hidden><h2>This run</h2></section><details'
        ' id="text"><summary>Text of this run</summary><p></p><ol start="0"></ol></details><nav'
        ' id="around" aria-label="Lessons before and after"'
        f' data-address="{_lesson(home)}"></nav>{footer}</article>'
    )


def _alone(heading: str, lesson_page: str, footer: str) -> str:
    top = _top("The lesson" if lesson_page else "", lesson_page, footer)
    return f'<header id="article"><h1>{escape(heading)}</h1>{top}</header>'


def _top(words: str, address: str, more: str = "") -> str:
    return (
        f'<nav class="top">{f"""<a href="{address}">{words}</a>""" if words else ""}{more}'
        '<button type="button" id="theme" title="Light or dark (T)">◐</button>'
        '<button type="button" id="help" title="Keys (?)">?</button></nav>'
    )


def in_script(value: Any) -> str:
    """Return JSON that may stand in a script."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def document_head(
    title: str, summary: str, root: str | None, *, styles: str, more: str, first: str = ""
) -> str:
    """Return the head of a document of ours; `styles` is the name of a bundle, `first` is HTML that
    stands before every address.
    """
    name = title if title == COURSE else f"{title} · {COURSE}"
    icon = "data:," if root is None else f"{root}{bundles.ICON}"
    unscripted = "" if root is None else _styles_html(root, bundles.UNSCRIPTED)
    return (
        '<!doctype html><html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f'<title>{escape(name)}</title><meta name="description" content="{escape(summary)}">'
        f'{first}<link rel="icon" href="{icon}">{_styles_html(root, styles)}'
        f"{unscripted and f'<noscript>{unscripted}</noscript>'}{more}</head>"
    )


def _course(home: str) -> str:
    return "?course" if home == "live" else "../index.html"


def _lesson(home: str) -> str:
    return "?lesson=LESSON" if home == "live" else "../LESSON/index.html"


def _stage(still: str, *, dressed: bool) -> str:
    """Return the stage. What a home may lack has `data-needs`, the verbs of its source that it is
    shown with.
    """
    buttons = "".join(
        f'<button type="button" data-act="{verb}" title="{title}"'
        f' aria-label="{title}">{_sign(sign)}</button>'
        for verb, title, sign in VERBS
    )
    speeds = "".join(f'<option value="{speed:g}">{speed:g}×</option>' for speed in SPEEDS)
    drawn = f'<img src="{escape(still)}" alt="A step of this lesson">' if still else ""
    picture = f'<noscript>{drawn}<p class="unscripted">{STANDS_STILL}</p></noscript>'
    opened = '<div id="open"><b></b> <span></span></div>' if dressed else ""
    below = '<div id="main-chart" hidden></div><div id="places"></div>' if dressed else ""
    return (
        f'<section id="stage" aria-label="Stage">{opened}<div id="view"><div id="scene"'
        f' aria-busy="true"></div>{picture}<div id="legend" role="group" aria-label="Legend"'
        ' tabindex="0"></div><div id="tools" role="group" aria-label="Tools"><button type="button"'
        ' id="move" data-needs="handles" aria-pressed="false" title="Handles in the scene (H)"'
        ' hidden>Move<span> it yourself</span></button><button type="button" id="pin"'
        ' data-needs="pin" aria-pressed="false" title="Keep this run behind the next (I)"'
        ' hidden>Pin</button><button type="button" id="set" data-needs="change sweep"'
        ' aria-expanded="false" aria-controls="drawer" title="What this run is made with (S)"'
        ' hidden>Knobs</button></div><aside id="drawer" aria-label="Knobs"'
        f' hidden></aside></div><div id="bar" role="group" aria-label="Steps">{buttons}<input'
        ' id="step" type="range" min="0" max="0" value="0" aria-label="Step"><output'
        ' id="count"></output><select id="speed" aria-label="Speed" title="Steps per'
        f' second"><option value="">Speed</option>{speeds}</select></div><p id="caption"'
        f' role="status" aria-live="polite" tabindex="0"></p>{below}</section>'
        '<div id="tiles" role="group"'
        ' aria-label="Curves, pictures and code of this step"></div><div id="large" role="dialog"'
        ' aria-label="Enlarged" hidden></div>'
    )


def _sign(path: str) -> str:
    return f'<svg viewBox="0 0 16 16" aria-hidden="true"><path d="{path}"/></svg>'


def _question(question: dict[str, Any]) -> str:
    name = escape(question["name"])
    if question["choices"]:
        inputs = "".join(
            f'<label><input type="radio" name="given" value="{escape(choice)}">'
            f" {escape(choice)}</label>"
            for choice in question["choices"]
        )
    else:
        unit = escape(f" ({question['unit']})") if question["unit"] else ""
        inputs = (
            f'<label>Your prediction{unit} <input inputmode="decimal" autocomplete="off"'
            ' name="given"></label>'
        )
    return (
        '<form class="question"'
        f' data-question="{name}"><fieldset><legend>{question["html"]}</legend>{inputs}</fieldset><button'  # noqa: E501
        ' type="submit" value="answer">Answer</button> <button type="submit" value="skip">Skip and'
        ' show me</button><output aria-live="polite"></output></form>'
    )
