"""Exercise match, lesson icp.

Write ICP's first half: for every source point the index of its nearest target point. The lesson
draws your correspondences, and fits the motion to them.

Watch it live:  workbench show icp --with my_match.py
Have it judged: workbench check my_match.py

It may use Python's own library, numpy and scipy, and modules that lie beside this file. One call
may take 5 s and 2 GB. It may print: the first 64 KB are kept. It reaches no network, no other
program and no file that is not its own. The first line above says what this file is handed in for:
leave it there.
"""

import numpy as np


def match(p_target: np.ndarray, p_source: np.ndarray) -> np.ndarray:
    """Return for each source point the index of the target point nearest to it.

    Args:
        p_target: The cloud to find partners in, metres.
        p_source: The points that want a partner, metres; in the target frame, as ICP has moved them so far.

    Returns:
        n whole numbers from 0 to m - 1, Euclidean distances deciding. Several source points may share a partner, and target
        points may stay without one. Where two target points are equally near, either is right.

    Raises:
        ValueError: If there is no target point (m = 0).

    Shapes:
        p_target: (m, 3) float
        p_source: (n, 3) float
        returned: (n,) int

    Examples:
        match(np.array([[0.0, 0, 0], [1, 0, 0]]), np.array([[0.9, 0, 0], [0.2, 0, 0], [5, 0, 0]]))
            gives [1, 0, 1]
        match(np.array([[0.0, 0, 0], [0, 0, 1]]), np.array([[0.0, 0, 0.7]]))
            gives [1]
    """
    raise NotImplementedError
