"""What the explanations of the pinhole lesson's questions say, held against the camera written out
in plain numpy.
"""

import re
from dataclasses import replace

import numpy as np

from tests.readings import NUMBER, number, says
from tests.truths.pinhole import TOWER, bent, camera, centre, height, pixels_at
from tests.verdicts import Claim, Run
from workbench.data.views.street import street

POINT = rf"\(({NUMBER}), ({NUMBER}), ({NUMBER})\)"


def place(m: re.Match[str], p: np.ndarray) -> bool:
    return all(
        says(text, float(value)) for text, value in zip(m.groups()[: len(p)], p, strict=True)
    )


def _step_right(run: Run, p: np.ndarray) -> float:
    """By how many pixels a point moves to the right when the camera steps 2 m to its right."""
    before, after = (
        K @ (R @ p + t) for R, t, K in (camera(replace(run.params, aside=a)) for a in (0.0, 2.0))
    )
    return float(after[0] / after[2] - before[0] / before[2])


def _bow(run: Run) -> float:
    """How far straight edges through the middle leave their lines, px, at most over all
    directions.
    """
    r = np.linspace(-0.7, 0.7, 57)
    worst = 0.0
    for angle in np.linspace(0.0, np.pi, 12):
        along = np.array([np.cos(angle), np.sin(angle)])
        across = np.array([-np.sin(angle), np.cos(angle)])
        worst = max(
            worst, run.params.f * np.abs(bent(run.params, r[:, None] * along) @ across).max()
        )
    return float(worst)


WHYS = {
    "predict-dolly": (
        Claim(
            rf"It grows from ({NUMBER}) to ({NUMBER}) px. .*f is three times as long, and the"
            r" tower's Z, which was larger to"
            " begin with, did not grow three times",
            lambda run, k, m: bool(
                says(m[1], height(run.params, TOWER, 1.0))
                and says(m[2], height(run.params, TOWER))
                and number(m[2]) > number(m[1])
                and 1
                < np.linalg.norm(TOWER[0] - centre(run.params))
                / np.linalg.norm(TOWER[0] - run.params.camera)
                < 3
            ),
        ),
    ),
    "predict-behind": (
        Claim(
            rf"At \(({NUMBER}), ({NUMBER})\), well inside the picture. Z = ({NUMBER}) m turns both"
            r" signs, and a lamp above the"
            " axis shows up below it",
            lambda run, k, m: bool(
                says(m[1], pixels_at(run)[5, 0])
                and says(m[2], pixels_at(run)[5, 1])
                and 40 < number(m[1]) < 280
                and 119.5 < number(m[2]) < 200
                and says(m[3], run.states[1].now.p_camera[5, 2])
                and run.states[1].now.p_camera[5, 1] < 0
            ),
        ),
    ),
    "predict-centre": (
        Claim(
            rf"It is at C = −Rᵀt = {POINT} m",
            lambda run, k, m: place(m, np.array(run.params.camera)),
        ),
        Claim(
            rf"Both are ({NUMBER}) m long",
            lambda run, k, m: (
                says(m[1], float(np.linalg.norm(camera(run.params)[1])))
                and says(m[1], float(np.linalg.norm(run.params.camera)))
            ),
        ),
    ),
    "predict-rails": (
        Claim(
            rf"It moves by ({NUMBER}) px, while a near point of the rail moves by ({NUMBER}) px to"
            r" the left",
            lambda run, k, m: (
                says(m[1], abs(_step_right(run, np.array([0.0, 1e9, 0.0]))))
                and says(m[2], -_step_right(run, street().points[3]))
            ),
        ),
    ),
    "through-the-middle": (
        Claim(rf"It is bent by ({NUMBER}) px", lambda run, k, m: says(m[1], _bow(run))),
    ),
    "predict-crop": (
        Claim(
            rf"({NUMBER}) px: first .*The middle of the picture is ({NUMBER}) px",
            lambda run, k, m: (
                says(m[1], (159.5 - 60 + 0.5) / 2 - 0.5)
                and says(m[2], ((320 - 60) / 2 - 1) / 2)
                and says(m[1], float(run.subject.K[0, 2]))
            ),
        ),
    ),
}
