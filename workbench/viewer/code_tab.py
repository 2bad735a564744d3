"""The Code tab: the source of the algorithm that runs, the line it stands at, and its local variables."""

from collections.abc import Callable
from typing import Any

import viser

from workbench.page.code import source_html
from workbench.page.legend import escape
from workbench.tracing import Moment


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
            self._source.content = f'<div class="wb-code" tabindex="0">{source_html(moment.function)}</div>'
        at = min(max(moment.line - first, 0), len(lines) - 1)
        # the unreadable image runs the script that keeps the marked line in sight inside its box
        self._mark.content = (
            f"<style>.wb-code [data-line='{at}']{{background:rgba(204,121,167,.32);box-shadow:inset 3px 0 #cc79a7}}</style>"
            f'<img src="data:,x" alt="" hidden data-line="{moment.line}" onerror="'
            f"const l=document.querySelector('.wb-code [data-line=&quot;{at}&quot;]'),b=l?.closest('.wb-code');"
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
