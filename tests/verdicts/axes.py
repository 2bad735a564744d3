"""When the sentences of the alignment lesson are true, decided with scipy from the scans and the truth they carry."""

import itertools
import re

import numpy as np

from lessons.alignment.captions import caption
from tests.readings import LENGTH, NUMBER, near, near_length, number
from tests.truths.alignment import HOME, eigenvectors, many, to_nearest, turn_left
from tests.verdicts import Claim, Run

__all__ = ["CAPTIONS", "LINES", "WHYS", "caption", "right"]

ANGLE = rf"(less than 0\.001|{NUMBER})°"


def angle_close(said: str, true: float) -> bool:
    return true < 0.0011 if said.startswith("less") else near(said, true) or abs(number(said) - true) < 1e-6


def length_close(said: str, true: float) -> bool:
    return near_length(said, true) or (said == "0 mm" and true < 1e-9)


def right(run: Run, k: int) -> bool | None:
    state = run.states[k]
    return None if state.moment != "pose" or state.scans.T_target_source is None else turn_left(state) < HOME


def laid(run: Run, k: int, m: re.Match[str]) -> bool:
    """Said of the frame laid on the frame: how near, how far from the truth, and what that makes it."""
    state, said = run.states[k], m.groupdict()
    at_home = "home" in m[0]
    return (
        length_close(said["near"], to_nearest(state))
        and angle_close(said["off"], turn_left(state))
        and at_home == (turn_left(state) < HOME)
    )


def came_home(run: Run, k: int, m: re.Match[str]) -> bool:
    ended = many(run.states[k])
    return bool(abs(float(m[1]) - 100 * np.mean(ended < HOME)) <= 0.51) and angle_close(m[2], float(np.median(ended)))


CAPTIONS = (
    Claim(
        rf"the second scan is (?P<off>{ANGLE[1:-2]})° from the truth; its points lie (?P<near>{LENGTH}) \(RMS\) from the"
        r" nearest of the first\. It has come home\.",
        laid,
    ),
    Claim(
        rf"its points lie (?P<near>{LENGTH}) \(RMS\) from the nearest of the first, and it is wrong,"
        rf" (?P<off>{ANGLE[1:-2]})° from the truth",
        laid,
    ),
    Claim(rf"(\d+) % come home, within 10°\. The median rotation error is {ANGLE}", came_home),
)


def axes_are_there(run: Run, k: int, m: re.Match[str]) -> bool:
    """The last rotation leaves the eigenvectors, in whatever order and of whatever sign."""
    last = [state for state in run.states if state.moment == "rotation"][-1]
    across = np.abs(eigenvectors(last.scans.p_source).T @ last.jacobi.V)
    return bool(np.allclose(np.sort(across, axis=0), [[0] * 3, [0] * 3, [1] * 3], atol=1e-6))


LINES = {
    "home": (Claim("Plane turns find the axes", axes_are_there),),
    "stray": (
        Claim(
            r"Axis 1 moves by 2° only",
            lambda run, k, m: run.params.seed != 0 or near("2", float(run.states[-2].outcome.axes[0]), 1),
        ),
    ),
}


def half_of_the_choices(run: Run, k: int, m: re.Match[str]) -> bool:
    axes = eigenvectors(run.states[-1].scans.p_source)
    hands = [np.linalg.det(axes * signs) > 0 for signs in itertools.product((1, -1), repeat=3)]
    return (len(hands), sum(hands)) == (8, int(m[1]))


WHYS = {
    "predict-rotations": (
        Claim(r"^(\d+) rotations", lambda run, k, m: sum(s.moment == "rotation" for s in run.states) == int(m[1])),
    ),
    "predict-frames": (Claim(r"^(\d): each line has two ends, and of the eight choices half", half_of_the_choices),),
    "predict-signs": (
        Claim(
            r"^(\d+) %", lambda run, k, m: bool(abs(float(m[1]) - 100 * np.mean(many(run.states[-1]) < HOME)) <= 0.51)
        ),
    ),
}
