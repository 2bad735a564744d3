"""What stands beside the picture: the rms beside the error to the truth, f, the camera in numbers,
and its uncertainty.
"""

import numpy as np

from lessons.calibration.state import Ending, State
from lessons.calibration.views import GRID, places
from workbench.algorithms.least_squares.board_adjustment import SHARED, shared_numbers
from workbench.numerals import brief, fixed, pixels, plus_minus
from workbench.scene import Chart, Field, Picture, Primitive, Table

FOCAL = Chart("Focal length", unit="px")
ERROR = Chart("Error", unit="px")
VIEWS = Chart("rms of each view", "view", "px")
TILT = Chart("± of f over the tilt of boards", "tilt (°)", "log₁₀ of px")
RADIUS = Chart("Error over the picture", "distance from the middle (px)", "px")
RINGS = 9


def beside(state: State) -> dict[str, Primitive]:
    """Return the charts and tables of a step."""
    estimate, subject = state.now, state.subject
    scene: dict[str, Primitive] = {"rms": ERROR.scalar(state.rms, "reprojection, rms", log=True)}
    if estimate.K is not None:
        scene["f"] = FOCAL.scalar(float(estimate.K[0, 0]), "fx as found")
        scene["camera in numbers"] = _camera(state)
    if subject.K is not None:
        scene["f/truth"] = FOCAL.scalar(float(subject.K[0, 0]), "fx in truth", "truth")
        scene["map"] = ERROR.scalar(
            state.worst_in_picture, "worst in the picture", "truth", log=True
        )
    if estimate.phase == "constraints":
        rows = tuple((str(i + 1), brief(value)) for i, value in enumerate(estimate.singular_values))
        scene["singular values"] = Table("Singular values of the rows", ("", "value"), rows)
    if state.ending is not None:
        scene |= _ending(state, state.ending)
    return scene


def _camera(state: State) -> Table:
    """Return the numbers that all views share, their ±, and the true ones."""
    estimate = state.now
    truth = state.subject.K
    assert estimate.K is not None
    numbers = shared_numbers(estimate.K, estimate.lens)
    sd = np.full(9, np.nan) if estimate.adjustment is None else estimate.adjustment.deviations
    true = None if truth is None else shared_numbers(truth, state.subject.lens)
    rows = []
    for i, name in enumerate(SHARED):
        decimals = 1 if i < 4 else 4
        value = fixed(numbers[i], decimals)
        deviation = ""
        if 0 < sd[i] < np.inf:
            value, deviation = plus_minus(numbers[i], sd[i], decimals)
        rows.append(
            (name, value, deviation, *(() if true is None else (fixed(true[i], decimals),)))
        )
    return Table(
        "The camera", ("", "found", "±", *(() if true is None else ("true",))), tuple(rows)
    )


def _ending(state: State, ending: Ending) -> dict[str, Primitive]:
    if ending.kind != "known":
        numbers = np.array(state.subject.views, float)
        kept = np.arange(len(numbers)) != ending.worst
        scene: dict[str, Primitive] = {"views": VIEWS.bars(numbers, state.per_view, "rms")}
        if ending.without is not None and ending.kind == "without":
            off = np.sqrt(np.square(ending.without.residuals).sum(axis=2).mean(axis=1))
            scene["views/without"] = VIEWS.dots(
                numbers[kept], off, "without the worst", "highlight"
            )
        return scene | {"names": _names(state)}
    w, h = state.subject.size
    scene = {}
    if np.isfinite(ending.deviation).any():
        values = Field.magnitude(ending.deviation, "± of where a ray is seen", "px")
        scene["uncertainty"] = Picture(values, "± of where a ray is seen")
    uv = places((w, h))
    radius = np.linalg.norm(uv - (np.array([w, h]) - 1) / 2, axis=1)
    ring = np.minimum((RINGS * radius / radius.max()).astype(int), RINGS - 1)
    x = (np.arange(RINGS) + 0.5) * radius.max() / RINGS
    for path, name, values, color in (
        ("off", "error to the truth", state.map_error, "truth"),
        ("expected", "± of the covariance", ending.deviation.ravel(), "source"),
    ):
        if len(values) == GRID[0] * GRID[1] and np.isfinite(values).any():
            most = [np.nanmax(values[ring == i], initial=0.0) for i in range(RINGS)]
            scene[f"radius/{path}"] = RADIUS.curve(x, np.array(most), name, color)  # type: ignore[arg-type]
    if ending.tilts is not None:
        tilts, deviation = ending.tilts
        scene["tilts"] = TILT.curve(
            tilts,
            np.log10(deviation),
            "promised by such boards",
            "source",
            marks=(state.params.tilt,),
        )
    return scene


def _names(state: State) -> Table:
    """Return what is called the error, for the same residuals."""
    off = state.now.residuals
    lengths = np.linalg.norm(off, axis=2)
    rows = (
        ("rms of points", pixels(float(np.sqrt((lengths**2).mean())))),
        ("rms of coordinates", pixels(float(np.sqrt((off**2).mean())))),
        ("mean length", pixels(float(lengths.mean()))),
        (
            "norm / n, of an old tutorial",
            pixels(float((np.sqrt((lengths**2).sum(axis=1)) / lengths.shape[1]).mean())),
        ),
    )
    return Table("What is called the error", ("name", "here"), rows)
