"""What searches for nearest points share: a tree that is soon built, and what a cloud must be.

Reference: Maneewongvatana and Mount, It's okay to be skinny, if your friends are fat, 1999 (the
sliding midpoint, where scipy's tree is cut that is not balanced).
"""

import numpy as np
import scipy
from jaxtyping import Float


def tree_of(p: Float[np.ndarray, "n d"]) -> "scipy.spatial.KDTree":
    """Return a k-d tree: with large leaves, neither balanced nor compacted, the soonest built of
    all mixtures tried, and as quick to ask.
    """
    return scipy.spatial.KDTree(p, leafsize=32, balanced_tree=False, compact_nodes=False)


def tree_for_many(p: Float[np.ndarray, "n d"]) -> "scipy.spatial.KDTree":
    """Return a k-d tree for asking all points for some sixteen neighbours each: smaller leaves and
    closer boxes than `tree_of`, which take longer to build and less to ask.
    """
    return scipy.spatial.KDTree(p, leafsize=16, balanced_tree=False)


def check_clouds(*clouds: np.ndarray) -> None:
    """Raise an error unless every cloud has points and all of them are finite.

    Raises:
        ValueError: If a cloud is empty or holds coordinates that are not finite.
    """
    for p in clouds:
        if len(p) == 0:
            raise ValueError("a cloud has no points")
        if not np.isfinite(p).all():
            raise ValueError("a cloud has coordinates that are not finite; drop those points first")
