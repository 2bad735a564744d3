"""Where the scans in space come from: built-in shapes, a lidar on a street, or the person's own
files.
"""

import functools
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import scipy

from lessons.icp.inputs import Input
from workbench.data.files import read_cloud, read_pose
from workbench.data.framing import FAR, METRES, Frame, extent, frame, ground_grid, round_below
from workbench.data.shapes.clouds import pair
from workbench.data.shapes.lidar import lidar_pair
from workbench.data.thinning import some_points, spacing, voxel_means
from workbench.errors import InputError
from workbench.geometry.motions import apply, exp_so3, inverse, motion, turn_about
from workbench.geometry.motions.alignment import MotionError, motion_error
from workbench.geometry.points.nearest import tree_of
from workbench.geometry.points.normals import Normals
from workbench.knobs import called
from workbench.lesson import cached

HOME_DEGREES, HOME_SPACINGS = 5.0, 2.0
RINGS, COLUMNS = 32, 900
WIDTH = 1.2  # metres of the picture that large or small scans are shown wide


@dataclass(frozen=True, eq=False, kw_only=True)
class Scans:
    """Target and source in their own frames (metres), and what does not change while ICP runs.

    Attributes:
        p_target: Target points, target frame.
        p_source: Source points, source frame.
        is_outlier: Which source points belong to nothing.
        T_truth: The true T_target_source, or None where nobody knows it.
        T_start: The initial guess of T_target_source.
        frame: How the target stands in the picture, which is about its middle.
        spacing: Typical distance between neighbouring target points, metres.
        grid: Segments of a ground grid in the picture.
        cell: The edge of its squares, metres of the scans.
        p_target_shown: The target as the picture has it.
        p_source_shown: The source likewise, before any motion.
        n_target: Gives the normals of the target, each computed when first asked for: unit vectors,
            or zero for a point that shall not pull because its neighbours lie along a line.
        tree: Gives the target's k-d tree.
    """

    p_target: np.ndarray
    p_source: np.ndarray
    is_outlier: np.ndarray
    T_truth: np.ndarray | None
    T_start: np.ndarray
    frame: Frame
    spacing: float
    grid: np.ndarray
    cell: float
    p_target_shown: np.ndarray
    p_source_shown: np.ndarray
    n_target: Callable[[], Normals]
    tree: Callable[[], "scipy.spatial.KDTree"]

    @property
    def known(self) -> bool:
        """Whether the truth is known."""
        return self.T_truth is not None

    def about_centre(self, w_world: np.ndarray) -> np.ndarray:
        """Return the turn by a rotation vector of the picture about its middle, in the target
        frame.
        """
        return turn_about(self.frame.centre, exp_so3(self.frame.R_world_file.T @ w_world))

    def error(self, T_target_source: np.ndarray) -> MotionError:
        """Return how far a motion is from the truth, by the points that belong to something."""
        return motion_error(T_target_source, self.T_truth, self.p_source[~self.is_outlier])

    def at_home(self, error: MotionError) -> bool:
        """Tell whether a motion with this error is the true one, but for sampling.

        It turns by less than HOME_DEGREES, and its points are, by root mean square, less than
        HOME_SPACINGS times the spacing of the target's points away from where they belong. Not so
        where the truth is not known.
        """
        near = HOME_SPACINGS * self.spacing
        return error.rotation < HOME_DEGREES and error.displacement < near

    def right_share(self, indices: np.ndarray, kept: np.ndarray) -> float:
        """Return the share of kept matches whose partner lies within two spacings of the truth."""
        if self.T_truth is None or not kept.any():
            return float("nan")
        off = self.p_target[indices[kept]] - apply(self.T_truth, self.p_source[kept])
        within = (HOME_SPACINGS * self.spacing) ** 2
        return float(np.mean(np.einsum("ij,ij->i", off, off) <= within))


def scans_of(params: Input) -> Scans:
    """Return the scans that the params describe.

    Raises:
        InputError: If an own file cannot be used, or only one of the two scans is given.
    """
    if (params.target, params.source, params.truth) != (None, None, None):
        _check(params)
        scans = _own(params)
    else:
        scans = _driven(params) if params.shape == "lidar" else _built_in(params)
    v_world, w_world = np.array(params.guess[:3]), np.array(params.guess[3:])
    T_start = scans.about_centre(w_world)  # the handle turns about the middle of the picture
    T_start[:3, 3] += scans.frame.R_world_file.T @ v_world / scans.frame.scale
    return replace(scans, T_start=T_start)


def _true_motion(params: Input) -> np.ndarray:
    turn = exp_so3(np.array([0.0, 0.0, np.radians(params.start_angle)]))
    return motion(turn, np.array([params.start_shift, 0.0, 0.0]))


def _built_in(params: Input) -> Scans:
    T_truth = _true_motion(params)
    home = sampled(params)
    p_source = apply(inverse(T_truth), home.p_source)
    return replace(home, p_source=p_source, p_source_shown=p_source, T_truth=T_truth)


