"""The inputs, the rows to fit with what is true of them, and what one step holds."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from workbench.algorithms.robust import ransac
from workbench.algorithms.robust.models import Model, rms_distance
from workbench.algorithms.robust.samplers import termination_length
from workbench.data.framing import Unit, Up
from workbench.knobs import Knob, Pick

ModelName = Literal["line", "plane", "circle", "sphere", "homography", "fundamental matrix"]
Table = Literal["alone", "beside a wall", "with a wire"]
ScoreName = Literal["count", "MSAC", "MLESAC"]
SamplerName = Literal["uniform", "PROSAC"]
Steps = Literal["every part", "every sample", "improvements"]

MOST_POINTS = 5000
IN_METRES = {"model": ("line", "plane", "circle", "sphere")}
OF_A_CLOUD = {"model": ("plane", "sphere")}
IN_PIXELS = {"model": ("homography", "fundamental matrix")}


@dataclass(frozen=True)
class Params:
    """Points with outliers, a model to fit, and how RANSAC looks for it."""

    model: Annotated[
        ModelName, Knob("What is fitted; the last two to matches between two images")
    ] = "plane"
    table: Annotated[
        Table, Knob("What stands beside the plane's points", needs={"model": ("plane",)})
    ] = "alone"
    points: Annotated[
        int, Knob("Points or matches of the built-in scene", 50, MOST_POINTS, step=50)
    ] = 600
    outliers: Annotated[float, Knob("Share of them that belongs to nothing", 0, 0.9, step=0.05)] = (
        0.5
    )
    noise: Annotated[
        float,
        Knob("Noise of each coordinate (sigma)", 0, 0.05, unit="m", step=0.001, needs=IN_METRES),
    ] = 0.015
    inlier_distance: Annotated[
        float,
        Knob(
            "Points this near to a model vote for it",
            0.001,
            0.5,
            unit="m",
            step=0.001,
            needs=IN_METRES,
        ),
    ] = 0.03
    noise_pixels: Annotated[
        float,
        Knob("Noise of each pixel of a match (sigma)", 0, 5, unit="px", step=0.1, needs=IN_PIXELS),
    ] = 1.0
    inlier_pixels: Annotated[
        float,
        Knob(
            "Matches this near to a model vote for it; 95 % of the true ones lie within 3.46 sigma"
            " for a homography, within 1.96 sigma for a fundamental matrix",
            0.1,
            30,
            unit="px",
            step=0.1,
            needs=IN_PIXELS,
        ),
    ] = 3.5
    score: Annotated[
        ScoreName, Knob("How good a candidate is, from the distances of all points")
    ] = "count"
    sampler: Annotated[SamplerName, Knob("By chance alone, or the most trusted points first")] = (
        "uniform"
    )
    confidence: Annotated[
        float,
        Knob(
            "With which probability one sample at least is free of outliers", 0.5, 0.999, step=0.001
        ),
    ] = 0.99
    most_samples: Annotated[int, Knob("Samples drawn at most", 1, 2000)] = 500
    local_refit: Annotated[
        bool, Knob("Refit every new best at once, not only the last (LO-RANSAC)")
    ] = False
    steps: Annotated[
        Steps, Knob("What becomes a step; the first three samples show every part")
    ] = "every sample"
    sample: Annotated[
        tuple[int, int, int, int],
        Knob(
            "Your own first sample: click points; the last clicks count, -1 is none",
            -1,
            MOST_POINTS - 1,
            by=Pick("points"),
        ),
    ] = (-1, -1, -1, -1)
    cloud: Annotated[
        Path | None,
        Knob("Own cloud for a plane or a sphere: ply, pcd, obj, xyz, csv, npz", needs=OF_A_CLOUD),
    ] = None
    cloud_unit: Annotated[
        Unit, Knob("In which unit the numbers of an own cloud are", of_files=True)
    ] = "m"
    up: Annotated[Up, Knob("Which axis of an own cloud points up", of_files=True)] = "z"
    matches: Annotated[
        Path | None,
        Knob("Own matches: npz (x1, x2; F or H if known) or lines of u v u' v'", needs=IN_PIXELS),
    ] = None
    first_image: Annotated[
        Path | None, Knob("The first image of own matches, to be shown", needs=IN_PIXELS)
    ] = None
    second_image: Annotated[Path | None, Knob("Their second image", needs=IN_PIXELS)] = None
    scene_seed: Annotated[int, Knob("Which scene: where its points and outliers are", 0, 99)] = 0
    seed: Annotated[int, Knob("Which samples chance draws", 0, 99)] = 0


@dataclass(frozen=True, eq=False, kw_only=True)
class Subject:
    """The rows of a run, and how they are shown.

    Attributes:
        model: What is fitted.
        p: The rows: points in metres, or matches in pixels.
        truth: The true parameters, where known.
        p_true: Rows free of noise that truly belong to the model, where known; else none.
        is_inlier: Which rows were made from the model, where known.
        quality: How much each row is trusted, where known.
        low, high: The ends of the window in which models are drawn, in the unit of the rows.
        places: For each half of a row that is a point (one, or two for a match), where it stands in
            the picture.
        sizes: Of the two images, pixels; for matches only.
        images: The images themselves, where the person gave them.
        noun: What a row is called.
    """

    model: Model
    p: np.ndarray
    truth: np.ndarray | None = None
    p_true: np.ndarray
    is_inlier: np.ndarray | None = None
    quality: np.ndarray | None = None
    low: np.ndarray
    high: np.ndarray
    places: tuple[Callable[[np.ndarray], np.ndarray], ...]
    sizes: tuple[np.ndarray, ...] = ()
    images: tuple[np.ndarray | None, ...] = (None, None)
    noun: str = "points"

    @cached_property
    def shown(self) -> tuple[np.ndarray, ...]:
        """The rows as points of the picture, (n, 3); for matches one array per image."""
        d = self.p.shape[1] // len(self.places)
        return tuple(place(self.p[:, k * d : (k + 1) * d]) for k, place in enumerate(self.places))

    def most_trusted(self, fit: ransac.Fit) -> tuple[int, float]:
        """Return among how many of the most trusted rows a fit has the largest share of votes, and
        this share.
        """
        assert self.quality is not None
        return termination_length(fit.inliers, self.quality, self.model.sample_size)

    def error(self, estimate: np.ndarray | None) -> float:
        """Return the root mean square distance of the noiseless rows to an estimate; NaN where that
        is not known.
        """
        if estimate is None or not len(self.p_true):
            return float("nan")
        return rms_distance(self.model, estimate, self.p_true)


@dataclass(frozen=True, eq=False)
class Rival:
    """What a method that uses all rows at once makes of them.

    Attributes:
        name: Least squares, or Huber's loss.
        estimate: Its answer.
        error: To the truth, in the unit of the model; NaN where that is not known.
    """

    name: str
    estimate: np.ndarray
    error: float


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One step: what RANSAC just did, and how far its best is from the truth.

    Attributes:
        params: The inputs.
        subject: The rows, the same for the whole run.
        now: What RANSAC yielded.
        inlier_distance: In the unit of the model.
        best_error: Of the best so far to the truth; NaN where there is none or the truth is not
            known.
        chosen: Whether the sample was picked by the person.
        rivals: Least squares and Huber, over all rows.
        before: The best one step earlier, if any: what a new best or a refit replaced.
        degenerate: How many samples determined no model so far.
    """

    params: Params
    subject: Subject
    now: ransac.State
    inlier_distance: float
    best_error: float
    chosen: bool
    rivals: tuple[Rival, ...]
    before: ransac.Fit | None
    degenerate: int
