"""A scene as SVG: surfaces as one picture, a circle for each point and a line for each segment."""

import base64
import io
from collections.abc import Iterator, Sequence

import numpy as np
from PIL import Image, ImageColor

from workbench.picture.theme import theme
from workbench.rendering.lens import Lens
from workbench.rendering.raster import LEAST_RADIUS, bands, clipped
from workbench.rendering.shapes import Discs, Shape, Sheet, Strokes, Surface

FINER = 2
LOOKS = 64
"""Places along a line at which it is looked whether a surface hides it."""


def scene_svg(shapes: Sequence[Shape], lens: Lens, *, scale: float, dark: bool) -> str:
    """Return the surfaces, and the points and lines from far to near, as the inside of an SVG of
    the lens's size; words are left out, and so is what a surface hides.
    """
    surfaces = [shape for shape in shapes if isinstance(shape, Surface | Sheet)]
    finer = lens.scaled(FINER * scale)
    depth = np.empty(finer.size[::-1], np.float32)
    wide, high = (-(-side // FINER) for side in finer.size)
    sheet = Image.new("RGBA", (wide, high))
    for raster in bands(surfaces, finer, FINER, scale=FINER * scale, dark=dark):
        depth[raster.rows.start : raster.rows.stop] = raster.depth
        sheet.paste(raster.image(FINER), (0, raster.rows.start // FINER))
    image = ""
    if surfaces:
        file = io.BytesIO()
        sheet.save(file, "PNG", compress_level=9)
        data = base64.b64encode(file.getvalue()).decode()
        image = (
            f'<image width="{lens.size[0]}" height="{lens.size[1]}"'
            f' href="data:image/png;base64,{data}"/>'
        )
    ground = np.array(ImageColor.getrgb(theme(dark=dark).paper))
    groups: dict[str, list[tuple[float, str]]] = {"grid": [], "vectors": []}
    for shape in shapes:
        where = groups["vectors" if shape.framed else "grid"]
        if isinstance(shape, Discs):
            where += _circles(shape, depth, lens=lens, ground=ground)
        elif isinstance(shape, Strokes):
            where += _lines(shape, depth, lens=lens, ground=ground)
    drawn = (
        f'<g class="{name}">{"".join(svg for _, svg in sorted(ones, key=lambda row: -row[0]))}</g>'
        for name, ones in groups.items()
    )
    grid, vectors = drawn
    return f'{grid}<g class="surfaces">{image}</g>{vectors}'


def _circles(
    discs: Discs, depth: np.ndarray, *, lens: Lens, ground: np.ndarray
) -> Iterator[tuple[float, str]]:
    uv, z = lens.seen(discs.p)
    hidden = _hidden(uv, z, depth, lens=lens)
    for (u, v), far, out, color in zip(uv, z, hidden, discs.rgba, strict=True):
        if np.isfinite(far) and not out:
            radius = max(lens.focal * discs.radius / far, LEAST_RADIUS)
            ink = _ink("fill", color, ground)
            yield float(far), f'<circle cx="{u:.2f}" cy="{v:.2f}" r="{radius:.2f}" {ink}/>'


def _lines(
    strokes: Strokes, depth: np.ndarray, *, lens: Lens, ground: np.ndarray
) -> Iterator[tuple[float, str]]:
    uv, inverse, which = clipped(strokes.ends, lens, margin=strokes.width)
    share = np.linspace(0, 1, LOOKS)
    for pair, near, i in zip(uv, inverse, which, strict=True):
        along = pair[0] + share[:, None] * (pair[1] - pair[0])
        z = 1 / (near[0] + share * (near[1] - near[0]))
        seen = ~_hidden(along, z, depth, lens=lens)
        starts = np.flatnonzero(seen & ~np.concatenate([[False], seen[:-1]]))
        ends = np.flatnonzero(seen & ~np.concatenate([seen[1:], [False]]))
        for first, last in zip(starts, ends, strict=True):
            (a, b), (c, d) = along[[first, last]]
            yield (
                float(z[first : last + 1].mean()),
                f'<line x1="{a:.2f}" y1="{b:.2f}" x2="{c:.2f}" y2="{d:.2f}" stroke-width='
                f'"{strokes.width:g}" stroke-linecap="round"'
                f" {_ink('stroke', strokes.rgba[i], ground)}/>",
            )


def _hidden(uv: np.ndarray, z: np.ndarray, depth: np.ndarray, *, lens: Lens) -> np.ndarray:
    """Tell which places (n,) a surface hides; `depth` is the picture's, of any fineness."""
    high, wide = depth.shape
    finer = np.array([wide, high]) / lens.size
    inside = np.all((uv >= 0) & (uv < lens.size), axis=1)
    column, row = np.floor(np.where(inside[:, None], uv, 0) * finer).astype(np.intp).T
    return inside & (0.997 * np.nan_to_num(z) > depth[row, column])


def _ink(name: str, rgba: np.ndarray, ground: np.ndarray) -> str:
    """Return a colour mixed with the ground, as a page does: where two lines meet is no dot."""
    power = 0.6 if ground.mean() < 128 else 1.0
    share = (rgba[3] / 255) ** power
    red, green, blue = np.rint(share * rgba[:3] + (1 - share) * ground).astype(int)
    return f'{name}="#{red:02x}{green:02x}{blue:02x}"'
