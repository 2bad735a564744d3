"""When the sentences of the pose lesson are true, decided by scipy's rotations and plain sums from
its states.
"""

import re
from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache

import numpy as np
from scipy.spatial.transform import Rotation

from lessons.pose.captions import caption
from lessons.pose.lesson import lesson
from lessons.pose.state import Params, Repeated, State
from lessons.pose.trials import ANEW
from tests.readings import LENGTH, NUMBER, near, near_length, number
from tests.truths.pose import is_near, is_right, off, pixels_off, rms, share_near
from tests.verdicts import Claim, Run
from workbench.data.views.sightings import random_views
from workbench.geometry.cameras.camera_motions import sqpnp
from workbench.geometry.cameras.control_points import epnp

__all__ = ["CAPTIONS", "LINES", "WHYS", "caption", "right", "until_the_end"]
OF_MANY = {
    replace(case.params, seed=0)
    for case in (*lesson.questions, lesson.preset("tiny"), lesson.preset("safe"))
}
"""Params whose sentences speak of the other pictures."""


def until_the_end(params: Params) -> Iterator[State]:
    """The run without its other pictures, where nothing is said of them."""
    for state in lesson.run(params):
        yield state
        if is_right(state) is not None and replace(params, seed=0) not in OF_MANY:
            return


def right(run: Run, k: int) -> bool | None:
    return is_right(run.states[k])


def exactly(run: Run, k: int, m: re.Match[str]) -> bool:
    """Each solution sees the three points where they were seen."""
    state = run.states[k]
    return rms(pixels_off(state.now.T, state.subject)[:3]) < 0.01


def told(run: Run, k: int, m: re.Match[str]) -> bool:
    """The distance to the truth, in both units."""
    state = run.states[k]
    degrees, metres = off(state.T, state.subject.T_true)
    return (near(m[1], degrees) or degrees < 1e-6) and (near_length(m[2], metres) or metres < 1e-8)


def better(run: Run, k: int, m: re.Match[str]) -> bool:
    """What is taken fits no worse than the others."""
    state = run.states[k]
    errors = [rms(pixels_off(T, state.subject)) for T in state.now.candidates]
    return rms(pixels_off(state.now.T, state.subject)) <= min(errors) + 1e-9


def ended(run: Run, k: int, m: re.Match[str]) -> bool:
    return not is_right(run.states[k])


def best(run: Run, k: int, m: re.Match[str]) -> bool:
    """More points are within the distance than from any best before."""
    bests = [state.now.best.count for state in run.states[1:k] if state.now.best]
    return run.states[k].now.best.count > max(bests, default=0)


def swapped(run: Run, k: int, m: re.Match[str]) -> bool:
    repeated = run.states[k].now
    return abs(number(m[1]) - 100 * repeated.swapped / repeated.pictures) <= 0.5


def counted(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    return float(m[1]) == sum(is_near(T, state.subject) for T in state.now.Ts) and m[2] == str(
        state.now.pictures
    )


def all_right(run: Run, k: int, m: re.Match[str]) -> bool:
    return share_near(run.states[k].now, run.states[k].subject) == 1


def turned_far(run: Run, k: int, m: re.Match[str]) -> bool:
    """The shares of EPnP and SQPnP, solved again one by one and turned by scipy."""
    n = len(run.states[k].subject.p_shown)
    shares = shares_turned_far(run.states[k].params, n)
    return all(
        abs(number(text) - share) <= 0.51 for share, text in zip(shares, m.groups(), strict=True)
    )


@lru_cache(maxsize=8)
def shares_turned_far(params: Params, n: int) -> tuple[float, ...]:
    """Of EPnP and of SQPnP, percent; a caption and an explanation tell of the same."""
    rng = np.random.default_rng([params.seed, 4])
    R_true, p, xy = random_views(ANEW, n, rng)
    xy = xy + params.noise / params.f * rng.standard_normal(xy.shape)
    shares = []
    for solver in (epnp, sqpnp):
        R = np.stack([solver(a, b)[:3, :3] for a, b in zip(p, xy, strict=True)])
        turn = Rotation.from_matrix(R) * Rotation.from_matrix(R_true).inv()
        shares.append(100 * float((turn.magnitude() > np.radians(5)).mean()))
    return tuple(shares)


CAPTIONS = (
    Claim(rf"EPnP is over 5° off in ({NUMBER}) %, SQPnP in ({NUMBER}) %\.", turned_far),
    Claim(r"sees the three points exactly where they were seen", exactly),
    Claim(rf"The pose is ({NUMBER})° and ({LENGTH}) from the truth\.", told),
    Claim(r"The better one is taken", better),
    Claim(r"(It looks settled, and it|It) is wrong(\.|: without a pose)", ended),
    Claim(r"New best after", best),
    Claim(rf"In ({NUMBER}) % the wrong one of the two poses fitted better\.", swapped),
    Claim(r"(\d+) of (\d+) are right\.", counted),
    Claim(r"All \d+ are right\.", all_right),
    Claim(r"is there a solution: all are wrong\.", lambda run, k, m: not len(run.states[k].now.Ts)),
)


def others(run: Run) -> Repeated:
    return run.states[-1].now


def of_stop(run: Run) -> int:
    """Where the way down ends."""
    return next(
        k for k, state in enumerate(run.states) if getattr(state.now, "phase", "") == "stop"
    )


def left_to_chance(run: Run, k: int, m: re.Match[str]) -> bool:
    """In a good part of the pictures, but not in most, the other pose fits better; by less than the
    noise adds up to.
    """
    repeated = others(run)
    assert repeated.swapped is not None
    return 0.15 < repeated.swapped / repeated.pictures < 0.7


LINES = {
    "tiny": (Claim(r"which of them fits better is left to chance", left_to_chance),),
    "safe": (
        Claim(
            r"the same noise, and it ends right",
            lambda run, k, m: (
                bool(is_right(run.states[of_stop(run)]))
                and share_near(others(run), run.states[0].subject) == 1
            ),
        ),
    ),
    "believed": (
        Claim(
            r"^Two wrong points of twenty",
            lambda run, k, m: int(run.states[0].subject.given.is_outlier.sum()) == 2,
        ),
    ),
}

WHYS = {
    "predict-few": (
        Claim(
            rf"^In ({NUMBER}) % by this implementation, by OpenCV's in about twice as many, and"
            rf" SQPnP's in ({NUMBER}) %",
            lambda run, k, m: turned_far(run, len(run.states) - 1, m),
        ),
    ),
    "predict-plane": (
        Claim(
            rf"^By ({NUMBER})° in the middle of 40 pictures",
            lambda run, k, m: near(
                m[1],
                float(np.median([off(T, run.states[0].subject.T_true)[0] for T in others(run).Ts])),
            ),
        ),
    ),
}
