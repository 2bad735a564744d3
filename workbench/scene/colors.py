"""What colours mean: one role, one colour in all lessons; numbers by a colour map, classes by
roles.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from workbench.scene.checks import check_array, need

Role: TypeAlias = Literal[
    "target",
    "source",
    "correspondence",
    "truth",
    "wrong",
    "highlight",
    "neutral",
    "other",
    "x",
    "y",
    "z",
]

PALETTE: Mapping[Role, tuple[int, int, int]] = {
    "target": (0, 114, 178),  # blue: target, reference
    "source": (230, 159, 0),  # orange: source, estimate
    "correspondence": (153, 153, 153),  # grey
    "truth": (0, 158, 115),  # green
    "wrong": (213, 94, 0),  # vermillion: wrong, outlier
    "highlight": (204, 121, 167),  # purple
    "neutral": (110, 118, 129),  # things without a part in the story
    "other": (86, 180, 233),  # sky blue: one more curve
    "x": (213, 94, 0),
    "y": (0, 158, 115),
    "z": (0, 114, 178),
}

UNKNOWN = (128, 128, 128)
"""The grey of what a Field does not know."""
_VIRIDIS = (
    "440154",
    "472d7b",
    "3b528b",
    "2c728e",
    "21918c",
    "28ae80",
    "5dc863",
    "addc30",
    "fde725",
)
_DIVERGING = ("0072b2", "6baed0", "f4f4f4", "eba273", "d55e00")


@dataclass(frozen=True, eq=False)
class Field:
    """A number per point, vertex or pixel, shown by a colour map that has a bar with its unit.

    Args:
        values: (n,) or (h, w). NaN means unknown and is drawn in grey.
        low: The lower end of the colour bar; values below are clipped.
        high: Its upper end.
        map: `viridis` for magnitudes; `diverging` for signed quantities, where low must be -high.
    """

    values: np.ndarray
    low: float
    high: float
    title: str
    unit: str = ""
    map: Literal["viridis", "diverging"] = "viridis"

    def __post_init__(self) -> None:
        check_array("Field.values", self.values)
        need(
            bool(np.isfinite([self.low, self.high]).all()) and self.low < self.high,
            "a Field needs low < high, finite",
        )
        if self.map == "diverging":
            need(
                bool(np.isclose(self.low, -self.high)),
                "a diverging Field has zero in the middle: low = -high",
            )

    @classmethod
    def magnitude(
        cls, values: np.ndarray, title: str, unit: str = "", *, percent: float = 95.0
    ) -> "Field":
        """Return sizes from zero to where so many per cent of the known values are reached, so that
        a few do not pale all.

        The bar ends at 1 where no value is known, and never at 0.
        """
        known = values[np.isfinite(values)]
        top = float(np.percentile(known, percent)) if known.size else 1.0
        return cls(values, 0.0, max(top, 1e-6), title, unit)

    def rgb(self) -> np.ndarray:
        """Return the colours, uint8, one more axis of length 3 than `values`."""
        known = np.isfinite(self.values)
        level = np.where(known, (self.values - self.low) / (self.high - self.low), 0.0)
        colors = color_map(self.map, level)
        colors[~known] = UNKNOWN
        return colors


@dataclass(frozen=True, eq=False)
class Classes:
    """A class per point: `ids` (n,) index into `roles`, each with its name in the legend."""

    ids: np.ndarray
    roles: tuple[Role, ...]
    names: tuple[str, ...]

    def __post_init__(self) -> None:
        need(len(self.roles) == len(self.names) > 0, "Classes needs one name per role")
        check_array("Classes.ids", self.ids)
        need(self.ids.dtype.kind in "iub", "Classes.ids are whole numbers")
        need(
            self.ids.size == 0 or int(self.ids.max()) < len(self.roles),
            "a class id is beyond the roles",
        )

    @classmethod
    def marking(
        cls, marked: np.ndarray, role: Role, name: str, *, others: tuple[Role, str]
    ) -> "Classes":
        """Return two classes: the items that are `marked` (n,) bool, and the others, with their
        role and name.
        """
        return cls(marked.astype(np.uint8), (others[0], role), (others[1], name))

    def present(self) -> list[tuple[Role, str]]:
        """Return role and name of each class that some item has."""
        counts = np.bincount(self.ids.astype(np.intp).ravel(), minlength=len(self.roles))
        return [
            (role, name)
            for role, name, count in zip(self.roles, self.names, counts, strict=True)
            if count
        ]

    def rgb(self) -> np.ndarray:
        """Return (n, 3) uint8 colours."""
        return np.array([PALETTE[role] for role in self.roles], np.uint8)[self.ids.astype(int)]


Color: TypeAlias = Role | Field | Classes | np.ndarray


def color_map(name: Literal["viridis", "diverging"], level: np.ndarray) -> np.ndarray:
    """Return uint8 colours (..., 3) for levels from 0 to 1, clipped.

    Reference: viridis after van der Walt and Smith (2015), at nine stops; the diverging map joins
    the palette's blue and vermillion through near-white.
    """
    stops = np.array(
        [
            [int(code[i : i + 2], 16) for i in (0, 2, 4)]
            for code in (_VIRIDIS if name == "viridis" else _DIVERGING)
        ]
    )
    at = np.clip(level, 0.0, 1.0) * (len(stops) - 1)
    return (
        np.stack([np.interp(at, np.arange(len(stops)), stops[:, i]) for i in range(3)], -1)
        .round()
        .astype(np.uint8)
    )


def color_rows(color: Color, n: int) -> np.ndarray:
    """Return (n, 3) uint8 colours of n items."""
    if isinstance(color, str):
        return np.broadcast_to(np.array(PALETTE[color], np.uint8), (n, 3))
    return color if isinstance(color, np.ndarray) else color.rgb()


def check_role(role: object) -> None:
    """Refuse what is no role of the palette."""
    need(role in PALETTE, f"unknown colour role {role!r}: one of {', '.join(PALETTE)}")
