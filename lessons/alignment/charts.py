"""What stands beside the picture: variance by direction, what is left off the diagonal, the
truth.
"""

import numpy as np

from lessons.alignment.state import State
from workbench.certain import sure
from workbench.geometry.motions.principal_axes import degrees_between_axes
from workbench.numerals import angle, fixed, length
from workbench.scene import Chart, Curve, Primitive, Table

CM2 = 1e4  # square centimetres in a square metre
ROUNDING = 1e-16  # below this share nothing is left off the diagonal
BINS = np.arange(0.0, 181.0, 10.0)
OFF, TO_AXES = Chart("Off the diagonal", unit="of the norm"), Chart("Frame to the axes", unit="deg")
OF_AXES = Chart("Variance of each axis", "axis", "cm²")
BY_DIRECTION = Chart("Variance by direction", "angle in the plane (deg)", "cm²")
ENDS = Chart("Where many turns end", "rotation error (deg)", "turns")


def beside_axes(state: State) -> dict[str, Primitive]:
    """Return the charts and tables of a step."""
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


def _to_axes(state: State) -> float:
    """Return the largest angle from an axis of the frame to the eigenvector that is nearest to
    it, degrees.
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


def _outcome(state: State) -> Table:
    outcome = sure(state.outcome)
    rows = [("to the nearest points (RMS)", length(outcome.gap))]
    if np.isfinite(outcome.rotation):
        rows.append(("rotation, to the truth", angle(outcome.rotation)))
    if outcome.axes is not None:
        rows += [
            (f"axis {k + 1} off, up to its sign", angle(float(outcome.axes[k]))) for k in range(3)
        ]
    return Table("Frame on frame", ("", "distance"), tuple(rows))
