"""Nonlinear least squares, step by step.

- `descent`: Gauss and Newton's steps, and Levenberg and Marquardt's that can be taken back.
- `board_adjustment`: a camera, its lens and the poses of a board, refined together.
"""

from workbench.algorithms.least_squares.descent import (
    CHANGE,
    FIRST_DAMPING,
    LEAST_DAMPING,
    Along,
    DampedStep,
    Descent,
    Descents,
    Linearise,
    Phase,
    Retract,
    Stop,
    Walked,
    along_step,
    covariance,
    damped_step,
    descend,
    descend_many,
    with_its_way,
)

__all__ = [
    "CHANGE",
    "FIRST_DAMPING",
    "LEAST_DAMPING",
    "Along",
    "DampedStep",
    "Descent",
    "Descents",
    "Linearise",
    "Phase",
    "Retract",
    "Stop",
    "Walked",
    "along_step",
    "covariance",
    "damped_step",
    "descend",
    "descend_many",
    "with_its_way",
]
