"""Windows around pixels, cut out and framed: what a method compares, as a picture."""

import numpy as np
from jaxtyping import UInt8

GAP = 2
LEAST_SPAN = 60.0  # grey levels: noise alone shall not look like a texture


def framed(
    picture: UInt8[np.ndarray, "h w 3"],
    center: tuple[int, int],
    window: int,
    *,
    frame: tuple[int, int, int],
) -> UInt8[np.ndarray, "h w 3"]:
    """Return a copy of a picture with a frame around the window at `center` (u, v)."""
    u, v = center
    half = max(window // 2, 1) + 1
    h, w = picture.shape[:2]
    marked = picture.copy()
    rows, columns = np.mgrid[v - half : v + half + 1, u - half : u + half + 1]
    edge = np.maximum(np.abs(rows - v), np.abs(columns - u)) == half
    inside = edge & (rows >= 0) & (rows < h) & (columns >= 0) & (columns < w)
    marked[rows[inside], columns[inside]] = frame
    return marked


def side_by_side(
    left: UInt8[np.ndarray, "h w 3"],
    right: UInt8[np.ndarray, "h w 3"],
    uv: tuple[int, int],
    *,
    d: int,
    window: int,
    frame: tuple[int, int, int],
) -> UInt8[np.ndarray, "k m 3"]:
    """Return the windows around left (u, v) and right (u - d, v) beside each other, each framed.

    Both are brightened alike; what lies outside the pictures is grey.
    """
    u, v = uv
    half = max(window // 2, 3) + 1
    cuts = [_cut(picture, x, v, half=half) for picture, x in ((left, u), (right, u - d))]
    low = float(np.min(cuts))
    span = max(float(np.max(cuts)) - low, LEAST_SPAN)
    bright = [np.rint((cut - low) * (255.0 / span)).astype(np.uint8) for cut in cuts]
    framed_left, framed_right = (framed(cut, (half, half), window, frame=frame) for cut in bright)
    gap = np.full((framed_left.shape[0], GAP, 3), 255, np.uint8)
    return np.concatenate([framed_left, gap, framed_right], axis=1)


def _cut(picture: np.ndarray, u: int, v: int, *, half: int) -> np.ndarray:
    h, w = picture.shape[:2]
    rows, columns = np.mgrid[v - half : v + half + 1, u - half : u + half + 1]
    inside = (rows >= 0) & (rows < h) & (columns >= 0) & (columns < w)
    cut = np.full((*rows.shape, 3), 128, np.uint8)
    cut[inside] = picture[rows[inside], columns[inside]]
    return cut
