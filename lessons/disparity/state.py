"""The inputs, the pair of pictures that a run starts from, and one step from them to depths."""

import functools
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from workbench.algorithms.stereo.cost_volume import census_cost_volume
from workbench.algorithms.stereo.disparity import Stage
from workbench.algorithms.stereo.disparity_map import agree, seen_from_right, winner_takes_all
from workbench.data.views.stereo import StereoPair
from workbench.errors import InputError
from workbench.knobs import Knob, Pick

Scene = Literal[
    "spheres",
    "planes",
    "posts",
    "plain wall",
    "repeated pattern",
    "boards at three depths",
    "Motorcycle",
]
MADE = ("spheres", "planes", "posts", "plain wall", "repeated pattern", "boards at three depths")
Cost = Literal["SAD", "SSD", "census", "NCC"]
Mistake = Literal[
    "none", "pictures exchanged", "rows off by 2 px", "right picture darker", "f not rescaled"
]


@dataclass(frozen=True)
class Params:
    """A pair of pictures, how it is matched, and the pixel that is followed."""

    scene: Annotated[Scene, Knob("What the two cameras look at; the motorcycle is real")] = (
        "spheres"
    )
    cost: Annotated[Cost, Knob("How two windows are compared")] = "SAD"
    window: Annotated[
        int, Knob("Side of the window over which costs are summed", 1, 21, unit="px", step=2)
    ] = 3
    smoothness: Annotated[
        float,
        Knob(
            "What a jump between neighbours costs, in usual matching costs; 0 leaves the paths out",
            0,
            4,
            step=0.1,
        ),
    ] = 1.0
    max_disparity: Annotated[int, Knob("Largest shift that is tried", 3, 127, unit="px")] = 31
    baseline: Annotated[
        float,
        Knob(
            "Distance between the cameras", 0.02, 0.5, unit="m", step=0.005, needs={"scene": MADE}
        ),
    ] = 0.1
    focal_length: Annotated[
        float, Knob("Focal length", 50, 8000, unit="px", step=10, needs={"scene": MADE})
    ] = 150.0
    noise: Annotated[
        float,
        Knob(
            "Noise of both sensors, in grey levels of 255", 0, 40, step=0.5, needs={"scene": MADE}
        ),
    ] = 4.0
    disparity_error: Annotated[
        float,
        Knob("Added to every disparity before it becomes a depth", -3, 3, unit="px", step=0.25),
    ] = 0.0
    mistake: Annotated[Mistake, Knob("A classic mistake on the way; the scene stays true")] = "none"
    pixel: Annotated[
        tuple[int, int],
        Knob(
            "The left pixel (u, v) that is followed: click the left picture",
            0,
            639,
            unit="px",
            by=Pick("left/picture"),
        ),
    ] = (54, 80)
    shrink: Annotated[
        int,
        Knob(
            "Average blocks of k × k pixels first (motorcycle and own pairs)",
            1,
            16,
            label="Shrink k times",
            of_files=True,
        ),
    ] = 4
    doffs: Annotated[
        float,
        Knob(
            "Right minus left principal point, in pixels of the files (own pairs)",
            -500,
            500,
            unit="px",
            label="doffs",
            of_files=True,
        ),
    ] = 0.0
    own_focal_length: Annotated[
        float,
        Knob(
            "Focal length of an own pair, in pixels of its files; 0: not known, so no metres",
            0,
            20000,
            unit="px",
            of_files=True,
        ),
    ] = 0.0
    own_baseline: Annotated[
        float,
        Knob(
            "Distance between the cameras of an own pair; 0: not known, so no metres",
            0,
            100,
            unit="m",
            step=0.001,
            of_files=True,
        ),
    ] = 0.0
    left: Annotated[Path | None, Knob("An own left picture, rectified; give both")] = None
    right: Annotated[Path | None, Knob("An own right picture of the same size")] = None
    seed: Annotated[int, Knob("Which textures and which noise", 0, 99, needs={"scene": MADE})] = 0

    def __post_init__(self) -> None:
        if self.window % 2 == 0:
            raise InputError(
                f"window = {self.window}: a window has a middle pixel, so its side is odd"
            )


