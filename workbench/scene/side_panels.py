"""What stands beside the space: numbers, curves, tables, and what just happened in words."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from workbench.numerals import fixed
from workbench.scene.checks import check_array, check_finite, check_text, need, what
from workbench.scene.colors import Role, check_role


@dataclass(frozen=True, eq=False)
class Scalar:
    """One number of this step; a sink draws it as a curve over steps. NaN means: none at this step.

    Scalars with the same `chart` share one plot; `unit` is written at its axis. `log` asks for a
    logarithmic axis.
    """

    value: float
    name: str
    chart: str
    unit: str = ""
    color: Role = "source"
    log: bool = False

    def __post_init__(self) -> None:
        number = isinstance(self.value, (int, float, np.number)) and not isinstance(
            self.value, np.complexfloating
        )
        need(
            number, f"Scalar.value is one real number, not {what(self.value)}: float(...) makes one"
        )
        check_role(self.color)


@dataclass(frozen=True, eq=False)
class Curve:
    """y over x at this step: a cost curve, a histogram, a basin. Curves with the same `chart` share
    one plot.

    `marks` are x positions worth a vertical line (the chosen disparity, the current angle). NaN in
    y leaves a gap. `part` says what it is of the large chart of a story, `plot` of which; `knob`
    and `steps` what moves a mark by hand: see the verbs of `Chart`.
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
    part: Literal["", "whole", "mark", "second", "band"] = ""
    plot: "Chart | None" = None
    knob: str = ""
    steps: str = ""

    def __post_init__(self) -> None:
        check_array("Curve.x", self.x)
        check_array("Curve.y", self.y)
        good = self.x.ndim == 1 and self.x.shape == self.y.shape and len(self.x) > 0
        need(
            good,
            f"Curve.x and y are (n,), n > 0, as long as each other, not {self.x.shape} and"
            f" {self.y.shape}",
        )
        check_role(self.color)
        check_finite("Curve.x", self.x)


