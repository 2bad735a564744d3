"""Finding places of a picture in another: gradient, structure tensor, corners and patches, or SIFT;
then matches.
"""

import functools
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from lessons.features.scans import Matcher, chosen
from lessons.features.state import PIXELS, Params, Pictured
from lessons.features.stored import keypoints
from lessons.features.turned_pictures import (
    motorcycle_levels,
    places_in_turned,
    read_levels,
    turned,
)
from workbench.data.files import stamp
from workbench.errors import InputError
from workbench.geometry.features.keypoints import gradient, patches, strongest
from workbench.geometry.features.matching import nearest_both_ways
from workbench.geometry.features.sift import Sift, turned_patch
from workbench.knobs import called

Response = Callable[[np.ndarray], np.ndarray]
BORDER = 16  # no corner is nearer to the border, whatever the patch
# of the square that SIFT describes: half its side, in sizes of the keypoint; pixels shown
SEEN = 6.0
SIDE = 25


def picture_steps(
    params: Params, harris_response: Response, mutual_matches: Matcher
) -> Iterator[Pictured]:
    """Yield the steps from two pictures to their matches."""
    first, second, disparity = pictures_of(params)
    step = Pictured(phase="pictures", first=first, second=second)
    yield step
    if params.describe == "SIFT":
        sifts = _sift(first.tobytes(), first.shape), _sift(second.tobytes(), second.shape)
        uv_first, uv_second = (sift.uv for sift in sifts)
        step = replace(step, sifts=sifts)
    else:
        strength = np.hypot(*gradient(first)), np.hypot(*gradient(second))
        yield replace(step, phase="gradient", strength=strength)
        response = checked(harris_response, first), checked(harris_response, second)
        yield replace(step, phase="response", response=response)
        uv_first, uv_second = (strongest(r, params.corners, border=BORDER) for r in response)
    step = replace(step, phase="corners", uv_first=uv_first, uv_second=uv_second)
    if len(uv_first) < 2 or len(uv_second) < 2:
        yield step
        return
    if disparity is not None:
        step = replace(
            step, uv_truth=places_in_turned(uv_first, disparity, np.radians(params.turn))
        )
    yield step
    if step.sifts:
        a, b = (sift.descriptors for sift in step.sifts)
    else:
        a, b = (
            patches(image, uv, params.patch)
            for image, uv in ((first, uv_first), (second, uv_second))
        )
    nearest = nearest_both_ways(a, b)
    pairs = np.column_stack([np.arange(len(a)), nearest.index])
    best = int(np.argmin(nearest.distance / np.maximum(nearest.second, 1e-12)))
    if step.sifts:
        seen = [
            _turned(image, by, k)
            for image, by, k in zip((first, second), step.sifts, pairs[best], strict=True)
        ]
    else:
        seen = [
            _shown(of[k].reshape(params.patch, params.patch))
            for of, k in zip((a, b), pairs[best], strict=True)
        ]
    step = replace(
        step, windows=np.hstack([seen[0], np.full((len(seen[0]), 2), 255, np.uint8), seen[1]])
    )
    yield replace(step, phase="patch", **judged(step, pairs[[best]]))
    yield replace(step, phase="nearest", **judged(step, pairs))
    pairs = chosen(params, nearest, a, b=b, mutual_matches=mutual_matches)
    yield replace(step, phase="kept", **judged(step, pairs))


@functools.lru_cache(maxsize=8)
def _sift(levels: bytes, shape: tuple[int, int]) -> Sift:
    """Return the keypoints of a picture, found once: they cost more than all else."""
    return keypoints(np.frombuffer(levels).reshape(shape))


def _turned(image: np.ndarray, by: Sift, k: int) -> np.ndarray:
    patch = turned_patch(
        image, by.uv[k], float(by.angle[k]), half=SEEN * float(by.sigma[k]), side=SIDE
    )
    return _shown(patch - patch.mean())


def judged(step: Pictured, pairs: np.ndarray) -> dict[str, np.ndarray | None]:
    """Return matches, which of them are right, and of which that is known, as fields of a step."""
    if step.uv_truth is None or step.uv_second is None:
        return {"pairs": pairs, "right": None, "known": None}
    off = np.linalg.norm(step.uv_truth[pairs[:, 0]] - step.uv_second[pairs[:, 1]], axis=1)
    return {"pairs": pairs, "right": off < PIXELS, "known": np.isfinite(off)}


def checked(harris_response: Response, image: np.ndarray) -> np.ndarray:
    """Return the response, which must have the picture's size."""
    response = np.asarray(harris_response(image), float)
    if response.shape != image.shape:
        raise InputError(
            f"harris_response returned {response.shape} numbers for a picture of {image.shape}"
        )
    return np.nan_to_num(response)


def pictures_of(params: Params) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
    """Return the grey levels of both pictures, the second turned, and the true disparity where it
    is known.

    Raises:
        InputError: If own files are no pair of pictures.
    """
    files = params.first_image, params.second_image
    if files == (None, None):
        first, second, disparity = motorcycle_levels()
    elif files[0] is None or files[1] is None:
        raise InputError(
            f"own pictures come in pairs: give both {called('first_image')} and"
            f" {called('second_image')}"
        )
    else:
        first, second, disparity = *(_own(file, stamp(file)) for file in files if file), None
    return first, turned(second, np.radians(params.turn)), disparity


@functools.lru_cache(maxsize=4)
def _own(file: Path, _stamp: tuple) -> np.ndarray:
    return read_levels(file)


def _shown(patch: np.ndarray) -> np.ndarray:
    return np.rint(127.5 + 127.5 * patch / max(float(np.abs(patch).max()), 1e-9)).astype(np.uint8)
