"""The inputs of the RANSAC lesson."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

from workbench.knobs import Knob, Pick

ModelName = Literal["line", "plane", "circle", "sphere", "homography", "fundamental matrix"]
Table = Literal["alone", "beside a wall", "with a wire"]
ScoreName = Literal["count", "MSAC", "MLESAC"]
SamplerName = Literal["uniform", "PROSAC"]
Steps = Literal["every part", "every sample", "improvements"]
Up = Literal["z", "y", "-y"]
CloudUnit = Literal["mm", "cm", "m", "km"]

MOST_POINTS = 5000


@dataclass(frozen=True)
class Params:
    """Points with outliers, a model to fit, and how RANSAC looks for it."""

    model: Annotated[ModelName, Knob("What is fitted; the last two to matches between two images")] = "plane"
    table: Annotated[Table, Knob("What stands beside the plane's points")] = "alone"
    points: Annotated[int, Knob("Points or matches of the built-in scene", 50, MOST_POINTS, step=50)] = 600
    outliers: Annotated[float, Knob("Share of them that belongs to nothing", 0, 0.9, step=0.05)] = 0.5
    noise: Annotated[float, Knob("Noise of each coordinate (sigma)", 0, 0.05, unit="m", step=0.001)] = 0.015
    inlier_distance: Annotated[
        float, Knob("Points this near to a model are its inliers", 0.001, 0.5, unit="m", step=0.001)
    ] = 0.03
    noise_pixels: Annotated[float, Knob("Noise of each pixel of a match (sigma)", 0, 5, unit="px", step=0.1)] = 1.0
    inlier_pixels: Annotated[
        float,
        Knob("Matches this near to a model are its inliers; 95 % lie within 3.46 sigma for a homography, within 1.96 sigma"
             " for a fundamental matrix", 0.1, 30, unit="px", step=0.1),
    ] = 3.5  # fmt: skip
    score: Annotated[ScoreName, Knob("How good a candidate is, from the distances of all points")] = "count"
    sampler: Annotated[SamplerName, Knob("By chance alone, or the most trusted points first")] = "uniform"
    confidence: Annotated[
        float, Knob("With which probability one sample at least is free of outliers", 0.5, 0.999, step=0.001)
    ] = 0.99
    most_samples: Annotated[int, Knob("Samples drawn at most", 1, 2000)] = 500
    local_refit: Annotated[bool, Knob("Refit every new best at once, not only the last (LO-RANSAC)")] = False
    steps: Annotated[Steps, Knob("What becomes a step; the first three samples show every part")] = "every sample"
    sample: Annotated[
        tuple[int, int, int, int],
        Knob("Your own first sample: click points; the last clicks count, -1 is none", -1, MOST_POINTS - 1,
             by=Pick("points")),
    ] = (-1, -1, -1, -1)  # fmt: skip
    cloud: Annotated[Path | None, Knob("Own cloud for a plane or a sphere: ply, pcd, obj, xyz, csv, npz")] = None
    cloud_unit: Annotated[CloudUnit, Knob("In which unit the numbers of an own cloud are")] = "m"
    up: Annotated[Up, Knob("Which axis of an own cloud points up")] = "z"
    matches: Annotated[Path | None, Knob("Own matches: npz (x1, x2; F or H if known) or lines of u v u' v'")] = None
    first_image: Annotated[Path | None, Knob("The first image of own matches, to be shown")] = None
    second_image: Annotated[Path | None, Knob("Their second image")] = None
    scene_seed: Annotated[int, Knob("Which scene: where its points and outliers are", 0, 99)] = 0
    seed: Annotated[int, Knob("Which samples chance draws", 0, 99)] = 0
