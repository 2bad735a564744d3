"""Where views come from, built-in or a person's own, what they look like, and how well a camera is
known by them.
"""

import functools
from dataclasses import replace

import numpy as np

from lessons.calibration.state import COEFFICIENTS, Params, Subject
from workbench.algorithms.least_squares.board_adjustment import (
    linearised,
    shared_information,
    shared_numbers,
)
from workbench.data.framing import METRES
from workbench.data.views import boards
from workbench.data.views.corners import find_corners, pictures_below, read_corners
from workbench.errors import InputError
from workbench.geometry.cameras import normalize, resize_intrinsics
from workbench.geometry.cameras.distortion import Distortion, distort
from workbench.geometry.cameras.raster import MeshItem, render
from workbench.knobs import only

TILTS = np.array([1.0, 2, 5, 10, 15, 20, 30, 40, 50, 60])  # degrees
GRID = (33, 25)  # places along the width and the height of a picture
PHOTOGRAPH = (320, 240)
MOST_SIDE = 640  # pixels, of an own picture


def subject_of(params: Params) -> Subject:
    """Return the views of a run.

    Raises:
        InputError: If fewer than two are left, or own files cannot be used.
    """
    if params.corners is not None or params.images is not None:
        subject = _own(params)
    else:
        subject = _built_in(
            only(
                params,
                "views",
                "tilt",
                "distance",
                "spread",
                "noise",
                "fault",
                "bad_corners",
                "seed",
            )
        )
    if params.leave_out not in subject.views:
        return subject
    if len(subject.views) < 3:
        raise InputError("two views at least are needed: leave out none")
    keep = np.array(subject.views) != params.leave_out
    return replace(
        subject,
        uv=subject.uv[keep],
        views=tuple(view for view in subject.views if view != params.leave_out),
        Ts_camera_board=subject.Ts_camera_board[keep]
        if subject.K is not None
        else subject.Ts_camera_board,
    )


def _own(params: Params) -> Subject:
    pictures = None
    without = ()
    if params.corners is None:
        assert params.images is not None
        corners, pictures, without = find_corners(params.images, *params.board)
    else:
        corners = read_corners(params.corners, params.camera)
        pictures = (
            None if params.images is None else pictures_below(corners, params.images, params.shown)
        )
    return Subject(
        p_board=METRES[params.unit if params.corners else "m"] * corners.p_board,
        uv=corners.uv,
        views=corners.views,
        size=corners.size if pictures is None else corners.stated or pictures.size,
        pictures=pictures,
        without=without,
    )


@functools.lru_cache(maxsize=64)
def _built_in(params: Params) -> Subject:
    rng = np.random.default_rng(params.seed)
    Ts_camera_board = _poses(rng, params, params.tilt)
    uv = boards.board_pixels(
        rng, Ts_camera_board, sigma=params.noise, fault=params.fault, bad_corners=params.bad_corners
    )
    return Subject(
        p_board=boards.board_points(),
        uv=uv,
        views=tuple(range(params.views)),
        size=boards.SIZE,
        K=boards.K_TRUE,
        lens=boards.LENS_TRUE,
        Ts_camera_board=Ts_camera_board,
    )


def _poses(rng: np.random.Generator, params: Params, tilt: float) -> np.ndarray:
    return boards.board_poses(
        rng, params.views, tilt=np.radians(tilt), distance=params.distance, spread=params.spread
    )


def photograph(params: Params, subject: Subject, shown: int) -> np.ndarray:
    """Return the picture of a view: as our camera takes it, a person's own, or an empty one."""
    if subject.K is not None:
        return _taken(
            only(params, "views", "tilt", "distance", "spread", "fault", "seed"),
            subject.views[shown],
        )
    own = (
        None
        if subject.pictures is None
        else subject.pictures.shown(subject.views[shown], MOST_SIDE)
    )
    if own is not None:
        return own
    w, h = subject.size
    return np.full((max(round(PHOTOGRAPH[0] * h / w), 1), PHOTOGRAPH[0], 3), 232, np.uint8)


