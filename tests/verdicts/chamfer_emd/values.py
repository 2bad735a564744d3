"""What the lesson on Chamfer and earth mover's measures, and the values that its captions carry: by
whole distance matrices and scipy's plain assignment.
"""

import functools
from dataclasses import replace

import numpy as np
import scipy

from lessons.chamfer_emd import blurred, twelve
from lessons.chamfer_emd.clouds import clouds_of
from lessons.chamfer_emd.inputs import Input
from lessons.chamfer_emd.state import Clouds
from tests.verdicts import Run


@functools.lru_cache(maxsize=64)
def _clouds(params: Input) -> Clouds:
    return clouds_of(params)


def target_of(run: Run) -> np.ndarray:
    """Return the cloud that a run measures against."""
    if run.params.stage == "twelve":
        return twelve.ring()
    return _clouds(replace(run.params, stage="flows", start="larger")).p_target


@functools.lru_cache(maxsize=512)
def _measured(p_bytes: bytes, target_bytes: bytes) -> tuple[float, float, float, np.ndarray]:
    """Return both sides of Chamfer, the earth mover's distance, and how far each share of mass goes
    under it.
    """
    p, target = (np.frombuffer(b).reshape(-1, 3) for b in (p_bytes, target_bytes))
    D = scipy.spatial.distance.cdist(p, target)
    copies = np.lcm(*D.shape)
    many = D.repeat(copies // D.shape[0], axis=0).repeat(copies // D.shape[1], axis=1)
    moved = many[scipy.optimize.linear_sum_assignment(many)]
    return (
        float((D.min(axis=1) ** 2).mean()),
        float((D.min(axis=0) ** 2).mean()),
        float(moved.mean()),
        moved,
    )


def measured(p: np.ndarray, run: Run) -> tuple[float, float, float, np.ndarray]:
    return _measured(
        np.ascontiguousarray(p).tobytes(),
        np.ascontiguousarray(target_of(run)).tobytes(),
    )


def moving(run: Run, k: int, side: str) -> np.ndarray:
    return getattr(run.states[k], side).flow.p_moving


def lowered(run: Run, k: int) -> float:
    to_target, to_source, _, _ = measured(moving(run, k, "left"), run)
    return {
        "both sides": to_target + to_source,
        "source to target": to_target,
        "target to source": to_source,
    }[run.params.lowers]


def emd(run: Run, k: int, side: str = "right") -> float:
    return measured(moving(run, k, side), run)[2]


def out_of_place(run: Run, k: int, side: str) -> float:
    return float(np.mean(measured(moving(run, k, side), run)[3] > run.params.near))


def larger(run: Run) -> np.ndarray:
    target = target_of(run)
    return target.mean(axis=0) + 1.05 * (target - target.mean(axis=0))


def chamfer(p: np.ndarray, run: Run) -> float:
    return sum(measured(p, run)[:2])


def index_mse(run: Run) -> float:
    p = moving(run, 0, "left")
    target = target_of(run)
    return (
        float(np.mean(np.sum((p - target) ** 2, axis=1))) if len(p) == len(target) else float("nan")
    )


def _held(run: Run, k: int) -> tuple[float, float]:
    to_target, to_source, moved, _ = measured(run.states[k].p, run)
    return to_target + to_source, moved


def _chamfer_now(run: Run, k: int) -> float:
    return chamfer(moving(run, k, "left"), run) if of_flows(run) else _held(run, k)[0]


def _emd_now(run: Run, k: int) -> float:
    return emd(run, k) if of_flows(run) else _held(run, k)[1]


def of_flows(run: Run) -> bool:
    return run.params.stage == "flows"


def _by_row(run: Run, k: int) -> float:
    return float(np.mean(np.sum((run.states[k].p - target_of(run)) ** 2, axis=1)))


def _on_one_place(run: Run, k: int) -> float:
    p = run.states[k].p
    return float((scipy.spatial.distance.cdist(p, p) < 1e-9).sum(axis=1).max())


def _farthest(run: Run, k: int) -> float:
    return float(np.linalg.norm(run.states[k].p - target_of(run), axis=1).max())


def _blob_cost(run: Run, k: int) -> float:
    return run.states[k].costs[0]


VALUES = {
    "step": lambda run, k: k,
    "left": lambda run, k: out_of_place(run, k, "left"),
    "other": lambda run, k: out_of_place(run, k, "right"),
    "chamfer": _chamfer_now,
    "emd": _emd_now,
    "larger": lambda run, k: chamfer(larger(run), run),
    "back": lambda run, k: measured(moving(run, 0, "left"), run)[1],
    "rows": _by_row,
    "dots": _on_one_place,
    "bunched": lambda run, k: 0.05 * k,
    "off": _farthest,
    "others": lambda run, k: len(run.states[k].p) - 1,
    "blur": lambda run, k: blurred.BLURS[k],
    "far": lambda run, k: cost_of_plan(run.subject.p_far, target_of(run), run.states[k].plans[0]),
    "near": lambda run, k: cost_of_plan(run.subject.p_near, target_of(run), run.states[k].plans[1]),
}


def cost_of_plan(p: np.ndarray, target: np.ndarray, plan: np.ndarray) -> float:
    """Return the mean distance of a plan, whose rows are in shares of a point's mass."""
    return float(np.vdot(plan, scipy.spatial.distance.cdist(p, target)) / len(p))


def plan_cost(p: np.ndarray, target: np.ndarray, blur: float) -> float:
    """Return the cost of the entropic plan, in the log domain, row by row and column by column."""
    D = scipy.spatial.distance.cdist(p, target)
    f, g = np.zeros(len(p)), np.zeros(len(target))
    for _ in range(300):
        f = -blur * (np.logaddexp.reduce((g - D) / blur, axis=1) + np.log(len(p)))
        g = -blur * (np.logaddexp.reduce((f[:, None] - D) / blur, axis=0) + np.log(len(target)))
    return float(np.vdot(np.exp((f[:, None] + g - D) / blur), D))
