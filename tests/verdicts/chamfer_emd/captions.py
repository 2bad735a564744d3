"""What captions of the lesson on Chamfer and earth mover's say of the flows, and of the clouds that
are moved by hand.
"""

import re

import numpy as np
import scipy

from lessons.chamfer_emd.point_sets import blob
from tests.readings import NUMBER, number, says
from tests.verdicts import Claim, Run
from tests.verdicts.chamfer_emd.values import (
    _held,
    chamfer,
    emd,
    larger,
    lowered,
    measured,
    moving,
    of_flows,
    out_of_place,
    plan_cost,
    target_of,
)
from workbench.algorithms.transport.flow import Stop

FIGURE = rf"(<?{NUMBER})"
SHARE = rf"({NUMBER}) %"


def near(text: str, value: float) -> bool:
    """Whether a number is said with its two digits that count."""
    return 0 < value < number(text[1:]) if text.startswith("<") else says(text, value, 2)


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
    p = moving(run, k, side)
    target = target_of(run)
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
    state = run.states[k]
    target = target_of(run)
    rng = np.random.default_rng(run.params.seed)
    far = blob(run.params.points, 0.3, True, rng=rng)
    blur = state.blur
    known = plan_cost(far, target, blur)
    return (
        abs(state.costs[0] - known) < 0.01 * known
        and near(m[1], state.costs[0])
        and near(m[2], state.costs[1])
    )


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
