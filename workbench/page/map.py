"""The map of a course: which lesson builds on which, drawn from what the lessons themselves say.

Every chapter has a band of rows. A lesson stands right of all that it needs. Its lines turn only in
the gaps between columns, where each lesson that others need has a track of its own: no two lines
lie on each other.
"""

from collections.abc import Mapping, Sequence
from html import escape

WIDTH, HEIGHT = 146, 44
ACROSS, DOWN = 40, 14
"""A lesson's box and the gaps between boxes, in pixels."""
LEFT, BETWEEN = 92, 16
"""The width of the chapters' names, and what parts two chapters."""
ROUND = 7
TRACKS = 5
"""Lines side by side between two columns."""
LONGEST = 19
"""Signs on a line of a box."""


def depths(needs: Mapping[str, Sequence[str]]) -> dict[str, int]:
    """Return in which column each lesson stands, counted from 0: right of all that it needs.

    Args:
        needs: Lesson to the lessons it builds on, in course order; names that are no lesson here
            are passed over, and so is a need that stands later in the course (nothing can wait for
            itself).
    """
    depth: dict[str, int] = {}
    for name, wanted in needs.items():
        depth[name] = 1 + max((depth[need] for need in wanted if need in depth), default=-1)
    return depth


def rows(
    needs: Mapping[str, Sequence[str]], chapters: Mapping[str, Sequence[str]]
) -> tuple[dict[str, int], dict[str, range]]:
    """Return in which row each lesson stands, counted from 0, and which rows each chapter has.

    A lesson takes the row of what it needs in its chapter, else the first; neither in its place nor
    on the way to it stands another.
    """
    column = depths(needs)
    row: dict[str, int] = {}
    bands: dict[str, range] = {}
    top = 0
    for chapter, names in chapters.items():
        taken: set[tuple[int, int]] = set()
        for name in sorted(names, key=lambda name: column[name]):
            behind = [need for need in needs[name] if column.get(need, column[name]) < column[name]]
            first = min((column[need] for need in behind), default=column[name] - 1)
            cells = range(first + 1, column[name] + 1)  # its own, and those that its lines cross
            same = [row[need] for need in behind if need in names]
            free = (
                at
                for at in [*same, *range(top, top + len(names))]
                if taken.isdisjoint((cell, at) for cell in cells)
            )
            row[name] = next(free)
            taken.add((column[name], row[name]))
        end = max((row[name] for name in names), default=top - 1) + 1
        bands[chapter] = range(top, end)
        top = end
    return row, bands


def course_map(
    titles: Mapping[str, str],
    needs: Mapping[str, Sequence[str]],
    addresses: Mapping[str, str],
    *,
    chapters: Mapping[str, Sequence[str]],
) -> str:
    """Return the map as links in an SVG; empty where no lesson builds on another.

    Args:
        titles: By the lesson's name, in course order.
        needs: The lessons that each builds on, likewise.
        addresses: Of the lessons' pages, likewise.
        chapters: The names of the lessons of each chapter, in course order.
    """
    column = depths(needs)
    if max(column.values(), default=0) < 1:
        return ""
    row, bands = rows(needs, chapters)
    band = {name: i for i, names in enumerate(chapters.values()) for name in names}
    x = {name: LEFT + at * (WIDTH + ACROSS) for name, at in column.items()}
    y = {name: 8 + row[name] * (HEIGHT + DOWN) + band[name] * BETWEEN for name in column}
    wide = LEFT + (max(column.values()) + 1) * (WIDTH + ACROSS) - ACROSS + 2
    high = max(y.values()) + HEIGHT + 8
    lines = "".join(_lines(needs, column, x, y=y))
    boxes = "".join(
        _box(name, titles[name], addresses[name], needs=needs[name], x=x[name], y=y[name])
        for name in column
    )
    stripes = "".join(
        _stripe(chapter, 1 + rows_[0] * (HEIGHT + DOWN) + i * BETWEEN, len(rows_), wide=wide)
        for i, (chapter, rows_) in enumerate(bands.items())
    )
    return (
        '<section class="map" id="map" aria-label="Which lesson builds on which"><header><h2>What'
        " builds on what</h2><p>Each lesson stands to the right of those it"
        ' needs.</p></header><div tabindex="0" role="group" aria-label="Map of the lessons"><svg'
        f' width="{wide}" height="{high}" viewBox="0 0 {wide}'
        f' {high}">{stripes}{lines}{boxes}</svg></div></section>'
    )


def _lines(
    needs: Mapping[str, Sequence[str]],
    column: Mapping[str, int],
    x: Mapping[str, int],
    *,
    y: Mapping[str, int],
) -> list[str]:
    """Return a path for each need: it turns behind what is needed, and runs along the other's
    row.
    """
    tracks: dict[int, list[str]] = {}
    drawn = []
    for name, wanted in needs.items():
        for need in [need for need in wanted if column.get(need, column[name]) < column[name]]:
            gap = column[need] + 1
            used = tracks.setdefault(gap, [])
            if need not in used and y[need] != y[name]:
                used.append(need)
            track = used.index(need) % TRACKS if need in used else 0
            turn = LEFT + gap * (WIDTH + ACROSS) - ACROSS + 8 + 6 * track
            path = _path(
                (x[need] + WIDTH, y[need] + HEIGHT // 2), turn, (x[name], y[name] + HEIGHT // 2)
            )
            drawn.append(f'<path data-way="{escape(need)} {escape(name)}" d="{path}"/>')
    return drawn


def _path(start: tuple[int, int], turn: int, end: tuple[int, int]) -> str:
    """Return a line that goes across, up or down at `turn`, and across again, with round
    corners.
    """
    (x0, y0), (x1, y1) = start, end
    if y0 == y1:
        return f"M{x0} {y0}H{x1}"
    down = 1 if y1 > y0 else -1
    bend = min(ROUND, abs(y1 - y0) // 2)
    return (
        f"M{x0} {y0}H{turn - bend}Q{turn} {y0} {turn} {y0 + down * bend}"
        f"V{y1 - down * bend}Q{turn} {y1} {turn + bend} {y1}H{x1}"
    )


def _stripe(chapter: str, y: int, count: int, *, wide: int) -> str:
    high = count * (HEIGHT + DOWN)
    return (
        f'<rect class="stripe" x="0" y="{y}" width="{wide}" height="{high}" rx="10"/>'
        f'<text class="name" x="14" y="{y + (HEIGHT + DOWN) // 2}">{escape(chapter)}</text>'
    )


def _box(name: str, title: str, address: str, *, needs: Sequence[str], x: int, y: int) -> str:
    lines = _wrapped(title)
    first = y + HEIGHT / 2 - 8 * (len(lines) - 1)
    words = "".join(
        f'<tspan x="{x + WIDTH / 2:g}"'
        f' y="{first + 16 * i:g}">{escape(line)}{" " if line is not lines[-1] else ""}</tspan>'
        for i, line in enumerate(lines)
    )
    return (
        f'<a href="{escape(address)}" data-name="{escape(name)}"'
        f' data-needs="{escape(" ".join(needs))}"><rect x="{x}" y="{y}" width="{WIDTH}"'
        f' height="{HEIGHT}" rx="8"/><text>{words}</text></a>'
    )


def _wrapped(title: str) -> list[str]:
    """Return a title on one line, or on two of nearly one length."""
    words = title.split()
    if len(title) <= LONGEST or len(words) < 2:
        return [title]
    cuts = [(" ".join(words[:i]), " ".join(words[i:])) for i in range(1, len(words))]
    return list(min(cuts, key=lambda cut: max(map(len, cut))))
