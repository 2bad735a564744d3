"""Two scans of one shape, the second turned away and with what went wrong; or a person's own
clouds.
"""

import functools
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from lessons.alignment.state import Params, Scans
from workbench.data.files import lost_rows, read_cloud, read_pose, stamp
from workbench.data.framing import FAR, Frame, Up, box, extent, frame
from workbench.data.shapes.clouds import box_surface, vase
from workbench.data.shapes.rabbit import rabbit
from workbench.data.thinning import some_points
from workbench.errors import InputError
from workbench.geometry.motions import exp_so3, motion
from workbench.knobs import called

SLANT = np.array([0.36, 0.48, 0.8])
LOW, GAP = (
    0.4,
    0.2,
)  # metres: the least side of the box, and what lies between the scans in the picture
Sample = Callable[[int, np.random.Generator], np.ndarray]


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
    how = replace(params, signs="third-moment", flip="least")
    return _scans(how, *(stamp(path) for path in files))


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
    scale = params.scale if params.stage == "pairs" else 1.0
    p_target = scale * shape + params.noise * rng.standard_normal(shape.shape)
    p_source = second_scan(params, rng, None if params.stage == "axes" and params.fresh else shape)
    mirrored = params.stage == "pairs" and params.mirrored
    return _beside(
        p_target,
        p_source,
        None if mirrored else motion(scale * _true_rotation(params), np.zeros(3)),
        params,
    )


def second_scan(
    params: Params, rng: np.random.Generator, shape: np.ndarray | None = None
) -> np.ndarray:
    """Return the second scan in its own frame, of the shape's points given or of fresh ones."""
    sample = _sampler(params)
    shape = sample(params.points, rng) if shape is None else shape
    if params.stage == "axes":
        shape = _defective(shape, sample, params, rng)
    elif params.mirrored:
        shape = shape * [1.0, 1.0, -1.0]
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
    if params.source is not None:
        p_file, how = _framed(params.source, params.up)
        p = how.shown(p_file)
        return lambda count, rng: some_points(p, count, rng)
    if params.shape in ("rabbit", "vase"):
        return rabbit if params.shape == "rabbit" else vase
    size = {
        "box": (1.0, params.side, LOW),
        "plate": (1.0, params.side, 0.0),
        "cube": (1.0, 1.0, 1.0),
    }[params.shape]
    return lambda count, rng: box_surface(count, size, rng)


def _framed(path: Path, up: Up) -> tuple[np.ndarray, Frame]:
    """Return the points of an own file, and how they stand in the picture: upright about their
    middle, 1 m long.
    """
    p_file = read_cloud(path, 4)
    if not extent(p_file, FAR) > 0:
        raise InputError(f"{path.name}: all its points lie at one place")
    return p_file, frame(p_file, 1.0, up=up, far=FAR)


def _own_pair(params: Params) -> Scans:
    assert params.source is not None
    assert params.target is not None
    p_target, how = _framed(params.target, params.up)
    p_source, theirs = _framed(params.source, params.up)
    p_target, p_source = how.shown(p_target), replace(theirs, scale=how.scale).shown(p_source)
    rng = np.random.default_rng(params.seed)
    if params.stage == "pairs":
        holed = next(
            (file.name for file in (params.target, params.source) if lost_rows(file)), None
        )
        if holed is not None:
            raise InputError(
                f"pairs go row by row, and {holed} has rows that are NaN: leave them out of both"
                " files"
            )
        if len(p_target) != len(p_source):
            raise InputError(
                f"pairs go row by row: {params.target.name} has {len(p_target):,} points and"
                f" {params.source.name} {len(p_source):,}; go by axes instead"
            )
        both = some_points(np.hstack([p_target, p_source]), params.points, rng)
        p_target, p_source = np.ascontiguousarray(both[:, :3]), np.ascontiguousarray(both[:, 3:])
    else:
        p_target, p_source = (some_points(p, params.points, rng) for p in (p_target, p_source))
    T_shown = None
    if params.truth is not None:
        T, R_up = read_pose(params.truth, params.target, params.source), how.R_world_file
        moved = T[:3, :3] @ theirs.centre + T[:3, 3] - how.centre
        T_shown = motion(R_up @ T[:3, :3] @ R_up.T, how.scale * R_up @ moved)
    return replace(_beside(p_target, p_source, T_shown, params), own=True)


def _beside(
    p_target: np.ndarray, p_source: np.ndarray, T: np.ndarray | None, params: Params
) -> Scans:
    """Return the scans, the first to the left of the second, whose stray point lies where it was
    dragged.
    """
    far = (
        FAR if params.source is not None else 0.0
    )  # a few far points of an own cloud push nothing out of the picture
    left = min(-0.5, box(p_source, far)[0][0]) - GAP - box(p_target, far)[1][0]
    stray = np.array(params.stray) if any(params.stray) else None
    if stray is not None:
        p_source = np.concatenate([p_source, [stray]])
        if params.stage == "pairs":  # the stray one has a partner at the middle of the first scan
            p_target = np.concatenate([p_target, [p_target.mean(axis=0)]])
    return Scans(
        p_target=p_target,
        p_source=p_source,
        T_target_source=T,
        T_world_target=motion(np.eye(3), np.array([left, 0.0, 0.0])),
        stray=stray,
    )
