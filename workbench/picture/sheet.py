"""One picture of a step: the scene, its words, and below it caption, legend and chart."""

import base64
import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from typing import Any

import numpy as np
from PIL import Image

from workbench.lesson import View
from workbench.page.chart_svg import charts_svg
from workbench.page.legend import Bar, legend_entries
from workbench.picture import letters
from workbench.picture.ink import inked
from workbench.picture.labels import labels_svg
from workbench.picture.theme import Theme, theme
from workbench.picture.vectors import scene_svg
from workbench.rendering.lens import Lens
from workbench.rendering.raster import painted
from workbench.rendering.shapes import Shape, Word, shapes_of, stage_of
from workbench.scene import Picture, Scene, in_space

WIDEST_PAGE = 800
NARROWEST_PAGE = 400
"""Pixels of the page that a picture is of: a wider picture has larger letters."""
EDGE = 14.0
"""What is left free at the sides of words."""
CAPTION = 16.0
SMALL = 13.0
FAMILY = "'Source Serif 4',Charter,Georgia,serif"


@dataclass(frozen=True, kw_only=True)
class Style:
    """How a picture looks.

    Args:
        width: Pixels.
        dark: Whether its ground is dark.
        chart: Whether the chart stands below the scene.
        caption: Whether the caption does.
    """

    width: int = 1200
    dark: bool = False
    chart: bool = True
    caption: bool = True

    @property
    def page(self) -> int:
        """Pixels of the page that it is of."""
        return min(max(self.width, NARROWEST_PAGE), WIDEST_PAGE)

    @property
    def scale(self) -> float:
        """Pixels of the picture to one of the page."""
        return self.width / self.page

    @property
    def scene_size(self) -> tuple[int, int]:
        """Width and height of the scene on the page, pixels."""
        return self.page, round(0.625 * self.page)


@dataclass(frozen=True, kw_only=True, eq=False)
class Moment:
    """What a picture is of.

    Args:
        scene: What is drawn.
        view: The grid and the axes beside it.
        lens: How it is seen, in pixels of the page.
        caption: What is said, and its tone.
        run: The run as plain data, for its charts.
        step: The step of it.
        charts: The names of those that are drawn.
        hide: Parts of charts that are left out.
        lines: Lines that are kept free for the caption; None for as many as it has.
        height: How high the picture is at least, pixels of the page.
    """

    scene: Scene
    view: View
    lens: Lens
    caption: str = ""
    tone: str = "info"
    run: Mapping[str, Any] = field(default_factory=dict)
    step: int = 0
    charts: Sequence[str] = ()
    hide: Sequence[str] = ()
    lines: int | None = None
    height: float = 0.0


def png_of(moment: Moment, style: Style) -> bytes:
    """Return a picture as a PNG file."""
    file = io.BytesIO()
    image_of(moment, style).save(file, "PNG", compress_level=9)
    return file.getvalue()


def image_of(moment: Moment, style: Style) -> Image.Image:
    """Return a picture as RGB pixels."""
    colors = theme(dark=style.dark)
    below, height = _below(moment, style, colors)
    image = Image.new("RGB", (style.width, round(height * style.scale)), colors.paper)
    lens = moment.lens.scaled(style.scale)
    shapes = _shapes(moment)
    scene = painted(shapes, lens, scale=style.scale, dark=style.dark)
    image.paste(scene, (0, 0), scene)
    if not any(in_space(primitive) for primitive in moment.scene.values()):
        _lay_flat(image, moment.scene, lens.size)
    inked(image, _words(shapes, moment.lens, colors) + below, style.scale)
    return image


def svg_of(moment: Moment, style: Style) -> bytes:
    """Return a picture as SVG: surfaces as one picture, points and lines as circles and lines, then
    words, caption, legend and chart.
    """
    colors = theme(dark=style.dark)
    below, height = _below(moment, style, colors)
    shapes = _shapes(moment)
    wide, high = style.scene_size
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide} {height:g}"'
        f' width="{style.width}" height="{height * style.scale:g}" font-family="{FAMILY}"'
        f' font-size="12" fill="{colors.soft}"><rect width="{wide}" height="{height:g}"'
        f' fill="{colors.paper}"/><svg width="{wide}" height="{high}">'
        f"{scene_svg(shapes, moment.lens, scale=style.scale, dark=style.dark)}</svg>"
        f'<g class="words">{_words(shapes, moment.lens, colors)}</g>'
        f'<g class="below">{below}</g></svg>\n'
    ).encode()


def paper_svg(moment: Moment, style: Style) -> bytes:
    """Return a picture as SVG for paper: all of the scene is one picture, its ground transparent
    and without the grid.
    """
    colors = theme(dark=style.dark)
    below, height = _below(moment, style, colors)
    shapes = shapes_of(moment.scene)
    wide, high = style.scene_size
    sheet = painted(shapes, moment.lens.scaled(1.25), scale=1.25)
    if not shapes:
        _lay_flat(sheet, moment.scene, sheet.size)
    file = io.BytesIO()
    sheet.save(file, "WEBP", quality=80, alpha_quality=60)
    data = base64.b64encode(file.getvalue()).decode()
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide} {height:g}" width="{wide}"'
        f' height="{height:g}" font-family="system-ui,sans-serif" font-size="12"'
        f' fill="{colors.soft}"><image width="{wide}" height="{high}"'
        f' href="data:image/webp;base64,{data}"/>{_words(shapes, moment.lens, colors)}{below}'
        "</svg>\n"
    ).encode()


