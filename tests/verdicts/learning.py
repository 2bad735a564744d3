"""Decides what the learning lesson says: by scipy's rotations, trimesh, and networks asked one
cloud at a time.
"""

import re
from typing import Any

import numpy as np

from lessons.learning.captions import caption as caption
from tests.own_seed import of_preset
from tests.readings import LENGTH, NUMBER, metres, number, says
from tests.truths import decided
from tests.truths.learning import farthest, folded, named, overlap, radii, to_given, wrong_by
from tests.verdicts import Claim, Run

VALUE, TURN = rf"({NUMBER})", rf"({NUMBER})°"


def right(run: Run, k: int) -> bool | None:
    """Only an end is judged: by the worst turn, the spread of a circle, folded edges, clouds named,
    views never seen.
    """
    if not run.states[k].last:
        return None
    value, good, bad = judged(run, k)
    if good < bad:
        return decided(value <= good, wrong=value >= bad)
    return decided(value >= good, wrong=value <= bad)


def judged(run: Run, k: int) -> tuple[float, float, float]:
    """The number by which an end is judged, and where it is right and where wrong."""
    state = run.states[k]
    match state.params.task:
        case "angle" | "rotation":
            return float(wrong_by(state).max()), 15, 90
        case "sets":
            return float(radii(state).std()), 0.02, 0.05
        case "mesh":
            return folded(state), 0.02 if farthest(state) <= 0.05 else -1, 0.2
        case "classify":
            return named(state, "changed"), 0.9, 0.6
        case _:
            return state.about.unseen, 18, 12


def same_angle(text: str, degrees: Any) -> bool:
    """Whether an angle is said to three digits."""
    return abs(number(text) - degrees) <= 0.006 * max(degrees, 0.01) + 1e-3


def end(run: Run):
    return run.states[-1]


def _worst(run: Run, k: int, m: re.Match[str]) -> bool:
    errors = wrong_by(run.states[k])
    at = np.abs(np.abs(run.states[k].about.degrees) - abs(number(m[2]))) < 0.51
    return same_angle(m[1], errors.max()) and bool(errors[at].max() > errors.max() - 0.01)


def _radii(run: Run, k: int, m: re.Match[str]) -> bool:
    r = radii(run.states[k])
    return all(
        says(text, value)
        for text, value in zip(m.groups(), (r.min(), r.max(), r.mean(), r.std()), strict=True)
    )


CAPTIONS = [
    Claim(
        rf"wrong by {TURN} on average",
        lambda run, k, m: same_angle(m[1], wrong_by(run.states[k]).mean()),
    ),
    Claim(rf"at most by {TURN}, for (?:a turn of|a rotation by) {TURN}", _worst),
    Claim(
        rf"For the picked one, {TURN}: {TURN}",
        lambda run, k, m: same_angle(
            m[2], wrong_by(run.states[k])[run.params.picked % len(run.states[k].now.errors)]
        ),
    ),
    Claim(
        rf"radii from {VALUE} to {VALUE} m, {VALUE} on average, with a spread of {VALUE} m", _radii
    ),
    Claim(
        rf"({LENGTH}) from the given points",
        lambda run, k, m: (
            abs(metres(m[1]) / np.sqrt(to_given(run.states[k])) - 1) < 0.08
            if run.states[k].last
            else True
        ),
    ),
    Claim(r"from its true surface \(roots of Chamfer\)", None),
    Claim(
        rf"The farthest part of that surface is ({LENGTH}) from the mesh",
        lambda run, k, m: (
            abs(metres(m[1]) - farthest(run.states[k])) < (0.02 if run.states[k].last else 0.04)
        ),
    ),
    Claim(
        rf"Folded by over 90°: {VALUE} % of the edges",
        lambda run, k, m: says(m[1], 100 * folded(run.states[k]), 2),
    ),
    Claim(
        rf"{VALUE} % of 100 new clouds are named rightly",
        lambda run, k, m: not run.states[k].last or says(m[1], 100 * named(run.states[k], "plain")),
    ),
    Claim(
        rf"The same [\w ,]+: {VALUE} %",
        lambda run, k, m: (
            not run.states[k].last or says(m[1], 100 * named(run.states[k], "changed"))
        ),
    ),
    Claim(
        rf"Density and discs share {VALUE} % of what they cover",
        lambda run, k, m: says(m[1], 100 * overlap(run.states[k])),
    ),
    Claim(r"It looks settled, and it is wrong", lambda run, k, m: right(run, k) is False),
]

LINES = {
    "rotation": [
        Claim(
            r"After 1,500 updates the worst error is 3\.6°",
            of_preset(lambda run, k, m: abs(wrong_by(end(run)).max() - 3.6) < 0.05),
        )
    ],
    "euler": [
        Claim(
            r"the worst is over 150°", of_preset(lambda run, k, m: wrong_by(end(run)).max() > 150)
        ),
        Claim(
            r"the mean error is over seven times that of six numbers",
            lambda run, k, m: wrong_by(end(run)).mean() > 7 * 1.3,
        ),
    ],
    "nine": [
        Claim(
            r"1\.05° off on average after 1,500 updates",
            of_preset(lambda run, k, m: abs(wrong_by(end(run)).mean() - 1.05) < 0.005),
        )
    ],
    "spikes": [
        Claim(
            r"after 80 updates 48 % of them",
            of_preset(lambda run, k, m: abs(folded(end(run)) - 0.48) < 0.005),
        )
    ],
    "smooth": [Claim(r"its ears are cut short", lambda run, k, m: farthest(end(run)) > 0.05)],
    "quaternion": [
        Claim(
            r"all errors over 20° are beyond 178°",
            of_preset(lambda run, k, m: min(end(run).about.degrees[wrong_by(end(run)) > 20]) > 178),
        ),
    ],
    "quaternion-matrix": [
        Claim(
            r"look for the large errors inside the ball",
            lambda run, k, m: min(end(run).about.degrees[wrong_by(end(run)) > 20]) < 165,
        ),
    ],
}

WHYS = {
    "predict-cut": [
        Claim(
            rf"At {TURN}, by {TURN}", lambda run, k, m: same_angle(m[2], wrong_by(end(run)).max())
        ),
    ],
    "predict-radius": [
        Claim(
            rf"After 150 updates a circle of radius {VALUE} m, spread {VALUE} m",
            lambda run, k, m: (
                says(m[1], radii(end(run)).mean()) and says(m[2], radii(end(run)).std())
            ),
        ),
    ],
    "predict-stray": [
        Claim(
            rf"^{VALUE} % of them, where chance gives 20 %; untouched {VALUE} %",
            lambda run, k, m: (
                says(m[1], 100 * named(end(run), "changed"))
                and says(m[2], 100 * named(end(run), "plain"))
            ),
        ),
    ],
    "predict-views": [
        Claim(
            rf"With {VALUE} dB: more to explain, so each is explained less well",
            lambda run, k, m: says(m[1], end(run).about.trained) and end(run).about.trained < 32,
        ),
        Claim(
            rf"views it was never shown have {VALUE} dB",
            lambda run, k, m: says(m[1], end(run).about.unseen),
        ),
    ],
}
