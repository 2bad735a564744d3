"""Build a map factor by factor, and undo its rigid part.

References: Foley, van Dam, Feiner and Hughes, Computer Graphics: Principles and Practice, 2nd ed.,
1990, chapter 5.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from workbench.tracing import traced

Invert = Callable[[np.ndarray], np.ndarray]
"""invert_rigid(T_a_b) -> T_b_a."""


@dataclass(frozen=True, eq=False)
class Factor:
    """One 4x4 of a product: what kind it is, what it does in words, and the matrix."""

    kind: str
    words: str
    matrix: Float[np.ndarray, "4 4"]


@dataclass(frozen=True, eq=False)
class State:
    """The product after one more factor.

    Attributes:
        factor: What was multiplied on the left just now.
        T: All factors so far.
        T_world_body: The rigid ones among them.
    """

    factor: Factor
    T: Float[np.ndarray, "4 4"]
    T_world_body: Float[np.ndarray, "4 4"]


@traced
def compose(
    shape: Sequence[Factor], motions: Sequence[Factor], invert_rigid: Invert
) -> Iterator[State]:
    """Yield the product after each factor, multiplied from right to left, and then with the rigid
    ones undone.

    Args:
        shape: Factors that change the body's shape; they act first.
        motions: Rigid factors, in world axes; they act afterwards.
        invert_rigid: The inverse of a rigid motion.
    """
    T = T_world_body = np.eye(4)
    yield State(Factor("start", "nothing yet", T), T, T_world_body)
    for factor in shape:
        T = factor.matrix @ T  # on the left: the newest factor acts last
        yield State(factor, T, T_world_body)
    for factor in motions:
        T_world_body = factor.matrix @ T_world_body
        T = factor.matrix @ T
        yield State(factor, T, T_world_body)
    T_body_world = invert_rigid(T_world_body)  # (R^T, -R^T t)
    T = T_body_world @ T
    yield State(Factor("undo", "the motion taken back", T_body_world), T, T_world_body)
