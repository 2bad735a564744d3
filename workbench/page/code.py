"""The source of the algorithm that runs, with the line it stands at and its local variables, for a
page.
"""

import ast
import functools
import io
import keyword
import threading
import tokenize
from collections.abc import Callable, Iterator
from typing import Any

from workbench.page.legend import escape
from workbench.tracing import Moment, source_of

_TEXTS = ("STRING", "FSTRING_START", "FSTRING_MIDDLE", "FSTRING_END")  # the last from Python 3.12
_CSS = {tokenize.COMMENT: "c", tokenize.NUMBER: "m"} | {
    getattr(tokenize, name): "s" for name in _TEXTS if hasattr(tokenize, name)
}
"""The class that a token has on a page."""
_PARSING = threading.Lock()
"""Python before 3.11.8 and 3.12.2 counts the depth of all trees that threads make in one place, and
refuses a tree when another was made meanwhile (CPython's issue 106905).
"""


def moment_data(moment: Moment) -> dict[str, Any]:
    """Return where an algorithm stood: the line's number in its source, from 0, and name, shape and
    value of each local.
    """
    lines, first = moment.source
    at = min(max(moment.line - first, 0), len(lines) - 1)
    return {
        "line": at,
        "locals": [[local.name, local.shape, local.value] for local in moment.variables],
    }


@functools.lru_cache(maxsize=64)
def source_html(function: Callable[..., Any]) -> str:
    """Return a function's source as HTML, every line with its number in the file and `data-line`,
    from 0.
    """
    lines, first = source_of(function)
    rows = _rows("\n".join(lines), first)
    start, end = _long_docstring("\n".join(lines))
    folded = (
        f"<details><summary>{rows[start]}</summary>{''.join(rows[start + 1 : end])}</details>"
        if end
        else ""
    )
    return f"{''.join(rows[:start])}{folded}{''.join(rows[end:])}"


def text_html(source: str) -> str:
    """Return any Python as HTML, such as a student's file, every line with its number and
    `data-line`, from 1.
    """
    return "".join(_rows(source.rstrip(), 1, 1))


def _rows(source: str, first: int, start: int = 0) -> list[str]:
    return [
        f'<div data-line="{i + start}"><span class="n">{first + i}</span>{line or " "}</div>'
        for i, line in enumerate(_highlighted(source))
    ]


def _long_docstring(source: str) -> tuple[int, int]:
    """Return where a function's docstring starts and ends if it is longer than a line, else (0, 0):
    it is folded away.
    """
    with _PARSING:
        body = ast.parse(source).body[0].body  # type: ignore[attr-defined]
    first = body[0]
    is_text = (
        isinstance(first, ast.Expr)
        and isinstance(first.value, ast.Constant)
        and isinstance(first.value.value, str)
    )
    if not is_text or first.end_lineno == first.lineno:
        return 0, 0
    return first.lineno - 1, first.end_lineno or 0


def _highlighted(source: str) -> list[str]:
    """Return the lines of a source as HTML; of what is no Python, those after the error plain."""
    lines = source.split("\n")
    made = [""] * len(lines)
    at = [0] * len(lines)
    for row, start, end, css in _marked(lines):
        start = max(start, at[row])
        made[row] += escape(lines[row][at[row] : start])
        if start < end:
            made[row] += f'<span class="{css}">{escape(lines[row][start:end])}</span>'
        at[row] = max(end, start)
    return [html + escape(line[k:]) for html, line, k in zip(made, lines, at, strict=True)]


def _marked(lines: list[str]) -> Iterator[tuple[int, int, int, str]]:
    """Yield what has a colour, in order: row, columns from and to before, and the class."""
    try:
        for token in tokenize.generate_tokens(io.StringIO("\n".join(lines)).readline):
            css = _CSS.get(token.type)
            if token.type == tokenize.NAME and keyword.iskeyword(token.string):
                css = "k"
            first = token.start[0] - 1
            last = token.end[0] - 1
            for row in range(first, last + 1) if css else ():
                start = token.start[1] if row == first else 0
                end = token.end[1] if row == last else len(lines[row])
                yield row, start, end, css or ""
    except (tokenize.TokenError, SyntaxError):  # what follows is no Python
        return
