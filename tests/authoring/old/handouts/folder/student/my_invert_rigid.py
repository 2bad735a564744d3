"""Exercise invert_rigid, lesson transforms.

Write the inverse of a rigid motion. The lesson takes the body back with it at the last step: with
the right inverse it stands on its ghost again, with (R^T, -t) it does not.

Watch it live:  workbench show transforms --with my_invert_rigid.py
Have it judged: workbench check my_invert_rigid.py

It may use Python's own library, numpy and scipy, and modules that lie beside this file. One call
may take 5 s and 2 GB. It may print: the first 64 KB are kept. It reaches no network, no other
program and no file that is not its own. The first line above says what this file is handed in for:
leave it there.
"""

import numpy as np


def invert_rigid(T_a_b: np.ndarray) -> np.ndarray:
    """Return the motion T_b_a that takes points back from frame a to frame b.

    With T_a_b = (R, t) a point goes p_a = R p_b + t, metres. The inverse undoes that for every point.

    Args:
        T_a_b: A rigid motion: rotation R in the upper left 3x3, translation t (metres) in the last column, and
            (0, 0, 0, 1) as last row. It may be the identity. Nobody gives you a motion that scales or shears.

    Returns:
        T_b_a, again a rigid motion, in a new array: the input stays as it is.

    Shapes:
        T_a_b: (4, 4) float
        returned: (4, 4) float

    Examples:
        invert_rigid(np.array([[1.0, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, -3], [0, 0, 0, 1]]))
            gives [[1, 0, 0, -2], [0, 1, 0, 0], [0, 0, 1, 3], [0, 0, 0, 1]]
        invert_rigid(np.array([[0.0, -1, 0, 2], [1, 0, 0, 5], [0, 0, 1, 0], [0, 0, 0, 1]]))
            gives [[0, 1, 0, -5], [-1, 0, 0, 2], [0, 0, 1, 0], [0, 0, 0, 1]]
    """
    raise NotImplementedError
