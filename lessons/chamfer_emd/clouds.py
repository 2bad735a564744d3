"""The two clouds of a run, built-in or the person's own, and known changes of the target to compare
with.
"""

import numpy as np

from lessons.chamfer_emd.inputs import Input, Start
from lessons.chamfer_emd.point_sets import (
    blob,
    bumped,
    bunched,
    crowded,
    doubled,
    grown,
    part_missing,
    shuffled,
    spread,
    with_outlier,
)
from lessons.chamfer_emd.state import Clouds
from workbench.data.files import read_cloud
from workbench.data.framing import FAR, Frame, frame
from workbench.data.thinning import some_points
from workbench.errors import InputError
from workbench.knobs import called
from workbench.numerals import brief, percent

WIDTH = 2.0  # metres of an own cloud's longest edge in the picture
YARDSTICKS: tuple[tuple[str, Start, float], ...] = (
    ("5 % larger", "larger", 0.05),
    ("80 % bunched", "bunched", 0.8),
    ("half missing", "part missing", 0.5),
    ("one point 3 m off", "one outlier", 3.0),
    ("rows shuffled", "shuffled rows", 1.0),
)


def clouds_of(params: Input) -> Clouds:
    """Return the clouds that the params describe.

    Raises:
        InputError: If an own file cannot be used, or a source is given without its target.
    """
    if params.source is not None and params.target is None:
        raise InputError(
            f"an own source needs an own target to flow to: give {called('target')} too"
        )
    rng = np.random.default_rng(params.seed)
    if params.target is None:
        framed = Frame()
        p_target = spread(params.shape, params.points)
    else:
        whole = read_cloud(params.target)
        framed = frame(whole, WIDTH, far=FAR)
        p_target = framed.shown(some_points(whole, params.points, rng))
    if params.source is None:
        p_source = changed(p_target, params.start, params.amount, params=params, rng=rng)
        name = _name(params)
    else:
        p_source = framed.shown(
            some_points(read_cloud(params.source), params.source_points or params.points, rng)
        )
        name = params.source.name
    return Clouds(p_source=p_source, p_target=p_target, name=name, scale=framed.scale)


def changed(
    p_target: np.ndarray, start: Start, amount: float, *, params: Input, rng: np.random.Generator
) -> np.ndarray:
    """Return a source: a blob, or the target, with as many points as are asked for, after one
    change.
    """
    built_in = params.target is None
    count = params.source_points or len(p_target)
    share = min(amount, 1.0)
    if start == "blob":
        return blob(count, amount, bool(np.ptp(p_target[:, 1]) == 0), rng=rng)
    if start == "doubled points":
        return doubled(p_target, share)
    if start == "bunched" and built_in:
        return bunched(params.shape, count, share)
    if count == len(p_target):
        p = p_target
    else:
        p = (
            spread(params.shape, count)
            if built_in
            else p_target[np.resize(rng.permutation(len(p_target)), count)]
        )
    if start == "larger":
        return grown(p, amount)
    if start == "bunched":
        return crowded(p, share)
    if start == "bump":
        return bumped(p, amount)
    if start == "part missing":
        return part_missing(p, share)
    if start == "one outlier":
        return with_outlier(p, amount)
    return shuffled(p, share, rng)


def yardsticks(clouds: Clouds, params: Input) -> tuple[tuple[str, np.ndarray], ...]:
    """Return the target after each of the known changes, with as many points, for numbers to
    compare with.
    """
    rng = np.random.default_rng(params.seed)
    alike = Input(shape=params.shape, points=params.points, target=params.target)
    return tuple(
        (name, changed(clouds.p_target, start, amount, params=alike, rng=rng))
        for name, start, amount in YARDSTICKS
    )


def _name(params: Input) -> str:
    part = percent(min(params.amount, 1.0), 0)
    metres = f"{brief(params.amount)} m"
    return {
        "blob": f"a blob of radius {metres}",
        "larger": f"the target {percent(params.amount, 0)} larger",
        "bunched": f"the target with {part} of its points bunched at one place",
        "bump": f"the target with an eighth of it pushed out by {metres}",
        "part missing": f"the target without {part} of it",
        "one outlier": f"the target with one point {metres} off",
        "shuffled rows": f"the target with {part} of its rows shuffled",
        "doubled points": f"the target with {part} of its points doubled",
    }[params.start]