@functools.lru_cache(maxsize=128)
def _taken(params: Params, view: int) -> np.ndarray:
    T_camera_board = _poses(np.random.default_rng(params.seed), params, params.tilt)[view]
    p, faces, colors = boards.board_mesh()
    w, h = PHOTOGRAPH
    K = resize_intrinsics(boards.K_TRUE, w / boards.SIZE[0], h / boards.SIZE[1])
    item = MeshItem(boards.printed(p, params.fault), faces, colors)
    return render(
        [item],
        T_camera_board,
        K,
        width=w,
        height=h,
        distortion=boards.LENS_TRUE,
        background=(196, 203, 212),
    ).colors


def places(size: tuple[int, int]) -> np.ndarray:
    """Return pixels of a grid over a picture, row by row, (n, 2)."""
    u, v = np.meshgrid(np.linspace(0, size[0] - 1, GRID[0]), np.linspace(0, size[1] - 1, GRID[1]))
    return np.stack([u.ravel(), v.ravel()], axis=1)


def map_error(subject: Subject, K: np.ndarray, lens: Distortion) -> np.ndarray:
    """Return how far from its true pixel a camera sees each ray of the grid, pixels."""
    if subject.K is None:
        return np.empty(0)
    uv = places(subject.size)
    seen = distort(_true_rays(), *lens) @ K[:2, :2].T + K[:2, 2]
    return np.linalg.norm(seen - uv, axis=1)


@functools.cache
def _true_rays() -> np.ndarray:
    return normalize(places(boards.SIZE), boards.K_TRUE, boards.LENS_TRUE)


def deviations(
    size: tuple[int, int], K: np.ndarray, lens: Distortion, *, covariance: np.ndarray | None
) -> np.ndarray:
    """Return over the picture the predicted standard deviation, in its worst direction, of where a
    ray is seen, pixels.
    """
    xy = normalize(places(size), K, lens)
    if covariance is None:
        return np.full(GRID[::-1], np.nan)
    p = np.column_stack([xy, np.ones(len(xy))])
    shared = shared_numbers(K, lens)
    J = linearised(
        shared, np.eye(3)[None], np.zeros((1, 3)), p_board=p, uv=np.zeros((1, len(p), 2))
    )[0, : len(covariance)]
    J = J.reshape(len(covariance), 2, -1)
    C = np.einsum("iap,ij,jbp->pab", J, covariance, J)
    known = np.isfinite(C).all(axis=(1, 2))
    sd = np.full(len(p), np.nan)
    sd[known] = np.sqrt(np.linalg.eigvalsh(C[known])[:, -1])
    return sd.reshape(GRID[::-1])


def over_tilt(params: Params) -> tuple[np.ndarray, np.ndarray]:
    """Return tilts in degrees, and the deviation of f that boards of that tilt promise, pixels."""
    return _over_tilt(only(params, "views", "distance", "spread", "noise", "lens", "seed"))


@functools.lru_cache(maxsize=64)
def _over_tilt(params: Params) -> tuple[np.ndarray, np.ndarray]:
    free = np.arange(9) < 4 + COEFFICIENTS[params.lens]
    shared = shared_numbers(boards.K_TRUE, boards.LENS_TRUE)
    shared[~free] = 0.0
    p_board = boards.board_points()
    sd = []
    for tilt in TILTS:
        T = _poses(np.random.default_rng(params.seed), params, tilt)
        block = linearised(
            shared,
            T[:, :3, :3],
            T[:, :3, 3],
            p_board=p_board,
            uv=np.zeros((len(T), len(p_board), 2)),
        )
        sd.append(
            params.noise * float(np.sqrt(np.linalg.inv(shared_information(block, free))[0, 0]))
        )
    return TILTS, np.array(sd)
