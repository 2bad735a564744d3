"""The words over a scene, moved apart where they would cover each other, as a page's script moves
them.
"""

from collections.abc import Iterable
from html import escape

from workbench.picture import letters
from workbench.picture.theme import Theme
from workbench.rendering.lens import Lens
from workbench.rendering.shapes import Word

SIZE = 13.0
LINE = 17.5
EDGE = 5.0
SHIFTS = (0.0, -1.05, 1.3, -2.1, 2.35, -3.15)
"""Heights of a word that it may go up or down to be read."""

_Box = tuple[float, float, float, float]


def labels_svg(words: Iterable[Word], lens: Lens, theme: Theme) -> str:
    """Return words over a scene as the inside of an SVG of the lens's size.

    One whose place is outside the picture is left out; one that would be cut at a side is moved
    inwards. Those that stay in their places have them first.
    """
    width, height = lens.size
    visible = []
    for word in words:
        uv, depth = lens.seen(word.p)
        if depth > 0 and 0 <= uv[0] <= width and 0 <= uv[1] <= height:
            visible.append((float(depth), float(uv[0]), float(uv[1]), word))
    taken: list[_Box] = []
    parts = []
    for _, u, v, word in sorted(visible, key=lambda item: (not item[3].stays, item[0])):
        wide = letters.width(word.text, SIZE, letters.BOLD) + 2 * EDGE
        left = min(max(u - wide / 2, 0.0), max(0.0, width - wide))
        top = v - LINE / 2 if word.small or word.stays else v - LINE - 2
        places = [
            min(max(top + shift * LINE, 0.0), height - LINE)
            for shift in (SHIFTS[:1] if word.stays else SHIFTS)
        ]
        free = (y for y in places if not any(_cross((left, y, wide, LINE), box) for box in taken))
        top = next(free, places[0])
        taken.append((left, top, wide, LINE))
        parts.append(
            f'<rect x="{left:.1f}" y="{top:.1f}" width="{wide:.1f}" height="{LINE}"'
            f' fill="{theme.paper}" fill-opacity="{0.62 * word.opacity:.2f}"/>'
            f'<text x="{left + EDGE:.1f}" y="{top + 13:.1f}" font-size="{SIZE:g}"'
            f' font-weight="{letters.BOLD}" fill="{theme.soft}">{escape(word.text)}</text>'
        )
    return "".join(parts)


def _cross(a: _Box, b: _Box) -> bool:
    return a[0] < b[0] + b[2] and b[0] < a[0] + a[2] and a[1] < b[1] + b[3] and b[1] < a[1] + a[3]
