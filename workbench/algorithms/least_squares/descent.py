"""Nonlinear least squares in small steps: Gauss and Newton's, and Levenberg and Marquardt's.

`linearise` gives the residuals (n,) at an unknown and their Jacobian (n, k) with respect to a small
step; `retract` gives the unknown that a small step (k,) leads to. Both may take many unknowns in
rows.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import Enum
from typing import Literal

import numpy as np
from jaxtyping import Bool, Float

from workbench.tracing import traced

Linearise = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]
Retract = Callable[[np.ndarray, np.ndarray], np.ndarray]
DampedStep = Callable[[np.ndarray, np.ndarray, float], np.ndarray]
Phase = Literal["start", "linearised", "tried", "accepted", "rejected"]
FIRST_DAMPING, CHANGE = 1e-3, 10.0
LEAST_DAMPING = 1e-15


class Stop(Enum):
    """Why the descent ended."""

    CONVERGED = "the sum of squares hardly changes any more"
    SINGULAR = "the linear problem has no one solution"
    DIVERGED = "the numbers are not finite any more"
    MAX_ITERATIONS = "the maximum number of iterations is reached"

    @property
    def message(self) -> str:
        """The reason in words."""
        return self.value


@dataclass(frozen=True, eq=False, kw_only=True)
class Descent:
    """One moment of an iteration.

    Attributes:
        phase: The start; the linear problem around the current unknown; its solution tried out;
            kept, or taken back.
        iteration: From 1, 0 at the start.
        cost: The residuals' sum of squares.
        damping: That the step is solved with: 0 for Gauss-Newton.
        step: The solution of the linear problem; None before there is one.
        trial: The unknown that it leads to.
        before: The sum of squares where the step began.
        predicted: By how much the linear problem said that the step lowers the sum.
        stop: Why this is the last moment, or None.
    """

    phase: Phase
    iteration: int
    unknown: np.ndarray
    residuals: Float[np.ndarray, " n"]
    jacobian: Float[np.ndarray, "n k"]
    cost: float
    damping: float
    step: np.ndarray | None = None
    trial: np.ndarray | None = None
    trial_cost: float = np.nan
    before: float = np.nan
    predicted: float = np.nan
    stop: Stop | None = None

    @property
    def gain(self) -> float:
        """How much the step lowers the sum of squares, as a share of the prediction."""
        return (self.before - self.trial_cost) / self.predicted if self.predicted > 0.0 else np.nan


def damped_step(
    residuals: Float[np.ndarray, " n"], jacobian: Float[np.ndarray, "n k"], damping: float
) -> Float[np.ndarray, " k"]:
    """Return the step that solves (JᵀJ + damping diag(JᵀJ)) step = -Jᵀr.

    It is solved as least squares of J and of damped rows below it. JᵀJ itself would square the
    condition, and far from the answer half of the digits with it.

    Raises:
        LinAlgError: If the matrix is singular: some step changes no residual.

    Reference: Marquardt, An algorithm for least-squares estimation of nonlinear parameters, 1963.
    """
    size = np.linalg.norm(jacobian, axis=0)
    k = jacobian.shape[1]
    if not (size > 0.0).all():
        raise np.linalg.LinAlgError("some unknown changes no residual")
    rows = (
        np.vstack([jacobian / size, np.sqrt(damping) * np.eye(k)]) if damping else jacobian / size
    )
    wanted = np.concatenate([-residuals, np.zeros(len(rows) - len(residuals))])
    step, _, rank, _ = np.linalg.lstsq(rows, wanted, rcond=None)
    if rank < k:
        raise np.linalg.LinAlgError("some step changes no residual")
    return step / size


@traced
def descend(
    linearise: Linearise,
    retract: Retract,
    start: np.ndarray,
    *,
    damped_step: DampedStep,
    damping: float = FIRST_DAMPING,
    iterations: int = 100,
    tolerance: float = 1e-6,
) -> Iterator[Descent]:
    """Yield the moments of Levenberg-Marquardt; damping 0 is Gauss-Newton and accepts every step.

    Args:
        iterations: Linear problems solved at most.
        tolerance: Converged when a step changes the sum of squares by no more than this share of
            it, or promises to.

    Reference: Nocedal and Wright, Numerical Optimization, 2nd ed., 10.3; Madsen, Nielsen and
    Tingleff, Methods for non-linear least squares problems, 2004, section 3.2 (the gain ratio).
    """
    unknown = start
    is_damped = damping > 0.0
    residuals, jacobian = linearise(unknown)
    moment = Descent(
        phase="start",
        iteration=0,
        unknown=unknown,
        residuals=residuals,
        jacobian=jacobian,
        cost=float(residuals @ residuals),
        damping=damping,
    )
    yield moment
    for iteration in range(1, iterations + 1):
        moment = replace(
            moment,
            phase="linearised",
            iteration=iteration,
            step=None,
            trial=None,
            trial_cost=np.nan,
        )
        yield moment
        try:
            step = damped_step(moment.residuals, moment.jacobian, moment.damping)
        except np.linalg.LinAlgError:
            yield replace(moment, phase="rejected", stop=Stop.SINGULAR)
            return
        # what overflows has diverged, and is said to
        with np.errstate(over="ignore", invalid="ignore"):
            trial = retract(moment.unknown, step)
            trial_residuals, trial_jacobian = linearise(trial)
            trial_cost = float(trial_residuals @ trial_residuals)
            predicted = moment.cost - float(
                np.square(moment.residuals + moment.jacobian @ step).sum()
            )
        moment = replace(
            moment,
            phase="tried",
            step=step,
            trial=trial,
            trial_cost=trial_cost,
            before=moment.cost,
            predicted=predicted,
        )
        yield moment

        stop = Stop.MAX_ITERATIONS if iteration == iterations else None
        if not np.isfinite(trial).all() or not np.isfinite(trial_cost):
            stop = Stop.DIVERGED
        elif min(abs(moment.cost - trial_cost), abs(predicted)) <= tolerance * moment.cost:
            stop = Stop.CONVERGED
        if trial_cost < moment.cost or (not is_damped and stop is not Stop.DIVERGED):
            lower = max(moment.damping / CHANGE, LEAST_DAMPING) if is_damped else 0.0
            moment = replace(
                moment,
                phase="accepted",
                unknown=trial,
                residuals=trial_residuals,
                jacobian=trial_jacobian,
                cost=trial_cost,
                damping=lower,
                stop=stop,
            )
        else:
            moment = replace(moment, phase="rejected", damping=moment.damping * CHANGE, stop=stop)
        yield moment
        if stop:
            return


@dataclass(frozen=True, eq=False)
class Along:
    """Sums of squares at shares of a step, and what the linear problem says of them."""

    shares: Float[np.ndarray, " k"]
    costs: Float[np.ndarray, " k"]
    promised: Float[np.ndarray, " k"]


def along_step(
    moment: Descent, linearise: Linearise, retract: Retract, *, shares: Float[np.ndarray, " k"]
) -> Along:
    """Return the sums of squares at shares of the step of a descent; 1 is its end.

    Raises:
        ValueError: If there is no step.

    Reference: Nocedal and Wright, Numerical Optimization, 2nd ed., 4.1 (the model beside the
    function).
    """
    if moment.step is None:
        raise ValueError("there is no step to go along")
    with np.errstate(over="ignore", invalid="ignore"):
        unknowns = retract(np.tile(moment.unknown, (len(shares), 1)), shares[:, None] * moment.step)
        costs = np.square(linearise(unknowns)[0]).sum(axis=-1)
        promised = np.square(
            moment.residuals + shares[:, None] * (moment.jacobian @ moment.step)
        ).sum(axis=-1)
    return Along(shares, costs, promised)


@dataclass(frozen=True, eq=False)
class Walked:
    """A moment of a descent and its way: the unknowns kept so far, and those taken back."""

    now: Descent
    kept: Float[np.ndarray, "k m"]
    taken_back: Float[np.ndarray, "t m"]
    along: Along | None = None


def with_its_way(
    moments: Iterator[Descent],
    linearise: Linearise,
    retract: Retract,
    *,
    shares: Float[np.ndarray, " k"],
) -> Iterator[Walked]:
    """Yield the moments of a descent, each with the way that led there."""
    kept, taken_back = [], []
    for moment in moments:
        if moment.phase in ("start", "accepted"):
            kept.append(moment.unknown)
        elif moment.phase == "rejected" and moment.trial is not None:
            taken_back.append(moment.trial)
        along = (
            along_step(moment, linearise, retract, shares=shares)
            if moment.phase == "tried"
            else None
        )
        yield Walked(
            moment, np.array(kept), np.array(taken_back).reshape(-1, moment.unknown.size), along
        )


def covariance(
    residuals: Float[np.ndarray, " n"], jacobian: Float[np.ndarray, "n k"]
) -> Float[np.ndarray, "k k"]:
    """Return the covariance of the unknowns at the minimum, s² (JᵀJ)⁻¹ with s² = r·r / (n - k).

    It holds for residuals with independent errors of one size, and as far as the problem is
    straight; infinite where n is not above k, or some step changes no residual.

    Reference: Hartley and Zisserman, Multiple View Geometry, 2nd ed., 5.2; Seber and Wild,
    Nonlinear regression, 2.1.
    """
    n, k = jacobian.shape
    normal = jacobian.T @ jacobian
    if n <= k or not np.linalg.cond(normal) < 1e15:
        return np.full((k, k), np.inf)
    return residuals @ residuals / (n - k) * np.linalg.inv(normal)


@dataclass(frozen=True, eq=False)
class Descents:
    """Many descents after as many iterations: unknowns, sums of squares, who has converged."""

    iteration: int
    unknowns: Float[np.ndarray, "k m"]
    costs: Float[np.ndarray, " k"]
    done: Bool[np.ndarray, " k"]


def descend_many(
    linearise: Linearise,
    retract: Retract,
    starts: Float[np.ndarray, "k m"],
    *,
    damping: float = FIRST_DAMPING,
    iterations: int = 100,
    tolerance: float = 1e-6,
) -> Iterator[Descents]:
    """Yield many descents side by side, each as `descend` would go, until all are done.

    What is not finite any more stays as it is and counts as done. The matrix is scaled to a
    diagonal of ones, where Marquardt's damping is one number.
    """
    unknowns = starts
    residuals, jacobians = linearise(unknowns)
    costs = np.square(residuals).sum(-1)
    dampings, done = np.full(len(starts), damping), np.zeros(len(starts), bool)
    yield Descents(0, unknowns, costs, done)
    for iteration in range(1, iterations + 1):
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            steps = _damped_steps(residuals, jacobians, dampings)
            trials = retract(unknowns, steps)
            trial_residuals, trial_jacobians = linearise(trials)
            trial_costs = np.square(trial_residuals).sum(-1)
            predicted = costs - np.square(residuals + (jacobians @ steps[..., None])[..., 0]).sum(
                -1
            )
            change = np.minimum(np.abs(costs - trial_costs), np.abs(predicted))
        finite = np.isfinite(trial_costs) & np.isfinite(trials).all(axis=-1)
        taken = finite & ~done & ((trial_costs < costs) | (damping == 0.0))
        done = done | ~finite | (change <= tolerance * costs)
        dampings = np.where(
            taken,
            np.maximum(dampings / CHANGE, LEAST_DAMPING if damping else 0.0),
            dampings * CHANGE,
        )
        unknowns = np.where(taken[:, None], trials, unknowns)
        costs = np.where(taken, trial_costs, costs)
        residuals = np.where(taken[:, None], trial_residuals, residuals)
        jacobians = np.where(taken[:, None, None], trial_jacobians, jacobians)
        yield Descents(iteration, unknowns, costs, done)
        if done.all():
            return


def _damped_steps(residuals: np.ndarray, jacobians: np.ndarray, dampings: np.ndarray) -> np.ndarray:
    """Solve many damped problems by eigenvalues: where one is singular, its step is not finite."""
    transposed = np.swapaxes(jacobians, -1, -2)
    normal = transposed @ jacobians
    gradient = (transposed @ residuals[..., None])[..., 0]
    size = np.sqrt(np.diagonal(normal, axis1=-2, axis2=-1))
    scale = np.where(size > 0.0, 1.0 / size, 1.0)
    values, vectors = np.linalg.eigh(np.nan_to_num(scale[:, :, None] * normal * scale[:, None, :]))
    along = (np.swapaxes(vectors, -1, -2) @ (scale * gradient)[..., None])[..., 0]
    along = along / (np.maximum(values, 0.0) + dampings[:, None])
    return -scale * (vectors @ along[..., None])[..., 0]
