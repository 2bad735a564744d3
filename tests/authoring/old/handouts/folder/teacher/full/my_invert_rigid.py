"""Exercise invert_rigid, lesson transforms.

A sample that earns full marks, for the teacher: do not hand it out.
"""

import numpy as np


def invert_by_elimination(T_a_b):
    return np.linalg.inv(T_a_b)


invert_rigid = invert_by_elimination
