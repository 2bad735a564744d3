"""Finding corners of a picture in another: gradient, structure tensor, corners, patches, matches."""

import functools
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import scipy

from lessons.features.scans import Matcher, chosen
from lessons.features.state import PIXELS, Params, Pictured
from workbench.data.files import read_image, stamp
from workbench.data.stereo import grey, motorcycle_pair, shrunk
from workbench.errors import InputError
from workbench.geometry.keypoints import gradient, patches, strongest
from workbench.geometry.matching import nearest_both_ways

Response = Callable[[np.ndarray], np.ndarray]
SHRINK = 2  # of the motorcycle's pictures
MOST_SIDE, LEAST_SIDE = 400, 80  # own pictures, pixels
BORDER = 16  # no corner is nearer to the border, whatever the patch


def picture_steps(params: Params, harris_response: Response, mutual_matches: Matcher) -> Iterator[Pictured]:
    """Yield the steps from two pictures to their matches."""
    first, second, disparity = pictures_of(params)
    now = Pictured(phase="pictures", first=first, second=second)
    yield now
    strength = np.hypot(*gradient(first)), np.hypot(*gradient(second))
    yield replace(now, phase="gradient", strength=strength)
    response = checked(harris_response, first), checked(harris_response, second)
    now = replace(now, phase="response", response=response)
    yield now
    uv_first, uv_second = (strongest(r, params.corners, border=BORDER) for r in response)
    if len(uv_first) < 2 or len(uv_second) < 2:
        yield replace(now, phase="corners", uv_first=uv_first, uv_second=uv_second)
        return
    uv_truth = None if disparity is None else true_places(uv_first, disparity, params.turn, second.shape)
    now = replace(now, phase="corners", uv_first=uv_first, uv_second=uv_second, uv_truth=uv_truth)
    yield now
    a, b = patches(first, uv_first, params.patch), patches(second, uv_second, params.patch)
    found = nearest_both_ways(a, b)
    pairs = np.column_stack([np.arange(len(a)), found.index])
    best = int(np.argmin(found.distance / np.maximum(found.second, 1e-12)))
    side = params.patch
    windows = np.hstack([_shown(a[best], side), np.full((side, 2), 255, np.uint8), _shown(b[found.index[best]], side)])
    now = replace(now, windows=windows)
    yield replace(now, phase="patch", **judged(now, pairs[[best]]))
    yield replace(now, phase="nearest", **judged(now, pairs))
    pairs = chosen(params, found, a, b, mutual_matches)
    yield replace(now, phase="kept", **judged(now, pairs))


def judged(now: Pictured, pairs: np.ndarray) -> dict[str, np.ndarray | None]:
    """Return matches, which of them are right, and of which that is known, as fields of a step."""
    if now.uv_truth is None or now.uv_second is None:
        return {"pairs": pairs, "right": None, "known": None}
    off = np.linalg.norm(now.uv_truth[pairs[:, 0]] - now.uv_second[pairs[:, 1]], axis=1)
    return {"pairs": pairs, "right": off < PIXELS, "known": np.isfinite(off)}


def checked(harris_response: Response, image: np.ndarray) -> np.ndarray:
    """Return the response, which must have the picture's size."""
    found = np.asarray(harris_response(image), float)
    if found.shape != image.shape:
        raise InputError(f"harris_response returned {found.shape} numbers for a picture of {image.shape}")
    return np.nan_to_num(found)


def true_places(uv: np.ndarray, disparity: np.ndarray, degrees: float, shape: tuple[int, int]) -> np.ndarray:
    """Return where pixels of the left picture lie in the turned right one; NaN where the disparity is not known."""
    d = disparity[uv[:, 1], uv[:, 0]]
    middle = (np.array(shape[::-1]) - 1) / 2
    return (uv - np.column_stack([d, np.zeros_like(d)]) - middle) @ _turn(degrees).T + middle


def _turn(degrees: float) -> np.ndarray:
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[c, -s], [s, c]])


def turned(image: np.ndarray, degrees: float) -> np.ndarray:
    """Return the picture turned about its middle, of the same size; what comes from outside is mid-grey."""
    if degrees == 0:
        return image
    R, middle = _turn(degrees), (np.array(image.shape) - 1) / 2  # in (v, u), the turn's inverse is R itself
    return scipy.ndimage.affine_transform(image, R, middle - R @ middle, order=1, cval=128.0)


def pictures_of(params: Params) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
    """Return the grey levels of both pictures, the second turned, and the true disparity where it is known.

    Raises:
        InputError: If own files are no pair of pictures.
    """
    files = params.first_image, params.second_image
    if files == (None, None):
        first, second, disparity = _motorcycle()
    elif files[0] is None or files[1] is None:
        raise InputError("own pictures come in pairs: give both a first and a second image")
    else:
        first, second, disparity = *(_own(file, stamp(file)) for file in files if file), None
    return first, turned(second, params.turn), disparity


@functools.lru_cache(maxsize=1)
def _motorcycle() -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
    made = shrunk(motorcycle_pair(), SHRINK)
    return grey(made.left), grey(made.right), made.disparity


@functools.lru_cache(maxsize=4)
def _own(file: Path, _stamp: tuple) -> np.ndarray:
    """Return a picture's grey levels, its longer side at most `MOST_SIDE` pixels."""
    image = read_image(file)
    levels = grey(image) if image.ndim == 3 else image.astype(float)
    k = -(-max(levels.shape) // MOST_SIDE)
    h, w = (side // k for side in levels.shape)
    if min(h, w) < LEAST_SIDE:
        raise InputError(f"{file.name}: {w} x {h} pixels after shrinking; {LEAST_SIDE} at least are needed")
    return levels[: h * k, : w * k].reshape(h, k, w, k).mean(axis=(1, 3))


def _shown(patch: np.ndarray, side: int) -> np.ndarray:
    top = max(float(np.abs(patch).max()), 1e-9)
    return np.rint(127.5 + 127.5 * patch / top).astype(np.uint8).reshape(side, side)
