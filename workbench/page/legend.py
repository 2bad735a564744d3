"""The legend of a scene and the bar of a colour map, as HTML. Whatever a lesson or its params say
is escaped.
"""

import html
from typing import Any, cast

from workbench.numerals import brief
from workbench.scene import PALETTE, Classes, Field, Primitive, Role, Scene, color_map, in_space


def escape(text: str) -> str:
    """Return text that is safe inside HTML."""
    return html.escape(text)


def css_color(rgb: tuple[int, int, int]) -> str:
    """Return a colour as CSS writes it."""
    return "#{:02x}{:02x}{:02x}".format(*rgb)


def legend_html(scene: Scene, grid: float | None) -> str:
    """Return the legend of a scene: every named thing with its colour, every colour map with its
    bar and unit.

    Each row names the paths of what it is about, so that a page can tell which thing is meant.
    """
    rows: dict[str, list[str]] = {}
    for path, primitive in scene.items():
        for row in _legend_rows(primitive) if in_space(primitive) else ():
            rows.setdefault(row, []).append(path)
    found = [
        f'<span data-things="{escape("|".join(paths))}">{row}</span>' for row, paths in rows.items()
    ]
    if grid is not None:
        found.append(f"<span>grid {grid:g} m</span>")
    return f'<div class="wb-legend">{"".join(found)}</div>' if found else ""


def _legend_rows(primitive: Primitive) -> list[str]:
    color: Any = getattr(primitive, "color", None)
    name = getattr(primitive, "name", "")
    field = color if isinstance(color, Field) else getattr(primitive, "image", None)
    if isinstance(field, Field):
        return [bar_html(field)]
    if isinstance(color, Classes):
        return [_dot(PALETTE[role], label) for role, label in color.present()]
    if isinstance(color, str) and name:
        return [_dot(PALETTE[cast(Role, color)], name)]
    return []


def bar_html(field: Field) -> str:
    """Return the colour bar of a field: its title, ends and unit."""
    stops = ",".join(css_color(tuple(color_map(field.map, i / 8).tolist())) for i in range(9))  # type: ignore[arg-type]
    small = field.unit == "m" and max(abs(field.low), abs(field.high)) < 0.1
    scale, unit = (1e3, "mm") if small else (1.0, field.unit)
    low, high = (brief(scale * value) for value in (field.low, field.high))
    bar = f'<b style="background:linear-gradient(90deg,{stops})"></b>'
    return f"{escape(field.title)}: {low}{bar}{high}{escape(f' {unit}') if unit else ''}"


def _dot(rgb: tuple[int, int, int], label: str) -> str:
    return f'<i style="background:{css_color(rgb)}"></i>{escape(label)}'
