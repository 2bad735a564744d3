"""What is fitted to: made points, a coin's rim, or a person's own points."""

import functools
from pathlib import Path

import numpy as np

from lessons.fitting.state import Params, Subject
from workbench.algorithms.round_shapes import CYLINDER, ROUND_SHAPES, RoundName, RoundShape, fit_round
from workbench.data.files import read_image, shipped
from workbench.data.fit_scenes import arc_points, cap_points, errors, outlying_plane, pipe_points
from workbench.data.flat_points import read_flat_or_cloud
from workbench.data.framing import METRES, box
from workbench.data.rims import rim_points
from workbench.data.thinning import evenly
from workbench.errors import InputError
from workbench.geometry.algebraic_fits import fit_algebraic
from workbench.geometry.lines_planes import fit_hyperplane

MOST_POINTS, MOST_PIXELS = 2000, 900
WIDTH = 2.0  # metres that own points are long in the picture
WINDOWS = 12  # round the coin
RAYS, FARTHEST = 360, 45.0  # round a coin; pixels
LARGEST = 3.0  # times as large as the points a circle may be that they are shown by
TRUE = {
    "circle": np.array([0.0, 0.0, 1.0]),
    "sphere": np.array([0.0, 0.0, 0.0, 1.0]),
    "cylinder": np.array([0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0]),
}
PLACES = {"circle": arc_points, "sphere": cap_points, "cylinder": pipe_points}


def subject_of(params: Params, rng: np.random.Generator) -> Subject:
    """Return what the stage is about.

    Raises:
        InputError: If a person's file cannot be used for it.
    """
    if params.stage == "coin":
        return coin_of(params)
    if params.stage == "line":
        if params.cloud is not None:
            raise InputError("own points are not used in the stage line: set the stage to descent or robust")
        turn = np.radians(params.slope)
        along = rng.uniform(-1.0, 1.0, params.points)
        p_true = along[:, None] * np.array([np.cos(turn), np.sin(turn)])
        p = p_true + errors(rng, p_true.shape, params.noise)
        return Subject(p=p, truth=np.array([-np.sin(turn), np.cos(turn), 0.0]), p_true=p_true)
    if params.cloud is not None:
        return own(params, params.cloud)
    if params.stage == "robust":
        p, _ = outlying_plane(
            rng, params.points, params.noise, params.outliers, params.reach, both_sides=params.side == "both"
        )
        return Subject(p=p, truth=np.array([0.0, 0.0, 1.0, 0.0]))
    shape: RoundName = params.shape if params.stage == "descent" else "circle"
    p_true = PLACES[shape](np.radians(params.arc), params.points)
    p = p_true + errors(rng, p_true.shape, params.noise, params.errors if params.stage == "descent" else "independent")
    return _round(p, ROUND_SHAPES[shape], truth=TRUE[shape], p_true=p_true)


def _round(p: np.ndarray, kind: RoundShape, truth: np.ndarray | None = None, **more) -> Subject:
    """Add the best straight line to points in the plane, and the unknowns with the least squares."""
    start = truth if kind is CYLINDER else fit_algebraic(p)
    best = None if start is None else fit_round(kind, p[None], start[None], tolerance=1e-15)[0]
    straight = fit_hyperplane(p) if kind.name == "circle" else None
    return Subject(p=p, kind=kind, truth=truth, straight=straight, best=best, **more)


def own(params: Params, path: Path) -> Subject:
    """Return a person's points: about the origin, where their closed-form circle or sphere has the radius 1 m."""
    shape: RoundName = params.shape if params.stage == "descent" else "circle"
    p = read_flat_or_cloud(path, fewest=6)
    p, what = p[evenly(len(p), MOST_POINTS)], "plane" if params.stage == "robust" else shape
    wanted = 2 if what == "circle" else 3
    if wanted != p.shape[1]:
        raise InputError(f"{path.name} has {p.shape[1]} columns, and a {what} needs {wanted}")
    size = np.ptp(p, axis=0).max()
    if not size > 0:
        raise InputError(f"{path.name}: all its points lie at one place")
    low, high = box(p)
    center, unit = (low + high) / 2, size / WIDTH
    if what != "plane" and np.linalg.matrix_rank(p - p.mean(axis=0), tol=1e-9 * size) < wanted:
        flat = "line" if wanted == 2 else "plane"
        raise InputError(f"{path.name}: the points lie on a {flat}, and nothing round fits them best")
    if what in ("circle", "sphere"):
        found = fit_algebraic(p)
        if found[-1] < LARGEST * size:
            center, unit = found[:-1], found[-1]
    shown, scale = (p - center) / unit, METRES[params.cloud_unit] * unit
    return Subject(p=shown, scale=scale) if what == "plane" else _round(shown, ROUND_SHAPES[shape], scale=scale)


def coin_of(params: Params) -> Subject:
    """Return an arc of the rim of a picked coin, in radii of the whole rim about its centre."""
    photograph = coins() if params.image is None else read_image(params.image)
    h, w = photograph.shape[:2]
    if max(h, w) > MOST_PIXELS:
        raise InputError(f"the photograph is {w} by {h} pixels; at most {MOST_PIXELS} are used: make it smaller")
    uv = np.minimum(params.coin, (w - 1, h - 1)).astype(float)
    rim = rim_points(photograph, uv, RAYS, FARTHEST)
    whole = fit_algebraic(rim)
    if not (np.isfinite(whole).all() and 0.0 < whole[2] < 4 * FARTHEST):
        raise InputError("no rim is found round this pixel: pick one inside something bright and round")
    x, y, radius = whole
    rim = (rim - whole[:2]) * [1.0, -1.0] / radius  # y is up in the picture
    p = windows(rim, params.arc)[0]
    return _round(
        p,
        ROUND_SHAPES["circle"],
        truth=TRUE["circle"],
        p_true=rim,
        photograph=photograph,
        middle=(float(x), float(y), float(radius)),
    )


def windows(rim: np.ndarray, arc: float) -> np.ndarray:
    """Return arcs of a rim, degrees long, that begin in so many places, the first about +x; (k, n, 2)."""
    n = len(rim)
    count = max(round(n * arc / 360.0), 4)
    first = np.arange(WINDOWS) * n // WINDOWS - count // 2
    return rim[(first[:, None] + np.arange(count)) % n]


@functools.cache
def coins() -> np.ndarray:
    """Return the coins of Pompeii that scikit-image ships."""
    return read_image(shipped("coins.png"))
