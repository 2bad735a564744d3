"""What is fitted to: made points, a coin's rim, or a person's own points."""

from pathlib import Path

import numpy as np

from lessons.fitting.fit_scenes import (
    arc_points,
    cap_points,
    errors,
    line_points,
    outlying_plane,
    pipe_points,
)
from lessons.fitting.round_shapes import CYLINDER, ROUND_SHAPES, RoundName, RoundShape, fit_round
from lessons.fitting.state import Params, Subject
from workbench.data.files import read_image
from workbench.data.files.rims import coins, find_rim
from workbench.data.flat_points import read_round
from workbench.data.framing import METRES
from workbench.errors import InputError
from workbench.geometry.shapes.algebraic_fits import fit_algebraic
from workbench.geometry.shapes.lines_planes import fit_hyperplane
from workbench.knobs import called

MOST_POINTS = 2000
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
        rim = find_rim(coins() if params.image is None else read_image(params.image), params.coin)
        return _round(
            rim.windows(params.arc)[0],
            ROUND_SHAPES["circle"],
            truth=TRUE["circle"],
            p_true=rim.p,
            rim=rim,
        )
    if params.stage == "line":
        if params.cloud is not None:
            raise InputError(
                f"own points are not used in the stage line: set {called('stage')} to descent or"
                " robust"
            )
        turn = np.radians(params.slope)
        p_true = line_points(rng, turn, params.points)
        p = p_true + errors(rng, p_true.shape, params.noise)
        return Subject(p=p, truth=np.array([-np.sin(turn), np.cos(turn), 0.0]), p_true=p_true)
    if params.cloud is not None:
        return own(params, params.cloud)
    if params.stage == "robust":
        p, _ = outlying_plane(
            rng,
            params.points,
            params.noise,
            outliers=params.outliers,
            reach=params.reach,
            both_sides=params.side == "both",
        )
        return Subject(p=p, truth=np.array([0.0, 0.0, 1.0, 0.0]))
    shape: RoundName = params.shape if params.stage == "descent" else "circle"
    p_true = PLACES[shape](np.radians(params.arc), params.points)
    p = p_true + errors(
        rng,
        p_true.shape,
        params.noise,
        kind=params.errors if params.stage == "descent" else "independent",
    )
    return _round(p, ROUND_SHAPES[shape], truth=TRUE[shape], p_true=p_true)


def _round(p: np.ndarray, kind: RoundShape, truth: np.ndarray | None = None, **more) -> Subject:
    """Add the best straight line to points in the plane, and the unknowns with the least
    squares.
    """
    start = truth if kind is CYLINDER else fit_algebraic(p)
    best = None if start is None else fit_round(kind, p[None], start[None], tolerance=1e-15)[0]
    straight = fit_hyperplane(p) if kind.name == "circle" else None
    return Subject(p=p, kind=kind, truth=truth, straight=straight, best=best, **more)


def own(params: Params, path: Path) -> Subject:
    """Return a person's points: about the origin, where their closed-form circle or sphere has the
    radius 1 m.
    """
    shape: RoundName = params.shape if params.stage == "descent" else "circle"
    p, unit = read_round(path, "plane" if params.stage == "robust" else shape, most=MOST_POINTS)
    scale = METRES[params.cloud_unit] * unit
    return (
        Subject(p=p, scale=scale)
        if params.stage == "robust"
        else _round(p, ROUND_SHAPES[shape], scale=scale)
    )
