"""The inputs of the lesson."""

from pathlib import Path
from typing import Literal

from workbench.data.framing import Unit, Up
from workbench.lesson import Params, Pick, knob

MOST_POINTS = 5000
OF_A_CLOUD = {"stage": ("search",), "model": ("plane", "sphere")}
OF_MATCHES = {"stage": ("search",), "model": ("homography", "fundamental matrix")}


class Input(Params):
    """Points, some of which belong to a model, and how RANSAC looks for it."""

    stage: Literal["search", "draws", "band", "fan"] = knob(
        "search", "RANSAC; or a line in the flat: pairs drawn, the band widened, the noise redrawn"
    )
    model: Literal["line", "plane", "circle", "sphere", "homography", "fundamental matrix"] = knob(
        "plane", "What is fitted; the last two to matches between two images"
    )
    table: Literal["alone", "beside a wall", "with a wire"] = knob(
        "alone", "What stands beside the plane's points"
    )
    wall: float = knob(
        2.0, "How many times as many points the wall has", 0.5, 3.0, unit="×", step=0.1
    )
    taken: int = knob(0, "How many winners' voters are taken away before the run", 0, 2)
    points: int = knob(600, "Points or matches of the built-in scene", 50, MOST_POINTS, step=10)
    outliers: float = knob(0.5, "Share of them that belongs to nothing", 0, 0.9, step=0.05)
    noise: float = knob(0.015, "Noise of each coordinate (sigma)", 0, 0.05, unit="m", step=0.001)
    inlier_distance: float = knob(
        0.03, "Points this near to a model vote for it", 0.001, 0.5, unit="m", step=0.001
    )
    noise_pixels: float = knob(
        1.0, "Noise of each pixel of a match (sigma)", 0, 5, unit="px", step=0.1
    )
    inlier_pixels: float = knob(
        3.5,
        "Matches this near to a model vote for it; 95 % of the true ones lie within 3.46 sigma for"
        " a homography, within 1.96 sigma for a fundamental matrix",
        0.1,
        30,
        unit="px",
        step=0.1,
    )
    score: Literal["count", "MSAC", "MLESAC"] = knob(
        "count", "How good a candidate is, from the distances of all points"
    )
    sampler: Literal["uniform", "PROSAC"] = knob(
        "uniform", "By chance alone, or the most trusted points first"
    )
    confidence: float = knob(
        0.99, "With which probability one sample at least is clean", 0.5, 0.999, step=0.001
    )
    most_samples: int = knob(500, "Samples drawn at most", 2, 2000)
    local_refit: bool = knob(False, "Refit every new best at once, not only the last (LO-RANSAC)")
    steps: Literal["every part", "every sample", "improvements"] = knob(
        "every sample", "What becomes a step; the first three samples show every part"
    )
    who_is_right: bool = knob(
        False, "Show who is right: a ring around each point of the true model"
    )
    sample: tuple[int, int, int, int] = knob(
        (-1, -1, -1, -1),
        "Your own first sample: click points; the last clicks count, -1 is none",
        -1,
        MOST_POINTS - 1,
        by=Pick("points"),
    )
    cloud: Path | None = knob(
        None,
        "Own cloud for a plane or a sphere: ply, pcd, obj, xyz, csv, npz",
        read_with=OF_A_CLOUD,
    )
    cloud_unit: Unit = knob("m", "In which unit the numbers of an own cloud are", of_files=True)
    up: Up = knob("z", "Which axis of an own cloud points up", of_files=True)
    matches: Path | None = knob(
        None,
        "Own matches: npz (x1, x2; F or H if known) or lines of u v u' v'",
        read_with=OF_MATCHES,
    )
    first_image: Path | None = knob(
        None, "The first image of own matches, to be shown", read_with=OF_MATCHES
    )
    second_image: Path | None = knob(None, "Their second image", read_with=OF_MATCHES)
    scene_seed: int = knob(0, "Which scene: where its points and outliers are", 0, 99)
    seed: int = knob(0, "Which samples chance draws", 0, 99)