def _shapes(moment: Moment) -> list[Shape]:
    return [*stage_of(moment.view), *shapes_of(moment.scene)]


def _words(shapes: Sequence[Shape], lens: Lens, colors: Theme) -> str:
    return labels_svg([shape for shape in shapes if isinstance(shape, Word)], lens, colors)


def _lay_flat(image: Image.Image, scene: Scene, size: tuple[int, int]) -> None:
    """Lay a picture from beside a scene where nothing stands in space."""
    flat = next((primitive for primitive in scene.values() if isinstance(primitive, Picture)), None)
    if flat is not None:
        pixels = Image.fromarray(np.ascontiguousarray(flat.rgb()))
        share = 0.9 * min(size[0] / pixels.width, size[1] / pixels.height)
        pixels = pixels.resize((round(share * pixels.width), round(share * pixels.height)))
        image.paste(pixels, ((size[0] - pixels.width) // 2, (size[1] - pixels.height) // 2))


def _below(moment: Moment, style: Style, colors: Theme) -> tuple[str, float]:
    """Return what stands below the scene, and where it ends, pixels of the page."""
    top = float(style.scene_size[1])
    parts = []
    if style.caption and moment.caption:
        text, top = _caption(moment, style.page, top, colors=colors)
        parts.append(text)
    text, top = _legend(moment.scene, style.page, top, colors=colors)
    parts.append(text)
    if style.chart and moment.charts:
        wide = int(style.page - 2 * EDGE)
        svg, high = charts_svg(moment.run, moment.step, moment.charts, hide=moment.hide, wide=wide)
        parts.append(
            f'<g class="chart" transform="translate({EDGE:g} {top + 12:g})">'
            f"{_inked_words(colors.of_charts(svg), colors)}</g>"
        )
        top += 12 + high if high else 0
    return "".join(parts), max(top + 10, moment.height)


def _inked_words(svg: str, colors: Theme) -> str:
    """Return charts whose words say their colour: a picture has no style sheet."""
    return svg.replace("<text x=", f'<text fill="{colors.soft}" x=').replace(
        f'<text fill="{colors.soft}" x="4" y="12" fill=', '<text x="4" y="12" fill='
    )


def height_of(moment: Moment, style: Style) -> float:
    """Return how high a picture is, pixels of the page."""
    return _below(moment, style, theme(dark=style.dark))[1]


def caption_lines(text: str, style: Style) -> int:
    """Return how many lines a caption has below a scene."""
    return len(letters.lines(text, CAPTION, style.page - 2 * EDGE))


def _caption(moment: Moment, wide: int, top: float, *, colors: Theme) -> tuple[str, float]:
    tones = {"good": colors.good, "wrong": colors.wrong}
    ink = tones.get(moment.tone, colors.ink)
    lines = letters.lines(moment.caption, CAPTION, wide - 2 * EDGE)
    text = "".join(
        f'<text x="{EDGE:g}" y="{top + 20 + 22 * i:g}" font-size="{CAPTION:g}"'
        f' fill="{ink}">{escape(line)}</text>'
        for i, line in enumerate(lines)
    )
    kept = max(len(lines), moment.lines or 0)
    return f'<g class="caption">{text}</g>', top + 22 * kept + 6


def _legend(scene: Scene, wide: int, top: float, *, colors: Theme) -> tuple[str, float]:
    """Return the legend of a scene in lines that fit, and where it ends."""
    room = wide - EDGE
    left = EDGE
    base = top + 17
    parts = []
    for i, entry in enumerate(legend_entries(scene)):
        before = f"{entry.title}: {entry.low}" if isinstance(entry, Bar) else entry.name
        after = f"{entry.high} {entry.unit}".strip() if isinstance(entry, Bar) else ""
        sign = 104 if after else 16
        needed = sign + letters.width(before, SMALL) + letters.width(after, SMALL) + 16
        if left > EDGE and left + needed - 16 > room:
            left = EDGE
            base += 19
        words = f'y="{base:g}" font-size="{SMALL:g}" fill="{colors.soft}"'
        if isinstance(entry, Bar):
            start = left + letters.width(before, SMALL) + 7
            stops = "".join(
                f'<stop offset="{k / 8:g}" stop-color="{c}"/>' for k, c in enumerate(entry.colors)
            )
            parts.append(
                f'<text x="{left:.1f}" {words}>{escape(before)}</text><linearGradient'
                f' id="bar{i}">{stops}</linearGradient><rect x="{start:.1f}" y="{base - 9:g}"'
                f' width="90" height="9" fill="url(#bar{i})"/>'
                f'<text x="{start + 97:.1f}" {words}>{escape(after)}</text>'
            )
        else:
            parts.append(
                f'<rect x="{left:.1f}" y="{base - 10:g}" width="10" height="10"'
                f' fill="{entry.color}"/><text x="{left + 15:.1f}"'
                f" {words}>{escape(entry.name)}</text>"
            )
        left += needed
    return f'<g class="legend">{"".join(parts)}</g>', base + 4 if parts else top
