"""What lines of presets and explanations of questions of the RANSAC lesson say, decided from the
rows and the truth that a run carries.
"""

import dataclasses
import re
from collections.abc import Callable

import numpy as np

from tests.readings import NUMBER, near, near_length
from tests.truths.ransac import (
    apart,
    at_true_share,
    clean,
    clutter_votes,
    drawn,
    enough_for,
    error_of_rival,
    finished,
    kept,
    last_error,
    limit_of,
    refused,
    votes_on,
)
from tests.verdicts import Claim, Run
from tests.verdicts.ransac.values import VALUES


def distance(name: str) -> str:
    """Return what finds a distance and calls it so."""
    return rf"(?P<{name}>{NUMBER} (?:mm|µm|m|px))"


def same(text: str, value: float) -> bool:
    """Whether a distance as it is written is this one, to the digits that are written: of thousands
    of pixels two.
    """
    if not text.endswith("px"):
        return near_length(text, value)
    return near(text.removesuffix(" px"), value, 3 if value < 1e3 else 2)


# preset lines -------------------------------------------------------------------------------------


def at(seed: int, holds: Callable[[Run], bool]) -> Callable[[Run, int, re.Match[str]], bool]:
    """Judge a number that is seen at the preset's own seed, and there alone."""
    return lambda run, k, m: run.params.seed != seed or holds(run)


def both_kept(run: Run) -> bool:
    by_count = kept(finished(dataclasses.replace(run.params, score="count")))
    return near("5", 1e3 * kept(run), 1) and near("49", 1e3 * by_count, 2)


def twice_as_many(run: Run, k: int, m: re.Match[str]) -> bool:
    """Of the points on either plane: the wall is upright in the table's own directions, 1 m from
    its middle.
    """
    best = run.states[-1].best
    true = run.subject.is_inlier
    wall = best.inliers & ~true  # the final plane, where that is upright, is the wall
    return abs(best.estimate[2]) < 0.3 and bool(1.8 < wall.sum() / true.sum() < 2.3)


def sooner(run: Run) -> bool:
    return (drawn(run), drawn(finished(dataclasses.replace(run.params, local_refit=False)))) == (
        53,
        80,
    )


def trusted_ends(run: Run) -> bool:
    by_chance = finished(dataclasses.replace(run.params, sampler="uniform", steps="improvements"))
    return (drawn(run), drawn(by_chance)) == (14, 375)


def picked_are_inliers(run: Run, k: int, m: re.Match[str]) -> bool:
    rows = run.states[0].sample
    spread = float(np.linalg.norm(np.ptp(run.subject.p[rows], axis=0)))
    return picked(run) and bool(run.subject.is_inlier[rows].all() and spread < 0.3)


def picked(run: Run) -> bool:
    return set(run.states[0].sample) == set(run.params.sample[1:])


def on_a_wire(run: Run, k: int, m: re.Match[str]) -> bool:
    """The picked points are on one line, give no plane, and another sample follows."""
    first, second = run.states[0], run.states[1]
    line = np.linalg.matrix_rank(np.diff(run.subject.p[first.sample], axis=0), tol=1e-9) == 1
    return line and picked(run) and second.phase == "degenerate" and run.states[2].iteration == 2


LINES = {
    "thirty": (
        Claim(
            "A third of all samples is clean", lambda run, k, _: abs(clean(run, 3) - 1 / 3) < 0.02
        ),
        Claim(
            "13 are enough here", at(2, lambda run: drawn(run) == 13 and last_error(run) < 0.005)
        ),
        Claim(
            "drag least squares 15 cm off",
            lambda run, k, _: abs(error_of_rival(run, "least squares") - 0.15) < 0.01,
        ),
    ),
    "seventy": (
        Claim(
            "Only one sample in 37 is clean", lambda run, k, _: abs(1 / clean(run, 3) - 37) < 0.5
        ),
        Claim("126 are drawn", at(2, lambda run: drawn(run) == 126)),
        Claim(
            "the plane is still only 3 mm off",
            at(2, lambda run: near("3", 1e3 * last_error(run), 1)),
        ),
    ),
    "tight": (
        Claim(
            "4 mm is a quarter of the noise",
            lambda run, k, _: abs(run.params.inlier_distance / run.params.noise - 0.25) < 0.03,
        ),
        Claim(
            "three in four true points are refused",
            lambda run, k, _: abs(refused(run) - 0.75) < 0.1,
        ),
        Claim(
            "500 samples do not suffice",
            lambda run, k, _: (
                drawn(run) == run.params.most_samples == 500
                and enough_for(votes_on(run, run.states[-1].best.estimate) / 600, 3, 0.99) > 500
            ),
        ),
        Claim(
            "the answer rests on the few that are left",
            lambda run, k, _: bool(run.states[-1].best.inliers.mean() < 0.15),
        ),
    ),
    "loose": (
        Claim(
            "0.3 m is 20 sigma",
            lambda run, k, _: bool(np.isclose(run.params.inlier_distance, 20 * run.params.noise)),
        ),
        Claim("clutter votes too", lambda run, k, _: clutter_votes(run)),
        Claim("13 samples satisfy the formula", at(0, lambda run: drawn(run) == 13)),
        Claim("the plane ends 4 cm off", lambda run, k, _: abs(last_error(run) - 0.04) < 0.005),
    ),
    "msac": (
        Claim(
            "A count cannot tell 1 mm from 149 mm. MSAC can",
            lambda run, k, _: run.params.inlier_distance == 0.15,
        ),
        Claim(
            "the sample that it keeps is 5 mm from the truth; the one that a count keeps is 49"
            " mm off",
            at(0, both_kept),
        ),
    ),
    "two-planes": (
        Claim("a wall with twice as many points", twice_as_many),
        Claim("each new best", None),
    ),
    "collinear": (
        Claim(
            "You picked three points of a taut wire: a whole pencil of planes goes through them."
            " The sample is lost, and still counts as drawn",
            on_a_wire,
        ),
    ),
    "near-sample": (
        Claim("three points that truly belong to the plane, close together", picked_are_inliers),
        Claim(
            "the next step counts who is near it",
            lambda run, k, _: run.states[2].phase == "inliers",
        ),
    ),
    "wider": (Claim("of the true line have a ring", None),),
    "race": (Claim("one step for each new best", None),),
    "rivals": (Claim("RANSAC's and the truth", None),),
    "local": (
        Claim(
            "gathers its votes sooner: the run ends after 53 samples in place of 80", at(7, sooner)
        ),
        Claim("Refit every new best|each new best", None),
    ),
    "prosac": (
        Claim(
            "to know when to stop: after 14 samples, where chance draws 375", at(0, trusted_ends)
        ),
    ),
    "epipolar": (
        Claim(
            "seven at once must be free of outliers",
            lambda run, k, _: len(run.states[0].sample) in (0, 7),
        ),
        Claim("at 30 %", lambda run, k, _: abs(clean(run, 1) - 0.7) < 0.01),
    ),
}