@cached
def sampled(params: Input) -> Scans:
    """Return built-in scans before the source is turned away: the same arrays whatever the
    start.
    """
    rng = np.random.default_rng(params.seed)
    wrong = {"overlap": params.overlap, "noise": params.noise, "outliers": params.outliers}
    scans = pair(params.shape, params.points, np.eye(4), rng=rng, **wrong)
    p, q = scans.p_target, scans.p_source
    tree = _tree_when_asked(p)
    return Scans(
        p_target=p,
        p_source=q,
        is_outlier=scans.is_outlier,
        T_truth=np.eye(4),
        T_start=np.eye(4),
        frame=Frame(),
        spacing=spacing(p),
        grid=ground_grid(0.5, -0.35),
        cell=0.5,
        p_target_shown=p,
        p_source_shown=q,
        tree=tree,
        n_target=_normals_when_asked(p, tree, spread=False),
    )


@cached(most=8)
def _driven(params: Input) -> Scans:
    """Return the scans before and after the scanner has moved: other rings on the same street."""
    T_truth = _true_motion(params)
    rng = np.random.default_rng(params.seed)
    noise = params.noise
    p_target, p_source = lidar_pair(T_truth, rng, rings=RINGS, columns=COLUMNS, noise=noise)
    p_target, p_source = _thinned(p_target, p_source, params)
    upright = frame(p_target, WIDTH, up="z", far=FAR)
    return replace(_framed(p_target, p_source, upright, spread=_spread(params)), T_truth=T_truth)


def _check(params: Input) -> None:
    if params.target is None or params.source is None:
        both = f"{called('target')} and {called('source')}"
        raise InputError(f"own scans come in pairs: give both {both}")
    for scan in (params.target, params.source):
        read_cloud(scan)  # so that a bad file is refused before anything else
    if params.truth is not None:
        read_pose(params.truth, params.target, params.source)


@cached(most=8)
def _own(params: Input) -> Scans:
    """Thin own scans and bring them into the picture; anew when a file has changed."""
    target, source = params.target, params.source
    assert target is not None
    assert source is not None
    p_target, p_source = (METRES[params.unit] * read_cloud(scan) for scan in (target, source))
    if not extent(p_target, FAR) > 0:
        raise InputError(f"{target.name}: all its points lie at one place")
    p_target, p_source = _thinned(p_target, p_source, params)
    how = frame(p_target, WIDTH, up=params.up, far=FAR)
    made = _framed(p_target, p_source, how, spread=_spread(params))
    return replace(
        made, T_truth=_known_pose(params.truth, target, source, metres=METRES[params.unit])
    )


def _known_pose(
    truth: Path | None, target: Path, source: Path, *, metres: float
) -> np.ndarray | None:
    if truth is None:
        return None
    T = read_pose(truth, target, source).copy()
    T[:3, 3] *= metres
    return T


def _spread(params: Input) -> bool:
    """Tell which planes may pull; asked only where planes do."""
    return params.planes == "spread" if params.fit == "point-to-plane" else True


def _thinned(
    p_target: np.ndarray, p_source: np.ndarray, params: Input
) -> tuple[np.ndarray, np.ndarray]:
    """Thin both scans by the same voxels, and draw at most so many source points by chance."""
    if params.thinning == "voxel":
        size = params.voxel / 100.0 * extent(p_target, FAR)
        p_target, p_source = voxel_means(p_target, size), voxel_means(p_source, size)
    rng = np.random.default_rng(params.seed)
    return p_target, some_points(p_source, params.own_points, rng)


def _framed(p_target: np.ndarray, p_source: np.ndarray, how: Frame, *, spread: bool) -> Scans:
    """Bring scans of any size and place into the picture, WIDTH wide and upright about the
    middle.
    """
    target_shown = how.shown(p_target)
    cell = round_below(0.5 / how.scale)
    tree = _tree_when_asked(p_target)
    return Scans(
        p_target=p_target,
        p_source=p_source,
        is_outlier=np.zeros(len(p_source), bool),
        T_truth=None,
        T_start=np.eye(4),
        frame=how,
        spacing=spacing(p_target),
        grid=ground_grid(how.scale * cell, float(np.percentile(target_shown[:, 2], 1))),
        cell=cell,
        p_target_shown=target_shown,
        p_source_shown=how.shown(p_source),
        tree=tree,
        n_target=_normals_when_asked(p_target, tree, spread=spread),
    )


def _tree_when_asked(p: np.ndarray) -> Callable[[], "scipy.spatial.KDTree"]:
    return functools.cache(functools.partial(tree_of, p))


def _normals_when_asked(
    p: np.ndarray, tree: Callable[[], "scipy.spatial.KDTree"], *, spread: bool
) -> Callable[[], Normals]:
    return functools.cache(lambda: Normals(p, spread=spread, tree=tree()))
