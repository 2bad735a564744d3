"""Decides what the lesson on Chamfer and earth mover's says: by whole distance matrices and scipy's
plain assignment.
"""

import functools
import re
from dataclasses import replace

import numpy as np
import scipy

from lessons.chamfer_emd import blurred, bunch, far_dot, twelve
from lessons.chamfer_emd.captions import caption as caption_of_flows
from lessons.chamfer_emd.clouds import clouds_of
from lessons.chamfer_emd.inputs import Input
from lessons.chamfer_emd.point_sets import blob
from lessons.chamfer_emd.state import Clouds, state_of
from tests.own_seed import of_preset
from tests.readings import NUMBER, number, says
from tests.verdicts import Claim, Run
from workbench.algorithms.transport.flow import Stop
from workbench.lesson import Look
from workbench.scene import Caption

CAPTIONS_OF = {
    twelve.Twelve: lambda look: twelve.caption(look.params, look.now),
    bunch.Rings: lambda look: bunch.caption(look.now),
    far_dot.Ring: lambda look: far_dot.caption(look.now),
    blurred.Pairs: lambda look: blurred.caption(look.now),
    Clouds: lambda look: caption_of_flows(state_of(look)),
}


def caption(look: Look) -> Caption:
    """Return the caption alone, without the picture."""
    return CAPTIONS_OF[type(look.subject)](look)


@functools.lru_cache(maxsize=64)
def _clouds(params: Input) -> Clouds:
    return clouds_of(params)


def target_of(run: Run) -> np.ndarray:
    """Return the cloud that a run measures against."""
    if run.params.stage == "twelve":
        return twelve.ring()
    return _clouds(replace(run.params, stage="flows", start="larger")).p_target


FIGURE = rf"(<?{NUMBER})"
SHARE = rf"({NUMBER}) %"


def near(text: str, value: float) -> bool:
    """Whether a number is said with its two digits that count."""
    return 0 < value < number(text[1:]) if text.startswith("<") else says(text, value, 2)


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


def ranks_differ(run: Run) -> bool:
    p, other = moving(run, 0, "left"), larger(run)
    return (chamfer(p, run) < chamfer(other, run)) != (
        measured(p, run)[2] < measured(other, run)[2]
    )


def index_mse(run: Run) -> float:
    p, target = moving(run, 0, "left"), target_of(run)
    return (
        float(np.mean(np.sum((p - target) ** 2, axis=1))) if len(p) == len(target) else float("nan")
    )


def blind(run: Run) -> bool:
    """Whether some number of the start says "equal" or "closer" of clouds that are not."""
    p = moving(run, 0, "left")
    to_target, to_source, moved, _ = measured(p, run)
    one_way = {"source to target": to_target, "target to source": to_source}.get(
        run.params.lowers, 1.0
    )
    return (
        ranks_differ(run)
        or (to_target + to_source == 0 and (moved > 0 or index_mse(run) > 0))
        or one_way == 0 < moved
    )


def right(run: Run, k: int) -> bool | None:
    if run.params.stage != "flows":
        return None
    if k == 0:
        return not blind(run)
    left, other = out_of_place(run, k, "left"), out_of_place(run, k, "right")
    return True if left < 0.15 and other < 0.15 else False if left > other + 0.05 else None


def ended(run: Run, k: int, side: str) -> Stop | None:
    """Return why a flow really ended by step k."""
    flow = getattr(run.states[k], side).flow
    if flow.step < k or k == len(run.states) - 1:
        return flow.stop
    return None


