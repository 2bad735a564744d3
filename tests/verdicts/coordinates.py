"""When the sentences of the coordinates lesson are true, decided by vectors and closed forms from
its states.
"""

import re

import numpy as np

from lessons.coordinates.placing import Walked
from tests.readings import LENGTH, NUMBER, near, near_length, number, says
from tests.truths.coordinates import (
    apart,
    between_means,
    fastest,
    in_caps,
    is_right,
    put_back,
    straight_over_shortest,
)
from tests.verdicts import Claim, Run

__all__ = ["CAPTIONS", "LINES", "WHYS", "right"]


def right(run: Run, k: int) -> bool | None:
    return is_right(run.states[k])


def walked(run: Run, k: int, m: re.Match[str]) -> bool:
    return put_back(run.states[k].now) < 1e-6


def largest_turn(run: Run, k: int, m: re.Match[str]) -> bool:
    """The largest change of the azimuth, from the points of the walk."""
    p = run.states[k].now.p
    directions = p[:, :2] / np.linalg.norm(p[:, :2], axis=1)[:, None]
    a = directions[:-1]
    b = directions[1:]
    turns = np.degrees(
        np.arctan2(np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]), (a * b).sum(axis=1))
    )
    return near_length(m[1], float(np.linalg.norm(p[-1] - p[-2]))) and near(
        m[2], float(turns.max())
    )


def shared(run: Run, k: int, m: re.Match[str]) -> bool:
    share = 100 * in_caps(run.states[k].now.p)
    return says(m[1], share) and m[2].startswith("even") == bool(is_right(run.states[k]))


def meant(run: Run, k: int, m: re.Match[str]) -> bool:
    off = between_means(run.states[k].subject.degrees)
    return says(m[1], off / 1e3) and m[2].endswith("right.") == (off < 1e4)


def followed(run: Run, k: int, m: re.Match[str]) -> bool:
    pan, sight = fastest(run.params.miss)
    return (
        near(m[1], pan, 4 if pan >= 1000 else 3)
        and near(m[2], sight, 3)
        and all(state.now.off < 1e-9 for state in run.states)
    )


def still_met(run: Run, k: int, m: re.Match[str]) -> bool:
    step = run.states[k].now
    return bool(np.abs(step.lines @ step.x_h).max() < 1e-9)


CAPTIONS = (
    Claim(r"its coordinates put every place back where it was: right\.", walked),
    Claim(rf"One step of ({LENGTH}) changed φ by ({NUMBER})°", largest_turn),
    Claim(
        rf"({NUMBER}) % of the points lie within 30° of a pole, in 13\.4 % of the area: (even, but"
        r" for chance, and right"
        r"|drawn evenly in θ, they are not even on the sphere\. It is wrong)",
        shared,
    ),
    Claim(
        rf"The mean of the latitudes and longitudes is ({NUMBER}) km from the middle of the"
        r" places(: here it is right\."
        r"|\. It is wrong\.)",
        meant,
    ),
    Claim(
        r"The target was in the middle all the time: right\. For that the pan axis turned with"
        rf" ({NUMBER})°/s at its"
        rf" fastest, the line of sight with ({NUMBER})°/s",
        followed,
    ),
    Claim(r"Both lines still go through it: right\.", still_met),
)


def longer(run: Run) -> float:
    return 100 * (straight_over_shortest(run.states[0].subject.degrees) - 1)


def _ten_metres(run: Run, *_) -> bool:
    step = run.states[-2].now
    return (
        abs(step.circle_length / 1e3 - 12_348) < 0.5
        and abs(longer(run) / 100 * step.circle_length - 10) < 0.5
    )


def calm(run: Run, k: int, m: re.Match[str]) -> bool:
    pan, sight = fastest(run.params.miss)
    return pan > 9.9 * fastest(1.0)[0] and abs(sight - fastest(1.0)[1]) < 0.1


LINES = {
    "cartesian": (
        Claim(
            r"on the same walk no coordinate jumps",
            lambda run, k, m: bool(
                max(
                    np.abs(np.diff(s.now.c, axis=0)).max()
                    for s in run.states[-1:]
                    if isinstance(s.now, Walked)
                )
                < 0.08
            ),
        ),
    ),
    "anchorage": (
        Claim(r"is 33\.6 % longer here", lambda run, k, m: abs(longer(run) - 33.6) < 0.05),
    ),
    "equator": (
        Claim(
            r"of 12,348 km the map's straight line is 10 m longer than the great circle",
            _ten_metres,
        ),
    ),
    "banana": (
        Claim(
            r"their mean lies inside the bend",
            lambda run, k, m: float(np.linalg.norm(run.states[-1].now.mean)) < 9.5,
        ),
    ),
    "keyhole": (Claim(r"as calm as before, the pan axis turns ten times as fast", calm),),
    "wide": (
        Claim(
            r"twice as fast as the line of sight",
            lambda run, k, m: bool(abs(np.divide(*fastest(30.0)) - 2) < 0.01),
        ),
    ),
    "saturn": (
        Claim(
            r"are up to 5\.9° apart, 5,980 km along its clouds",
            lambda run, k, m: (
                abs(run.states[-1].now.apart.max() - 5.98e6) < 5e3
                and abs(
                    np.degrees(np.max(run.states[-1].now.latitude - run.states[-1].now.geocentric))
                    - 5.9
                )
                < 0.05
            ),
        ),
    ),
}

WHYS = {
    "predict-poles": (
        Claim(
            rf"^({NUMBER}) %: 60° of the 180°",
            lambda run, k, m: says(m[1], 100 * in_caps(run.states[-1].now.p)),
        ),
    ),
    "predict-way": (
        Claim(
            rf"^({NUMBER}) %: ({NUMBER}) km for ({NUMBER}) km",
            lambda run, k, m: (
                abs(number(m[1]) - longer(run)) < 0.06
                and says(
                    m[3],
                    apart(run.states[0].subject.degrees[:1], run.states[0].subject.degrees[1:])[0]
                    / 1e3,
                )
            ),
        ),
    ),
    "predict-pan": (
        Claim(
            rf"^({NUMBER})°/s at its fastest: v / d with d = 17 cm",
            lambda run, k, m: near(m[1], fastest(1.0)[0], 4),
        ),
    ),
    "predict-ball": (
        Claim(rf"^({NUMBER}): 1 · π · 2π", lambda run, k, m: says(m[1], 2 * np.pi**2)),
    ),
    "predict-mean": (
        Claim(
            rf"^({NUMBER}) km from the middle",
            lambda run, k, m: says(m[1], between_means(run.states[-1].subject.degrees) / 1e3),
        ),
    ),
}