@dataclass(frozen=True, eq=False, kw_only=True)
class Setup:
    """What stays the same for the length of a run.

    Args:
        params: What was asked for.
        pair: The pictures as they are matched, and the truth about the left one.
        left, right: Their brightness, 0 .. 255.
        f: The focal length with which depths are made: the camera's, but for the mistake of not
            rescaling it.
        pixel: The pixel (u, v) that is followed, inside the picture.
        max_disparity: The largest that is tried: below the width of the pictures.
        far: Depth up to which things are drawn, metres.
        metric: Whether the cameras are known. Where they are not, the pair's camera is made up:
            nothing is in metres.
    """

    params: Params
    pair: StereoPair
    left: np.ndarray
    right: np.ndarray
    f: float
    pixel: tuple[int, int]
    max_disparity: int
    far: float
    metric: bool = True

    @functools.cached_property
    def true_depth(self) -> np.ndarray:
        """The true depth of every left pixel, metres: infinite where nothing shifts, NaN where the
        truth is not known.
        """
        true = self.pair.disparity
        return np.full(self.left.shape, np.nan) if true is None else self.pair.camera.depth(true)

    @property
    def scale(self) -> float:
        """How large the scene is drawn: all there is to see fits the same stage, whatever its
        depth.
        """
        return 2.3 / self.far

    @functools.cached_property
    def agreeing(self) -> tuple[float, float]:
        """The share of left pixels whose partners choose them back; and the same with the pictures
        exchanged.

        By census, on one row in four.
        """
        left, right = self.left[::4], self.right[::4]
        return _agreeing(left, right, self.max_disparity), _agreeing(
            right, left, self.max_disparity
        )

    @property
    def seem_exchanged(self) -> bool:
        """Whether clearly more pixels find each other with left and right exchanged."""
        as_given, exchanged = self.agreeing
        return exchanged > as_given + 0.07


def _agreeing(left: np.ndarray, right: np.ndarray, max_disparity: int) -> float:
    cost = census_cost_volume(left, right, max_disparity, 3)
    winner, back = (
        winner_takes_all(volume).astype(int) for volume in (cost, seen_from_right(cost))
    )
    return float(agree(winner, back).mean())


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One step.

    Args:
        setup: The pair and the knobs.
        stage: What was just done to the map; None once it became depths.
        disparity: The map, pixels, NaN where unknown.
        depth: The depth it stands for, metres.
        costs: The costs of the followed pixel by disparity, NaN beyond what was compared.
        piece: The last slice of the cost volume, while comparing.
        done: Disparities compared, or directions added.
        direction: (rows down, columns right) of the direction added.
        jumps: P1 and P2.
        lowest: Mean of the lowest cost per pixel, while comparing.
        energy: E(D) per pixel; NaN while comparing.
        wrong: Share of the pixels that both cameras see whose disparity is over 1 px off; NaN
            without truth.
        error: Mean error of the others, pixels; NaN without truth.
        unknown: Share of pixels without a disparity.
        uncertainty: How far `disparity_error` moves each depth, metres, in the last step.
        disparity_error: The error of a disparity for which that is, pixels.
        before: The step before.
    """

    setup: Setup
    stage: Stage | None
    disparity: np.ndarray
    depth: np.ndarray
    costs: np.ndarray
    piece: np.ndarray | None
    done: int
    direction: tuple[int, int] | None
    jumps: tuple[float, float]
    lowest: float
    energy: float
    wrong: float
    error: float
    unknown: float
    uncertainty: np.ndarray | None = None
    disparity_error: float = 0.0
    before: "Figures | None" = None

    @property
    def chosen(self) -> float:
        """The disparity of the followed pixel, NaN where it is unknown."""
        u, v = self.setup.pixel
        return float(self.disparity[v, u])


@dataclass(frozen=True, kw_only=True)
class Figures:
    """The numbers of a step that the next one is compared with."""

    wrong: float
    error: float
    unknown: float
    energy: float
