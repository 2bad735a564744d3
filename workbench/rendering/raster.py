"""Shapes as pixels: the nearest is seen, by a depth for each pixel; translucent surfaces are laid
over what is behind them.

Faint discs and lines are opaque and pale, as on a page: they keep how much of the ground shows.
"""

from collections.abc import Iterable, Iterator

import numpy as np
from PIL import Image

from workbench.rendering.lens import NEAR, Lens
from workbench.rendering.shapes import Discs, Shape, Sheet, Strokes, Surface

LARGE = 1 << 21
"""Pixels of a box beyond which it is drawn before smaller ones; samples of lines drawn together."""
MOST = 1 << 18
"""Candidate pixels that are looked at together."""
BAND = 1 << 22
"""Pixels of a picture that are in memory at once, about: a wide one is made in bands of rows."""
LIGHT = np.array([0.35, -0.6, -0.72])
"""Where light comes from, in the frame of the eye."""
LEAST_RADIUS = 0.7
"""Pixels of a page that a disc has at least."""
LINES_NEARER = 0.998
DISCS_NEARER = 0.9985
"""Shares of the depth that lines and discs on a surface are drawn at, so that it does not hide
them.
"""


def painted(
    shapes: Iterable[Shape], lens: Lens, *, scale: float, dark: bool = False
) -> Image.Image:
    """Return shapes as an image with a transparent ground, of the lens's size.

    Args:
        shapes: What is drawn; words are not.
        lens: How it is seen.
        scale: Pixels of the picture to one of a page, for the widths of lines.
        dark: Whether the ground will be dark: faint things keep more of their colour then.
    """
    finer = 3 if lens.size[0] <= 1300 else 2
    sheet = Image.new("RGBA", lens.size)
    for raster in bands(shapes, lens.scaled(finer), finer, scale=scale * finer, dark=dark):
        sheet.paste(raster.image(finer), (0, raster.rows.start // finer))
    return sheet


def bands(
    shapes: Iterable[Shape], lens: Lens, finer: int, *, scale: float, dark: bool = False
) -> Iterator["Raster"]:
    """Yield a picture of shapes in bands of rows from above, each but the last of a multiple of
    `finer` rows; the other arguments are those of `painted`.
    """
    shapes = list(shapes)
    width, height = lens.size
    rows = finer * max(1, BAND // (finer * width))
    for top in range(0, height, rows):
        raster = Raster(lens, range(top, min(top + rows, height)), scale=scale, dark=dark)
        raster.paint(shapes)
        yield raster


class Raster:
    """A band of a picture in the making: colours and depths of the pixels of some of its rows."""

    def __init__(self, lens: Lens, rows: range, *, scale: float, dark: bool = False):
        n = lens.size[0] * len(rows)
        self.lens = lens
        self.rows = rows
        self._depth = np.full(n, np.inf, np.float32)
        self._rgba = np.zeros((n, 4), np.uint8)
        self._scale = scale
        self._power = 0.6 if dark else 1.0

    @property
    def depth(self) -> np.ndarray:
        """The depth (rows, columns) of what is seen, metres; infinite where nothing is."""
        return self._depth.reshape(len(self.rows), self.lens.size[0])

    def paint(self, shapes: Iterable[Shape]) -> None:
        """Draw shapes: those that hide what is behind them first."""
        shapes = list(shapes)
        solid = [shape for shape in shapes if not _is_glass(shape)]
        for shape in solid:
            for pixels, z, rgba in self._fragments(shape):
                self._put(pixels, z, rgba)
        for shape in sorted(filter(_is_glass, shapes), key=lambda shape: -self._far(shape)):
            self._lay_over(shape)

    def image(self, finer: int) -> Image.Image:
        """Return the band, so many times smaller along each side, its ground transparent."""
        whole = Image.fromarray(self._rgba.reshape(*self.depth.shape, 4), "RGBA")
        return whole.convert("RGBa").reduce(finer).convert("RGBA")

    def _far(self, shape: Shape) -> float:
        p = shape.corners.reshape(-1, 3) if isinstance(shape, Surface) else shape.p  # type: ignore[union-attr]
        return float(self.lens.before(p)[:, 2].mean())

    def _put(self, pixels: np.ndarray, z: np.ndarray, rgba: np.ndarray) -> None:
        np.minimum.at(self._depth, pixels, z)
        nearest = z <= self._depth[pixels]
        self._rgba[pixels[nearest]] = rgba[nearest]

    def _lay_over(self, shape: Shape) -> None:
        """Blend the nearest of a translucent shape over what is farther away."""
        depth = self._depth.copy()
        nearest = np.zeros_like(self._rgba)
        for pixels, z, rgba in self._fragments(shape):
            before = np.flatnonzero(z < depth[pixels])
            np.minimum.at(depth, pixels[before], z[before])
            before = before[z[before] == depth[pixels[before]]][::-1]  # of equals the first stays
            nearest[pixels[before]] = rgba[before]
        chosen = np.flatnonzero(depth < self._depth)
        for start in range(0, len(chosen), MOST):
            pixels = chosen[start : start + MOST]
            self._rgba[pixels] = _blended(nearest[pixels], self._rgba[pixels])

    def _fragments(self, shape: Shape) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        if isinstance(shape, Discs):
            yield from self._discs(shape)
        elif isinstance(shape, Strokes):
            yield from self._strokes(shape)
        elif isinstance(shape, Surface):
            yield from self._faces(shape)
        elif isinstance(shape, Sheet):
            yield from self._sheet(shape)

    def _paled(self, rgba: np.ndarray) -> np.ndarray:
        paled = rgba.copy()
        paled[:, 3] = np.rint(255 * (rgba[:, 3] / 255) ** self._power)
        return paled

    def _boxes(
        self, low: np.ndarray, high: np.ndarray
    ) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        """Yield which box, column and row of all pixels of the band in boxes, so many at a time as
        memory likes; low and high are (n, 2) pixels.
        """
        width, height = self.lens.size
        size = np.array([width, height])
        first = np.clip(np.floor(low), 0, size).astype(np.intp)
        last = np.clip(np.ceil(high) + 1, 0, size).astype(np.intp)
        large = np.prod(last - first, axis=1, dtype=float) > LARGE
        first[:, 1] = np.maximum(first[:, 1], self.rows.start)
        last[:, 1] = np.minimum(last[:, 1], self.rows.stop)
        rows = max(1, MOST // width)
        for top in range(self.rows.start, self.rows.stop, rows) if large.any() else ():
            yield from _cells(
                np.flatnonzero(large),
                np.maximum(first[large], [0, top]),
                np.minimum(last[large], [width, top + rows]),
            )
        small = np.flatnonzero(~large)
        yield from _cells(small, first[small], last[small])

    def _pixels(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the indices in the band of columns and rows of the picture."""
        return (y - self.rows.start) * self.lens.size[0] + x

    def _touches(self, low: np.ndarray, high: np.ndarray) -> np.ndarray:
        """Tell what has some of the band's rows, by its lowest and highest row; what has NaN for
        them has none.
        """
        return (high >= self.rows.start - 2) & (low <= self.rows.stop + 1)

    def _discs(self, discs: Discs) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        uv, depth = self.lens.seen(discs.p)
        radius = np.maximum(self.lens.focal * discs.radius / depth, LEAST_RADIUS * self._scale)
        seen = np.flatnonzero(self._touches(uv[:, 1] - radius, uv[:, 1] + radius))
        uv = uv[seen]
        depth = depth[seen]
        radius = radius[seen]
        rgba = self._paled(discs.rgba[seen])
        for which, x, y in self._boxes(uv - radius[:, None], uv + radius[:, None]):
            du = x + 0.5 - uv[which, 0]
            dv = y + 0.5 - uv[which, 1]
            inside = du * du + dv * dv <= radius[which] ** 2
            chosen = which[inside]
            pixels = self._pixels(x[inside], y[inside])
            yield pixels, (DISCS_NEARER * depth[chosen]).astype(np.float32), rgba[chosen]

    def _strokes(self, strokes: Strokes) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        wide = max(strokes.width * self._scale, 1.0)
        uv, inverse, which = clipped(strokes.ends, self.lens, margin=wide)
        if not len(which):
            return
        rgba = self._paled(strokes.rgba)[which]
        along = uv[:, 1] - uv[:, 0]
        length = np.linalg.norm(along, axis=1)
        across = np.column_stack([-along[:, 1], along[:, 0]]) / np.maximum(length, 1e-9)[:, None]
        ticks = np.linspace(-0.5, 0.5, int(np.ceil(wide)) + 1) * (wide - 1.0 if wide > 1 else 0.0)
        counts = np.ceil(1.5 * length).astype(np.intp) + 2
        first, last = self._crossing(uv, counts - 1, wide)
        width = self.lens.size[0]
        for part in _chunks(counts * len(ticks), LARGE):
            n = last[part] - first[part]
            stroke = np.repeat(np.arange(part.start, part.stop), n)
            at = np.arange(n.sum()) - np.repeat(np.cumsum(n) - n - first[part], n)
            t = at / (counts[stroke] - 1)
            middle = uv[stroke, 0] + t[:, None] * along[stroke]
            z = 1.0 / (inverse[stroke, 0] + t * (inverse[stroke, 1] - inverse[stroke, 0]))
            for tick in ticks:
                place = np.floor(middle + tick * across[stroke]).astype(np.intp)
                inside = (place >= [0, self.rows.start]) & (place < [width, self.rows.stop])
                inside = inside.all(1)
                pixels = self._pixels(*place[inside].T)
                depth = (LINES_NEARER * z[inside]).astype(np.float32)
                yield pixels, depth, rgba[stroke[inside]]

    def _crossing(
        self, uv: np.ndarray, steps: np.ndarray, wide: float
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the first step along each line that may be in the band, and the one after the
        last; `uv` (n, 2, 2) are ends, `wide` is how thick a line is.
        """
        start = uv[:, 0, 1]
        end = uv[:, 1, 1]
        flat = np.abs(end - start) < 1e-9
        slope = np.where(flat, 1.0, end - start)
        rows = np.array([[self.rows.start - wide - 1], [self.rows.stop + wide + 1]])
        t = np.sort((rows - start) / slope, axis=0)
        t = np.where(flat, [[0.0], [1.0]], np.clip(t, 0, 1))
        first = np.floor(t[0] * steps).astype(np.intp)
        last = np.ceil(t[1] * steps).astype(np.intp) + 1
        away = ~self._touches(np.minimum(start, end) - wide, np.maximum(start, end) + wide)
        return first, np.where(away, first, last)

    def _faces(self, surface: Surface) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        uv, depth = self.lens.seen(surface.corners)
        first = uv[:, 1] - uv[:, 0]
        second = uv[:, 2] - uv[:, 0]
        area = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
        kept = np.isfinite(area) & (np.abs(np.nan_to_num(area)) > 1e-9)
        kept &= self._touches(uv[..., 1].min(1), uv[..., 1].max(1))
        uv = uv[kept]
        depth = depth[kept]
        first = first[kept]
        second = second[kept]
        area = area[kept]
        light = surface.normals[kept] @ self.lens.R_eye_world.T @ LIGHT
        rgb = surface.rgb[kept] * (0.62 + 0.38 * np.minimum(np.abs(light), 1.0))[..., None]
        for which, x, y in self._boxes(uv.min(1), uv.max(1)):
            du = x + 0.5 - uv[which, 0, 0]
            dv = y + 0.5 - uv[which, 0, 1]
            b = (du * second[which, 1] - dv * second[which, 0]) / area[which]
            c = (dv * first[which, 0] - du * first[which, 1]) / area[which]
            inside = (b >= -1e-9) & (c >= -1e-9) & (b + c <= 1 + 1e-9)
            which = which[inside]
            pixels = self._pixels(x, y)[inside]
            weights = np.column_stack([1 - b - c, b, c])[inside] / depth[which]
            inverse = weights.sum(1)
            color = np.einsum("ni,nij->nj", weights / inverse[:, None], rgb[which])
            alpha = np.full((len(which), 1), 255 * surface.opacity)
            rgba = np.rint(np.hstack([color, alpha])).astype(np.uint8)
            yield pixels, (1 / inverse).astype(np.float32), rgba

    def _sheet(self, sheet: Sheet) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        """Yield what is seen of an image on a plane: where each pixel's ray meets it."""
        width, height = self.lens.size
        uv, _ = self.lens.seen(sheet.p)
        behind = not np.isfinite(uv).all()
        low = np.zeros(2) if behind else uv.min(0)
        high = np.array([width, height], float) if behind else uv.max(0)
        corner = self.lens.before(sheet.corner)
        sides = np.stack([sheet.right, sheet.down], axis=1)
        plane = np.column_stack([self.lens.R_eye_world @ sides, corner])
        if abs(np.linalg.det(plane)) < 1e-12:  # seen from its edge
            return
        # a pixel's ray is z (a right + b down + corner): the inverse gives a : b : 1, over z
        back = np.linalg.inv(plane)
        image = _smaller(sheet.image, 0.0 if behind else float(np.ptp(uv, axis=0).max()))
        for _, x, y in self._boxes(low[None], high[None]):
            ray = np.column_stack([x + 0.5 - self.lens.middle[0], y + 0.5 - self.lens.middle[1]])
            met = np.column_stack([ray / self.lens.focal, np.ones(len(x))]) @ back.T
            with np.errstate(divide="ignore", invalid="ignore"):
                across, along, z = np.column_stack([met[:, :2], np.ones(len(met))]).T / met[:, 2]
            on = (across >= 0) & (across < 1) & (along >= 0) & (along < 1) & (z > NEAR)
            color = _between(image, across[on], along[on])
            alpha = np.full((len(color), 1), 255 * sheet.opacity)
            rgba = np.rint(np.hstack([color, alpha])).astype(np.uint8)
            yield self._pixels(x[on], y[on]), z[on].astype(np.float32), rgba


def clipped(
    ends: np.ndarray, lens: Lens, *, margin: float = 0.0
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return what is seen of segments.

    Args:
        ends: (n, 2, 3), metres.
        lens: How they are seen.
        margin: How far beyond the picture they go, pixels.

    Returns:
        Pixels (m, 2, 2) of their ends, one over their depths (m, 2), and which they are, (m,).
    """
    p = lens.before(ends)
    z = p[..., 2]
    which = np.flatnonzero((z > NEAR).any(1))
    p = p[which]
    z = p[..., 2]
    with np.errstate(divide="ignore", invalid="ignore"):
        t = (NEAR * 1.01 - z[:, 0]) / (z[:, 1] - z[:, 0])
    hidden = z <= NEAR
    t = np.where(hidden.any(1), t, 0.0)
    cut = p[:, 0] + t[:, None] * (p[:, 1] - p[:, 0])
    p = np.where(hidden[..., None], cut[:, None], p)
    uv = lens.pixels(p)
    inverse = 1.0 / p[..., 2]
    low = np.full(2, -margin)
    high = np.array(lens.size) + margin
    d = uv[:, 1] - uv[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        to_low = (low - uv[:, 0]) / d
        to_high = (high - uv[:, 0]) / d
    flat = d == 0
    inside = (uv[:, 0] >= low) & (uv[:, 0] <= high)
    enters = np.where(flat, np.where(inside, 0.0, 2.0), np.minimum(to_low, to_high)).max(1).clip(0)
    leaves = (
        np.where(flat, np.where(inside, 1.0, -1.0), np.maximum(to_low, to_high)).min(1).clip(max=1)
    )
    kept = enters <= leaves
    ts = np.stack([enters, leaves], axis=1)[kept]
    uv = uv[kept, :1] + ts[..., None] * d[kept, None]
    inverse = inverse[kept, :1] + ts * (inverse[kept, 1:] - inverse[kept, :1])
    return uv, inverse, which[kept]


def _is_glass(shape: Shape) -> bool:
    return isinstance(shape, Surface | Sheet) and shape.opacity < 1


def _blended(over: np.ndarray, under: np.ndarray) -> np.ndarray:
    """Return colours (n, 4) laid over others, uint8."""
    over = over.astype(np.float32)
    under = under.astype(np.float32)
    a = over[:, 3:] / 255
    b = under[:, 3:] / 255 * (1 - a)
    alpha = a + b
    color = (a * over[:, :3] + b * under[:, :3]) / np.maximum(alpha, 1e-6)
    return np.rint(np.hstack([color, 255 * alpha])).astype(np.uint8)


def _chunks(counts: np.ndarray, most: int) -> Iterator[slice]:
    """Yield slices whose counts sum to at most `most`, or that have one alone."""
    total = np.cumsum(counts)
    start = 0
    while start < len(counts):
        before = total[start - 1] if start else 0
        stop = max(start + 1, int(np.searchsorted(total, before + most, "right")))
        yield slice(start, stop)
        start = stop


def _cells(
    which: np.ndarray, first: np.ndarray, last: np.ndarray
) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    sides = np.maximum(last - first, 0)
    counts = sides[:, 0] * sides[:, 1]
    some = np.flatnonzero(counts)
    which = which[some]
    first = first[some]
    sides = sides[some]
    counts = counts[some]
    for part in _chunks(counts, MOST):
        n = counts[part]
        at = np.arange(n.sum()) - np.repeat(np.cumsum(n) - n, n)
        wide = np.repeat(sides[part, 0], n)
        corner = np.repeat(first[part], n, axis=0)
        yield np.repeat(which[part], n), corner[:, 0] + at % wide, corner[:, 1] + at // wide


def _smaller(image: np.ndarray, pixels: float) -> np.ndarray:
    """Return an image with at most twice as many pixels as are seen of it."""
    factor = int(max(image.shape[:2]) // max(pixels, 1.0)) if pixels else 1
    if factor < 2:
        return image
    return np.asarray(Image.fromarray(np.ascontiguousarray(image)).reduce(factor))


def _between(image: np.ndarray, across: np.ndarray, along: np.ndarray) -> np.ndarray:
    """Return the colours (n, 3) of an image at shares of its width and height, between its
    pixels.
    """
    height, width = image.shape[:2]
    u = np.clip(across * width - 0.5, 0, width - 1)
    v = np.clip(along * height - 0.5, 0, height - 1)
    left = np.floor(u).astype(np.intp)
    top = np.floor(v).astype(np.intp)
    right = np.minimum(left + 1, width - 1)
    low = np.minimum(top + 1, height - 1)
    du = (u - left)[:, None]
    dv = (v - top)[:, None]
    above = image[top, left] * (1 - du) + image[top, right] * du
    below = image[low, left] * (1 - du) + image[low, right] * du
    return above * (1 - dv) + below * dv
