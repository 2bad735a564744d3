"""What lines of presets and explanations of questions of the curvature lesson say, decided from
the steps of their runs.
"""

import numpy as np

from lessons.curvature.inputs import Input
from tests.own_seed import of_preset
from tests.readings import number, says_percent
from tests.truths.curvature import (
    angle_K,
    at,
    defects,
    exact_sum,
    facts,
    inside,
    mean_of,
    off_by_five_times_itself,
    off_by_more_than_itself,
    on_the_torus,
    params,
    regular,
    rms,
    run_of,
    scaled_by_two,
    slope,
    study,
    too_small,
    turned,
)
from tests.verdicts.curvature.captions import PERCENT, VALUE, claim

LINES = {
    "cylinder": [
        claim(
            r"H is 1/2r = 1 m⁻¹",
            lambda run, k, m: bool(np.allclose(inside(run, "mean", "H"), 1, rtol=2e-3)),
        ),
    ],
    "catenoid": [
        claim(
            r"Catenoid: H = 0, K < 0",
            lambda run, k, m: (
                bool((inside(run, "gaussian", "K") < 0).all())
                and np.abs(inside(run, "mean", "H")).max() < 0.02
            ),
        ),
        claim(
            r"negative everywhere", lambda run, k, m: bool((inside(run, "gaussian", "K") < 0).all())
        ),
    ],
    "double": [
        claim(
            r"Every length is doubled",
            lambda run, k, m: (
                np.ptp(run.states[0].subject.p) == 2 * np.ptp(next(iter(run_of(Input()))).subject.p)
            ),
        ),
    ],
    "no-area": [
        claim(
            r"about a hundred times too small here, and about four times smaller still on a mesh"
            r" four times as fine",
            too_small,
        ),
    ],
    "no-half": [
        claim(
            r"H = 2 m⁻¹, and H² − K = 3",
            lambda run, k, m: (
                bool(np.allclose(inside(run, "mean", "H"), 2, rtol=1e-2))
                and bool(
                    np.allclose(
                        inside(run, "mean", "H") ** 2 - angle_K(at(run, "mean")), 3, atol=0.15
                    )
                )
            ),
        ),
    ],
    "border": [
        claim(
            r"K and H are left open \(grey\) there",
            lambda run, k, m: (
                bool(facts(run.states[0])[2][run.states[0].now.vertex])
                and bool((np.isnan(at(run, "mean").now.H) == facts(run.states[0])[2]).all())
            ),
        ),
    ],
    "border-2pi": [
        claim(
            r"should add up to 2π",
            lambda run, k, m: abs(defects(run.states[0]).sum() - 2 * np.pi) < 1e-9,
        ),
        claim(
            r"each border vertex adds π that is not there, and the sum is far off",
            lambda run, k, m: (
                abs(at(run, "total").now.total - 2 * np.pi - np.pi * facts(run.states[0])[2].sum())
                < 1e-6
            ),
        ),
    ],
    "coarse": [
        claim(
            r"With 60 vertices the relative error of K is about 10 %",
            lambda run, k, m: (
                0.09
                < rms(
                    angle_K(at(run, "gaussian")),
                    at(run, "gaussian").subject.truth.gaussian,
                    ~facts(run.states[0])[2],
                )
                < 0.11
            ),
        ),
    ],
    "fine": [
        claim(r"0\.13 % \(RMS\): on a regular mesh it falls with the square of the edges", regular)
    ],
    "noise": [
        claim(r"K is off by more than its own size", off_by_more_than_itself),
        claim(
            r"A finer mesh makes it worse",
            lambda run, k, m: bool((np.diff(study(run).K) > 0).all()),
        ),
    ],
    "irregular": [claim(r"along the surface, never off it", on_the_torus)],
    "sphere-sum": [
        claim(r"off by over five times its own size", of_preset(off_by_five_times_itself))
    ],
    "torus-sum": [
        claim(
            r"cancel to the last digit",
            lambda run, k, m: abs(at(run, "total").now.defects.sum()) < 1e-9,
        ),
        claim(r"a handle", lambda run, k, m: facts(run.states[0])[3] == 0),
    ],
}

WHYS = {
    "seven": [
        claim(
            r"6 times 70° is 420°",
            lambda run, k, m: any(s.gap == -60 and s.angle == 70 for s in run.states),
        )
    ],
    "inside": [
        claim(
            rf"{VALUE}° of gaps and {VALUE}° of overlaps",
            lambda run, k, m: (
                abs(number(m[1]) - np.degrees(np.maximum(defects(run.states[0]), 0).sum())) < 0.06
                and abs(number(m[2]) + np.degrees(np.minimum(defects(run.states[0]), 0).sum()))
                < 0.06
            ),
        )
    ],
    "which-rolled": [
        claim(
            rf"K = {VALUE} m⁻² and H = {VALUE} m⁻¹",
            lambda run, k, m: (
                abs(number(m[1]) - 0) < 5e-4 and abs(number(m[2]) - 1 / (2 * 0.5)) < 2e-3
            ),
        ),
        claim(
            r"no angle changes",
            lambda run, k, m: bool(
                np.abs(defects(run.states[0])[~facts(run.states[0])[2]]).max() < 1e-9
            ),
        ),
    ],
    "which-double": [
        claim(
            r"It is ([\d.]+) times what it was: the angles stay, and each vertex has four times"
            r" the "
            r"area\. H would be halved",
            lambda run, k, m: number(m[1]) == 0.25 and scaled_by_two(run),
        ),
    ],
    "which-sides": [
        claim(
            r"H turns with the normal\. K is the product",
            lambda run, k, m: (
                bool(np.allclose(angle_K(run.states[-1]), angle_K(turned(run))))
                and bool(
                    np.allclose(at(run, "mean").now.H, -mean_of(params(run, inside_out=False)))
                )
            ),
        ),
    ],
    "which-finer": [
        claim(
            rf"from {PERCENT} to {PERCENT} \(RMS\)",
            lambda run, k, m: (
                says_percent(m[1], study(run).K[0]) and says_percent(m[2], study(run).K[-1])
            ),
        ),
        claim(
            rf"so does the error of defect / area; that of the quadric fit falls to {PERCENT}",
            lambda run, k, m: (
                abs(slope(study(run).K, study(run).counts)) < 0.15
                and study(run).K_fit[-1] < study(run).K_fit[0] / 5
                and says_percent(m[1], study(run).K_fit[-1])
            ),
        ),
    ],
    "which-sum": [
        claim(
            r"V − E \+ F = (\d+), and 2π times that is 4π",
            lambda run, k, m: int(m[1]) == facts(run.states[0])[3] == 2 and exact_sum(run),
        ),
    ],
}
