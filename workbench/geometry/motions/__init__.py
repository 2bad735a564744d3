"""Motions of space: rotations, rigid and affine ones, and the best of them between points.

- `rigid`: SO(3) and SE(3) with exp and log that hold at the identity and at half a turn.
- `rotations`: rotations as an axis and an angle, 24 kinds of Euler angles, unit quaternions.
- `rotation_outputs`: numbers that a network can put out for a rotation, and gradients.
- `affine`: affine and projective maps as 4x4 matrices, built from factors and taken apart.
- `alignment`: least-squares alignment of paired points, and one point-to-plane step.
- `principal_axes`: the centroid and principal axes of a cloud, and rules for their signs.
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
