"""What is fitted to: made points, a coin's rim, or a person's own points."""

import functools
from pathlib import Path

import numpy as np

from lessons.fitting.state import Params, Subject
from workbench.algorithms.round_shapes import CYLINDER, ROUND_SHAPES, RoundName, RoundShape, fit_round
from workbench.data.files import read_cloud, read_image, stamp, text_rows
from workbench.data.fit_scenes import arc_points, cap_points, errors, outlying_plane, pipe_points
from workbench.data.framing import METRES, frame
from workbench.data.rims import rim_points
from workbench.data.thinning import evenly
from workbench.errors import InputError
from workbench.geometry.algebraic_fits import fit_algebraic
from workbench.geometry.lines_planes import fit_hyperplane

MOST_POINTS, MOST_PIXELS = 2000, 900
WIDTH = 2.0  # metres that own points are long in the picture
WINDOWS = 12  # round the coin
RAYS, FARTHEST = 360, 45.0  # round a coin; pixels
IN_PLANE = (".xyz", ".txt", ".csv", ".tsv", ".dat")
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
    """Return a person's points, 2 m long in the picture."""
    p = _own_points(path, stamp(path))
    p = p[evenly(len(p), MOST_POINTS)]
    if not np.ptp(p, axis=0).max() > 0:
        raise InputError(f"{path.name}: all its points lie at one place")
    flat, columns = (p.shape[1] == 2), p.shape[1]
    wanted = 3 if params.stage == "robust" or (params.stage == "descent" and params.shape != "circle") else 2
    if wanted != columns:
        what = "a plane" if params.stage == "robust" else f"a {params.shape if params.stage == 'descent' else 'circle'}"
        raise InputError(f"{path.name} has {columns} columns, and {what} needs {wanted}")
    placed = frame(np.column_stack([p, np.zeros(len(p))]) if flat else p, WIDTH)
    shown = placed.shown(np.column_stack([p, np.zeros(len(p))]) if flat else p)[:, :columns]
    scale = METRES[params.cloud_unit] / placed.scale
    if params.stage == "robust":
        return Subject(p=shown, scale=scale)
    subject = _round(shown, ROUND_SHAPES[params.shape if params.stage == "descent" else "circle"], scale=scale)
    if np.linalg.matrix_rank(shown - shown.mean(axis=0), tol=1e-9) < columns:
        raise InputError(
            f"{path.name}: the points lie on a {'line' if flat else 'plane'}, and nothing round fits them best"
        )
    return subject


@functools.lru_cache(maxsize=4)
def _own_points(path: Path, _stamp: tuple[int, int]) -> np.ndarray:
    """Return the points of a file, two columns of a text file as places in the plane."""
    if path.suffix.lower() not in IN_PLANE:
        return read_cloud(path, fewest=6)
    rows = [line.replace(",", " ").replace(";", " ").split() for _, line in text_rows(path, "points", IN_PLANE)]
    if not rows or max(len(row) for row in rows) != 2:
        return read_cloud(path, fewest=6)
    try:
        p = np.array([[float(word) for word in row] for row in rows[not _is_number(rows[0][0]) :]])
    except ValueError:
        raise InputError(f"{path.name}: two numbers x y are wanted on each line") from None
    if p.ndim != 2 or p.shape[1:] != (2,) or len(p) < 6 or not np.isfinite(p).all():
        raise InputError(f"{path.name}: six lines at least of two finite numbers x y are wanted")
    return p


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


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
    from skimage import data

    return data.coins()