def settled(run: Run, k: int, side: str) -> bool:
    """Whether no short step of all points along their pulls lowers the distance; the pulls by
    differences of the matrix.
    """
    p, target = moving(run, k, side), target_of(run)
    value = lowered(run, k) if side == "left" else emd(run, k)
    if side == "right":
        # a kink: subgradients, tried by `flow` itself; that the value no longer falls is claimed by
        # its steps
        return True
    D = scipy.spatial.distance.cdist(p, target)
    pull = np.zeros_like(p)
    if run.params.lowers != "target to source":
        pull += 2 / len(p) * (target[D.argmin(axis=1)] - p)
    if run.params.lowers != "source to target":
        np.add.at(pull, D.argmin(axis=0), 2 / len(target) * (target - p[D.argmin(axis=0)]))
    steepness = float(np.sqrt((pull**2).sum() / len(p)))
    for metres in (1e-2, 1e-3, 1e-4):
        D = scipy.spatial.distance.cdist(p + metres / max(steepness, 1e-12) * pull, target)
        to_target, to_source = (D.min(axis=1) ** 2).mean(), (D.min(axis=0) ** 2).mean()
        after = {
            "both sides": to_target + to_source,
            "source to target": to_target,
            "target to source": to_source,
        }
        if after[run.params.lowers] < 0.995 * value - 1e-9:
            return False
    return True


def _started(run: Run, k: int, m: re.Match[str]) -> bool:
    if not of_flows(run):
        return _numbers(run, k, m)
    return near(m[1], chamfer(moving(run, 0, "left"), run)) and near(m[2], emd(run, 0))


def _both_sides(run: Run, k: int, m: re.Match[str]) -> bool:
    return says(m[1], 100 * out_of_place(run, k, "left")) and says(
        m[2], 100 * out_of_place(run, k, "right")
    )


def _why(side: str):
    def holds(run: Run, k: int, m: re.Match[str]) -> bool:
        stop = ended(run, k, side)
        value = lowered(run, k) if side == "left" else emd(run, k)
        return {
            "arrived": stop is Stop.ARRIVED and value < 1e-9,
            "came to rest": (stop is Stop.SETTLED and value > 1e-9 and settled(run, k, side)),
            "used up its steps": (
                stop is Stop.MAX_STEPS
                and getattr(run.states[k], side).flow.step == run.params.steps
            ),
        }[m[1]]

    return holds


WHY = r"(arrived|came to rest|used up its steps)"


def _held(run: Run, k: int) -> tuple[float, float]:
    to_target, to_source, moved, _ = measured(run.states[k].p, run)
    return to_target + to_source, moved


def _numbers(run: Run, k: int, m: re.Match[str], *, first: int = 1) -> bool:
    chamfer_now, emd_now = _held(run, k)
    return _zero_or_near(m[first], chamfer_now) and _zero_or_near(m[first + 1], emd_now)


def _zero_or_near(text: str, value: float) -> bool:
    return abs(value) < 1e-12 if text == "0" else near(text, value)


def _in_a_bunch(run: Run, k: int) -> float:
    spread = np.linalg.norm(run.states[k].p - run.states[k].p[-1], axis=1)
    return 100 * float(np.mean(spread < 0.26))


def _bunched(run: Run, k: int, m: re.Match[str]) -> bool:
    # the even points that lie inside the bunch by chance are counted too
    count = number(m[1])
    return 0 <= _in_a_bunch(run, k) - count < 8 and _numbers(run, k, m, first=2)


def _ranked(run: Run, k: int, m: re.Match[str]) -> bool:
    chamfer_now, emd_now = _held(run, k)
    of_larger = chamfer(larger(run), run), measured(larger(run), run)[2]
    return _bunched(run, k, m) and chamfer_now < of_larger[0] and emd_now > of_larger[1]


def _blur(run: Run, k: int, m: re.Match[str]) -> bool:
    state, target = run.states[k], target_of(run)
    rng = np.random.default_rng(run.params.seed)
    far = blob(run.params.points, 0.3, True, rng=rng)
    blur = state.blur
    known = plan_cost(far, target, blur)
    return (
        abs(state.costs[0] - known) < 0.01 * known
        and near(m[1], state.costs[0])
        and near(m[2], state.costs[1])
    )


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


