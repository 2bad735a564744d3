"""Two pictures of one scene with matches between them, made or from people's files."""

import functools
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import numpy as np
from jaxtyping import Float, UInt8

from workbench.data.files import read_image
from workbench.data.files.intrinsics import read_intrinsics
from workbench.data.files.matches import read_matches
from workbench.data.thinning import evenly
from workbench.data.views.skyline import skyline_items
from workbench.data.views.street import street_items
from workbench.errors import InputError
from workbench.geometry.cameras import intrinsics, look_at, normalize, pixel_rays, project
from workbench.geometry.cameras.raster import Image, in_sight, render
from workbench.geometry.motions import apply, exp_so3, inverse, motion
from workbench.geometry.two_views.epipolar import fit_fundamental
from workbench.geometry.two_views.essential import essential_from_fundamental, essential_to_poses
from workbench.geometry.two_views.triangulation import midpoints

SIZE = (480, 320)
FOCAL = 420.0
EYE = np.array([-0.4, 0.5, 1.7])
TARGET = np.array([0.3, 8.0, 1.2])
NEAREST, FARTHEST = 3.0, 22.0  # metres, of what is matched of the street
MODEL = 50.0  # of the far scene's metres one is drawn: nearly 200 m become the street's 4
# radians that the second camera turns towards what both see, where it stands beside the first
INWARD = 0.1
CANDIDATES, CLEAN = 12_000, 300
GROUND = -0.02  # metres below which everything is ground
SHOWN_DEPTH = 9.0  # metres that the middle of a person's scene is drawn away
LARGEST = 720  # pixels that a person's picture is shown wide, at most

What = Literal["street", "plane", "far"]


@dataclass(frozen=True, eq=False, kw_only=True)
class TwoViews:
    """Two pictures and their matches; what is not known is None, metres where the scene was made.

    Attributes:
        images: Both, RGB, as large as they are shown.
        sizes: Width and height of both in the pixels of the matches.
        strides: Every so many of these pixels one is shown.
        matches: Rows (u, v, u', v').
        sigma: Standard deviation of each number of a match.
        p_first: The true points of the matches.
        clean: Other matches of the same scene without noise.
        depth: Of every pixel of the first picture.
        model: How many metres one metre of the drawing stands for, about the first camera.
    """

    images: tuple[UInt8[np.ndarray, "_h _w 3"] | None, UInt8[np.ndarray, "_k _m 3"] | None]
    sizes: tuple[tuple[int, int], tuple[int, int]]
    strides: tuple[int, int] = (1, 1)
    K_first: Float[np.ndarray, "3 3"]
    K_second: Float[np.ndarray, "3 3"]
    matches: Float[np.ndarray, "n 4"]
    sigma: float | None = None
    T_first_world: Float[np.ndarray, "4 4"]
    T_second_first: Float[np.ndarray, "4 4"] | None = None
    p_first: Float[np.ndarray, "n 3"] | None = None
    clean: Float[np.ndarray, "_c 4"]
    depth: Float[np.ndarray, "_h _w"] | None = None
    model: float = 1.0


def made_views(
    scene: What,
    count: int,
    sigma: float,
    *,
    baseline: float,
    heading: float,
    rng: np.random.Generator,
) -> TwoViews:
    """Return two pictures of a made scene, and matches on its surfaces that both cameras see.

    Args:
        scene: The street, its level ground alone, or a city far away.
        sigma: Standard deviation of each number of a match, pixels.
        baseline: Metres; 0 for a camera that only turns.
        heading: Where the second camera stands, radians: 0 right of the first, pi / 2 ahead, pi
            left.

    Raises:
        InputError: If both cameras see less than `count` points.
    """
    views, p_first, both = _taken(scene, baseline, heading)
    if len(both) < count:
        raise InputError(
            f"the two cameras see {len(both)} points in common, {count} matches are asked for"
        )
    order = rng.permutation(len(both))
    rows = order[:count]
    return replace(
        views,
        matches=both[rows] + sigma * rng.normal(size=(count, 4)),
        sigma=sigma,
        p_first=p_first[rows],
        clean=both[order[-CLEAN:]],
    )


