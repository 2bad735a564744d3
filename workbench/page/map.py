"""The map of a course: which lesson builds on which, drawn from what the lessons themselves say."""

from collections.abc import Mapping, Sequence
from html import escape

WIDTH, HEIGHT = 192, 34
ACROSS, DOWN = 44, 12
"""A lesson's box and the gaps between boxes, in pixels."""


def columns(needs: Mapping[str, Sequence[str]]) -> list[list[str]]:
    """Return lessons in columns: each stands right of all that it needs, and near their height.

    Args:
        needs: Lesson to the lessons it builds on, in course order; names that are no lesson here
            are passed over, and so is a need that stands later in the course (nothing can wait for
            itself).
    """
    depth: dict[str, int] = {}
    for name, wanted in needs.items():
        depth[name] = 1 + max((depth[one] for one in wanted if one in depth), default=-1)
    found: list[list[str]] = [[] for _ in range(max(depth.values(), default=-1) + 1)]
    row: dict[str, float] = {}
    for at, column in enumerate(found):
        here = [name for name, deep in depth.items() if deep == at]
        heights = {name: [row[one] for one in needs[name] if one in row] for name in here}
        column += sorted(
            here, key=lambda name: sum(heights[name]) / len(heights[name]) if heights[name] else 0.0
        )
        row |= {name: i - (len(column) - 1) / 2 for i, name in enumerate(column)}
    return found


def course_map(
    titles: Mapping[str, str], needs: Mapping[str, Sequence[str]], addresses: Mapping[str, str]
) -> str:
    """Return the map of lessons, given by name in course order, as links in an SVG; empty where
    none builds on another.
    """
    placed = columns(needs)
    if len(placed) < 2:
        return ""
    tallest = max(map(len, placed))
    wide, high = len(placed) * (WIDTH + ACROSS) - ACROSS + 2, tallest * (HEIGHT + DOWN) - DOWN + 2
    corner = {
        name: (1 + x * (WIDTH + ACROSS), 1 + (y + (tallest - len(column)) / 2) * (HEIGHT + DOWN))
        for x, column in enumerate(placed)
        for y, name in enumerate(column)
    }
    ways = "".join(
        _way(corner[one], corner[name]) for name in corner for one in needs[name] if one in corner
    )
    boxes = "".join(
        f'<a href="{escape(addresses[name])}"><rect x="{x}" y="{y:g}" width="{WIDTH}"'
        f' height="{HEIGHT}" rx="7"/><text x="{x + WIDTH / 2:g}"'
        f' y="{y + HEIGHT / 2:g}">{escape(titles[name])}</text></a>'
        for name, (x, y) in corner.items()
    )
    return (
        '<section class="map" aria-label="Which lesson builds on which"><h2>What builds on'
        f' what</h2><div tabindex="0"><svg width="{wide}" height="{high:g}" viewBox="0 0 {wide}'
        f' {high:g}">{ways}{boxes}</svg></div></section>'
    )


def _way(start: tuple[float, float], end: tuple[float, float]) -> str:
    """Return the line from a lesson to one that builds on it."""
    x0, y0, x1, y1 = start[0] + WIDTH, start[1] + HEIGHT / 2, end[0], end[1] + HEIGHT / 2
    return (
        f'<path d="M{x0} {y0:g}C{x0 + ACROSS / 2:g} {y0:g} {x1 - ACROSS / 2:g} {y1:g} {x1}'
        f' {y1:g}"/>'
    )
