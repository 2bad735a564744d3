"""The inputs, and what one step holds."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Annotated

import numpy as np

from workbench.algorithms.two_views import Followed, Related, Route
from workbench.certain import sure
from workbench.data.views.two_views import LARGEST, TwoViews, What
from workbench.geometry.cameras import project
from workbench.geometry.motions import angle_between, motion
from workbench.geometry.motions.alignment import degrees_between
from workbench.geometry.points.metrics import rms
from workbench.geometry.two_views.epipolar import sampson_distances
from workbench.geometry.two_views.homography import transform_pixels
from workbench.geometry.two_views.triangulation import camera_matrix, triangulation_covariances
from workbench.knobs import Knob, Pick

MOST_MATCHES = 1500  # of a person's file
GOOD_TURN, GOOD_DIRECTION = 1.0, 5.0  # degrees within which a pose is called right


@dataclass(frozen=True)
class Params:
    """Two cameras, the matches between their pictures, and what is made of them."""

    scene: Annotated[
        What, Knob("What is seen: a street, its level ground alone, or a city from a hill")
    ] = "street"
    baseline: Annotated[
        float,
        Knob(
            "How far the second camera stands from the first; 0: it only turned",
            0,
            2,
            unit="m",
            step=0.01,
        ),
    ] = 1.0
    heading: Annotated[
        float,
        Knob(
            "Where it stands: 0 right of the first, 90 ahead of it, 180 left of it",
            0,
            180,
            unit="deg",
            step=1,
        ),
    ] = 20.0
    matches: Annotated[int, Knob("How many matches there are", 8, 500)] = 60
    noise: Annotated[
        float, Knob("Noise of each number of a match (sigma)", 0, 3, unit="px", step=0.05)
    ] = 0.5
    normalise: Annotated[
        bool, Knob("Centre and scale the pixels before the equations are solved")
    ] = True
    rank_two: Annotated[bool, Knob("Drop the smallest singular value of F")] = True
    route: Annotated[Route, Knob("What is refined until the lines are as near as they can be")] = (
        "refined pose"
    )
    f_error: Annotated[
        float,
        Knob(
            "How wrong the focal length is that one believes in",
            -20,
            20,
            unit="%",
            step=1,
            label="f wrong by",
        ),
    ] = 0.0
    keep_upright: Annotated[
        bool, Knob("Rectify along the mean x axis of the cameras, whoever is left")
    ] = True
    pixel: Annotated[
        tuple[int, int],
        Knob(
            "The pixel (u, v) that is followed: click the first picture",
            0,
            LARGEST - 1,
            unit="px",
            by=Pick("first/picture"),
        ),
    ] = (318, 119)
    own_matches: Annotated[
        Path | None, Knob("Own matches: npz (x1, x2; K; R, t if known) or lines of u v u' v'")
    ] = None
    first_image: Annotated[Path | None, Knob("The first image of own matches, to be shown")] = None
    second_image: Annotated[Path | None, Knob("Their second image")] = None
    intrinsics: Annotated[
        Path | None, Knob("K of both cameras, a text file: fx fy cx cy, or three rows")
    ] = None
    seed: Annotated[int, Knob("Which points are matched, and their noise", 0, 99)] = 0


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One step of the lesson.

    Attributes:
        params: The inputs.
        views: Both pictures and their matches.
        uv_first: The followed pixel, of the first picture.
        K_first, K_second: The intrinsics that one believes in.
        length: Metres that a baseline of 1 is drawn with: no picture tells.
        T_true: The true motion T_second_first with that length, where it is known.
        now: What was just done.
        last: Whether the run ends here.
    """

    params: Params
    views: TwoViews
    uv_first: np.ndarray
    K_first: np.ndarray
    K_second: np.ndarray
    length: float
    T_true: np.ndarray | None
    now: Followed | Related
    last: bool = False

    @property
    def T_second_first(self) -> np.ndarray | None:
        """The estimated motion, its translation as long as it is drawn."""
        T = self.now.T_second_first if isinstance(self.now, Related) else None
        return None if T is None else motion(T[:3, :3], self.length * T[:3, 3])

    @property
    def moved(self) -> bool:
        """Whether a baseline is there to be found, as far as one knows."""
        return self.T_true is None or bool(np.any(self.T_true[:3, 3]))

    @cached_property
    def parallax(self) -> float:
        """How far points are seen from where they would be infinitely far away: the median, pixels;
        NaN if not known.
        """
        p = self.views.p_first
        T = self.T_true
        if p is None or T is None:
            return float("nan")
        seen, at_infinity = (
            project(p, motion(T[:3, :3], t), self.views.K_second) for t in (T[:3, 3], np.zeros(3))
        )
        return float(np.median(np.linalg.norm(seen - at_infinity, axis=1)))

    @cached_property
    def turn_error(self) -> float:
        """How far the rotation is from the true one, degrees; NaN where nothing is to compare."""
        T, true = self.T_second_first, self.T_true
        return float("nan") if T is None or true is None else degrees_between(T, true)

    @cached_property
    def direction_error(self) -> float:
        """How far the direction of the translation is from the true one, degrees; NaN also where
        nothing moved.
        """
        T, true = self.T_second_first, self.T_true
        if T is None or true is None or not self.moved:
            return float("nan")
        return float(np.degrees(angle_between(T[:3, 3], true[:3, 3])))

    @cached_property
    def right(self) -> bool | None:
        """Whether the pose is right, None where nobody knows: within 1 degree, and its direction
        within 5.
        """
        if np.isnan(self.turn_error):
            return None
        return self.moved and self.turn_error < GOOD_TURN and self.direction_error < GOOD_DIRECTION

    def depth_sigma(self, p_first: np.ndarray) -> np.ndarray:
        """Return how uncertain the noise of the pixels makes the depths of points, metres, through
        the true cameras.
        """
        Ps = (
            camera_matrix(self.views.K_first, np.eye(4)),
            camera_matrix(self.views.K_second, sure(self.T_true)),
        )
        return np.sqrt(triangulation_covariances(*Ps, p_first, sigma=self.params.noise)[:, 2, 2])

    def to_lines(self, matches: np.ndarray) -> float:
        """Return the root mean square distance of matches to the lines of F, pixels; NaN where
        there is no F or no match.
        """
        if not isinstance(self.now, Related) or not len(matches):
            return float("nan")
        return rms(sampson_distances(self.now.F, matches[:, :2], matches[:, 2:]))

    @cached_property
    def disparities(self) -> np.ndarray | None:
        """The matches' differences (u - u', v - v') after rectification, pixels; None before."""
        rectification = self.now.rectification if isinstance(self.now, Related) else None
        if rectification is None:
            return None
        uv = self.views.matches
        return transform_pixels(rectification.H_first, uv[:, :2]) - transform_pixels(
            rectification.H_second, uv[:, 2:]
        )
