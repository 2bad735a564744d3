"""Two scans of one shape, the second turned away and with what went wrong; or a person's own
clouds.
"""

import functools
from dataclasses import replace

import numpy as np

from lessons.alignment.state import Params, Scans
from workbench.data.files import stamp
from workbench.data.framing import FAR
from workbench.data.scan_shapes import LOW, Sample, beside, own_pair, own_sampler, sampler
from workbench.data.thinning import some_points
from workbench.errors import InputError
from workbench.geometry.motions import exp_so3, motion
from workbench.knobs import called

SLANT = np.array([0.36, 0.48, 0.8])


def scans_of(params: Params) -> Scans:
    """Return the scans that the params describe, the same arrays as long as nothing that makes them
    changes.

    Raises:
        InputError: If an own file cannot be used, or own clouds do not fit together.
    """
    files = [path for path in (params.source, params.target, params.truth) if path is not None]
    if params.source is None and files:
        raise InputError(
            "an own first scan and a known pose come with an own cloud: give"
            f" {called('source')} too"
        )
    if params.truth is not None and params.target is None:
        raise InputError(
            f"a known pose is one in the frame of an own first scan: give {called('target')} too"
        )
    return _scans(replace(params, signs="third-moment"), *(stamp(path) for path in files))


def box_sides(params: Params) -> np.ndarray | None:
    """Return the sides of the shape's own box, metres; None where it is not made of planes across
    them.
    """
    if params.source is not None or params.shape not in ("box", "cube"):
        return None
    return np.array([1.0, params.side, LOW] if params.shape == "box" else [1.0, 1.0, 1.0])


@functools.lru_cache(maxsize=16)
def _scans(params: Params, *_stamps: tuple[int, int]) -> Scans:
    if params.target is not None:
        return _own_pair(params)
    rng = np.random.default_rng(params.seed)
    shape = _sampler(params)(params.points, rng)
    p_target = shape + params.noise * rng.standard_normal(shape.shape)
    p_source = second_scan(params, rng, None if params.fresh else shape)
    return _beside(p_target, p_source, motion(_true_rotation(params), np.zeros(3)), params)


def second_scan(
    params: Params, rng: np.random.Generator, shape: np.ndarray | None = None
) -> np.ndarray:
    """Return the second scan in its own frame, of the shape's points given or of fresh ones."""
    sample = _sampler(params)
    shape = sample(params.points, rng) if shape is None else shape
    shape = _defective(shape, sample, params, rng)
    p_source = shape @ _true_rotation(params)
    return (
        p_source
        if params.noisy == "target"
        else p_source + params.noise * rng.standard_normal(shape.shape)
    )


def _true_rotation(params: Params) -> np.ndarray:
    return exp_so3(np.radians(params.turn) * SLANT)


def _defective(
    p: np.ndarray, sample: Sample, params: Params, rng: np.random.Generator
) -> np.ndarray:
    """Return a scan that is denser above the middle of its height, and saw a part only."""
    if params.density > 1:
        middle = p[:, 2].min() / 2 + p[:, 2].max() / 2
        more = (params.density - 1) * int(np.count_nonzero(p[:, 2] > middle))
        again = sample(params.density * len(p), rng)
        p = np.concatenate([p, np.resize(again[again[:, 2] > middle], (more, 3))])
    if params.seen < 1:
        p = p[np.argsort(p[:, 0], kind="stable")[: max(4, round(params.seen * len(p)))]]
    return p


def _sampler(params: Params) -> Sample:
    """Return what draws points of the shape; of an own cloud some of its points, or all that it
    has.
    """
    return (
        sampler(params.shape, params.side)
        if params.source is None
        else own_sampler(params.source, params.up)
    )


def _own_pair(params: Params) -> Scans:
    assert params.source is not None
    assert params.target is not None
    p_target, p_source, T_shown = own_pair(params.target, params.source, params.truth, params.up)
    rng = np.random.default_rng(params.seed)
    p_target, p_source = (some_points(p, params.points, rng) for p in (p_target, p_source))
    return replace(_beside(p_target, p_source, T_shown, params), own=True)


def _beside(
    p_target: np.ndarray, p_source: np.ndarray, T: np.ndarray | None, params: Params
) -> Scans:
    """Return the scans, the first to the left of the second, whose stray point lies where it was
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
    )
