"""What stands beside the stages in space: variance by direction, what is left, the truth."""

import numpy as np

from lessons.axes.space import HAND, SIDES, Outcome, State, off_by_side
from lessons.axes.starts import Race
from workbench.certain import sure
from workbench.geometry.motions.principal_axes import degrees_between_axes
from workbench.lesson import Look
from workbench.numerals import angle, fixed, length
from workbench.scene import Chart, Curve, Primitive, Role, Table

CM2, MM = 1e4, 1e3  # square centimetres in a square metre, millimetres in a metre
COLORS: tuple[Role, Role, Role] = ("x", "y", "z")
ROUNDING = 1e-16  # below this share nothing is left off the diagonal
ENTRY = Chart("Entry off the diagonal", "turned by hand", "cm²", x_range=(-45, 45), x_unit="deg")
HELD = Chart("Turned", unit="deg")
OFF, TO_AXES = Chart("Off the diagonal", unit="%"), Chart("Frame to the axes", unit="deg")
FRAME, HOME = Chart("Frame", unit=""), Chart("Come home", unit="%")
OF_AXES = Chart("Variance of each axis", "axis", "variance (cm²)")
BY_DIRECTION = Chart("Variance by direction", "angle in the plane (deg)", "variance (cm²)")
ALONG = Chart("Along the axes", "distance from the centroid, over σ", "points")
ENDS = Chart("Where many turns end", "rotation error (deg)", "turns")
FRAMES = Chart("Four frames", "frame", "mm to the nearest points")
SIDE = Chart(
    "How far axis 1 differs", "middle side of the box", "deg", x_range=(0.6, 1.0), x_unit="m"
)
RACE = Chart("RMSE from four frames", "frame", "RMSE, dots: before ICP (mm)")
OFF_TRUTH, GAP = Chart("Rotation error", unit="deg"), Chart("To the nearest points", unit="m")


def of_space(look: Look) -> dict[str, Primitive]:
    """Return the charts and tables of a step of the stages in space."""
    state = look.now
    rotated = look.now.jacobi
    if rotated is None:
        return {}
    turning = state.axes is None
    off, to_axes = (
        (max(rotated.off, ROUNDING), max(_to_axes(state), 1e-9)) if turning else (np.nan,) * 2
    )
    scene: dict[str, Primitive] = {
        "off diagonal": OFF.scalar(100.0 * off, "off the diagonal", log=True),
        "to axes": TO_AXES.scalar(to_axes, "frame to the true axes", "truth", log=True),
    }
    if turning:
        rows = ("xyz"[k : k + 1] for k in range(3))
        cells = tuple(
            (name, *(fixed(CM2 * v, 2) for v in row))
            for name, row in zip(rows, rotated.A, strict=True)
        )
        scene["covariance"] = Table("Covariance in the frame (cm²)", ("", "x", "y", "z"), cells)
        if state.moment == "hand":
            return scene | _by_hand(state)
        if state.before is not None and rotated.plane is not None:
            scene["variance"] = _variance(state.before, rotated.plane, rotated.angle)
        return scene
    k = state.moment
    three = np.arange(1.0, 4.0)
    if k in ("order", "frame", "signs"):
        scene["variances"] = OF_AXES.bars(three, CM2 * sure(state.variances), "along the axes")
    if state.frames and state.outcome is None:
        scene["frame number"] = FRAME.scalar(state.frame, "frame")
    if k == "frame":
        scene["gap"] = GAP.scalar(state.frames[state.frame - 1].gap, "gap")
        gaps = np.array([MM * frame.gap for frame in state.frames])
        x = np.arange(1.0, len(gaps) + 1)
        scene["gaps"] = FRAMES.bars(x, gaps, "to the nearest points")
    if k == "signs":
        scene |= _lopsided(look)
    if k in ("pose", "turns"):
        scene["gap"] = GAP.scalar(sure(state.outcome).gap, "gap")
        scene["outcome"] = _outcome(sure(state.outcome))
        scene["error"] = OFF_TRUTH.scalar(sure(state.outcome).rotation, "rotation error", "truth")
    if state.turns is not None:
        scene["turns"] = ENDS.histogram(
            state.turns.degrees, np.arange(0.0, 181.0, 10.0), "turns", "truth"
        )
        scene["home"] = HOME.scalar(100.0 * float(state.turns.home.mean()), "come home", "truth")
    if k in ("pose", "turns") and look.subject.what == "one box":
        off_by = off_by_side(look.params)
        side = look.params.side
        y = float(np.interp(side, SIDES, off_by))
        scene["side/curve"] = SIDE.whole(np.array(SIDES), off_by, "axis 1 off, median", "source")
        scene["side/mark"] = SIDE.mark(side, y, "this box", "source", knob="side")
    return scene


