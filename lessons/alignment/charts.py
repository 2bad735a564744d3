"""What stands beside the picture: variance by direction, what is left off the diagonal, the
truth.
"""

import numpy as np

from lessons.alignment.state import AxesState, PairsState
from workbench.certain import sure
from workbench.geometry.motions.principal_axes import degrees_between_axes
from workbench.numerals import angle, fixed, length
from workbench.scene import Chart, Curve, Primitive, Table

CM2 = 1e4  # square centimetres in a square metre
ROUNDING = 1e-16  # below this share nothing is left off the diagonal
BINS = np.arange(0.0, 181.0, 10.0)
OFF, TO_AXES = Chart("Off the diagonal", unit="of the norm"), Chart("Frame to the axes", unit="deg")
OF_AXES, OF_H = (
    Chart("Variance of each axis", "axis", "cm²"),
    Chart("Singular values of H", "direction", "cm²"),
)
BY_DIRECTION = Chart("Variance by direction", "angle in the plane (deg)", "cm²")
ENDS = Chart("Where many turns end", "rotation error (deg)", "turns")
RMSE, TURN = Chart("RMSE", unit="m"), Chart("Rotation error", unit="deg")


def beside_axes(state: AxesState) -> dict[str, Primitive]:
    """Return the charts and tables of a step of the stage `axes`."""
    now = state.jacobi
    turning = now is not None and state.axes is None
    scene: dict[str, Primitive] = {
        "off diagonal": OFF.scalar(
            max(now.off, ROUNDING) if turning and now else np.nan, "off the diagonal", log=True
        ),
        "to axes": TO_AXES.scalar(
            max(_to_axes(state), 1e-9) if turning else np.nan,
            "frame to the true axes",
            "truth",
            log=True,
        ),
    }
    if now is None:
        return scene
    if turning:
        scene["covariance"] = _matrix("Covariance in the frame (cm²)", now.A)
        if state.before is not None and now.plane is not None:
            scene["variance"] = _variance(state.before, now.plane, now.angle)
    if state.variances is not None and state.moment in ("order", "signs"):
        scene["variances"] = OF_AXES.bars(
            np.arange(1.0, 4.0), CM2 * state.variances, "along the axes"
        )
    if state.moments is not None and state.variances is not None and state.moment == "signs":
        scene["moments"] = _moments(state.moments, state.variances)
    if state.outcome is not None and state.moment in ("pose", "turns"):
        scene["outcome"] = _outcome(state)
    if state.turns is not None:
        scene["turns"] = ENDS.histogram(state.turns.degrees, BINS, "turns", "truth")
    return scene


def _to_axes(state: AxesState) -> float:
    """Return the largest angle from an axis of the frame to the eigenvector that is nearest to it,
    degrees.
    """
    assert state.jacobi is not None
    A, V = state.jacobi.A, state.jacobi.V
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


def _matrix(title: str, A: np.ndarray) -> Table:
    rows = tuple(
        (name, *(fixed(CM2 * value, 2) for value in row))
        for name, row in zip("xyz", A, strict=True)
    )
    return Table(title, ("", "x", "y", "z"), rows)


def _moments(moments: np.ndarray, variances: np.ndarray) -> Table:
    skewness = moments / np.maximum(variances, 1e-12) ** 1.5
    rows = tuple((f"axis {k + 1}", fixed(float(skewness[k]), 3)) for k in range(3))
    return Table("Third moments, before signs", ("", "over σ³"), rows)


def _outcome(state: AxesState) -> Table:
    outcome = sure(state.outcome)
    rows = [("to the nearest points (RMS)", length(outcome.gap))]
    if np.isfinite(outcome.rotation):
        rows.append(("rotation, to the truth", angle(outcome.rotation)))
    if outcome.axes is not None:
        rows += [
            (f"axis {k + 1} off, up to its sign", angle(float(outcome.axes[k]))) for k in range(3)
        ]
    return Table("Frame on frame", ("", "distance"), tuple(rows))


def beside_pairs(state: PairsState) -> dict[str, Primitive]:
    """Return the charts and tables of a step of the stage `pairs`."""
    now, outcome = state.now, state.outcome
    begun = now.stage != "pairs"
    scene: dict[str, Primitive] = {
        "rmse": RMSE.scalar(now.rmse if begun else np.nan, "RMSE of the pairs"),
        "rotation error": TURN.scalar(
            outcome.rotation if begun else np.nan, "rotation error", "truth"
        ),
    }
    if now.H is not None and now.stage == "cross":
        scene["cross"] = _matrix("Cross-covariance H (cm²)", now.H)
    if now.D is not None:
        signs = np.ones(3) if now.S is None else now.S
        scene["singular"] = OF_H.bars(
            np.arange(1.0, 4.0), CM2 * now.D * signs, "with the sign it got"
        )
    if now.scale is not None:
        scene["scales"] = _scales(state, now.scale)
    return scene


def _scales(state: PairsState, scale: float) -> Table:
    rows = [
        ("second to first, least squares", fixed(scale, 3)),
        ("first to second, least squares", fixed(state.back, 3)),
        ("there and back", fixed(scale * state.back, 3)),
        ("ratio of sizes", fixed(state.sizes, 3)),
    ]
    if np.isfinite(state.true_scale):
        rows.append(("true", fixed(state.true_scale, 3)))
    return Table("Scale", ("", "×"), tuple(rows))
