"""The inputs, what is looked at, and what one step holds."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from workbench.algorithms.cameras.camera_search import Searched
from workbench.algorithms.robust import ransac
from workbench.data.framing import Frame, Up
from workbench.data.shapes.solids import Solid
from workbench.data.views.sightings import Sightings
from workbench.geometry.cameras import camera_center, normalize
from workbench.geometry.cameras.camera_motions import reprojection_errors
from workbench.geometry.motions.alignment import degrees_between
from workbench.geometry.points.metrics import rms
from workbench.knobs import Gizmo, Knob

Target = Literal["box", "marker", "street", "triangle"]
Method = Literal["P3P", "DLT", "SQPnP", "EPnP", "IPPE", "RANSAC"]
BOX, MARKER = {"target": ("box",)}, {"target": ("marker",)}
SPREAD = {"target": ("box", "street")}
GUESSED_FOCAL = 800.0  # of a person's own camera, px, as long as nobody says it
FAR_DEGREES = 5.0
NEAR_DEGREES, NEAR_SHARE = 10.0, 0.1
"""A pose counts as right within so many degrees, and with its centre within this share of its
distance.
"""


@dataclass(frozen=True)
class Params:
    """What a camera sees, with which errors, and how its place is computed from that."""

    target: Annotated[Target, Knob("What the camera looks at")] = "box"
    method: Annotated[Method, Knob("How its pose is computed")] = "P3P"
    points: Annotated[
        int,
        Knob(
            "How many points are known; of the street at most those in sight", 4, 200, needs=SPREAD
        ),
    ] = 20
    thickness: Annotated[
        float,
        Knob(
            "How thick the box is, as a share of its height; 0 is a plane",
            0,
            1,
            step=0.01,
            needs=BOX,
        ),
    ] = 1.0
    camera: Annotated[
        tuple[float, float, float],
        Knob(
            "Where the camera is; drag its handle",
            -6,
            6,
            unit="m",
            by=Gizmo(0.7),
            needs={"target": ("box", "street", "triangle")},
        ),
    ] = (1.6, -2.6, 1.8)
    distance: Annotated[
        float, Knob("How far the marker is, 0.1 m wide", 0.3, 10, unit="m", needs=MARKER)
    ] = 1.0
    tilt: Annotated[float, Knob("How far it is turned away", 0, 80, unit="deg", needs=MARKER)] = (
        40.0
    )
    f: Annotated[
        float,
        Knob(
            "Focal length of our camera",
            200,
            3000,
            unit="px",
            label="Focal length f",
            step=10,
            needs={"sightings": (None,)},
        ),
    ] = 800.0
    noise: Annotated[
        float, Knob("Noise of each pixel coordinate (sigma)", 0, 3, unit="px", step=0.1)
    ] = 1.0
    outliers: Annotated[
        float, Knob("Share of points seen somewhere else", 0, 0.8, step=0.05, needs=SPREAD)
    ] = 0.0
    origin: Annotated[
        float,
        Knob("How far off the origin of the coordinates is", 0, 1000, unit="km", needs=SPREAD),
    ] = 0.0
    centred: Annotated[
        bool,
        Knob("Take points relative to their mean first, as one should", needs={"method": ("DLT",)}),
    ] = True
    refine: Annotated[
        bool,
        Knob(
            "Gauss-Newton steps on all points afterwards",
            needs={"method": ("P3P", "DLT", "SQPnP", "EPnP", "IPPE")},
        ),
    ] = True
    inlier_pixels: Annotated[
        float,
        Knob(
            "Points seen this near to where they should be are inliers",
            0.5,
            20,
            unit="px",
            step=0.5,
            needs={"method": ("RANSAC",)},
        ),
    ] = 3.0
    sightings: Annotated[
        Path | None, Knob("Own points instead: lines of X Y Z u v, metres and pixels (txt, csv)")
    ] = None
    focal: Annotated[
        float,
        Knob(
            "Focal length of the camera that saw own points; 800 px is a guess until you give"
            " yours",
            50,
            20_000,
            unit="px",
            label="Own focal length",
            step=1,
            of_files=True,
        ),
    ] = GUESSED_FOCAL
    principal: Annotated[
        tuple[float, float],
        Knob(
            "Principal point of own pixels", 0, 10_000, unit="px", parts=("u", "v"), of_files=True
        ),
    ] = (319.5, 239.5)
    up: Annotated[Up, Knob("Which axis of own points points up", of_files=True)] = "z"
    seed: Annotated[int, Knob("Which points, which noise, which samples", 0, 99)] = 0


@dataclass(frozen=True, eq=False, kw_only=True)
class Subject:
    """What is the same in all steps of a run.

    Attributes:
        given: Points and pixels.
        K: Intrinsics of the camera.
        T_true: Its true motion, or None.
        frame: How the points stand in the picture.
        body: What is drawn of the target, in the world without its far origin; None for own points.
        photograph: Part of what the camera saw, (h, w, 3) uint8; white for own points.
        kind: What was looked at, as far as it decides how large things are drawn; own points are
            drawn as a box's.
        window: The pixels (left, top, right, bottom) that it covers.
    """

    given: Sightings
    K: np.ndarray
    T_true: np.ndarray | None
    frame: Frame
    body: Solid | None
    photograph: np.ndarray
    kind: Target
    window: np.ndarray

    @cached_property
    def xy(self) -> np.ndarray:
        """Normalised coordinates of the pixels."""
        return normalize(self.given.uv, self.K)

    @cached_property
    def p_shown(self) -> np.ndarray:
        """The points as the picture has them."""
        return self.frame.shown(self.given.p_world)

    @property
    def distance(self) -> float:
        """How far the true camera is from the middle of the points, metres."""
        assert self.T_true is not None
        return float(np.linalg.norm(camera_center(self.T_true) - self.given.p_world.mean(axis=0)))

    def pixel_errors(self, T_camera_world: np.ndarray) -> np.ndarray:
        """Return the reprojection error of each point, px."""
        return self.K[0, 0] * reprojection_errors(T_camera_world, self.given.p_world, self.xy)

    def off(self, T_camera_world: np.ndarray | None) -> tuple[float, float]:
        """Return how far a pose is from the truth, degrees and metres; NaN where one of them is not
        known.
        """
        if T_camera_world is None or self.T_true is None or not np.isfinite(T_camera_world).all():
            return np.nan, np.nan
        moved = camera_center(T_camera_world) - camera_center(self.T_true)
        return degrees_between(T_camera_world, self.T_true), float(np.linalg.norm(moved))

    def near(self, degrees: np.ndarray, metres: np.ndarray) -> np.ndarray:
        """Tell which errors are those of right poses."""
        return (degrees < NEAR_DEGREES) & (metres < NEAR_SHARE * self.distance)


@dataclass(frozen=True, eq=False)
class Repeated:
    """What became of the method in other pictures, with other noise.

    Attributes:
        Ts: The motions that were found, (k, 4, 4).
        degrees: Their rotation errors.
        metres: How far their centres are off.
        pictures: How many pictures there were; some give no motion.
        swapped: In how many pictures the wrong one of a plane's two refined motions was chosen;
            None for other methods.
        counts: How many of the random triples of points have no, one, ..., four solutions; None
            where not asked.
        anew: Rotation errors of EPnP and of SQPnP, (2, j), in pictures of as many random points;
            None where not asked.
    """

    Ts: np.ndarray
    degrees: np.ndarray
    metres: np.ndarray
    pictures: int
    swapped: int | None = None
    counts: np.ndarray | None = None
    anew: np.ndarray | None = None

    @property
    def far(self) -> tuple[float, float]:
        """In which shares of those EPnP and SQPnP are turned too far."""
        assert self.anew is not None
        epnp, sqpnp = (self.anew > FAR_DEGREES).mean(axis=1)
        return float(epnp), float(sqpnp)


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One step: what the method just did; `now` is None at the first, where nothing is known
    yet.
    """

    params: Params
    subject: Subject
    now: Searched | ransac.State | Repeated | None = None

    @cached_property
    def T(self) -> np.ndarray | None:
        """The pose in question, T_camera_world, where there is one that can be drawn."""
        match self.now:
            case Searched():
                T = self.now.T
            case ransac.State():
                T = (
                    self.now.best.estimate
                    if self.now.best and self.now.estimate is None
                    else self.now.estimate
                )
            case _:
                T = None
        return T if T is not None and np.isfinite(T).all() else None

    @cached_property
    def off(self) -> tuple[float, float]:
        """How far it is from the truth, degrees and metres."""
        return self.subject.off(self.T)

    @cached_property
    def rms(self) -> float:
        """Its root mean square error in the picture, px; infinite where a point is behind it."""
        assert self.T is not None
        return rms(self.subject.pixel_errors(self.T))

    def judged(self, T: np.ndarray) -> float:
        """Return the error by which a motion is chosen or not, px: of the fourth point, or of all
        points of a plane.
        """
        rows = slice(3, 4) if self.params.method == "P3P" else slice(None)
        return rms(self.subject.pixel_errors(T)[rows])

    @property
    def right(self) -> bool:
        """Whether it is right, as far as the truth is known."""
        return self.subject.T_true is not None and bool(
            self.subject.near(*map(np.asarray, self.off))
        )