BY_HAND = [
    Claim(rf"in one place: Chamfer says {FIGURE} m², earth mover's {FIGURE} m\.", _numbers),
    Claim(
        r"(Every dot|every point) is at home",
        lambda run, k, m: np.allclose(run.states[k].p, target_of(run), atol=1e-12),
    ),
    Claim(r"both numbers are 0", lambda run, k, m: max(_held(run, k)) < 1e-12),
    Claim(
        rf"Pairs by row say {FIGURE} m². Chamfer says {FIGURE} m² and earth mover's {FIGURE} m\.",
        lambda run, k, m: (
            near(m[1], float(np.mean(np.sum((run.states[k].p - target_of(run)) ** 2, axis=1))))
            and _numbers(run, k, m, first=2)
        ),
    ),
    Claim(
        rf"{SHARE} in a bunch: closer than L by Chamfer \({FIGURE} m²\), and farther by earth"
        rf" mover's \({FIGURE} m\)",
        _ranked,
    ),
    Claim(rf"{SHARE} in a bunch: Chamfer {FIGURE} m², earth mover's {FIGURE} m\.", _bunched),
    Claim(
        r"the other (\d+) are at home",
        lambda run, k, m: (
            np.count_nonzero(np.linalg.norm(run.states[k].p - target_of(run), axis=1) < 1e-12)
            == number(m[1])
        ),
    ),
    Claim(
        rf"Sinkhorn says {FIGURE} m for the blob, and {FIGURE} m for the cloud that is almost at"
        r" home",
        _blur,
    ),
]


CAPTIONS = [
    Claim(rf"Chamfer {FIGURE} m², earth mover's {FIGURE} m\.", _started),
    Claim(
        rf"The ranking flips: to Chamfer this is closer than the target 5 % larger \({FIGURE} m²\)",
        lambda run, k, m: (
            near(m[1], chamfer(larger(run), run))
            and chamfer(moving(run, 0, "left"), run) < chamfer(larger(run), run)
        ),
    ),
    Claim(
        r"to earth mover's it is farther",
        lambda run, k, m: emd(run, 0) > measured(larger(run), run)[2],
    ),
    Claim(
        r"To Chamfer the two are equal: each point lies on one of the other cloud",
        lambda run, k, m: chamfer(moving(run, 0, "left"), run) == 0 < emd(run, 0),
    ),
    Claim(
        rf"Every source point lies on the target, so the left flow has nothing to do; the other"
        rf" side is {FIGURE} m²",
        lambda run, k, m: (
            measured(moving(run, 0, "left"), run)[0] == 0
            and near(m[1], measured(moving(run, 0, "left"), run)[1])
        ),
    ),
    Claim(
        rf"Step \d+: {SHARE} of the left mass is out of place, and {SHARE} of the right",
        _both_sides,
    ),
    Claim(rf"{SHARE} of its mass out of place; the right one [\w ]+, {SHARE}", _both_sides),
    Claim(
        rf"{SHARE} of (?:the left mass is|its mass) out of place\.",
        lambda run, k, m: says(m[1], 100 * out_of_place(run, k, "left")),
    ),
    Claim(
        rf"A part of the ring has no dots: Chamfer is {FIGURE} m²\.",
        lambda run, k, m: near(m[1], chamfer(moving(run, 0, "left"), run)),
    ),
    Claim(rf"[Tt]he (?:left )?flow {WHY}", _why("left")),
    Claim(rf"the right one {WHY}", _why("right")),
    *BY_HAND,
]


def start(run: Run) -> np.ndarray:
    return moving(run, 0, "left")


def _idle(run: Run, *_) -> bool:
    p, target = moving(run, -1, "left"), target_of(run)
    serving = np.unique(scipy.spatial.distance.cdist(p, target).argmin(axis=0))
    idle = np.setdiff1d(np.arange(len(p)), serving)
    moved = np.linalg.norm(p - start(run), axis=1)[idle]
    return len(idle) == 71 and len(p) == 80 == len(target) and float(np.median(moved)) == 0.0


def plan_cost(p: np.ndarray, target: np.ndarray, blur: float) -> float:
    """Return the cost of the entropic plan, in the log domain, row by row and column by column."""
    D = scipy.spatial.distance.cdist(p, target)
    f, g = np.zeros(len(p)), np.zeros(len(target))
    for _ in range(300):
        f = -blur * (np.logaddexp.reduce((g - D) / blur, axis=1) + np.log(len(p)))
        g = -blur * (np.logaddexp.reduce((f[:, None] - D) / blur, axis=0) + np.log(len(target)))
    return float(np.vdot(np.exp((f[:, None] + g - D) / blur), D))


