"""The values that captions of the disparity lesson carry, found anew from the pictures' truth and
the maps that a run carries.
"""

import dataclasses

import numpy as np

from tests.truths.disparity import (
    cost_at,
    depths_off,
    fresh,
    hidden_given_up,
    hidden_share,
    lowest_until,
    of_stage,
    pair_of,
    true_depth,
    wrong,
    wrong_along,
)
from tests.verdicts import Run
from workbench.algorithms.stereo.disparity import Stage


def chosen(run: Run, k: int) -> tuple[float, float, float]:
    """Return disparity, depth and true depth of the followed pixel."""
    state = run.states[k]
    u, v = run.subject.pixel
    return (
        float(state.disparity[v, u]),
        float(state.depth[v, u]),
        float(true_depth(run.subject.pair)[v, u]),
    )


def is_map(run: Run) -> bool:
    return run.params.stage == "whole map"


def wrong_at(run: Run, k: int) -> float:
    stage = run.params.stage
    return wrong(run, k) / 100 if is_map(run) or stage in ("windows", "penalties") else np.nan


def d_of(run: Run, k: int) -> float:
    if run.params.stage == "row":
        return k
    return k if run.states[k].stage is Stage.COMPARE else chosen(run, k)[0]


def depth_of(run: Run, k: int) -> float:
    if run.params.stage == "jump":
        return 80.0 / (run.params.focal_length * run.params.baseline) * run.states[k].depth
    d = chosen(run, k)[0] + run.subject.pair.camera.doffs
    return run.subject.f * run.subject.pair.camera.baseline / d


def alone(run: Run, k: int) -> float:
    """The shift of the lowest sum of grey differences, for each column by itself."""
    _, v = run.subject.pixel
    half = run.params.window // 2
    left = run.subject.left
    right_ = run.subject.right
    w = left.shape[1]
    shifts = range(run.subject.max_disparity + 1)
    padded = [np.pad(picture, half, mode="edge") for picture in (left, right_)]
    best = []
    for u in range(run.states[k].columns):
        costs = []
        for d in shifts:
            if u - d < 0:
                break
            # beyond the border of what is compared, its last column counts again
            columns = np.clip(np.arange(u - half, u + half + 1), d, w - 1)
            rows = slice(v, v + 2 * half + 1)
            a = padded[0][rows][:, columns + half]
            b = padded[1][rows][:, columns - d + half]
            costs.append(np.abs(a - b).sum())
        best.append(int(np.argmin(costs)))
    return wrong_along(run, k, np.array(best, float))


def agreeing(run: Run) -> tuple[float, float]:
    return run.subject.agreeing


def sigma(run: Run, k: int) -> float:
    return 3.0 / (run.params.focal_length * run.states[k].value) * 0.5


def hidden(run: Run, k: int) -> float:
    if is_map(run):
        return hidden_given_up(run, k)
    scene = "posts" if run.params.scene == "Motorcycle" else run.params.scene
    params = dataclasses.replace(
        run.params, stage="whole map", scene=scene, baseline=run.states[k].value
    )
    return hidden_share(pair_of(params)) / 100


def jump(run: Run, k: int) -> float:
    return run.params.focal_length * run.params.baseline / run.states[k].depth


def error(run: Run, k: int) -> float:
    if run.params.stage == "one pixel":
        return (k - 8) / 8
    if run.states[k].uncertainty is None:
        return run.params.disparity_error
    return abs(run.params.disparity_error) or 0.5


def found(run: Run, k: int) -> float:
    fB = run.params.focal_length * run.params.baseline
    return fB / (fB / 20.0 + (k - 8) / 8)


def mean_step(run: Run, k: int) -> float:
    d = run.states[k].disparity[np.isfinite(run.states[k].disparity)]
    return float(np.abs(d - np.round(d)).mean())


VALUES = {
    "d": d_of,
    "fresh": fresh,
    "was": lambda run, k: wrong_at(run, k - 1),
    "wrong": wrong_at,
    "k": lambda run, k: k - of_stage(run, Stage.AGGREGATE),
    "is_now": lambda run, k: run.states[k].energy,
    "lost": lambda run, k: float(np.isnan(run.states[k].disparity).mean()),
    "hidden": hidden,
    "exchanged": lambda run, k: agreeing(run)[1],
    "given": lambda run, k: agreeing(run)[0],
    "mean": mean_step,
    "depth": depth_of,
    "true": lambda run, k: chosen(run, k)[2],
    "error": error,
    "half": lambda run, k: float(np.median(depths_off(run, k)[0])),
    "jump": jump,
    "found": found,
    "cost": lambda run, k: cost_at(run, k),
    "lowest": lambda run, k: cost_at(run, lowest_until(run, k)),
    "best": lambda run, k: lowest_until(run, k),
    "window": lambda run, k: (1, 3, 5, 7, 9, 11, 15, 21)[k],
    "price": lambda run, k: (0, 0.1, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3, 4)[k],
    "baseline": lambda run, k: run.states[k].value,
    "sigma": sigma,
    "n": lambda run, k: min(4 * (k + 1), run.subject.left.shape[1]),
    "off": lambda run, k: wrong_along(run, k, run.states[k].path.astype(float)),
    "alone": alone,
}
