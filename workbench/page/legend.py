"""The legend of a scene and the bar of a colour map: as entries, and as HTML of these. Whatever a
lesson or its params say is escaped there.
"""

import html
from dataclasses import dataclass
from typing import Any, TypeAlias, cast

from workbench.numerals import brief
from workbench.scene import PALETTE, Classes, Field, Primitive, Role, Scene, color_map, in_space
from workbench.words.axis import LOGARITHM


def escape(text: str) -> str:
    """Return text that is safe inside HTML."""
    return html.escape(text)


def css_color(rgb: tuple[int, int, int]) -> str:
    """Return a colour as CSS writes it."""
    return "#{:02x}{:02x}{:02x}".format(*rgb)


@dataclass(frozen=True)
class Swatch:
    """A colour, `#rrggbb`, and what it is of."""

    color: str
    name: str


@dataclass(frozen=True, kw_only=True)
class Bar:
    """The bar of a colour map: its title, the colours from low to high, its ends as they are
    written, and their unit, empty for none.
    """

    title: str
    colors: tuple[str, ...]
    low: str
    high: str
    unit: str


Entry: TypeAlias = Swatch | Bar


def legend_entries(scene: Scene) -> dict[Entry, list[str]]:
    """Return the legend of a scene: every named thing with its colour, every colour map with its
    bar; each with the paths of what it is about.
    """
    entries: dict[Entry, list[str]] = {}
    for path, primitive in scene.items():
        for entry in _entries(primitive) if in_space(primitive) else ():
            entries.setdefault(entry, []).append(path)
    return entries


def legend_html(scene: Scene, grid: float | None) -> str:
    """Return the legend of a scene, and the spacing of its grid, metres.

    Each row names the paths of what it is about, so that a page can tell which thing is meant.
    """
    rows = [
        f'<span data-things="{escape("|".join(paths))}">{_html(entry)}</span>'
        for entry, paths in legend_entries(scene).items()
    ]
    if grid is not None:
        rows.append(f"<span>grid {grid:g} m</span>")
    return f'<div class="wb-legend">{"".join(rows)}</div>' if rows else ""


def _entries(primitive: Primitive) -> list[Entry]:
    color: Any = getattr(primitive, "color", None)
    name = getattr(primitive, "name", "")
    field = color if isinstance(color, Field) else getattr(primitive, "image", None)
    if isinstance(field, Field):
        return [bar_of(field)]
    if isinstance(color, Classes):
        return [Swatch(css_color(PALETTE[role]), label) for role, label in color.present()]
    if isinstance(color, str) and name:
        return [Swatch(css_color(PALETTE[cast(Role, color)]), name)]
    return []


def bar_of(field: Field) -> Bar:
    """Return the colour bar of a field; short lengths are in millimetres, logarithms are said as
    the numbers they are of.
    """
    colors = (css_color(tuple(color_map(field.map, i / 8).tolist())) for i in range(9))  # type: ignore[arg-type]
    small = field.unit == "m" and max(abs(field.low), abs(field.high)) < 0.1
    scale, unit = (1e3, "mm") if small else (1.0, field.unit)
    logarithms = field.title.startswith(LOGARITHM)
    low, high = (10.0**end if logarithms else scale * end for end in (field.low, field.high))
    return Bar(
        title=field.title.removeprefix(LOGARITHM),
        colors=tuple(colors),
        low=brief(low),
        high=brief(high),
        unit=unit,
    )


def bar_html(field: Field) -> str:
    """Return the colour bar of a field: its title, ends and unit."""
    return _html(bar_of(field))


def _html(entry: Entry) -> str:
    if isinstance(entry, Swatch):
        return f'<i style="background:{entry.color}"></i>{escape(entry.name)}'
    bar = f'<b style="background:linear-gradient(90deg,{",".join(entry.colors)})"></b>'
    unit = escape(f" {entry.unit}") if entry.unit else ""
    return f"{escape(entry.title)}: {entry.low}{bar}{entry.high}{unit}"