def _by_hand(state: State) -> dict[str, Primitive]:
    rotated, before = sure(state.jacobi), sure(state.before)
    i, j = sure(rotated.plane)
    a = np.radians(HAND)
    c, s = np.cos(a), np.sin(a)
    entry = CM2 * ((before[j, j] - before[i, i]) * c * s + before[i, j] * (c * c - s * s))
    held = float(np.degrees(rotated.angle))
    return {
        "entry/curve": ENTRY.whole(HAND, entry, "entry of the shaded plane", "source"),
        "entry/zero": ENTRY.second(HAND, 0.0 * HAND, "zero", "neutral"),
        "entry/mark": ENTRY.mark(
            held, CM2 * rotated.A[i, j], "your hand", "source", steps="turned"
        ),
        "turned": HELD.scalar(held, "turned"),
    }


def _to_axes(state: State) -> float:
    """Return the largest angle from an axis of the frame to the nearest eigenvector, degrees."""
    A, V = sure(state.jacobi).A, sure(state.jacobi).V
    vectors = np.linalg.eigh(V @ A @ V.T)[1]
    nearest = np.abs(vectors.T @ V).argmax(axis=0)
    return float(degrees_between_axes(V, vectors[:, nearest]).max())


def _variance(A: np.ndarray, plane: tuple[int, int], turned: float) -> Curve:
    """Return the variance along every direction of the plane in which the frame was turned."""
    i, j = plane
    degrees = np.linspace(-90.0, 90.0, 181)
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    variance = c * c * A[i, i] + 2 * c * s * A[i, j] + s * s * A[j, j]
    name = f"from {'xyz'[i]} towards {'xyz'[j]}"
    return BY_DIRECTION.curve(degrees, CM2 * variance, name, marks=(float(np.degrees(turned)),))


def _lopsided(look: Look) -> dict[str, Primitive]:
    """Return how the points lie along axes 1 and 2, and the third moments before the signs."""
    state = look.now
    p = look.subject.p_source
    along = (
        (p - state.p_centre) @ sure(state.axes) / np.sqrt(np.maximum(sure(state.variances), 1e-12))
    )
    bins = np.linspace(-3.0, 3.0, 31)
    scene: dict[str, Primitive] = {}
    for k in range(2):
        count, edges = np.histogram(along[:, k], bins)
        x = (edges[1:] + edges[:-1]) / 2
        scene[f"along/{k + 1}"] = ALONG.curve(x, count.astype(float), f"axis {k + 1}", COLORS[k])
    rows = tuple((f"axis {k + 1}", fixed(float(v), 3)) for k, v in enumerate(skewness(state)))
    return scene | {"moments": Table("Third moments, before signs", ("", "over σ³"), rows)}


def skewness(state: State) -> np.ndarray:
    """Return the third moments before the signs over the variances to the power 1.5."""
    return sure(state.moments) / np.maximum(sure(state.variances), 1e-12) ** 1.5


def _outcome(outcome: Outcome) -> Table:
    rows = [("to the nearest points (RMS)", length(outcome.gap))]
    if np.isfinite(outcome.rotation):
        rows.append(("rotation, to the truth", angle(outcome.rotation)))
    if outcome.axes is not None:
        rows += [
            (f"axis {k + 1} off, up to its sign", angle(v)) for k, v in enumerate(outcome.axes)
        ]
    return Table("Frame on frame", ("", "distance"), tuple(rows))


def of_starts(look: Look) -> dict[str, Primitive]:
    """Return the RMSE of four starts, before ICP and now."""
    race: Race = look.now
    first = look.past[0] if look.past else race
    x = np.arange(1.0, len(race.rmse) + 1)
    scene: dict[str, Primitive] = {
        "race/now": RACE.bars(x, MM * race.rmse, "now", "source"),
        "race/first": RACE.dots(x, MM * first.rmse, "before ICP", "neutral"),
    }
    if race.is_told:
        off = float(race.off[race.winner])
        scene["low"] = GAP.scalar(float(race.rmse[race.winner]), "lowest RMSE")
        scene["winner"] = OFF_TRUTH.scalar(off, "rotation error", "truth")
    if race.alone is not None:
        scene["alone"] = Chart("RMSE without a frame", unit="m").scalar(race.alone[1], "alone")
    return scene
