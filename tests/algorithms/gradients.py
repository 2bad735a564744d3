"""Gradients that a training loop goes down, held against differences of the loss that it
reports.
"""

from collections.abc import Callable, Iterator
from types import ModuleType
from typing import Any

import numpy as np
import pytest


def descended(
    monkeypatch: pytest.MonkeyPatch, module: ModuleType, training: Callable[[], Iterator[Any]]
) -> tuple[np.ndarray, Callable[[], tuple[float, np.ndarray]]]:
    """Return what a training learns, to be written to, and its gradient; no step is taken."""
    caught: dict[str, Any] = {}

    def descend(values, gradient, counts, *, rate):
        caught.update(values=values, gradient=gradient)
        yield 0, 0.0

    monkeypatch.setattr(module, "descend", descend)
    next(training())
    return caught["values"], caught["gradient"]


def assert_gradient(
    values: np.ndarray,
    gradient: Callable[[], tuple[float, np.ndarray]],
    rng: np.random.Generator,
    *,
    tolerance: float = 1e-6,
    h: float = 1e-6,
) -> None:
    """Hold a gradient against differences along each of 30 numbers and of five directions of all;
    batches stay the same.

    Args:
        values: What is learned; written to, and put back.
        gradient: Returns the loss and the gradient.
        rng: What draws the batches.
        tolerance: Relative to the largest entry of the gradient.
        h: How far is stepped.
    """
    drawn = rng.bit_generator.state
    chance = np.random.default_rng(0)

    def at_the_same_batch() -> tuple[float, np.ndarray]:
        rng.bit_generator.state = drawn
        loss, slope = gradient()
        return loss, slope.copy()

    start = values.copy()
    _, slope = at_the_same_batch()
    size = float(np.abs(slope).max())
    assert size > 0
    one_by_one = chance.choice(
        np.flatnonzero(slope), min(30, np.count_nonzero(slope)), replace=False
    )
    ways = [np.eye(1, slope.size, int(k)).reshape(slope.shape) for k in one_by_one]
    ways += [w / np.linalg.norm(w) for w in chance.normal(size=(5, *slope.shape))]
    for way in ways:
        losses = []
        for sign in (1, -1):
            values[:] = start + sign * h * way
            losses.append(at_the_same_batch()[0])
        values[:] = start
        assert (slope * way).sum() == pytest.approx(
            (losses[0] - losses[1]) / (2 * h), abs=tolerance * size
        )
