"""Light and dark, as the page's own styles have them."""

import functools
import re
from dataclasses import dataclass
from pathlib import Path

from workbench.page import chart_svg
from workbench.page.bundles import STATIC

_LIGHT = r"(?<![\]\w]):root\{([^}]*)\}"
_DARK = r":root\[data-theme=dark\]\{([^}]*)\}"


@dataclass(frozen=True, kw_only=True)
class Theme:
    """Colours, `#rrggbb`: of the ground, words, quieter words, lines, and what is marked, right or
    wrong.
    """

    paper: str
    ink: str
    soft: str
    line: str
    mark: str
    good: str
    wrong: str
    is_dark: bool

    def of_charts(self, svg: str) -> str:
        """Return the SVG of charts, which is made for white paper, in the colours of the theme."""
        other = {
            chart_svg.SOFT: self.soft,
            chart_svg.GRID: self.line,
            chart_svg.INK: self.ink,
            chart_svg.MARK: self.mark,
        }
        pattern = "|".join(map(re.escape, other))
        return re.sub(pattern, lambda match: other[match[0]], svg)


@functools.cache
def theme(*, dark: bool) -> Theme:
    """Return the light theme of the page, or its dark one."""
    css = Path(STATIC / "page.css").read_text(encoding="utf-8")
    rules = [*re.findall(_LIGHT, css)[:1], *(re.findall(_DARK, css)[:1] if dark else [])]
    colors: dict[str, str] = {}
    for rule in rules:
        colors |= dict(re.findall(r"--(\w+):(#[0-9a-f]+)", rule))
    named = {name: _long(colors[name]) for name in Theme.__dataclass_fields__ if name in colors}
    return Theme(**named, is_dark=dark)


def _long(color: str) -> str:
    return color if len(color) == 7 else "#" + "".join(2 * digit for digit in color[1:])
