"""What stands beside the scene: distances to lines, errors of the pose, singular values, the four
motions, rows.
"""

import numpy as np

from lessons.epipolar.state import State
from workbench.algorithms.two_views import Followed, Related
from workbench.certain import sure
from workbench.geometry.cameras import camera_center
from workbench.geometry.motions import rotation_angle
from workbench.numerals import angle, brief, coordinates, fixed
from workbench.scene import Chart, Primitive, Table

LINES = Chart("Distance to the lines", unit="px")
POSE = Chart("Error of the pose", unit="°")
VALUES = Chart("Singular values of the equations", "which", "log10")
DEPTH = Chart("Depth error", "depth (m)", "m")
ROWS = Chart("Rows apart", "v − v′ (px)", "matches")
FLOOR = 1e-12  # of what is drawn by its logarithm


def beside(state: State) -> dict[str, Primitive]:
    """Return the charts and tables of a step."""
    result = state.now
    if isinstance(result, Followed):
        rows = zip(result.depths, result.uv_second, strict=True)
        cells = tuple(
            ("∞" if np.isinf(z) else fixed(float(z), 0), coordinates(uv, 1)) for z, uv in rows
        )
        return {
            "pictures of the ray": Table(
                "Pictures of the ray", ("depth (m)", "pixel (u′, v′)"), cells
            )
        }
    matched, clean = state.to_lines(state.views.matches), state.to_lines(state.views.clean)
    scene: dict[str, Primitive] = {"to lines": LINES.scalar(matched, "matches", log=True)}
    if not np.isnan(clean):
        scene["clean to lines"] = LINES.scalar(
            clean, "other points, without noise", "truth", log=True
        )
    if not np.isnan(state.turn_error):
        scene["turn"] = POSE.scalar(state.turn_error, "rotation", "truth", log=True)
        scene["direction"] = POSE.scalar(
            state.direction_error, "direction of the translation", "other", log=True
        )
    values = np.maximum(result.singular_values / result.singular_values[0], FLOOR)
    scene["values"] = VALUES.dots(np.arange(1.0, 10.0), np.log10(values), "over the largest")
    scene["matrices"] = _matrices(result)
    if len(result.in_front):
        scene["motions"] = _motions(result)
    if result.p_first is not None and state.views.p_first is not None:
        scene |= _depths(state, result)
    if state.disparities is not None:
        off = state.disparities[:, 1]
        edge = max(float(np.percentile(np.abs(off), 98)), 1e-3)
        scene["rows"] = ROWS.histogram(np.clip(off, -edge, edge), 21, "matches")
    return scene


def _matrices(estimate: Related) -> Table:
    rows = [("F", np.linalg.svd(estimate.F)[1])]
    if estimate.E_values is not None:
        rows.append(("E before", estimate.E_values))
    return Table(
        "Singular values, the first as 1",
        ("", "1st", "2nd", "3rd"),
        tuple((name, *(_value(s / values[0]) for s in values)) for name, values in rows),
    )


def _value(value: float) -> str:
    if value < 1e-12:
        return "0"
    return brief(value) if value >= 1e-3 else f"{brief(1e6 * value)} millionths"


def _motions(estimate: Related) -> Table:
    rows = []
    for T, count in zip(estimate.tested, estimate.in_front, strict=True):
        turn = angle(float(np.degrees(rotation_angle(T[:3, :3]))))
        rows.append((turn, coordinates(camera_center(T), 2), f"{count:,}"))
    return Table("Motions tried", ("turn", "second centre", "in front of both"), tuple(rows))


def _depths(state: State, estimate: Related) -> dict[str, Primitive]:
    """Return how far the depths of the points are off, and how far noise alone would put them."""
    true = sure(state.views.p_first)
    assert estimate.p_first is not None
    order = np.argsort(true[:, 2])
    z = true[order, 2]
    off = (state.length * estimate.p_first[:, 2] - true[:, 2])[order]
    top = 2.0 * z[-1]  # what is farther off is drawn there
    scene: dict[str, Primitive] = {
        "depth errors": DEPTH.dots(z, np.minimum(np.abs(off), top), "points", "source")
    }
    if state.moved:
        sigma = np.minimum(state.depth_sigma(true[order]), top)
        scene["depth sigma"] = DEPTH.curve(z, sigma, "σ from the pixels' noise", "truth")
    return scene
