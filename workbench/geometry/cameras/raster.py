"""Our own picture of points, segments and meshes: z-buffered, through a camera with its lens.

Everything becomes fragments (pixel, 1/Z, colour); of the fragments of one pixel the nearest wins.
What crosses the near plane is cut there in the world, before anything is divided by a depth. Where
the lens bends lines, what is long in the picture is cut into short pieces first, so that the camera
model is any function from world points to pixels.
Reference: Foley, van Dam, Feiner and Hughes, Computer Graphics, 2nd ed., 3.6 (scan conversion) and
15.4 (z-buffer).
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import groupby

import numpy as np
from jaxtyping import Bool, Float, Int, UInt8

from workbench.geometry.cameras.distortion import NONE, Distortion, invertible_radius
from workbench.geometry.cameras.pinhole import depths, normalize, project
from workbench.geometry.clipping import (
    clip_segments,
    clip_to_rectangle,
    clip_triangles,
    cut_finely,
    over_corners,
)
from workbench.geometry.motions import apply

ToPixels = Callable[[np.ndarray], np.ndarray]
"""World points (n, 3) in metres to pixels (n, 2); NaN where the camera does not see the point."""

# longest normalised edge that is drawn straight through a bending lens: 1/8 px off at f = 300, k1 =
# -0.3
PIECE = 0.06
FAVOUR = 1.002
STRAY = 3.0  # how far beyond the true picture a given camera model may look
# Pixels that a row is longer at each end, so that neighbours leave no crack: straight, bent lens
SLACK = (1e-6, 0.1)


@dataclass(frozen=True, eq=False)
class MeshItem:
    """Triangles to draw, one colour per face, seen from both sides."""

    p_world: Float[np.ndarray, "v 3"]
    faces: Int[np.ndarray, "f 3"]
    colors: UInt8[np.ndarray, "f 3"]


@dataclass(frozen=True, eq=False)
class SegmentItem:
    """Line segments to draw, one colour each, `width` pixels wide."""

    p_world: Float[np.ndarray, "n 2 3"]
    colors: UInt8[np.ndarray, "n 3"]
    width: int = 1


@dataclass(frozen=True, eq=False)
class PointItem:
    """Points to draw as discs, one colour each, `width` pixels across."""

    p_world: Float[np.ndarray, "n 3"]
    colors: UInt8[np.ndarray, "n 3"]
    width: int = 3


Item = MeshItem | SegmentItem | PointItem


@dataclass(frozen=True, eq=False)
class Image:
    """What the camera sees: colours, and the depth Z of each pixel, m, infinite for nothing."""

    colors: UInt8[np.ndarray, "h w 3"]
    depth: Float[np.ndarray, "h w"]


@dataclass(frozen=True, eq=False)
class _Eye:
    """A camera while it draws."""

    to_pixels: ToPixels
    T_camera_world: np.ndarray
    width: int
    height: int
    near: float
    bends: bool
    # (2, 2): lowest and highest x, y in normalised coordinates that can be in the picture
    window: np.ndarray

    def flatten(self, p_world: np.ndarray) -> np.ndarray:
        """Return ideal normalised coordinates, those of a camera without lens."""
        p_camera = apply(self.T_camera_world, p_world)
        return p_camera[:, :2] / p_camera[:, 2:]


@dataclass(frozen=True, eq=False)
class _Fragments:
    """Candidates for pixels: flat pixel index, 1/Z, and the row of `colors` of each."""

    pixel: np.ndarray
    inverse_depth: np.ndarray
    owner: np.ndarray
    colors: np.ndarray
    favour: float = 1.0  # lines and points lie on surfaces and shall win from them


def render(
    items: Iterable[Item],
    T_camera_world: Float[np.ndarray, "4 4"],
    K: Float[np.ndarray, "3 3"],
    *,
    width: int,
    height: int,
    distortion: Distortion = NONE,
    near: float = 0.05,
    background: tuple[int, int, int] = (255, 255, 255),
    to_pixels: ToPixels | None = None,
) -> Image:
    """Return the picture of the items as the camera sees them, and its depths.

    Of two things at the same depth the later wins; lines and points win from surfaces up to 0.2 %
    nearer, so that a mesh does not bury its own edges. `near`, m, is where segments and triangles
    are cut, and below which no point is drawn. `to_pixels` draws in place of `project`; the camera
    then only says what is near and in front. Through a lens, what is three times as far out as the
    picture reaches is left out then.

    Raises:
        ValueError: If the picture has no pixels or `near` is not positive.
    """
    if width < 1 or height < 1:
        raise ValueError(f"a picture needs at least one pixel, got {width} x {height}")
    if not near > 0:
        raise ValueError(f"the near plane must lie in front of the camera, got {near} m")
    see = to_pixels or (lambda p_world: project(p_world, T_camera_world, K, distortion))
    window = _window(K, width, height, distortion=distortion) * (
        1.0 if to_pixels is None else STRAY
    )
    eye = _Eye(see, T_camera_world, width, height, near, any(distortion), window)
    draw = {MeshItem: _draw_mesh, SegmentItem: _draw_segments, PointItem: _draw_points}
    parts = [draw[type(item)](item, eye) for item in _meshes_joined(items)]
    return _resolve(parts, width, height, background=background)


def in_sight(
    p_world: Float[np.ndarray, "n 3"],
    T_camera_world: Float[np.ndarray, "4 4"],
    K: Float[np.ndarray, "3 3"],
    *,
    depth: Float[np.ndarray, "h w"],
) -> Bool[np.ndarray, " n"]:
    """Return which points of surfaces a picture with this depth shows, without a lens, to 2 %."""
    uv = project(p_world, T_camera_world, K)
    z = depths(p_world, T_camera_world)
    h, w = depth.shape
    inside = np.asarray(((uv >= 1.0) & (uv <= np.array([w, h]) - 2.0)).all(axis=1))
    column, row = np.where(inside[:, None], uv, 0.0).round().astype(int).T
    return inside & (np.abs(depth[row, column] - z) < 0.02 * z)


def _meshes_joined(items: Iterable[Item]) -> Iterator[Item]:
    """Yield the items with meshes that follow each other as one: each costs calls of its own."""
    for is_mesh, group in groupby(items, lambda item: isinstance(item, MeshItem)):
        if not is_mesh:
            yield from group
            continue
        meshes = [item for item in group if isinstance(item, MeshItem)]
        before = np.cumsum([0, *(len(mesh.p_world) for mesh in meshes[:-1])])
        yield MeshItem(
            np.concatenate([mesh.p_world for mesh in meshes]),
            np.concatenate([mesh.faces + n for mesh, n in zip(meshes, before, strict=True)]),
            np.concatenate([mesh.colors for mesh in meshes]),
        )


def _resolve(
    parts: list[_Fragments], width: int, height: int, *, background: tuple[int, int, int]
) -> Image:
    """Keep the nearest fragment of each pixel; of equals, the last."""
    nearest, inverse_depth = np.zeros(width * height), np.zeros(width * height)
    colors = np.tile(np.array(background, np.uint8), (width * height, 1))
    keys = [part.inverse_depth * part.favour for part in parts]
    for part, key in zip(parts, keys, strict=True):
        np.maximum.at(nearest, part.pixel, key)
    for part, key in zip(parts, keys, strict=True):
        wins = np.flatnonzero(key == nearest[part.pixel])
        inverse_depth[part.pixel[wins]] = part.inverse_depth[wins]
        colors[part.pixel[wins]] = part.colors[part.owner[wins]]
    with np.errstate(divide="ignore"):
        return Image(colors.reshape(height, width, 3), (1.0 / inverse_depth).reshape(height, width))


def _draw_points(item: PointItem, eye: _Eye) -> _Fragments:
    """Draw discs around the points, all at the depth of their middle."""
    z = depths(item.p_world, eye.T_camera_world)
    rows = np.flatnonzero(z > eye.near)
    uv = eye.to_pixels(item.p_world[rows])
    return _stamp(
        uv, 1.0 / z[rows], np.arange(len(rows)), colors=item.colors[rows], width=item.width, eye=eye
    )


def _draw_segments(item: SegmentItem, eye: _Eye) -> _Fragments:
    """Cut segments at the near plane, and short if the lens bends; step along them by pixels."""
    ahead = depths(item.p_world.reshape(-1, 3), eye.T_camera_world).reshape(-1, 2) - eye.near
    uv, w, owner = _project(*clip_segments(item.p_world, ahead), eye)
    size = np.array([eye.width, eye.height])
    start, stop = clip_to_rectangle(uv, np.full(2, -0.5 - item.width), size - 0.5 + item.width)
    shown = start < stop
    uv, w, owner = uv[shown], w[shown], owner[shown]
    length = (stop - start)[shown]
    start = start[shown]
    steps = (
        np.ceil(length * np.abs(uv[:, 1] - uv[:, 0]).max(axis=1, initial=0.0)).astype(np.intp) + 1
    )
    row, step = _ragged(steps)
    share = start[row] + (length / np.maximum(steps - 1, 1))[row] * step
    at = uv[row, 0] + share[:, None] * (uv[row, 1] - uv[row, 0])
    return _stamp(
        at,
        w[row, 0] + share * (w[row, 1] - w[row, 0]),
        owner[row],
        colors=item.colors,
        width=item.width,
        eye=eye,
    )


def _draw_mesh(item: MeshItem, eye: _Eye) -> _Fragments:
    """Cut triangles at the near plane, and small if the lens bends; fill them row by row."""
    ahead = depths(item.p_world, eye.T_camera_world) - eye.near
    uv, w, owner = _project(*clip_triangles(item.p_world[item.faces], ahead[item.faces]), eye)
    return _fill(uv, w, owner, colors=item.colors, eye=eye)


def _project(
    p_world: np.ndarray, owner: np.ndarray, eye: _Eye
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return pixels and 1/Z of the corners, cut where the lens bends them, and their owners."""
    corners = p_world.shape[1]
    if eye.bends:
        low, high = eye.window
        p_world, row = cut_finely(p_world, eye.flatten, PIECE, low=low, high=high)
        owner = owner[row]
    flat = p_world.reshape(-1, 3)
    w = 1.0 / depths(flat, eye.T_camera_world)
    return eye.to_pixels(flat).reshape(-1, corners, 2), w.reshape(-1, corners), owner


