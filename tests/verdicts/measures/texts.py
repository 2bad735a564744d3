"""What lines of presets and explanations of questions of the measures lesson say, decided from the
last step of their runs.
"""

import re

import numpy as np

from tests.own_seed import of_preset
from tests.readings import number, says_percent
from tests.truths.measures import determinants, lantern_area, sums, truth
from tests.verdicts import Claim, Run
from tests.verdicts.measures.captions import PERCENT, VALUE, ball_share
from workbench.algorithms.surfaces.measures import Cells
from workbench.algorithms.surfaces.monte_carlo import Throws


def last(run: Run):
    return next(state for state in reversed(run.states) if state.study is None)


def shares(run: Run) -> np.ndarray:
    result = last(run).now
    assert isinstance(result, Cells)
    return np.array(result.areas) / truth(last(run))[0]


def lost(run: Run) -> float:
    return 1 - sums(last(run))[1] / truth(last(run))[1]


def plus_share(run: Run) -> float:
    parts = determinants(last(run))
    return float(parts[parts > 0].sum()) / truth(last(run))[1]


LINES = {
    "origin": [
        Claim(
            r"all plus together are 12 times the rabbit, all minus 11 times",
            lambda run, k, m: abs(plus_share(run) - 12) < 0.1,
        ),
        Claim(
            r"seven diagonals",
            lambda run, k, m: (
                round(float(np.linalg.norm(run.params.origin)) / last(run).subject.diagonal) == 7
            ),
        ),
    ],
    "hole": [
        Claim(r"1 % of the triangles", lambda run, k, m: run.params.hole == 0.01),
        Claim(
            r"one diagonal behind, 6\.6 % of the volume go with them",
            of_preset(
                lambda run, k, m: (
                    abs(np.linalg.norm(run.params.origin) / last(run).subject.diagonal - 1) < 0.05
                    and abs(lost(run) - 0.066) < 0.0006
                )
            ),
        ),
    ],
    "flipped": [
        Claim(
            r"10 % of the volume are gone",
            of_preset(lambda run, k, m: abs(lost(run) - 0.10) < 0.005),
        ),
        Claim(
            r"6 to 13 % with other seeds, and of the area nothing",
            lambda run, k, m: (
                0.06 < lost(run) < 0.13 and abs(sums(last(run))[0] / truth(last(run))[0] - 1) < 1e-9
            ),
        ),
    ],
    "overlap": [
        Claim(
            r"every tetrahedron is right, and what lies in both spheres is counted twice",
            lambda run, k, m: abs(sums(last(run))[1] / (8 * np.pi / 3) - 1) < 0.01,
        ),
    ],
    "union": [
        Claim(
            r"0\.1 % off with 32 cells, where the meshes were 17\.5 %",
            of_preset(
                lambda run, k, m: (
                    last(run).now.across[-1] == 32
                    and abs(abs(last(run).now.volumes[-1] / truth(last(run))[1] - 1) - 0.0012)
                    < 1e-4
                )
            ),
        ),
    ],
    "lantern": [
        Claim(
            r"11 in a ring, in 121 bands",
            lambda run, k, m: (run.params.sectors, run.params.rings) == (11, 121),
        ),
    ],
    "stratified": [
        Claim(
            r"an error that falls faster",
            lambda run, k, m: (
                abs(last(run).volume_error)
                < 0.5 * last(run).now.estimates.errors[-1] / truth(last(run))[1]
            ),
        ),
    ],
    "alike": [
        Claim(
            r"86 % of the points there, for 60 % of the area",
            of_preset(
                lambda run, k, m: (
                    abs(last(run).half_hits - 0.86) < 0.005
                    and abs(last(run).half_share - 0.6) < 0.005
                )
            ),
        ),
    ],
    "no-root": [
        Claim(
            r"half of all points crowd at corner a",
            lambda run, k, m: abs(run.states[3].quarters[0] - 0.5) < 0.03,
        ),
    ],
    "normalised": [
        Claim(
            r"half of all points crowd in the middle quarter",
            lambda run, k, m: abs(run.states[3].quarters[3] - 0.5) < 0.03,
        ),
    ],
    "lines": [
        Claim(
            r"0\.4 % off with 4,000 lines",
            of_preset(lambda run, k, m: abs(abs(last(run).area_error) - 0.004) < 5e-4),
        ),
    ],
}


def _tenfold(run: Run, k: int, m: re.Match[str]) -> bool:
    result = last(run).now
    assert isinstance(result, Throws)
    errors = dict(
        zip(
            result.estimates.counts,
            np.array(result.estimates.errors) / truth(last(run))[1],
            strict=True,
        )
    )
    agrees = says_percent(m[2], errors[1000]) and says_percent(m[3], errors[100_000])
    return agrees and abs(number(m[1]) - 100) < 1 and abs(errors[1000] / errors[100_000] - 10) < 0.3


WHYS = {
    "predict-walls": [
        Claim(
            rf"With 16 cells {VALUE} times, with 64 cells {VALUE} times",
            lambda run, k, m: (
                abs(number(m[1]) - shares(run)[4]) < 0.0051
                and abs(number(m[2]) - shares(run)[-1]) < 0.0051
                and last(run).now.across[4] == 16
                and last(run).now.across[-1] == 64
            ),
        ),
    ],
    "predict-tenth": [
        Claim(
            rf"{VALUE} times: the standard error falls from {PERCENT} at 1,000 throws to {PERCENT}"
            r" at 100,000",
            _tenfold,
        ),
    ],
    "predict-hits": [
        Claim(
            r"^(\d+)\. The corners take over",
            lambda run, k, m: number(m[1]) == last(run).now.hits[-1],
        ),
        Claim(
            r"a quarter of a per cent of its cube",
            lambda run, k, m: abs(ball_share(10) - 0.0025) < 1e-4,
        ),
        Claim(r"at twenty no throw finds it", lambda run, k, m: 100_000 * ball_share(20) < 0.01),
    ],
    "predict-inscribed": [
        Claim(
            rf"The area is {PERCENT} too small, the volume {PERCENT}",
            lambda run, k, m: (
                says_percent(m[1], 1 - sums(last(run))[0] / (4 * np.pi))
                and says_percent(m[2], lost(run))
            ),
        ),
    ],
    "predict-lantern": [
        Claim(
            rf"{VALUE} times that of the cylinder",
            lambda run, k, m: abs(number(m[1]) - lantern_area(11, 121)) < 0.0051,
        ),
    ],
}
