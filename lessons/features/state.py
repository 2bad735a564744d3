"""The inputs, the two scans, pictures or outlines, and what one step holds."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from workbench.data.framing import Up
from workbench.data.scan_pairs import Scans
from workbench.geometry.features.matching import Filter
from workbench.geometry.features.sift import Sift
from workbench.geometry.motions.alignment import MotionError
from workbench.knobs import Knob, Pick

Part = Literal["scans", "pictures", "outlines"]
Shape = Literal["rabbit", "vase", "corner"]
Facing = Literal["outwards", "source flipped", "random in source", "random in both"]
Compare = Literal["plain", "square root"]
Where = Literal["every point", "ISS keypoints"]
Angles = Literal["along the outline", "from the x axis"]
Describe = Literal["patches", "SIFT"]
SCANS, PICTURES, OUTLINES = ({"part": (part,)} for part in ("scans", "pictures", "outlines"))
PATCHES = PICTURES | {"describe": ("patches",)}
RIGHT, INLIER, HOME_DEGREES = 0.05, 0.04, 4.0  # metres, metres, degrees
PIXELS = 3.0  # within which a match of pictures is right
STEPS_ALONG = 2  # within which a match of outlines is right


@dataclass(frozen=True)
class Params:
    """What is described, how it is compared, and which matches are kept."""

    part: Annotated[
        Part, Knob("What is found again: points of scans, corners of pictures, points of outlines")
    ] = "scans"
    shape: Annotated[
        Shape, Knob("The built-in shape: without symmetry, turning, or sliding", needs=SCANS)
    ] = "rabbit"
    turn: Annotated[
        float,
        Knob(
            "How far the built-in source, the right picture or the second outline is turned",
            0,
            180,
            unit="deg",
            step=1,
        ),
    ] = 140.0
    overlap: Annotated[
        float, Knob("Share of the source that the target saw too", 0.4, 1, step=0.05, needs=SCANS)
    ] = 0.8
    noise: Annotated[
        float, Knob("Noise of each coordinate", 0, 0.01, unit="m", step=0.001, needs=SCANS)
    ] = 0.002
    points: Annotated[
        int, Knob("Points of each built-in scan", 400, 4000, step=100, needs=SCANS)
    ] = 2000
    radius: Annotated[
        float, Knob("Of a neighbourhood", 0.04, 0.4, unit="m", step=0.01, needs=SCANS)
    ] = 0.15
    normals: Annotated[Facing, Knob("Which side normals face", needs=SCANS)] = "outwards"
    where: Annotated[Where, Knob("Which points are matched", needs=SCANS)] = "every point"
    compare: Annotated[
        Compare, Knob("Histograms as they are, or the square root of every bar", needs=SCANS)
    ] = "plain"
    keep: Annotated[
        Filter,
        Knob(
            "Keep every nearest, by ratio of the two nearest, nearest both ways, or both",
            needs={"part": ("scans", "pictures")},
        ),
    ] = "both"
    ratio: Annotated[
        float,
        Knob(
            "Nearest over second nearest distance, at most",
            0.5,
            1,
            step=0.05,
            needs={"part": ("scans", "pictures"), "keep": ("ratio", "both")},
        ),
    ] = 0.9
    picked: Annotated[
        int,
        Knob(
            "The source point whose descriptor is shown: click one; -1 takes ours",
            -1,
            4000,
            by=Pick("source"),
            needs=SCANS,
        ),
    ] = -1
    describe: Annotated[
        Describe,
        Knob(
            "What is found and compared: corners with the pixels around them, or SIFT",
            needs=PICTURES,
        ),
    ] = "patches"
    corners: Annotated[int, Knob("Corners of each picture", 50, 600, step=50, needs=PATCHES)] = 300
    patch: Annotated[int, Knob("Side of a patch, odd", 7, 31, unit="px", step=2, needs=PATCHES)] = (
        15
    )
    angles: Annotated[
        Angles, Knob("Where the angles of an outline's bins begin", needs=OUTLINES)
    ] = "along the outline"
    target: Annotated[
        Path | None, Knob("Own target scan: ply, pcd, obj, xyz, csv, npz", needs=SCANS)
    ] = None
    source: Annotated[Path | None, Knob("Own source scan, found in the target", needs=SCANS)] = None
    truth: Annotated[
        Path | None,
        Knob("Known pose of the source in the target's frame: 4×4 or list of poses", needs=SCANS),
    ] = None
    first_image: Annotated[Path | None, Knob("Own first picture", needs=PICTURES)] = None
    second_image: Annotated[Path | None, Knob("Own second picture", needs=PICTURES)] = None
    up: Annotated[Up, Knob("Which axis of own scans points up", of_files=True)] = "z"
    voxel: Annotated[
        float,
        Knob(
            "Own scans: edge of the voxels that thin them, of the target's longest extent",
            1,
            10,
            unit="%",
            step=0.5,
            of_files=True,
        ),
    ] = 2.5
    seed: Annotated[int, Knob("What chance draws: points, noise, samples", 0, 99)] = 0


ScanPhase = Literal[
    "scans",
    "normals",
    "pairs",
    "histogram",
    "similar",
    "nearest",
    "kept",
    "sample",
    "refit",
    "icp",
    "end",
]


@dataclass(frozen=True, eq=False, kw_only=True)
class Scanned:
    """One step of finding a scan in another.

    Attributes:
        phase: What just happened.
        scans: The clouds.
        n_target: Normals of the target, from phase `normals` on.
        n_source: Of the source.
        picked: The source point whose descriptor is shown.
        angles: Of its pairs, rows (theta, alpha, phi).
        around: The other points of these pairs.
        f_source: Descriptors.
        f_target: Descriptors.
        there: The target point that is nearest to the truth of the picked one; the most alike where
            nobody knows.
        asked: The source points that are matched.
        pairs: Matches (source, target).
        right: Which of them are right; None where nobody knows.
        T_target_source: The motion so far.
        iteration: Samples drawn, or fits of ICP.
        inliers: Which matches the motion brings together.
        T_before: The motion before ICP.
    """

    phase: ScanPhase
    scans: Scans
    n_target: np.ndarray | None = None
    n_source: np.ndarray | None = None
    picked: int = 0
    angles: np.ndarray | None = None
    around: np.ndarray | None = None
    f_source: np.ndarray | None = None
    f_target: np.ndarray | None = None
    there: int = 0
    asked: np.ndarray | None = None
    pairs: np.ndarray | None = None
    right: np.ndarray | None = None
    T_target_source: np.ndarray | None = None
    iteration: int = 0
    inliers: np.ndarray | None = None
    T_before: np.ndarray | None = None

    @property
    def error(self) -> MotionError:
        """How far the motion is from the truth; NaN without a motion or a truth."""
        if self.T_target_source is None:
            return MotionError(np.nan, np.nan, np.nan)
        return self.scans.error(self.T_target_source)

    @property
    def home(self) -> bool:
        """Whether the motion is the true one to `HOME_DEGREES` and, by root mean square, to
        `RIGHT`.
        """
        return self.error.rotation < HOME_DEGREES and self.error.displacement < RIGHT


PicturePhase = Literal["pictures", "gradient", "response", "corners", "patch", "nearest", "kept"]


@dataclass(frozen=True, eq=False, kw_only=True)
class Pictured:
    """One step of finding corners of a picture in another.

    Attributes:
        phase: What just happened.
        first: Grey levels of the left picture.
        second: Of the right one, turned.
        strength: Length of the gradient, both pictures.
        response: The corner response, both pictures.
        sifts: The keypoints of both pictures, where SIFT describes them.
        uv_first: Corners (u, v).
        uv_second: Of the second picture.
        uv_truth: Where the corners of the first lie in the second, NaN where nobody knows.
        pairs: Matches (first, second).
        right: Which of them are right.
        known: Of which matches the truth is known.
        windows: The patches of the best match side by side, grey.
    """

    phase: PicturePhase
    first: np.ndarray
    second: np.ndarray
    strength: tuple[np.ndarray, np.ndarray] | None = None
    response: tuple[np.ndarray, np.ndarray] | None = None
    sifts: tuple[Sift, Sift] | None = None
    uv_first: np.ndarray | None = None
    uv_second: np.ndarray | None = None
    uv_truth: np.ndarray | None = None
    pairs: np.ndarray | None = None
    right: np.ndarray | None = None
    known: np.ndarray | None = None
    windows: np.ndarray | None = None


OutlinePhase = Literal["outlines", "bins", "histogram", "costs", "matched"]


@dataclass(frozen=True, eq=False, kw_only=True)
class Outlined:
    """One step of matching two outlines.

    Attributes:
        phase: What just happened.
        first: Points in order, metres.
        second: The same outline turned and larger.
        picked: The point whose histogram is shown.
        f_first: Shape contexts.
        f_second: Of the second.
        costs: Between all pairs.
        pairs: The assignment (first, second).
        right: Which of them are right.
    """

    phase: OutlinePhase
    first: np.ndarray
    second: np.ndarray
    picked: int = 0
    f_first: np.ndarray | None = None
    f_second: np.ndarray | None = None
    costs: np.ndarray | None = None
    pairs: np.ndarray | None = None
    right: np.ndarray | None = None


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One step of the lesson: of one of its three parts."""

    params: Params
    now: Scanned | Pictured | Outlined

    @property
    def right_share(self) -> float:
        """The share of the matches that are right, of those whose truth is known; NaN without any,
        and of a single one.
        """
        right = self.now.right
        known = self.now.known if isinstance(self.now, Pictured) else None
        if right is None or self.now.phase == "patch":
            return float("nan")
        right = right if known is None else right[known]
        return float(right.mean()) if len(right) else float("nan")
