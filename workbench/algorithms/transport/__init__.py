"""Optimal transport.

- `exact`: the one-to-one matching of two clouds with the least total distance.
- `sinkhorn`: entropic transport, found by scaling rows and columns in turn.
- `flow`: one cloud flows to another down a distance between them.
"""

from workbench.algorithms.transport.exact import (
    FEW_COPIES,
    MOST_UNEQUAL,
    Cloud,
    TransportPlan,
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
    "TransportPlan",
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
