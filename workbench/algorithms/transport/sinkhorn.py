"""Entropic optimal transport: a blurred plan, found by scaling rows and columns in turn.

Costs are of moving a unit of mass from row to column; masses are uniform and sum to 1. The
regularisation, the weight of the entropy, is in units of the cost: smaller is nearer to the optimum
and slower.

References: Cuturi, Sinkhorn distances, 2013, algorithm 1; Schmitzer, Stabilized sparse scaling
algorithms for entropy regularized transport problems, 2019, algorithm 2 (absorption); Peyre and
Cuturi, Computational optimal transport, 2019, section 4.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum

import numpy as np
from jaxtyping import Float

from workbench.tracing import traced, untraced

Cost = Float[np.ndarray, "n m"]

MOST_ENTRIES = 50_000_000  # of a cost matrix: 400 MB, and the plan is as large again

_WIDEST = 1e40  # scalings beyond this are absorbed into the potentials
_CHECK = 10  # sweeps between two looks at the marginals


class Stop(Enum):
    """Why the scaling ended."""

    CONVERGED = "converged: the plan's rows and columns sum to the masses within the tolerance"
    MAX_SWEEPS = "the maximum number of sweeps is reached before the plan's sums are right"

    @property
    def message(self) -> str:
        """The reason in words."""
        return self.value


@dataclass(frozen=True, eq=False)
class Blurred:
    """A plan with entropy, kept as its two potentials.

    Attributes:
        sweep: How often rows and columns were scaled.
        f, g: Log-domain potentials: plan_ij = exp((f_i + g_j - cost_ij) / regularisation).
        marginal_error: How much mass the row sums put wrongly; the column sums are exact.
        stop: Why this is the last state, or None.
    """

    sweep: int
    regularisation: float
    f: Float[np.ndarray, "n"]
    g: Float[np.ndarray, "m"]
    marginal_error: float
    stop: Stop | None = None

    def plan(self, cost: Cost) -> Cost:
        """Return how much mass goes from each row to each column."""
        return np.exp((self.f[:, None] + self.g - cost) / self.regularisation)

    def cost(self, cost: Cost) -> float:
        """Return the plan's cost without entropy: at least the optimum if its sums are right."""
        return float(np.vdot(self.plan(cost), cost))


@traced
def sinkhorn_steps(
    cost: Cost, regularisation: float, *, max_sweeps: int = 10_000, tolerance: float = 1e-9
) -> Iterator[Blurred]:
    """Yield the entropic plan's potentials after every few sweeps, until its sums are right.

    Any positive regularisation works, since the scalings are absorbed into log-domain potentials
    before they overflow. Converged when the row sums are wrong by no more than `tolerance` in
    total.

    Raises:
        ValueError: If the cost is empty, not finite or too large, or the regularisation is not
            positive.
    """
    check_cost(cost)
    if not (regularisation > 0 and max_sweeps >= 1):
        raise ValueError(
            f"regularisation > 0 and max_sweeps >= 1 are needed, not {regularisation} and"
            f" {max_sweeps}"
        )
    n, m = cost.shape
    f, g = tight_potentials(cost, np.zeros(m))
    K = kernel(cost, f, g, regularisation=regularisation)
    v = np.ones(m)
    Kv = K @ v

    for sweep in range(1, max_sweeps + 1):
        u = 1 / n / Kv  # Cuturi 2013, algorithm 1: rows
        v = 1 / m / (u @ K)  # columns
        Kv = K @ v
        too_wide = max(u.max(), v.max()) > _WIDEST
        if not (too_wide or sweep % _CHECK == 0 or sweep == max_sweeps):
            continue
        marginal_error = float(np.abs(u * Kv - 1 / n).sum())
        f_now, g_now = f + regularisation * np.log(u), g + regularisation * np.log(v)
        stop = why_stop(marginal_error <= tolerance, sweep == max_sweeps)
        yield Blurred(sweep, regularisation, f_now, g_now, marginal_error, stop)
        if stop:
            return
        if too_wide:  # Schmitzer 2019, algorithm 2: absorb
            f, g = f_now, g_now
            K = kernel(cost, f, g, regularisation=regularisation)
            v = np.ones(m)
            Kv = K @ v


def sinkhorn(
    cost: Cost, regularisation: float, *, max_sweeps: int = 10_000, tolerance: float = 1e-9
) -> Blurred:
    """Return the last state of `sinkhorn_steps`.

    Its steps are not traced (`workbench.tracing`): a trace of the run that calls this goes on with
    that run.

    Raises:
        ValueError: As `sinkhorn_steps`.
    """
    with untraced():
        *_, last = sinkhorn_steps(cost, regularisation, max_sweeps=max_sweeps, tolerance=tolerance)
    return last


def tight_potentials(
    cost: Cost, g: Float[np.ndarray, "m"]
) -> tuple[Float[np.ndarray, "n"], Float[np.ndarray, "m"]]:
    """Return the largest f, then the largest g, with f_i + g_j <= cost_ij (the c-transform).

    Reference: Peyre and Cuturi 2019, section 5.1.
    """
    f = (cost - g).min(axis=1)
    return f, (cost - f[:, None]).min(axis=0)


def kernel(
    cost: Cost, f: Float[np.ndarray, "n"], g: Float[np.ndarray, "m"], *, regularisation: float
) -> Cost:
    """Return exp((f_i + g_j - cost_ij) / regularisation), kept above the slow denormals."""
    K = f[:, None] + g
    K -= cost
    K *= 1 / regularisation
    lowest = 0.4 * np.log(np.finfo(K.dtype).tiny)
    return np.exp(np.maximum(K, lowest, out=K), out=K)


def check_cost(cost: np.ndarray) -> None:
    """Raise an error if a cost cannot be transported.

    Raises:
        ValueError: If it is empty, has more than MOST_ENTRIES entries, or one that is not finite.
    """
    if cost.size == 0:
        raise ValueError(f"a cost of {cost.shape[0]} x {cost.shape[1]} has nothing to move")
    if cost.size > MOST_ENTRIES:
        raise ValueError(
            f"a cost of {cost.shape[0]} x {cost.shape[1]} is too large; at most {MOST_ENTRIES:,}"
            " entries"
        )
    if not np.isfinite(cost).all():
        raise ValueError("the cost has entries that are not finite")


def why_stop(converged: bool, at_limit: bool) -> Stop | None:
    """Return the reason to stop, or None to go on."""
    if converged:
        return Stop.CONVERGED
    return Stop.MAX_SWEEPS if at_limit else None
