"""Finding corners of a picture in another: gradient, structure tensor, corners, patches, matches."""

import functools
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from lessons.features.scans import Matcher, chosen
from lessons.features.state import PIXELS, Params, Pictured
from workbench.data.files import stamp
from workbench.data.turned_pictures import motorcycle_levels, places_in_turned, read_levels, turned
from workbench.errors import InputError
from workbench.geometry.keypoints import gradient, patches, strongest
from workbench.geometry.matching import nearest_both_ways

Response = Callable[[np.ndarray], np.ndarray]
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
    uv_truth = None if disparity is None else places_in_turned(uv_first, disparity, np.radians(params.turn))
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


def pictures_of(params: Params) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
    """Return the grey levels of both pictures, the second turned, and the true disparity where it is known.

    Raises:
        InputError: If own files are no pair of pictures.
    """
    files = params.first_image, params.second_image
    if files == (None, None):
        first, second, disparity = motorcycle_levels()
    elif files[0] is None or files[1] is None:
        raise InputError("own pictures come in pairs: give both a first and a second image")
    else:
        first, second, disparity = *(_own(file, stamp(file)) for file in files if file), None
    return first, turned(second, np.radians(params.turn)), disparity


@functools.lru_cache(maxsize=4)
def _own(file: Path, _stamp: tuple) -> np.ndarray:
    return read_levels(file)


def _shown(patch: np.ndarray, side: int) -> np.ndarray:
    top = max(float(np.abs(patch).max()), 1e-9)
    return np.rint(127.5 + 127.5 * patch / top).astype(np.uint8).reshape(side, side)
