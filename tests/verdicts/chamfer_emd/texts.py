"""What preset lines and explanations of the lesson on Chamfer and earth mover's say, decided from
where its runs begin and end.
"""

import re

import numpy as np
import scipy

from tests.own_seed import of_preset
from tests.readings import number, says
from tests.verdicts import Claim, Run
from tests.verdicts.chamfer_emd.captions import FIGURE, SHARE, _numbers, near
from tests.verdicts.chamfer_emd.values import (
    _held,
    chamfer,
    emd,
    index_mse,
    larger,
    measured,
    moving,
    plan_cost,
    target_of,
)


def start(run: Run) -> np.ndarray:
    return moving(run, 0, "left")


def _idle(run: Run, *_) -> bool:
    p = moving(run, -1, "left")
    target = target_of(run)
    serving = np.unique(scipy.spatial.distance.cdist(p, target).argmin(axis=0))
    idle = np.setdiff1d(np.arange(len(p)), serving)
    moved = np.linalg.norm(p - start(run), axis=1)[idle]
    return len(idle) == 71 and len(p) == 80 == len(target) and float(np.median(moved)) == 0.0


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
    p = moving(run, -1, "right")
    target = target_of(run)
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