def _stamp(uv, inverse_depth, owner, *, colors, width: int, eye: _Eye) -> _Fragments:
    """Put a disc `width` pixels across at each place; NaN places get none."""
    offset = np.arange(width) - 0.5 * (width - 1)
    du, dv = (grid.ravel() for grid in np.meshgrid(offset, offset))
    disc = np.hypot(du, dv) <= 0.5 * width
    with np.errstate(invalid="ignore"):
        u = np.floor(uv[:, :1] + du[disc] + 0.5)
        v = np.floor(uv[:, 1:] + dv[disc] + 0.5)
        inside = (u >= 0) & (u < eye.width) & (v >= 0) & (v < eye.height)
    row = np.nonzero(inside)[0]
    pixel = (v[inside] * eye.width + u[inside]).astype(np.intp)
    return _Fragments(pixel, inverse_depth[row], owner[row], colors, favour=FAVOUR)


def _fill(uv, w, owner, *, colors, eye: _Eye) -> _Fragments:
    """Fill triangles row by row between their edges; 1/Z is affine in the picture."""
    with np.errstate(invalid="ignore"):
        low, high = over_corners(np.minimum, uv), over_corners(np.maximum, uv)
        in_picture = ((high >= 0) & (low <= np.array([eye.width, eye.height]) - 1)).all(axis=1)
    edge = np.roll(uv, -1, axis=1) - uv
    area = edge[:, 0, 0] * edge[:, 1, 1] - edge[:, 0, 1] * edge[:, 1, 0]
    kept = np.flatnonzero(in_picture & (np.abs(area) > 1e-9))
    # pieces in the order of their faces, of which the later wins; cutting mixes them
    kept = kept[np.argsort(owner[kept], kind="stable")]
    uv, w, edge, area, low, high = uv[kept], w[kept], edge[kept], area[kept], low[kept], high[kept]
    w_u = ((w[:, 1] - w[:, 0]) * -edge[:, 2, 1] - (w[:, 2] - w[:, 0]) * edge[:, 0, 1]) / area
    w_v = ((w[:, 2] - w[:, 0]) * edge[:, 0, 0] - (w[:, 1] - w[:, 0]) * -edge[:, 2, 0]) / area

    top = np.maximum(np.ceil(low[:, 1]), 0).astype(np.intp)
    bottom = np.minimum(np.floor(high[:, 1]), eye.height - 1).astype(np.intp)
    triangle, v = _ragged(np.maximum(bottom - top + 1, 0))
    v = v + top[triangle]
    left = np.zeros(len(v))
    right = np.full(len(v), eye.width - 1.0)
    slack = SLACK[eye.bends]
    for k in range(3):
        rise = edge[:, k, 1]
        with np.errstate(divide="ignore", invalid="ignore"):
            slope = (edge[:, k, 0] / rise)[triangle]
            crossing = uv[triangle, k, 0] + (v - uv[triangle, k, 1]) * slope
        # the inside is to the right of this edge
        opens = rise * area < 0
        closes = rise * area > 0
        np.maximum(left, crossing - slack, out=left, where=opens[triangle])
        np.minimum(right, crossing + slack, out=right, where=closes[triangle])
    left, right = np.ceil(left).astype(np.intp), np.floor(right).astype(np.intp)
    # 1/Z at the first corner's u of each row, and from there on
    at_corner = w[triangle, 0] + w_v[triangle] * (v - uv[triangle, 0, 1])
    corner = uv[triangle, 0, 0]
    along = w_u[triangle]
    # a sliver's slope may overshoot beyond its corners, where no depth is
    least, most = (over_corners(choose, w)[triangle] for choose in (np.minimum, np.maximum))
    span, u = _ragged(np.maximum(right - left + 1, 0))
    u += left[span]
    inverse_depth = at_corner[span] + along[span] * (u - corner[span])
    inverse_depth = np.clip(inverse_depth, least[span], most[span])
    u += (v * eye.width)[span]
    return _Fragments(u, inverse_depth, owner[kept][triangle][span], colors)


def _ragged(counts: Int[np.ndarray, " n"]) -> tuple[Int[np.ndarray, " m"], Int[np.ndarray, " m"]]:
    """Return, for n rows laid end to end, the row of each entry and its place in the row."""
    row = np.repeat(np.arange(len(counts)), counts)
    first = np.cumsum(counts) - counts
    return row, np.arange(len(row)) - first[row]


def _window(K, width: int, height: int, *, distortion: Distortion) -> np.ndarray:
    """Return the lowest and highest normalised x and y that any pixel sees."""
    u, v = np.arange(-0.5, width), np.arange(-0.5, height)
    border = np.concatenate(
        [
            np.column_stack([np.tile(u, 2), np.repeat([-0.5, height - 0.5], len(u))]),
            np.column_stack([np.repeat([-0.5, width - 0.5], len(v)), np.tile(v, 2)]),
        ]
    )
    xy = normalize(border, K, distortion)
    if np.isnan(xy).any():
        radius = invertible_radius(distortion)
        return np.array([[-radius, -radius], [radius, radius]])
    return np.stack([xy.min(axis=0), xy.max(axis=0)])
