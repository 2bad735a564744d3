"""Exercise match, lesson icp.

A sample that earns full marks, for the teacher: do not hand it out.
"""

import numpy as np


def match_all_at_once(p_target, p_source):
    squares = np.sum((p_source[:, None, :] - p_target[None, :, :]) ** 2, axis=2)
    return np.asarray(np.argmin(squares, axis=1))


match = match_all_at_once
