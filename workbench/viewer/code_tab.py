"""The Code tab: the source of the algorithm that runs, the line it stands at, and its local variables."""

import ast
import functools
from collections.abc import Callable
from typing import Any

import viser

from workbench.tracing import Moment, source_of
from workbench.viewer.style import escape


class CodeTab:
    """The running algorithm's source, in the container that is open."""

    def __init__(self, gui: viser.GuiApi):
        self._head = gui.add_html('<div class="wb wb-pad"><p>The code appears with the first step.</p></div>')
        self._source = gui.add_html("")
        self._mark = gui.add_html("")
        self._locals = gui.add_html("")
        self._function: Callable[..., Any] | None = None
        self._moment: Moment | None = None

    def show(self, moment: Moment | None) -> None:
        """Show where the algorithm stood at a step."""
        if moment is None or moment == self._moment:
            return
        self._moment = moment
        lines, first = moment.source
        if moment.function is not self._function:
            self._function = moment.function
            name = f"{moment.function.__module__}.{moment.function.__qualname__}"
            self._head.content = (
                f'<div class="wb wb-pad" style="padding-bottom:0"><strong>{escape(name)}</strong>'
                "<p>The marked line is where this step was yielded.</p></div>"
            )
            self._source.content = source_html(moment.function)
        at = min(max(moment.line - first, 0), len(lines) - 1)
        # the unreadable image runs the script that keeps the marked line in sight inside its box
        self._mark.content = (
            f"<style>#wb-line-{at}{{background:rgba(204,121,167,.32);box-shadow:inset 3px 0 #cc79a7}}</style>"
            f'<img src="data:,x" alt="" hidden data-line="{moment.line}" onerror="'
            f"const l=document.getElementById('wb-line-{at}'),b=l?.closest('.wb-code');"
            'if(b)b.scrollTop=l.offsetTop-b.offsetTop-0.6*b.clientHeight">'
        )
        rows = "".join(
            f"<tr><td><code>{escape(v.name)}</code></td><td>{escape(v.shape)}</td><td>{escape(v.value)}</td></tr>"
            for v in moment.variables
        )
        self._locals.content = (
            '<div class="wb wb-pad"><table><thead><tr><th>Variable</th><th>Shape or type</th><th>Value or range</th>'
            f"</tr></thead><tbody>{rows}</tbody></table></div>"
        )


@functools.lru_cache(maxsize=64)
def source_html(function: Callable[..., Any]) -> str:
    """Return a function's source as HTML, every line with its number in the file and an id of its own."""
    lines, first = source_of(function)
    rows = [
        f'<div id="wb-line-{i}"><span class="n">{first + i}</span>{line or " "}</div>'
        for i, line in enumerate(_highlighted("\n".join(lines)))
    ]
    start, end = _long_docstring("\n".join(lines))
    folded = f"<details><summary>{rows[start]}</summary>{''.join(rows[start + 1 : end])}</details>" if end else ""
    return f'<div class="wb-code" tabindex="0">{"".join(rows[:start])}{folded}{"".join(rows[end:])}</div>'


def _long_docstring(source: str) -> tuple[int, int]:
    """Return where a function's docstring starts and ends if it is longer than a line, else (0, 0): it is folded away."""
    body = ast.parse(source).body[0].body  # type: ignore[attr-defined]
    first = body[0]
    is_text = (
        isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant) and isinstance(first.value.value, str)
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
