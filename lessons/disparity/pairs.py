"""The pair of pictures that a run starts from, with the mistake that was asked for."""

import functools
from dataclasses import dataclass, replace

import numpy as np

from lessons.disparity.inputs import Input
from workbench.algorithms.stereo.cost_volume import census_cost_volume
from workbench.algorithms.stereo.disparity_map import agree, seen_from_right, winner_takes_all
from workbench.data.views.stereo import (
    StereoPair,
    StereoViews,
    grey,
    motorcycle_pair,
    read_pair,
    shrunk,
    synthetic_views,
)
from workbench.errors import InputError
from workbench.geometry.cameras.stereo import StereoCamera
from workbench.knobs import called
from workbench.lesson import cached

SIZE = (160, 120)
MOST_CELLS = 12_000_000
ROWS_OFF = 2
DARKER = 0.7
MADE_UP_BASELINE = 0.1


@dataclass(frozen=True, eq=False, kw_only=True)
class Pictures:
    """What stays the same for the length of a run.

    Attributes:
        pair: The pictures as they are matched, and the truth about the left one.
        left: The brightness of the left one, 0 .. 255.
        right: Of the right one.
        f: The focal length with which depths are made: the camera's, but for the mistake of not
            rescaling it.
        pixel: The pixel (u, v) that is followed, inside the picture.
        max_disparity: The largest that is tried: below the width of the pictures.
        far: Depth up to which things are drawn, metres.
        metric: Whether the cameras are known. Where they are not, the pair's camera is made up:
            nothing is in metres.
    """

    pair: StereoPair
    left: np.ndarray
    right: np.ndarray
    f: float
    pixel: tuple[int, int]
    max_disparity: int
    far: float
    metric: bool = True

    @functools.cached_property
    def true_depth(self) -> np.ndarray:
        """The true depth of every left pixel, metres: infinite where nothing shifts, NaN where the
        truth is not known.
        """
        true = self.pair.disparity
        return np.full(self.left.shape, np.nan) if true is None else self.pair.camera.depth(true)

    @property
    def scale(self) -> float:
        """How large the scene is drawn: all there is to see fits the same stage, whatever its
        depth.
        """
        return 2.3 / self.far

    @functools.cached_property
    def agreeing(self) -> tuple[float, float]:
        """The share of left pixels whose partners choose them back; and the same with the pictures
        exchanged.

        By census, on one row in four.
        """
        left = self.left[::4]
        right = self.right[::4]
        return _agreeing(left, right, self.max_disparity), _agreeing(
            right, left, self.max_disparity
        )

    @property
    def seem_exchanged(self) -> bool:
        """Whether clearly more pixels find each other with left and right exchanged."""
        as_given, exchanged = self.agreeing
        return exchanged > as_given + 0.07


def _agreeing(left: np.ndarray, right: np.ndarray, max_disparity: int) -> float:
    cost = census_cost_volume(left, right, max_disparity, 3)
    winner, back = (
        winner_takes_all(volume).astype(int) for volume in (cost, seen_from_right(cost))
    )
    return float(agree(winner, back).mean())


def pictures_of(params: Input) -> Pictures:
    """Return the pair of a run.

    Raises:
        InputError: If own files are no pair, or the cost volume would be too large.
    """
    if (params.left is None) != (params.right is None):
        raise InputError(
            f"an own pair is two files: give both {called('left')} and {called('right')}"
        )
    metric = True
    shrink = 1
    if params.left is not None:
        pair = _own(params)
        shrink = params.shrink
        metric = params.own_focal_length > 0 and params.own_baseline > 0
    elif params.scene == "Motorcycle":
        pair = _motorcycle(params)
        shrink = params.shrink
    else:
        pair = made(params)
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
    return Pictures(
        pair=pair,
        left=grey(pair.left),
        right=grey(pair.right),
        f=pair.camera.f * times,
        pixel=(min(params.pixel[0], w - 1), min(params.pixel[1], h - 1)),
        max_disparity=max_disparity,
        far=_far(pair, max_disparity) * times,
        metric=metric,
    )


def _mistaken(pair: StereoPair, params: Input) -> StereoPair:
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


def made(params: Input) -> StereoPair:
    """Return the two pictures that made cameras take of a made scene."""
    noise = params.noise
    seed = params.seed
    return taken(params.scene, params.focal_length, params.baseline, noise=noise, seed=seed)


@functools.lru_cache(maxsize=24)
def taken(scene: str, f: float, baseline: float, *, noise: float, seed: int) -> StereoPair:
    """Return the pair that two cameras take of a scene; f in pixels, the baseline in metres."""
    return _views(scene, f, baseline, seed=seed).exposed(noise)


@functools.lru_cache(maxsize=8)
def _views(scene: str, f: float, baseline: float, *, seed: int) -> StereoViews:
    """Return what the cameras see, which the noise leaves alone."""
    camera = StereoCamera(f, (SIZE[0] - 1) / 2, (SIZE[1] - 1) / 2, baseline)
    return synthetic_views(scene, camera, SIZE, rng=np.random.default_rng(seed))


@cached(most=2)
def _motorcycle(params: Input) -> StereoPair:
    return shrunk(motorcycle_pair(), params.shrink)


@cached(most=2)
def _own(params: Input) -> StereoPair:
    """Return an own pair; where its cameras are not known they are made up: as wide as usual, and a
    hand apart.
    """
    assert params.left is not None
    assert params.right is not None
    known = params.own_focal_length > 0 and params.own_baseline > 0
    f = 1.0
    baseline = MADE_UP_BASELINE
    if known:
        f = params.own_focal_length
        baseline = params.own_baseline
    pair = read_pair(params.left, params.right, f, baseline=baseline, doffs=params.doffs)
    if not known:
        pair = replace(pair, camera=replace(pair.camera, f=float(pair.left.shape[1])))
    return shrunk(pair, params.shrink)