def _blurred(run: Run, *_) -> bool:
    target = target_of(run)
    first, last = (plan_cost(moving(run, k, "right"), target, 0.5) for k in (0, -1))
    return (
        abs(first - 0.99) < 0.005
        and abs(emd(run, 0) - 0.81) < 0.005
        and abs(last - 0.54) < 0.005
        and 0.0035 < emd(run, -1) < 0.0045
    )


def _midway(run: Run, *_) -> bool:
    p, target = moving(run, -1, "right"), target_of(run)
    D = np.sort(scipy.spatial.distance.cdist(p, target), axis=1)
    at_both = (np.abs(D[:, :2] - 0.04) < 0.01).all(axis=1)
    return (len(p), len(target)) == (40, 80) and float(at_both.mean()) >= 0.9


LINES = {
    "blur": [
        Claim(
            r"almost at home",
            lambda run, k, m: 0 < measured(run.subject.p_near, run)[2] < 0.01,
        )
    ],
    "back": [
        Claim(
            r"the missing half is filled",
            lambda run, k, m: (
                measured(moving(run, -1, "left"), run)[1] < 0.01
                and moving(run, -1, "left")[:, 0].max() > 0.9
            ),
        )
    ],
    "larger": [
        Claim(
            r"Every point is 5 cm off",
            lambda run, k, m: bool(
                np.allclose(np.linalg.norm(start(run) - target_of(run), axis=1), 0.05)
            ),
        ),
        Claim(
            r"0\.0050 m² by Chamfer, 0\.05 m by EMD",
            lambda run, k, m: (
                abs(chamfer(start(run), run) - 0.005) < 1e-9 and abs(emd(run, 0) - 0.05) < 1e-9
            ),
        ),
    ],
    "flip": [
        Claim(
            r"80 % of the points in one bunch",
            lambda run, k, m: (
                float(
                    np.mean(
                        np.linalg.norm(start(run) - np.median(start(run), axis=0), axis=1) < 0.3
                    )
                )
                >= 0.8
            ),
        )
    ],
    "bump": [
        Claim(
            r"A bump of 14\.7 cm on an eighth of the ring has the Chamfer distance of the ring 5 %"
            r" larger, 0\.0050 m²",
            lambda run, k, m: (
                abs(chamfer(start(run), run) - chamfer(larger(run), run)) < 5e-5
                and abs(chamfer(start(run), run) - 0.005) < 5e-5
            ),
        ),
        Claim(
            r"EMD 0\.019 against 0\.05 m, Hausdorff 0\.147 against 0\.05 m",
            lambda run, k, m: (
                abs(emd(run, 0) - 0.0189) < 5e-5
                and abs(emd(run, 0) - 0.019) < 5e-4
                and abs(
                    scipy.spatial.distance.directed_hausdorff(start(run), target_of(run))[0] - 0.147
                )
                < 1e-9
            ),
        ),
    ],
    "missing": [
        Claim(
            r"only the left half of the target, twice",
            lambda run, k, m: (
                set(np.unique(start(run), axis=0, return_counts=True)[1]) == {2}
                and measured(start(run), run)[0] == 0
                and float(start(run)[:, 0].max()) < 0.1
            ),
        )
    ],
    "outlier": [
        Claim(
            r"One point of 80 is 1 m off, the others are at home",
            lambda run, k, m: (
                np.sort(np.linalg.norm(start(run) - target_of(run), axis=1)).tolist()
                == [0.0] * 79 + [1.0]
            ),
        )
    ],
    "shuffled": [
        Claim(
            r"The same points, and only their rows are in another order",
            lambda run, k, m: (
                chamfer(start(run), run) == 0 == emd(run, 0)
                and abs(index_mse(run) - (2.3 if run.params.seed == 0 else 2.0))
                < (0.05 if run.params.seed == 0 else 0.6)
            ),
        )
    ],
    "doubled": [
        Claim(
            r"Chamfer and Hausdorff are 0, EMD is 0\.21 m",
            lambda run, k, m: (
                chamfer(start(run), run) == 0
                and abs(emd(run, 0) - 0.21) < 0.005
                and len(start(run)) == 120
            ),
        )
    ],
    "idle": [
        Claim(
            r"71 of 80 points \(vermillion\) are nearest to"
            r" no target point, and nothing pulls them; the others serve all 80",
            of_preset(_idle),
        )
    ],
    "blurred": [
        Claim(r"not exact", of_preset(_blurred)),
        Claim(
            r"Sinkhorn with a blur of 0\.5 m says 0\.99 m where EMD is 0\.81 m",
            of_preset(_blurred),
        ),
    ],
    "unequal": [
        Claim(
            r"Exact EMD splits masses: nearly every source point ends midway between"
            r" the two target points it serves, 0\.04 m from both",
            _midway,
        )
    ],
}


