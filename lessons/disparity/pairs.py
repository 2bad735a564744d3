"""The pair of pictures that a run starts from, with the mistake that was asked for."""

import functools
from dataclasses import replace
from pathlib import Path

import numpy as np

from lessons.disparity.state import Params, Setup
from workbench.data.files import stamp
from workbench.data.views.stereo import (
    StereoPair,
    grey,
    motorcycle_pair,
    read_pair,
    shrunk,
    synthetic_pair,
)
from workbench.errors import InputError
from workbench.geometry.cameras.stereo import StereoCamera
from workbench.knobs import called

SIZE = (160, 120)
MOST_CELLS = 5_000_000
ROWS_OFF = 2
DARKER = 0.7
MADE_UP_BASELINE = 0.1


def setup_of(params: Params) -> Setup:
    """Return the pair of a run.

    Raises:
        InputError: If own files are no pair, or the cost volume would be too large.
    """
    metric = True
    if (params.left is None) != (params.right is None):
        raise InputError(
            f"an own pair is two files: give both {called('left')} and {called('right')}"
        )
    if params.left is not None and params.right is not None:
        stamps = tuple(stamp(path) for path in (params.left, params.right))
        metric = params.own_focal_length > 0 and params.own_baseline > 0
        cameras = (params.own_focal_length, params.own_baseline) if metric else None
        pair, shrink = (
            _own(params.left, params.right, stamps, cameras, params.doffs, params.shrink),
            params.shrink,
        )
    elif params.scene == "Motorcycle":
        pair, shrink = _motorcycle(params.shrink), params.shrink
    else:
        pair, shrink = (
            _made(params.scene, params.focal_length, params.baseline, params.noise, params.seed),
            1,
        )
    h, w = pair.left.shape[:2]
    max_disparity = min(params.max_disparity, w - 1)
    cells = h * w * (max_disparity + 1)
    if cells > MOST_CELLS:
        raise InputError(
            f"{w} x {h} pixels with {max_disparity + 1} disparities are {cells:,} costs, at most"
            f" {MOST_CELLS:,} are shown step by step: raise shrink (now {shrink}) or lower"
            " max_disparity"
        )
    pair = _mistaken(pair, params)
    times = shrink if params.mistake == "f not rescaled" else 1
    return Setup(
        params=params,
        pair=pair,
        left=grey(pair.left),
        right=grey(pair.right),
        f=pair.camera.f * times,
        pixel=(min(params.pixel[0], w - 1), min(params.pixel[1], h - 1)),
        max_disparity=max_disparity,
        far=_far(pair, max_disparity) * times,
        metric=metric,
    )


def _mistaken(pair: StereoPair, params: Params) -> StereoPair:
    if params.mistake == "pictures exchanged":
        return replace(pair, left=pair.right, right=pair.left)
    if params.mistake == "rows off by 2 px":
        return replace(
            pair,
            right=np.concatenate([pair.right[:1]] * ROWS_OFF + [pair.right])[: len(pair.right)],
        )
    if params.mistake == "right picture darker":
        return replace(pair, right=np.rint(DARKER * pair.right).astype(np.uint8))
    return pair


def _far(pair: StereoPair, max_disparity: int) -> float:
    """Return the depth up to which the scene goes: the truth's, or that of a tenth of the largest
    disparity.
    """
    camera = pair.camera
    d = (
        max_disparity / 10
        if pair.disparity is None
        else np.nanmin(pair.disparity[pair.disparity > 0.1])
    )
    return 1.25 * camera.f * camera.baseline / max(float(d) + camera.doffs, 0.5)


@functools.lru_cache(maxsize=8)
def _made(scene: str, f: float, baseline: float, noise: float, seed: int) -> StereoPair:
    camera = StereoCamera(f, (SIZE[0] - 1) / 2, (SIZE[1] - 1) / 2, baseline)
    return synthetic_pair(scene, camera, SIZE, noise=noise, rng=np.random.default_rng(seed))


@functools.lru_cache(maxsize=2)
def _motorcycle(shrink: int) -> StereoPair:
    return shrunk(motorcycle_pair(), shrink)


@functools.lru_cache(maxsize=2)
def _own(
    left: Path,
    right: Path,
    _stamps: tuple,
    cameras: tuple[float, float] | None,
    doffs: float,
    shrink: int,
) -> StereoPair:
    """Return an own pair; where its cameras are not known they are made up: as wide as usual, and a
    hand apart.
    """
    pair = read_pair(left, right, *(cameras or (1.0, MADE_UP_BASELINE)), doffs)
    if cameras is None:
        pair = replace(pair, camera=replace(pair.camera, f=float(pair.left.shape[1])))
    return shrunk(pair, shrink)
