"""The stage `space`: two paired clouds, and the best turn read off one matrix."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from lessons.pairs.inputs import Input
from workbench.algorithms.registration import procrustes
from workbench.data.files import lost_rows
from workbench.data.framing import FAR
from workbench.data.scan_shapes import Sample, beside, own_pair, own_sampler, sampler
from workbench.data.thinning import some_points
from workbench.errors import InputError
from workbench.geometry.motions import exp_so3, motion
from workbench.geometry.motions.alignment import align_rigid, degrees_between, similarity_scale

SLANT = np.array([0.36, 0.48, 0.8])  # about which the second scan is turned
ASIDE = 0.3  # metres: how far partners that err together lie off, along x
SHARES = np.arange(0.0, 91.0, 10.0)  # per cent of wrong partners that the chart tries
SIGMAS = np.arange(0.0, 0.101, 0.01)  # metres: noise that the chart tries
HOME_DEGREES, HOME_SCALE = 10.0, 0.02


@dataclass(frozen=True, eq=False, kw_only=True)
class Scans:
    """Two scans, each in its own frame, metres; the source's frame is the world that is shown.

    Attributes:
        p_target: The first scan; row k is the partner of row k of the second.
        p_source: The second scan.
        is_wrong: Which rows are no true pairs.
        T_target_source: What truly brings the second to the first, scale included; None where
            nobody knows it, or where nothing does, one being a mirror image.
        T_world_target: Where the first scan is shown, beside the second.
        mirrored: Whether one is made as a mirror image of the other.
        own: Whether both are a person's own.
        off: Degrees that the rigid fit is off, for each kind of mistakes at each of SHARES; empty
            where there is no truth to compare, and for own pairs.
        scales: The least-squares scale there and back at each of SIGMAS; empty where the scans are
            of one size.
    """

    p_target: np.ndarray
    p_source: np.ndarray
    is_wrong: np.ndarray
    T_target_source: np.ndarray | None
    T_world_target: np.ndarray
    mirrored: bool = False
    own: bool = False
    off: Mapping[str, np.ndarray] = field(default_factory=dict)
    scales: Mapping[str, np.ndarray] = field(default_factory=dict)

    @property
    def true_scale(self) -> float:
        """How many times larger the first scan truly is; NaN where nobody knows it."""
        T = self.T_target_source
        return float("nan") if T is None else float(np.cbrt(np.linalg.det(T[:3, :3])))

    def degrees_off(self, T: np.ndarray) -> float:
        """Return how far a map's turn is from the true one; NaN where there is none to compare."""
        if self.T_target_source is None or np.linalg.det(T[:3, :3]) < 0:
            return float("nan")
        return degrees_between(T, self.T_target_source)

    def at_home(self, T: np.ndarray, scale: float) -> bool:
        """Tell whether turn and scale are the true ones, but for noise."""
        return bool(
            self.degrees_off(T) < HOME_DEGREES and abs(scale / self.true_scale - 1) < HOME_SCALE
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One step.

    Attributes:
        now: What is known of the best map so far.
        back: The scale from the first scan to the second, in the last step; NaN before.
    """

    now: procrustes.State
    back: float = float("nan")


def built_in(params: Input) -> Scans:
    """Return two scans of a built-in shape, or of an own cloud."""
    rng = np.random.default_rng(params.seed)
    shape = _sampler(params)(params.points, rng)
    R = exp_so3(np.radians(params.turn) * SLANT)
    mirrored = params.mirrored
    in_target, in_source = rng.standard_normal((2, *shape.shape))
    p_whole = params.scale * shape
    turned = (shape * [1.0, 1.0, -1.0] if mirrored else shape) @ R
    in_source = in_source * 0.0 if params.noise and params.noisy == "target" else in_source
    p_target, p_source = p_whole + params.noise * in_target, turned + params.noise * in_source
    T = None if mirrored else motion(params.scale * R, np.zeros(3))
    order = rng.permutation(len(shape))
    scales = {}
    p_paired = p_target
    is_wrong = np.zeros(len(shape), bool)
    if params.wrong:
        together = params.mistakes == "together"
        p_paired, is_wrong = mispaired(p_target, params.wrong, together, order=order)
    if params.scale != 1.0:
        tried = [(p_whole + sigma * in_target, turned + sigma * in_source) for sigma in SIGMAS]
        scales["there"] = np.array([similarity_scale(p, q) for p, q in tried])
        scales["back"] = np.array([similarity_scale(q, p) for p, q in tried])
    return Scans(
        p_target=p_paired,
        p_source=p_source,
        is_wrong=is_wrong,
        T_target_source=T,
        T_world_target=beside(p_whole, turned, 0.0 if params.source is None else FAR),
        mirrored=mirrored,
        off={} if T is None else _offs(p_target, p_source, T, order=order),
        scales=scales,
    )


def _sampler(params: Input) -> Sample:
    if params.source is not None:
        return own_sampler(params.source, params.up)
    if params.shape in ("box", "plate"):
        return sampler(params.shape, params.side)
    return sampler(params.shape)


def mispaired(
    p_target: np.ndarray, wrong: float, together: bool, *, order: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the target with wrong partners, and which of its rows these are.

    Args:
        p_target: The true partners, row by row.
        wrong: How many of them go wrong, per cent.
        together: The highest of them are moved aside along x; else the first in `order` each take
            the partner of another.
        order: The rows, shuffled.
    """
    count = round(wrong / 100.0 * len(p_target))
    rows = np.argsort(-p_target[:, 2], kind="stable")[:count] if together else order[:count]
    p = p_target.copy()
    is_wrong = np.zeros(len(p_target), bool)
    p[rows] = p_target[rows] + [ASIDE, 0.0, 0.0] if together else p_target[np.roll(rows, 1)]
    is_wrong[rows] = True
    return p, is_wrong


def _offs(
    p_target: np.ndarray, p_source: np.ndarray, T: np.ndarray, *, order: np.ndarray
) -> dict[str, np.ndarray]:
    """Return how far off the turn is at each of SHARES, degrees, for both kinds of mistakes."""
    kinds = {"shuffled": False, "together": True}
    return {
        name: _off(p_target, p_source, T, together=same, order=order)
        for name, same in kinds.items()
    }


def _off(
    p_target: np.ndarray, p_source: np.ndarray, T: np.ndarray, *, together: bool, order: np.ndarray
) -> np.ndarray:
    """Return how far the rigid fit's turn is off at each of SHARES, degrees."""
    tried = [mispaired(p_target, share, together, order=order)[0] for share in SHARES]
    return np.array([degrees_between(align_rigid(p, p_source), T) for p in tried])


def own(params: Input) -> Scans:
    """Return an own pair of clouds, row by row.

    Raises:
        InputError: If a file cannot be used, or their rows do not pair.
    """
    target, source = params.target, params.source
    assert target is not None
    assert source is not None
    p_target, p_source, T = own_pair(target, source, params.truth, up=params.up)
    holed = next((file.name for file in (target, source) if lost_rows(file)), None)
    if holed is not None:
        raise InputError(
            f"pairs go row by row, and {holed} has rows that are NaN: leave them out of both files"
        )
    if len(p_target) != len(p_source):
        raise InputError(
            f"pairs go row by row: {target.name} has {len(p_target):,} points and {source.name}"
            f" {len(p_source):,}; scans without pairs are for the lesson icp"
        )
    rng = np.random.default_rng(params.seed)
    both = some_points(np.hstack([p_target, p_source]), params.points, rng)
    p_target, p_source = (np.ascontiguousarray(p) for p in (both[:, :3], both[:, 3:]))
    return Scans(
        p_target=p_target,
        p_source=p_source,
        is_wrong=np.zeros(len(p_source), bool),
        T_target_source=T,
        T_world_target=beside(p_target, p_source, FAR),
        own=True,
    )


def fit(
    scans: Scans, params: Input, scale: Callable[[np.ndarray, np.ndarray], float]
) -> Iterator[State]:
    """Yield the steps of the least-squares similarity, in the end with the scale that goes back."""
    p, q = scans.p_target, scans.p_source
    H = (p - p.mean(axis=0)).T @ (q - q.mean(axis=0))
    flip = params.flip if np.linalg.det(H) < 0 else "least"  # only a mirror image has to flip
    for state in procrustes.procrustes(p, q, scale, flip=flip):
        yield State(now=state, back=scale(q, p) if state.stage == "scale" else float("nan"))
