"""The numbers of a run beside its steps: what a scalar was at each of them."""

from dataclasses import dataclass

import numpy as np

from workbench.scene import Scalar, Scene
from workbench.words.axis import settled


@dataclass(frozen=True, eq=False)
class Series:
    """A scalar over the steps of a run: how it is drawn, and its value per step, NaN where a step
    has none.

    What is below round-off is zero.
    """

    scalar: Scalar
    values: np.ndarray


class ScalarColumns:
    """The scalars of a run's steps, grown step by step; read from any thread while one adds."""

    def __init__(self) -> None:
        self._first: dict[str, Scalar] = {}
        self._values: dict[
            str, np.ndarray
        ] = {}  # longer than what is known; NaN where a step has none
        self._steps = 0

    def add(self, scene: Scene) -> None:
        """Take the scalars of one more step."""
        k = self._steps
        self._steps = self._steps + 1
        for path, primitive in scene.items():
            if isinstance(primitive, Scalar) and path not in self._first:
                self._values[path] = np.full(max(64, 2 * k), np.nan)
                self._first[path] = primitive
        for path, values in self._values.items():
            if k >= len(values):
                self._values[path] = values = np.concatenate([values, np.full(len(values), np.nan)])
            primitive = scene.get(path)
            if isinstance(primitive, Scalar):
                values[k : k + 1] = settled(np.array([primitive.value]))

    def until(self, steps: int) -> dict[str, Series]:
        """Return every scalar of the first steps, as read-only views."""
        series = {}
        for path, scalar in tuple(self._first.items()):
            values = self._values[path][:steps]
            values.setflags(write=False)
            series[path] = Series(scalar, values)
        return series


def plotted_values(scalar: Scalar, values: np.ndarray) -> np.ndarray:
    """Return what is plotted of a scalar's values: they or their logarithm; NaN where there is
    none.
    """
    values = np.asarray(values, float)
    return np.log10(np.where(values > 0, values, np.nan)) if scalar.log else values
