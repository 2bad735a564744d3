"""What stands beside the space: numbers, curves, tables, and what just happened in words."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from workbench.scene.checks import check_array, check_finite, check_text, need, what
from workbench.scene.colors import Role, check_role


@dataclass(frozen=True, eq=False)
class Scalar:
    """One number of this step; a sink draws it as a curve over steps. NaN means: none at this step.

    Scalars with the same `chart` share one plot; `unit` is written at its axis. `log` asks for a logarithmic axis.
    """

    value: float
    name: str
    chart: str
    unit: str = ""
    color: Role = "source"
    log: bool = False

    def __post_init__(self) -> None:
        number = isinstance(self.value, (int, float, np.number)) and not isinstance(self.value, np.complexfloating)
        need(number, f"Scalar.value is one real number, not {what(self.value)}: float(...) makes one")
        check_role(self.color)


@dataclass(frozen=True, eq=False)
class Curve:
    """y over x at this step: a cost curve, a histogram, a basin. Curves with the same `chart` share one plot.

    `marks` are x positions worth a vertical line (the chosen disparity, the current angle). NaN in y leaves a gap.
    """

    x: np.ndarray
    y: np.ndarray
    name: str
    chart: str
    x_label: str
    y_label: str = ""
    color: Role = "source"
    kind: Literal["line", "bars", "dots"] = "line"
    marks: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        check_array("Curve.x", self.x)
        check_array("Curve.y", self.y)
        good = self.x.ndim == 1 and self.x.shape == self.y.shape and len(self.x) > 0
        need(good, f"Curve.x and y are (n,), n > 0, as long as each other, not {self.x.shape} and {self.y.shape}")
        check_role(self.color)
        check_finite("Curve.x", self.x)


@dataclass(frozen=True, eq=False)
class Table:
    """A small table of text beside the scene: a matrix, measured invariants. Rows have the length of `header`."""

    title: str
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    def __post_init__(self) -> None:
        need(all(len(row) == len(self.header) for row in self.rows), "every Table row is as long as the header")
        for cell in (*self.header, *(cell for row in self.rows for cell in row)):
            check_text(f"each cell of the Table {self.title!r}", cell)


@dataclass(frozen=True, eq=False)
class Caption:
    """What just happened and why, with the number that changed: one or two sentences of plain text."""

    text: str
    tone: Literal["info", "good", "wrong"] = "info"

    def __post_init__(self) -> None:
        check_text("Caption.text", self.text)
        need(bool(self.text.strip()), "a Caption says something")
