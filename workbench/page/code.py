"""The source of the algorithm that runs, with the line it stands at and its local variables, for a
page.
"""

import ast
import functools
from collections.abc import Callable
from typing import Any

from workbench.page.legend import escape
from workbench.tracing import Moment, source_of


def moment_data(moment: Moment) -> dict[str, Any]:
    """Return where an algorithm stood: the line's number in its source, from 0, and name, shape and
    value of each local.
    """
    lines, first = moment.source
    at = min(max(moment.line - first, 0), len(lines) - 1)
    return {"line": at, "locals": [[one.name, one.shape, one.value] for one in moment.variables]}


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
    from pygments.lexers.python import PythonLexer
    from pygments.token import Comment, Keyword, Number, String

    kinds = ((Comment, "c"), (Keyword, "k"), (String, "s"), (Number, "m"))
    lines = [""]
    for token, text in PythonLexer(stripnl=False, ensurenl=False).get_tokens(source):
        css = next((css for kind, css in kinds if token in kind), None)
        for i, part in enumerate(text.split("\n")):
            if i:
                lines.append("")
            if part:
                lines[-1] += f'<span class="{css}">{escape(part)}</span>' if css else escape(part)
    return lines
