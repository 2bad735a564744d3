"""The two scans of a run in one value: points, truth, start and place in the picture; and how far off a motion is."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from workbench.data.framing import Frame
from workbench.geometry.alignment import degrees_between
from workbench.geometry.motions import apply, exp_so3, motion

HOME_DEGREES, HOME_SPACINGS = 5.0, 2.0


@dataclass(frozen=True)
class Error:
    """How far a motion is from the truth; NaN where that is not known.

    Attributes:
        rotation: Degrees.
        translation: At the middle of the source, metres.
        displacement: Root mean square distance of the source points from where they belong, metres: it holds all of the
            error, also a wrong scale.
    """

    rotation: float
    translation: float
    displacement: float


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
        n_target: Gives the normals of the target, computed when first asked for: unit vectors, or zero for a point that
            shall not pull because its neighbours lie along a line.
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
    n_target: Callable[[], np.ndarray]

    def about_centre(self, w_world: np.ndarray) -> np.ndarray:
        """Return the turn by a rotation vector of the picture about its middle, as a motion of the target frame."""
        R = exp_so3(self.frame.R_world_file.T @ w_world)
        return motion(R, self.frame.centre - R @ self.frame.centre)

    def error(self, T_target_source: np.ndarray) -> Error:
        """Return how far a motion is from the truth."""
        if self.T_truth is None:
            return Error(np.nan, np.nan, np.nan)
        p = self.p_source[~self.is_outlier]
        off = apply(T_target_source, p) - apply(self.T_truth, p)
        displacement = np.sqrt(np.einsum("ij,ij->", off, off) / len(off))
        rotation = degrees_between(T_target_source, self.T_truth)
        return Error(rotation, float(np.linalg.norm(off.mean(axis=0))), float(displacement))

    def at_home(self, error: Error) -> bool:
        """Tell whether a motion with this error is the true one, but for sampling.

        It turns by less than HOME_DEGREES, and its points are, by root mean square, less than HOME_SPACINGS times the
        spacing of the target's points away from where they belong. Not so where the truth is not known.
        """
        return error.rotation < HOME_DEGREES and error.displacement < HOME_SPACINGS * self.spacing

    def right_share(self, indices: np.ndarray, kept: np.ndarray) -> float:
        """Return the share of kept matches whose partner lies within two spacings of where the source point belongs."""
        if self.T_truth is None or not kept.any():
            return float("nan")
        off = self.p_target[indices[kept]] - apply(self.T_truth, self.p_source[kept])
        return float(np.mean(np.einsum("ij,ij->i", off, off) <= (HOME_SPACINGS * self.spacing) ** 2))
