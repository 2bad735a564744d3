"""When the sentences of the features lesson are true, decided by scipy from motions, descriptors
and the truth.
"""

import re

import numpy as np

from lessons.features.captions import caption
from lessons.features.state import Outlined, Scanned
from tests.own_seed import of_preset
from tests.readings import LENGTH, near, near_length, number, says_percent
from tests.truths.features import agreeing, home, nearer, off, share, turn
from tests.verdicts import Claim, Run

__all__ = ["CAPTIONS", "LINES", "WHYS", "caption", "right"]

PERCENT = r"(?:less than )?[\d.,]+ %"


def right(run: Run, k: int) -> bool | None:
    step = run.states[k].now
    if isinstance(step, Scanned):
        return home(step) if step.phase == "end" else None
    if step.phase in ("kept", "matched"):
        right_share = share(step)
        return None if right_share is None else right_share > 0.5
    return None


def _share(run: Run, k: int, m: re.Match[str]) -> bool:
    right_share = share(run.states[k].now)
    return right_share is not None and says_percent(m["share"], right_share)


def _best(run: Run, k: int, m: re.Match[str]) -> bool:
    step = run.states[k].now
    assert isinstance(step, Scanned)
    before = [agreeing(s.now) for s in run.states[:k] if s.now.phase == "sample"]
    assert step.pairs is not None
    return number(m["n"]) == agreeing(step) > max(before, default=0) and number(m["of"]) == len(
        step.pairs
    )


def _agree(run: Run, k: int, m: re.Match[str]) -> bool:
    step = run.states[k].now
    assert isinstance(step, Scanned)
    return number(m["n"]) == agreeing(step)


def _away(run: Run, k: int, m: re.Match[str]) -> bool:
    step = run.states[k].now
    assert isinstance(step, Scanned)
    assert step.T_target_source is not None
    assert step.scans.T_truth is not None
    degrees = turn(step.T_target_source, step.scans.T_truth)
    return (near(m["turn"], degrees) or degrees < 0.0011) and near_length(m["off"], off(step))


def _most_wrong(run: Run, k: int, m: re.Match[str]) -> bool:
    right_share = share(run.states[k].now)
    return right_share is not None and right_share <= 0.5


def _partners(run: Run, k: int, m: re.Match[str]) -> bool:
    step = run.states[k].now
    assert isinstance(step, Outlined)
    assert step.f_first is not None
    assert step.f_second is not None
    a, b = step.f_first, step.f_second
    cost = (
        0.5
        * np.divide((a - b) ** 2, a + b, out=np.zeros_like(a), where=a + b > 0).sum(axis=1).mean()
    )
    return abs(float(m["cost"]) - cost) <= 0.0051


def _green(at_least: float | None = None, below: float | None = None):
    def holds(run: Run, k: int, m: re.Match[str]) -> bool:
        right_share = next(share(s.now) for s in run.states if s.now.phase in ("kept", "matched"))
        assert right_share is not None
        return (at_least is None or right_share > at_least) and (
            below is None or right_share < below
        )

    return holds


def _few(run: Run, k: int, m: re.Match[str]) -> bool:
    step = run.states[k].now
    return isinstance(step, Scanned) and step.T_target_source is None


CAPTIONS = (
    Claim(rf"(?P<share>{PERCENT}) of them are right", _share),
    Claim(rf"(?P<share>{PERCENT}) lie within 3 px of the truth", _share),
    Claim(
        r"(?P<n>[\d,]+) target points? (is|are) more alike than the true one",
        lambda run, k, m: number(m["n"]) == nearer(run.states[k].now),
    ),
    Claim(r"best motion so far: (?P<n>[\d,]+) of (?P<of>[\d,]+) matches agree", _best),
    Claim(r"to all that agree: (?P<n>[\d,]+) of [\d,]+ matches agree", _agree),
    Claim(
        rf"It is (?P<turn>(less than )?[\d.]+)° and (?P<off>{LENGTH}) \(RMS\) from the truth", _away
    ),
    Claim(r"It has come home", lambda run, k, m: home(run.states[k].now)),
    Claim(r"It looks settled, and it is wrong", lambda run, k, m: not home(run.states[k].now)),
    Claim(
        r"(?P<n>\d+|No) matches agree on a motion, and any three agree on some: nothing is found",
        _few,
    ),
    Claim(r"Most of what is kept is wrong|Most are wrong", _most_wrong),
    Claim(r"The true partners cost (?P<cost>[\d.]+) on average", _partners),
    Claim(
        r"its true partner|takes the right one|the right one turned|\d+ left and \d+ right", None
    ),
)

LINES = {
    "random": (
        Claim(r"about one in seven of the kept matches is green", of_preset(_green(0.1, 0.18))),
        Claim(
            r"RANSAC draws over 1,000 samples",
            lambda run, k, m: (
                max(s.now.iteration for s in run.states if s.now.phase == "refit") > 1000
            ),
        ),
        Claim(r"it comes home", lambda run, k, m: home(run.states[-1].now)),
    ),
    "wide": (Claim(r"well over half of the kept matches are green", _green(0.51)),),
    "patches": (Claim(r"90 % are green", _green(0.895, 0.905)),),
    "tilted": (
        Claim(r"The right photograph", None),
        Claim(r"87 % are green", _green(0.865, 0.875)),
    ),
    "turned": (Claim(r"The right photograph", None),),
    "sift": (Claim(r"82 % are green", _green(0.815, 0.825)),),
    "outline-x": (
        Claim(r"fewer than a tenth of the lines are green", of_preset(_green(below=0.1))),
    ),
}

WHYS: dict[str, tuple[Claim, ...]] = {}
