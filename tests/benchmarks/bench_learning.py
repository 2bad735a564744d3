"""Learning by hand-written gradients beside autograd and JAX: `python -m
tests.benchmarks.bench_learning [--rounds 5]`.

One update of the network that puts out six numbers for a rotation (64 rotations, two hidden layers
of 64, loss on the matrix) is the same sum for all: forward, backward and Adam. JAX compiles it; its
first call is told apart. One thread, CPU time, the least of the rounds that take turns, with the
largest difference of the gradients. Then every task of the lesson from its start to its end, every
step held against the truth.
"""

# ruff: noqa: E402

import argparse
import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")
os.environ.setdefault(
    "XLA_FLAGS", "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"
)

import time
from collections.abc import Callable
from typing import Any

import numpy as np

from lessons.learning.lesson import lesson, run
from tests.benchmarks.bench_ransac import optional
from workbench.algorithms.learning.perceptron import (
    backward,
    descend,
    forward,
    layers_of,
    new_values,
)
from workbench.geometry.motions.rotation_outputs import IN_SPACE, random_rotations

SIZES = (9, 64, 64, 6)
BATCH = 64
UPDATES = 200
Gradient = Callable[[np.ndarray, np.ndarray], tuple[float, np.ndarray]]


def main() -> None:
    """Print one table for an update, and one for the tasks."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=5)
    rounds = parser.parse_args().rounds
    updates(rounds)
    tasks(rounds)


def by_hand(values: np.ndarray, R: np.ndarray) -> tuple[float, np.ndarray]:
    """Return the loss and its gradient, as `regress` computes them."""
    six = IN_SPACE["6D"]
    layers = layers_of(values, SIZES)
    slopes = np.empty_like(values)
    outputs = forward(layers, R.reshape(-1, 9), "relu")
    off = six.decode(outputs[-1]) - R
    backward(
        layers,
        outputs,
        six.pullback(outputs[-1], 2 * off / BATCH),
        activation="relu",
        into=layers_of(slopes, SIZES),
    )
    return float((off * off).sum() / BATCH), slopes


def loss_in(xp: Any) -> Callable[[Any, Any], Any]:
    """Return the same loss in the words of another numpy, which differentiates it by itself."""

    def loss(values: Any, R: Any) -> Any:
        h = R.reshape(-1, 9)
        layers = layers_of(values, SIZES)
        for k, (weights, bias) in enumerate(layers):
            h = h @ weights + bias
            h = xp.maximum(h, 0) if k < len(layers) - 1 else h
        a, b = h[:, :3], h[:, 3:]
        u = a / xp.sqrt(xp.sum(a * a, axis=1, keepdims=True))
        v = b - xp.sum(u * b, axis=1, keepdims=True) * u
        v = v / xp.sqrt(xp.sum(v * v, axis=1, keepdims=True))
        third = [u[:, i] * v[:, j] - u[:, j] * v[:, i] for i, j in ((1, 2), (2, 0), (0, 1))]
        predicted = xp.stack([u, v, xp.stack(third, axis=1)], axis=2)
        return xp.sum((predicted - R) ** 2) / BATCH

    return loss


def contenders() -> dict[str, Gradient]:
    """Return what computes the gradient, of what is installed."""
    ways: dict[str, Gradient] = {"by hand": by_hand}
    if autograd := optional("autograd"):
        theirs = autograd.value_and_grad(loss_in(optional("autograd.numpy")))
        ways["autograd"] = lambda values, R: tuple(map(np.asarray, theirs(values, R)))  # type: ignore[return-value]
    if jax := optional("jax"):
        jax.config.update("jax_enable_x64", True)
        compiled = jax.jit(jax.value_and_grad(loss_in(optional("jax.numpy"))))
        ways["JAX, compiled"] = lambda values, R: tuple(map(np.asarray, compiled(values, R)))  # type: ignore[return-value]
    return ways


def updates(rounds: int) -> None:
    """Compare one update, Adam included."""
    rng = np.random.default_rng(0)
    first = new_values(SIZES, rng) + 0.01
    R = random_rotations(BATCH, 3, np.pi, rng=rng)[0]
    ways = contenders()
    least = dict[str, float]()
    expected = by_hand(first, R)[1]
    print(
        f"one update, milliseconds\n{'':16}{'least':>8}{'ratio':>8}{'first call':>12}   gradient"
        " off by"
    )
    started = {name: timed(lambda way=way: way(first, R)) for name, way in ways.items()}
    for _ in range(rounds):
        for name, way in ways.items():
            values = first.copy()
            took = timed(
                lambda way=way, values=values: [
                    *descend(values, lambda: way(values, R), (UPDATES,), rate=4e-3)
                ]
            )
            least[name] = min(least.get(name, np.inf), took / UPDATES)
    for name, way in ways.items():
        off = float(np.abs(way(first, R)[1] - expected).max())
        ratio = least["by hand"] / least[name]
        print(
            f"{name:16}{1e3 * least[name]:8.3f}{ratio:8.2f}{1e3 * started[name]:12.1f}   {off:.1e}"
        )


def tasks(rounds: int) -> None:
    """Time every task, at its defaults, from the first state to the last."""
    print(f"\nevery task, seconds\n{'':16}{'updates':>8}{'least':>8}")
    for name in ("short", "rotation", "smeared", "circle", "smooth", "pooled", "many"):
        params = lesson.preset(name).params
        states = list[Any]()
        took = min(
            timed(lambda params=params, states=states: states.extend(run(params)))
            for _ in range(min(rounds, 2))
        )
        print(f"{name:16}{states[-1].now.updates:8}{took:8.2f}")


def timed(work: Callable[[], object]) -> float:
    """Return the processor time of a call, seconds."""
    start = time.process_time()
    work()
    return time.process_time() - start


if __name__ == "__main__":
    main()
