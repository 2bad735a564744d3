"""Motions of space: rotations, rigid and affine ones, and the best of them between points.

- `rigid`: rigid motions: SO(3) and SE(3) with exp and log that hold at the identity and at half a
  turn.
- `rotations`: rotations by their other names: an axis and an angle, 24 kinds of Euler angles,
  unit quaternions.
- `rotation_outputs`: numbers that a network can put out for a rotation: how they become a matrix,
  and the gradient back through that.
- `affine`: affine and projective maps as 4x4 matrices: the factors they are built from, and how
  to take one apart.
- `alignment`: least-squares alignment of paired points: rigid, similarity, affine, and one linear
  point-to-plane step.
- `principal_axes`: the frame that a cloud carries: its centroid and principal axes, which have no
  sign until a rule chooses one.
"""

from workbench.geometry.motions.rigid import (
    R_ROWS_DOWN,
    R_UPRIGHT,
    across,
    angle_between,
    apply,
    exp_se3,
    exp_so3,
    inverse,
    log_se3,
    log_so3,
    motion,
    rotation_angle,
    skew,
    turn_about,
    turns,
)

__all__ = [
    "R_ROWS_DOWN",
    "R_UPRIGHT",
    "across",
    "angle_between",
    "apply",
    "exp_se3",
    "exp_so3",
    "inverse",
    "log_se3",
    "log_so3",
    "motion",
    "rotation_angle",
    "skew",
    "turn_about",
    "turns",
]
