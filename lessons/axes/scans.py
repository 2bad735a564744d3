"""Two scans of one shape, the second turned away and with what went wrong; or a person's own."""

from dataclasses import dataclass

import numpy as np

from lessons.axes.inputs import Input
from workbench.data.framing import FAR
from workbench.data.scan_shapes import LOW, Sample, beside, own_pair, own_sampler, sampler
from workbench.data.thinning import some_points
from workbench.errors import InputError
from workbench.geometry.motions import exp_so3, motion
from workbench.knobs import called
from workbench.lesson import cached

SLANT = np.array([0.36, 0.48, 0.8])  # about which the second scan is turned


@dataclass(frozen=True, eq=False, kw_only=True)
class Scans:
    """Two scans, each in its own frame, metres; the source's frame is the world that is shown.

    Attributes:
        p_target: The first scan.
        p_source: The second.
        T_target_source: What truly brings the second to the first; None where nobody knows it.
        T_world_target: Where the first scan is shown, beside the second.
        stray: The stray point, source frame, where there is one.
        what: What was scanned, in words.
        sides: The sides of the shape's own box, metres; None where it has none.
    """

    p_target: np.ndarray
    p_source: np.ndarray
    T_target_source: np.ndarray | None
    T_world_target: np.ndarray
    stray: np.ndarray | None = None
    what: str
    sides: tuple[float, float, float] | None = None


def scans_of(params: Input) -> Scans:
    """Return the scans that the params describe.

    Raises:
        InputError: If an own file cannot be used, or own clouds do not fit together.
    """
    given = (params.source, params.target, params.truth)
    files = [path for path in given if path is not None]
    if params.source is None and files:
        raise InputError(
            "an own first scan and a known pose come with an own cloud: give"
            f" {called('source')} too"
        )
    if params.truth is not None and params.target is None:
        raise InputError(
            f"a known pose is one in the frame of an own first scan: give {called('target')} too"
        )
    return _scans(params)


@cached
def _scans(params: Input) -> Scans:
    if params.target is not None:
        return _own_pair(params)
    rng = np.random.default_rng(params.seed)
    sample = sample_of(params)
    shape = sample(params.points, rng)
    p_target = shape + params.noise * rng.standard_normal(shape.shape)
    R = true_rotation(params)
    p_source = second_scan(params, sample, R, rng=rng, shape=None if params.fresh else shape)
    sides = None
    if params.source is None and params.shape in ("box", "cube"):
        sides = (1.0, params.side, LOW) if params.shape == "box" else (1.0, 1.0, 1.0)
    subject = f"one {params.shape}" if params.source is None else params.source.name
    return _beside(
        p_target, p_source, motion(R, np.zeros(3)), params=params, subject=subject, sides=sides
    )


def sample_of(params: Input) -> Sample:
    """Return what draws points of the shape, or of an own cloud some of its points."""
    if params.source is not None:
        return own_sampler(params.source, params.up)
    if params.shape in ("box", "plate"):
        return sampler(params.shape, params.side)
    return sampler(params.shape)


def true_rotation(params: Input) -> np.ndarray:
    """Return the rotation that takes directions of the second scan to the first."""
    return exp_so3(np.radians(params.turn) * SLANT)


def second_scan(
    params: Input,
    sample: Sample,
    R_target_source: np.ndarray,
    *,
    rng: np.random.Generator,
    shape: np.ndarray | None = None,
) -> np.ndarray:
    """Return the second scan in its own frame, of the shape's points given or of fresh ones."""
    shape = sample(params.points, rng) if shape is None else shape
    if params.density > 1:  # denser above the middle of its height
        middle = shape[:, 2].min() / 2 + shape[:, 2].max() / 2
        more = (params.density - 1) * int(np.count_nonzero(shape[:, 2] > middle))
        again = sample(params.density * len(shape), rng)
        shape = np.concatenate([shape, np.resize(again[again[:, 2] > middle], (more, 3))])
    if params.seen < 1:
        left = np.argsort(shape[:, 0], kind="stable")
        shape = shape[left[: max(4, round(params.seen * len(shape)))]]
    noise = params.noise * rng.standard_normal(shape.shape)
    is_clean = bool(params.noise) and params.noisy == "target"
    return shape @ R_target_source + (0.0 if is_clean else 1.0) * noise


def _own_pair(params: Input) -> Scans:
    assert params.source is not None
    assert params.target is not None
    p_target, p_source, T = own_pair(params.target, params.source, params.truth, up=params.up)
    rng = np.random.default_rng(params.seed)
    p_target, p_source = (some_points(p, params.points, rng) for p in (p_target, p_source))
    return _beside(p_target, p_source, T, params=params, subject="your own")


def _beside(
    p_target: np.ndarray,
    p_source: np.ndarray,
    T: np.ndarray | None,
    *,
    params: Input,
    subject: str,
    sides: tuple[float, float, float] | None = None,
) -> Scans:
    """Return the scans, the first to the left of the second, with the stray point that was
    dragged.
    """
    T_world_target = beside(p_target, p_source, FAR if params.source is not None else 0.0)
    stray = np.array(params.stray) if any(params.stray) else None
    if stray is not None:
        p_source = np.concatenate([p_source, [stray]])
    return Scans(
        p_target=p_target,
        p_source=p_source,
        T_target_source=T,
        T_world_target=T_world_target,
        stray=stray,
        what=subject,
        sides=sides,
    )