@functools.lru_cache(maxsize=16)
def _taken(scene: What, baseline: float, heading: float) -> tuple[TwoViews, np.ndarray, np.ndarray]:
    """Return the pictures, and the points that both cameras see with their pixels in both."""
    T_first_world = look_at(EYE, TARGET)
    p_center = baseline * np.array([np.cos(heading), 0.0, np.sin(heading)])
    R_second_first = exp_so3(np.array([0.0, INWARD * np.cos(heading), 0.02]))
    T_second_first = motion(R_second_first, -R_second_first @ p_center)
    T_second_world = T_second_first @ T_first_world
    w, h = SIZE
    K = intrinsics(FOCAL, (w - 1) / 2, (h - 1) / 2)
    first, second = (
        _photograph(T.tobytes(), scene == "far") for T in (T_first_world, T_second_world)
    )
    uv = np.random.default_rng(0).integers(0, SIZE, (CANDIDATES, 2))
    z = first.depth[uv[:, 1], uv[:, 0]]
    between = np.flatnonzero((z > NEAREST) & (z < (np.inf if scene == "far" else FARTHEST)))
    uv = uv[between].astype(float)
    z = z[between]
    _, n_first = pixel_rays(uv, np.eye(4), K)
    p_first = n_first / n_first[:, 2:] * z[:, None]
    uv_second = project(p_first, T_second_first, K)
    seen = in_sight(p_first, T_second_first, K, depth=second.depth)
    if scene == "plane":
        seen &= apply(inverse(T_first_world), p_first)[:, 2] < GROUND
    views = TwoViews(
        images=(first.colors, second.colors),
        sizes=(SIZE, SIZE),
        K_first=K,
        K_second=K,
        matches=np.empty((0, 4)),
        T_first_world=T_first_world,
        T_second_first=T_second_first,
        clean=np.empty((0, 4)),
        depth=first.depth,
        model=MODEL if scene == "far" else 1.0,
    )
    return views, p_first[seen], np.hstack([uv, uv_second])[seen]


@functools.lru_cache(maxsize=16)
def _photograph(T_camera_world: bytes, far: bool) -> Image:
    w, h = SIZE
    K = intrinsics(FOCAL, (w - 1) / 2, (h - 1) / 2)
    T = np.frombuffer(T_camera_world).reshape(4, 4)
    return render(
        skyline_items() if far else street_items(),
        T,
        K,
        width=w,
        height=h,
        background=(238, 243, 248),
    )


def own_views(
    matches: Path, first_image: Path | None, second_image: Path | None, *, K: Path | None, most: int
) -> TwoViews:
    """Return at most `most` of a person's matches, with their pictures where they are given.

    An npz of matches may have K, or K1 and K2, and the true R and t; the file K stands in place of
    those.

    Raises:
        InputError: If a file cannot be read, or nobody says what K is.
    """
    given = read_matches(matches, fewest=8)
    rows = evenly(len(given.p), most)
    K_first, K_second = given.K_first, given.K_second
    if K is not None:
        K_first = K_second = read_intrinsics(K)
    if K_first is None or K_second is None:
        raise InputError(
            f"{matches.name} has no K: give it as a file too (fx fy cx cy, or three rows), or as K"
            " in an npz"
        )
    image_first, size_first, k_first = _shown(first_image, given.p[:, :2])
    image_second, size_second, k_second = _shown(second_image, given.p[:, 2:])
    return TwoViews(
        images=(image_first, image_second),
        sizes=(size_first, size_second),
        strides=(k_first, k_second),
        K_first=K_first,
        K_second=K_second,
        matches=given.p[rows],
        T_first_world=look_at(EYE, TARGET),
        T_second_first=given.T_second_first,
        clean=np.empty((0, 4)),
    )


def shown_length(views: TwoViews) -> float:
    """Return how long the baseline is drawn, metres: as it is, or so that a person's scene fits.

    Where it is 0, a motion that is found all the same is drawn with 1 m.
    """
    if views.depth is not None and views.T_second_first is not None:
        return float(np.linalg.norm(views.T_second_first[:3, 3])) or 1.0
    uv_first, uv_second = views.matches[:, :2], views.matches[:, 2:]
    xy = normalize(uv_first, views.K_first), normalize(uv_second, views.K_second)
    E = essential_from_fundamental(
        fit_fundamental(uv_first, uv_second), views.K_first, views.K_second
    )
    z = max(
        (midpoints(T, *xy)[:, 2] for T in essential_to_poses(E)), key=lambda z: int((z > 0).sum())
    )
    middle = float(np.median(np.abs(z[np.isfinite(z)]))) if np.isfinite(z).any() else 0.0
    return SHOWN_DEPTH / middle if middle > 0 else 1.0


def _shown(file: Path | None, uv: np.ndarray) -> tuple[np.ndarray | None, tuple[int, int], int]:
    """Return a picture as it is shown, its whole size and stride; or the size its pixels need."""
    if file is None:
        w, h = np.ceil(1.05 * np.maximum(uv.max(axis=0), 10.0) + 1.0).astype(int).tolist()
        return None, (w, h), 1
    image = read_image(file)
    h, w = image.shape[:2]
    k = -(-w // LARGEST)
    rgb = image if image.ndim == 3 else np.repeat(image[..., None], 3, axis=2)
    return np.ascontiguousarray(rgb[::k, ::k]), (w, h), k
