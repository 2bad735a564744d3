"""Optimal transport: exact, blurred, and flows along it.

- `exact`: the earth mover's distance, exact: the one-to-one matching of two clouds with the least
  total distance.
- `sinkhorn`: entropic optimal transport: blur the transport plan a little, and it is found by
  scaling rows and columns in turn.
- `flow`: one cloud flows to another: gradient descent on a distance between them, one point each
  its own way.
"""

from workbench.algorithms.transport.exact import (
    FEW_COPIES,
    MOST_UNEQUAL,
    Cloud,
    Matching,
    best_assignment,
    best_matching,
    best_plan,
    best_plan_by_programme,
    blurred_earth_movers,
    blurred_potentials,
    contested,
    earth_movers,
    earth_movers_gradient,
)

__all__ = [
    "FEW_COPIES",
    "MOST_UNEQUAL",
    "Cloud",
    "Matching",
    "best_assignment",
    "best_matching",
    "best_plan",
    "best_plan_by_programme",
    "blurred_earth_movers",
    "blurred_potentials",
    "contested",
    "earth_movers",
    "earth_movers_gradient",
]