@dataclass(frozen=True)
class Chart:
    """A plot as it is declared once, for all that is drawn in it.

    Its verbs `whole`, `mark`, `second` and `band` draw the large chart of a story; the other ones
    draw small charts.

    Attributes:
        title: What it is called: what has the same chart shares a plot.
        x_label: What its curves run over, with the unit.
        unit: What their values are in, or the scalars of each step.
        x_range: The ends of the x axis of a large chart; None takes those of what is drawn.
        near: The ends of its x axis when a scene shows it from near.
        x_unit: What is written behind the numbers of its x axis: `deg` writes °.
        y_range: The ends of its y axis; None takes those of the whole curve and the marks.
        log: Whether the y axis of a large chart is logarithmic; what is not above zero is left out.
    """

    title: str
    x_label: str = ""
    unit: str = ""
    x_range: tuple[float, float] | None = None
    near: tuple[float, float] | None = None
    x_unit: str = ""
    y_range: tuple[float, float] | None = None
    log: bool = False

    def __post_init__(self) -> None:
        need(
            not (self.log and self.y_range) or self.y_range[0] > 0.0,
            f"Chart.y_range of logarithms is above zero, not {self.y_range}",
        )
        for name in ("x_range", "near", "y_range"):
            ends = getattr(self, name)
            need(
                ends is None or ends[0] < ends[1],
                f"Chart.{name} is (low, high), low < high, not {ends}",
            )

    def whole(self, x: np.ndarray, y: np.ndarray, name: str, color: Role = "source") -> Curve:
        """Return the whole curve y over x (n,), the landscape in which a mark moves."""
        return self._part("whole", x, y, name=name, color=color)

    def second(
        self, x: np.ndarray, y: np.ndarray, name: str, color: Role = "correspondence"
    ) -> Curve:
        """Return a second curve y over x (n,), of this step alone; it is drawn dashed."""
        return self._part("second", x, y, name=name, color=color)

    def mark(
        self,
        x: float,
        y: float,
        name: str,
        color: Role = "source",
        *,
        knob: str = "",
        steps: str = "",
    ) -> Curve:
        """Return a mark at (x, y) that moves from step to step.

        It can be dragged along the x axis where it names a knob, whose value is x, or with `steps`
        a scalar of the run whose value is x: it goes to the nearest step then.
        """
        need(not (knob and steps), "a mark is moved by a knob or by steps, not by both")
        place = np.array([float(x)]), np.array([float(y)])
        return replace(
            self._part("mark", *place, name=name, color=color), kind="dots", knob=knob, steps=steps
        )

    def band(self, low: float, high: float, name: str, color: Role = "truth") -> Curve:
        """Return a band on the x axis from low to high, such as all starts that lead home."""
        need(low < high, f"a band goes from low to high, not from {low} to {high}")
        return self._part(
            "band", np.array([float(low), float(high)]), np.zeros(2), name=name, color=color
        )

    def _part(
        self,
        part: Literal["whole", "mark", "second", "band"],
        x: np.ndarray,
        y: np.ndarray,
        *,
        name: str,
        color: Role,
    ) -> Curve:
        return Curve(x, y, name, self.title, self.x_label, self.unit, color, part=part, plot=self)

    def curve(
        self,
        x: np.ndarray,
        y: np.ndarray,
        name: str,
        color: Role = "source",
        *,
        marks: tuple[float, ...] = (),
    ) -> Curve:
        """Return y over x as a line."""
        return Curve(x, y, name, self.title, self.x_label, self.unit, color, "line", marks)

    def dots(
        self,
        x: np.ndarray,
        y: np.ndarray,
        name: str,
        color: Role = "source",
        *,
        marks: tuple[float, ...] = (),
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
        """Return how many of the values lie in each of so many bins, or between edges, as bars at
        their middles.
        """
        counts, edges = np.histogram(values, bins)
        x = (edges[1:] + edges[:-1]) / 2
        return Curve(
            x, counts.astype(float), name, self.title, self.x_label, self.unit, color, "bars", marks
        )

    def scalar(
        self, value: float, name: str, color: Role = "source", *, log: bool = False
    ) -> Scalar:
        """Return the number of this step."""
        return Scalar(value, name, self.title, self.unit, color, log)


@dataclass(frozen=True, eq=False)
class Table:
    """A small table of text beside the scene: a matrix, measured invariants. Rows have the length
    of `header`.
    """

    title: str
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    def __post_init__(self) -> None:
        need(
            all(len(row) == len(self.header) for row in self.rows),
            "every Table row is as long as the header",
        )
        for cell in (*self.header, *(cell for row in self.rows for cell in row)):
            check_text(f"each cell of the Table {self.title!r}", cell)

    @classmethod
    def of_matrix(
        cls, title: str, header: tuple[str, ...], matrix: np.ndarray, places: int = 2
    ) -> "Table":
        """Return a matrix as a table, every number with so many decimals; the header names its
        columns.
        """
        return cls(
            title, header, tuple(tuple(fixed(value, places) for value in row) for row in matrix)
        )


@dataclass(frozen=True, eq=False)
class Caption:
    """What just happened and why, with the number that changed: one or two sentences of plain text.

    `values` are the numbers in it by name, as `workbench.captions.say` keeps them. `place` names
    the step on the slider: `match`, `fit`.
    """

    text: str
    tone: Literal["info", "good", "wrong"] = "info"
    values: Mapping[str, float] = field(default_factory=dict)
    place: str = ""

    def __post_init__(self) -> None:
        check_text("Caption.text", self.text)
        need(bool(self.text.strip()), "a Caption says something")

    @classmethod
    def verdict(
        cls,
        text: str,
        *,
        right: bool,
        settled: bool = True,
        values: Mapping[str, float] | None = None,
        place: str = "",
    ) -> "Caption":
        """Return the caption of an end whose truth is known: where it is wrong, it says so behind
        the text.

        `settled` says that the method itself came to rest, so that nothing but the truth shows that
        it is wrong.
        """
        if right:
            return cls(text, "good", values or {}, place)
        wrong = "It looks settled, and it is wrong." if settled else "It is wrong."
        return cls(f"{text} {wrong}", "wrong", values or {}, place)
