"""Applies a Laplacian again and again: heat flows, surfaces grow smooth and shrink.

Reference: Taubin, A signal processing approach to fair surface design, SIGGRAPH 1995, sections 2
and 3.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import scipy
from jaxtyping import Float

from workbench.geometry.graphs import Sparse, degrees
from workbench.geometry.graphs.spectra import Laplacian
from workbench.tracing import traced

LIMIT = 1e100
"""Beyond this a function that grows without bound is held, so that it stays a number."""


@dataclass(frozen=True, eq=False)
class Heat:
    """The heat u of each node after explicit steps, and exp(-t L) u_0, the exact one then."""

    step: int
    u: Float[np.ndarray, " n"]
    exact: Float[np.ndarray, " n"]

    @property
    def error(self) -> float:
        """The largest error of any node."""
        return float(np.abs(self.u - self.exact).max())


@traced
def heat(
    u: Float[np.ndarray, " n"], laplacian: Laplacian, dt: float, *, steps: int
) -> Iterator[Heat]:
    """Yield heat that flows along the edges by explicit (forward Euler) steps of du/dt = -L u.

    Steps longer than 2 over the largest eigenvalue make some part of u grow at every step.
    """
    flow = scipy.sparse.diags_array(-dt / laplacian.mass) @ laplacian.matrix
    trace = float(flow.diagonal().sum())
    exact = u
    yield Heat(0, u, exact)
    for step in range(1, steps + 1):
        u = u - dt * laplacian(u)
        u = np.clip(u, -LIMIT, LIMIT)
        exact = scipy.sparse.linalg.expm_multiply(flow, exact, traceA=trace)
        yield Heat(step, u, exact)


@dataclass(frozen=True, eq=False)
class Smoothed:
    """Vertices after some rounds of smoothing, `step` of them; p (v, 3)."""

    step: int
    p: Float[np.ndarray, "v 3"]


@traced
def smooth(
    p: Float[np.ndarray, "v 3"],
    adjacency: Sparse,
    steps: int,
    *,
    inward: float = 0.5,
    outward: float = 0.0,
) -> Iterator[Smoothed]:
    """Yield vertices that move towards the mean of their neighbours, and then a little back.

    Args:
        adjacency: Which vertices share an edge; each has one at least.
        inward: The share of the way to the mean that a vertex goes (lambda).
        outward: The share that it goes away again (-mu, Taubin); 0 is Laplacian smoothing, which
            shrinks.
    """
    mean = scipy.sparse.diags_array(1 / degrees(adjacency)) @ adjacency
    yield Smoothed(0, p)
    for step in range(1, steps + 1):
        p = p + inward * (mean @ p - p)  # (2) and (3)
        if outward:
            # section 3: a pass that grows what the first has shrunk
            p = p - outward * (mean @ p - p)
        yield Smoothed(step, p)