# explanations -------------------------------------------------------------------------------------


def of_one_sample(run: Run, k: int, m: re.Match[str]) -> bool:
    w, cube, spoilt, needed = (float(m[name]) for name in ("w", "cube", "spoilt", "n"))
    return (
        abs(w**3 - cube) < 6e-4
        and abs(1 - w**3 - spoilt) < 6e-4
        and needed == at_true_share(run, 3)
        and ((1 - w**3) ** needed < 0.01 <= (1 - w**3) ** (needed - 1))
    )


def reach_of_the_picked(run: Run, k: int, m: re.Match[str]) -> bool:
    state = next(state for state in run.states if state.phase == "inliers")
    true = run.subject.p[run.subject.is_inlier]
    reached = (apart("plane", state.estimate, true) <= limit_of(run)).mean()
    return abs(100 * reached - float(m["n"])) <= 0.5 + 1e-9


def on_the_wall(run: Run, k: int, m: re.Match[str]) -> bool:
    best = run.states[-1].best
    true = run.subject.is_inlier
    of_table = (best.inliers & true).sum() / true.sum()
    k = len(run.states) - 1
    told = [int(m[name]) for name in ("n", "wall", "table", "clutter")]
    counts = [VALUES[name](run, k) for name in ("wall", "table", "clutter")]
    return told == [sum(counts), *counts] and abs(best.estimate[2]) < 0.3 and of_table < 0.1


def pull_upwards(run: Run, k: int, m: re.Match[str]) -> bool:
    """Of the outliers, nine in ten lie above the table."""
    subject = run.subject
    truth = subject.truth * np.sign(subject.truth[2])
    off = subject.p[~subject.is_inlier] @ truth[:3] + truth[3]
    return bool((off > 0).mean() > 0.9)


def three_errors(run: Run, k: int, m: re.Match[str]) -> bool:
    return (
        same(m["r"], last_error(run))
        and same(m["h"], error_of_rival(run, "Huber"))
        and same(m["s"], error_of_rival(run, "least squares"))
    )


WHYS = {
    "predict-needed": (
        Claim(
            r"clean with probability (?P<w>[\d.]+)³ = (?P<cube>[\d.]+), and (?P<spoilt>[\d.]+) to"
            r" the power (?P<n>\d+) falls"
            r" below 0\.01",
            of_one_sample,
        ),
        Claim(r"This run drew (\d+)", lambda run, k, m: int(m[1]) == drawn(run)),
        Claim("for its best so far", None),
    ),
    "predict-near-sample": (
        Claim(r"It reaches (?P<n>\d+) % of them", reach_of_the_picked),
        Claim("The three lie so close together", picked_are_inliers),
    ),
    "predict-two-planes": (
        Claim(
            r"(?P<n>\d+) votes: (?P<wall>\d+) of the wall, (?P<table>\d+) of the table and"
            r" (?P<clutter>\d+) of clutter\. It stands upright",
            on_the_wall,
        ),
        Claim(
            rf"the points of the table are {distance('n')} from it \(RMS\)",
            lambda run, k, m: same(m["n"], last_error(run)),
        ),
    ),
    "predict-size": (
        Claim(
            r"samples of four need (\d+) draws, samples of seven (\d+)",
            lambda run, k, m: (
                (int(m[1]), int(m[2])) == (at_true_share(run, 4), at_true_share(run, 7))
            ),
        ),
        Claim(
            r"This run drew (\d+)",
            lambda run, k, m: int(m[1]) == drawn(run) >= at_true_share(run, 7),
        ),
    ),
    "predict-huber": (
        Claim(
            rf"RANSAC {distance('r')}, Huber {distance('h')}, least squares {distance('s')}" " off",
            three_errors,
        ),
        Claim("here nearly all of them pull upwards", pull_upwards),
    ),
}
