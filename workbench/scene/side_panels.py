"""What stands beside the space: numbers, curves, tables, and what just happened in words."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from workbench.numerals import fixed
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


@dataclass(frozen=True)
class Chart:
    """A plot as it is declared once, for all that is drawn in it.

    Attributes:
        title: What it is called: what has the same chart shares a plot.
        x_label: What its curves run over, with the unit.
        unit: What their values are in, or the scalars of each step.
    """

    title: str
    x_label: str = ""
    unit: str = ""

    def curve(
        self, x: np.ndarray, y: np.ndarray, name: str, color: Role = "source", *, marks: tuple[float, ...] = ()
    ) -> Curve:
        """Return y over x as a line."""
        return Curve(x, y, name, self.title, self.x_label, self.unit, color, "line", marks)

    def dots(
        self, x: np.ndarray, y: np.ndarray, name: str, color: Role = "source", *, marks: tuple[float, ...] = ()
    ) -> Curve:
        """Return y over x as dots."""
        return Curve(x, y, name, self.title, self.x_label, self.unit, color, "dots", marks)

    def bars(self, x: np.ndarray, y: np.ndarray, name: str, color: Role = "source") -> Curve:
        """Return y over x as bars."""
        return Curve(x, y, name, self.title, self.x_label, self.unit, color, "bars")

    def histogram(
        self,
        values: np.ndarray,
        bins: int | np.ndarray,
        name: str,
        color: Role = "source",
        *,
        marks: tuple[float, ...] = (),
    ) -> Curve:
        """Return how many of the values lie in each of so many bins, or between edges, as bars at their middles."""
        counts, edges = np.histogram(values, bins)
        x = (edges[1:] + edges[:-1]) / 2
        return Curve(x, counts.astype(float), name, self.title, self.x_label, self.unit, color, "bars", marks)

    def scalar(self, value: float, name: str, color: Role = "source", *, log: bool = False) -> Scalar:
        """Return the number of this step."""
        return Scalar(value, name, self.title, self.unit, color, log)


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

    @classmethod
    def of_matrix(cls, title: str, header: tuple[str, ...], matrix: np.ndarray, places: int = 2) -> "Table":
        """Return a matrix as a table, every number with so many decimals; the header names its columns."""
        return cls(title, header, tuple(tuple(fixed(value, places) for value in row) for row in matrix))


@dataclass(frozen=True, eq=False)
class Caption:
    """What just happened and why, with the number that changed: one or two sentences of plain text.

    `values` are the numbers in it by name, as `workbench.captions.say` keeps them.
    """

    text: str
    tone: Literal["info", "good", "wrong"] = "info"
    values: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        check_text("Caption.text", self.text)
        need(bool(self.text.strip()), "a Caption says something")

    @classmethod
    def verdict(
        cls, text: str, *, right: bool, settled: bool = True, values: Mapping[str, float] | None = None
    ) -> "Caption":
        """Return the caption of an end whose truth is known: where it is wrong, it says so behind the text.

        `settled` says that the method itself came to rest, so that nothing but the truth shows that it is wrong.
        """
        if right:
            return cls(text, "good", values or {})
        wrong = "It looks settled, and it is wrong." if settled else "It is wrong."
        return cls(f"{text} {wrong}", "wrong", values or {})