def _spread(run: Run, k: int, m: re.Match[str]) -> bool:
    left, other = (float(np.mean(moving(run, -1, side)[:, 0] < 0)) for side in ("left", "right"))
    few = np.unique(
        scipy.spatial.distance.cdist(moving(run, -1, "left"), target_of(run)).argmin(axis=0)[
            far(run)
        ]
    )
    return (
        says(m[1], 100 * left)
        and says(m[2], 100 * other)
        and 0.6 < left < 0.99
        and 0.4 < other < 0.6
        and len(few) <= 10
    )


def far(run: Run) -> np.ndarray:
    """Tell which target points lie on the farther half."""
    return target_of(run)[:, 0] > 0


def _missing(run: Run, k: int, m: re.Match[str]) -> bool:
    to_target, to_source, _, _ = measured(start(run), run)
    return says(m[1], 100 * to_source / (to_target + to_source)) and near(
        m[2], to_target + to_source
    )


WHYS = {
    "predict-spread": [
        Claim(
            rf"After 40 steps {SHARE} of its points stay on the nearer half \({SHARE} for earth"
            r" mover's\)\. "
            rf"A few points near the far side serve all target points there",
            _spread,
        )
    ],
    "predict-flip": [
        Claim(
            rf"B has Chamfer {FIGURE} m² and EMD {FIGURE} m; L has {FIGURE} m² and {FIGURE} m",
            lambda run, k, m: (
                _numbers(run, AT_80, m)
                and near(m[3], chamfer(larger(run), run))
                and near(m[4], measured(larger(run), run)[2])
            ),
        ),
        Claim(
            r"enough to have a neighbour nearby everywhere",
            lambda run, k, m: (
                float(
                    scipy.spatial.distance.cdist(run.states[AT_80].p, target_of(run))
                    .min(axis=0)
                    .max()
                )
                < 0.15
            ),
        ),
    ],
    "predict-missing": [
        Claim(rf"{SHARE} of {FIGURE} m²", _missing),
        Claim(
            rf"Every orange dot lies on a blue place, so the other side is {FIGURE} m²",
            lambda run, k, m: number(m[1]) == measured(start(run), run)[0] == 0,
        ),
    ],
    "predict-outlier": [
        Claim(
            r"Hausdorff is (\d+) times that of the larger ring, Chamfer ([\d.]+)"
            r" times, EMD ([\d.]+) times",
            lambda run, k, m: (
                int(m[1]) == 20
                and abs(float(m[2]) - _held(run, AT_1)[0] / chamfer(larger(run), run)) < 0.051
                and abs(float(m[3]) - _held(run, AT_1)[1] / measured(larger(run), run)[2]) < 0.0051
            ),
        ),
    ],
    "whose-row": [],
    "blurred-home": [
        Claim(
            rf"It says {FIGURE} m, where the exact distance is {FIGURE} mm",
            lambda run, k, m: (
                near(
                    m[1],
                    plan_cost(run.subject.p_near, target_of(run), 0.5),
                )
                and near(m[2], 1000 * measured(run.subject.p_near, run)[2])
            ),
        )
    ],
}
AT_80, AT_1 = 16, 10
"""The steps at which 80 % are in the bunch, and at which the dot is 1 m off."""
