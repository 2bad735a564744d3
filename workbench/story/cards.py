"""The cards of a scene: a question that is asked where its words stand, and what-ifs with their
picks.
"""

from html import escape
from typing import Any

from workbench.lesson import Question
from workbench.story.markdown import Block
from workbench.story.model import StagePlace
from workbench.story.names import Names
from workbench.story.words import Found, element
from workbench.words.typeset import inline_html, with_terms


def asked(question: Question, beat: int, *, flag: bool) -> str:
    """Return the form of a question.

    Args:
        question: What is asked.
        beat: The index of its beat.
        flag: Whether the answer is a place on the x axis of the scene's chart.
    """
    if question.choices:
        inputs = "".join(
            f'<label><input type="radio" name="given" value="{escape(choice)}">'
            f" {inline_html(choice)}</label>"
            for choice in question.choices
        )
    else:
        inputs = _number(question)
    words = f'<fieldset><legend class="q">{inline_html(question.text)}</legend>{inputs}</fieldset>'
    buttons = (
        '<button type="submit" class="go" disabled>Let it roll</button> '
        '<button type="button" class="link" data-skip>just show me</button>'
    )
    reply = '<div class="reply" aria-live="polite"></div>'
    given = {
        "class": "ask",
        "data-question": question.name,
        "data-beat": beat,
        "data-flag": "true" if flag else "",
        "data-unit": question.unit,
    }
    return element("form", given, f"{words}{buttons}{reply}")


def _number(question: Question) -> str:
    low, high = question.low, question.high
    label = escape(f"Your answer, {question.unit}" if question.unit else "Your answer")
    if low is None or high is None:
        field = '<input inputmode="decimal" autocomplete="off" name="given">'
        return f'<label><span class="hide">{label}</span>{field}</label>'
    step = question.stride or nice_step(low, high)
    value = round((0.5 * (low + high) - low) / step) * step + low
    numbers = f'min="{low:g}" max="{high:g}" step="{step:g}" value="{value:g}"'
    return (
        f'<label><span class="hide">{label}</span><input type="range" name="given"'
        f' {numbers}></label><output class="given"></output>'
    )


def nice_step(low: float, high: float) -> float:
    """Return a round step of which a range has about 200."""
    power = 10.0 ** len(str(int((high - low) / 200))) / 10 if high - low >= 200 else 1.0
    while (high - low) / power < 100:
        power /= 10
    return power


def what_if(block: Block, names: Names, notes: Found, *, beat: int, later: bool = False) -> str:
    """Return a what-if: `### title`, a line, and links that are its picks; `later` hides it until
    the scene's question is answered, whose run it would show.

    Raises:
        AuthorError: If it has no title or no pick, or a pick leads nowhere.
    """
    title = ""
    lines = list[str]()
    picks = list[str]()
    for part in block.inside():
        text = next((token for token in part.tokens if token.type == "inline"), None)
        if text is None:
            continue
        if part.kind == "heading_open":
            title = text.content
            continue
        paragraph, chosen = _picks(text.children or [], names, notes, line=part.line)
        picks += chosen
        if paragraph:
            lines.append(paragraph)
    if not title or not picks:
        raise names.wrong(
            block.line, "a what-if has a title (### ...) and picks ([words](run:preset))"
        )
    view = names.view(block.attributes.values.get("camera", ""), block.line)
    line = " ".join(lines)
    given = {
        "class": "what-if later" if later else "what-if",
        "data-title": title,
        "data-line": line,
        "data-beat": beat,
        "data-view": view,
        "data-chart": block.attributes.values.get("chart"),
    }
    paragraph = f"<p>{with_terms(inline_html(line))}</p>" if line else ""
    head = f"<h3>{inline_html(title)}</h3>{paragraph}"
    return element("div", given, f'{head}<div class="picks" role="group">{"".join(picks)}</div>')


def _picks(tokens: list[Any], names: Names, notes: Found, *, line: int) -> tuple[str, list[str]]:
    """Return the words of a paragraph outside its links, and a button for each link to a run."""
    words, picks = list[str](), list[str]()
    go: str | None = None
    inside: list[str] = []
    for token in tokens:
        if token.type == "softbreak":
            line += 1
            words.append(" ")
        elif token.type == "link_open" and str(token.attrs.get("href", "")).startswith("run:"):
            run, step = names.moment(str(token.attrs["href"]).removeprefix("run:"), line)
            notes.places.append((StagePlace(run=run, step=0 if step is None else step), line))
            go = run if step is None else f"{run}@{step}"
            inside = []
        elif token.type == "link_close" and go is not None:
            given = {"type": "button", "class": "pick", "data-go": go, "aria-pressed": "false"}
            picks.append(element("button", given, escape("".join(inside))))
            go = None
        elif go is not None:
            inside.append(token.content)
        else:
            words.append(f"${token.content}$" if token.type == "math_inline" else token.content)
    return " ".join("".join(words).split()), picks
