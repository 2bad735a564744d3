"""What the RANSAC lesson says of its runs, decided from the rows and the truth that a state
carries.
"""

import dataclasses
import re
from collections.abc import Callable

import numpy as np

from lessons.ransac.captions import caption
from tests.readings import NUMBER, near, near_length, number
from tests.truths.ransac import (
    apart,
    at_true_share,
    clean,
    clutter_votes,
    determines,
    drawn,
    enough_for,
    error,
    error_of_rival,
    is_right,
    kept,
    last_error,
    most_trusted,
    refused,
    rms,
    share_for_stop,
    states,
)
from tests.verdicts import Claim, Run

__all__ = ["CAPTIONS", "LINES", "WHYS", "caption", "right"]

NUMBERS = {
    "no": 0,
    "none": 0,
    "one": 1,
    "two": 2,
    "three": 3,
    "four": 4,
    "five": 5,
    "six": 6,
    "seven": 7,
}


def right(run: Run, k: int) -> bool | None:
    state = run.states[k]
    if state.now.phase == "stop":
        return is_right(state)
    if state.now.phase == "degenerate" and state.subject.model.name != "fundamental matrix":
        return determines(state.subject.p[state.now.sample])
    return None


def distance(name: str) -> str:
    """Return what finds a distance and calls it so."""
    return rf"(?P<{name}>{NUMBER} (?:mm|µm|m|px))"


def same(said: str, value: float) -> bool:
    """Whether a distance as it is written is this one, to the digits that are written: of thousands
    of pixels two.
    """
    return (
        near(said.removesuffix(" px"), value, 3 if value < 1e3 else 2)
        if said.endswith("px")
        else near_length(said, value)
    )


def outliers_of(run: Run, k: int, found: re.Match[str]) -> bool:
    state = run.states[k]
    wrong = int(np.count_nonzero(~state.subject.is_inlier[state.now.sample]))
    said = len(state.now.sample) if found["n"] == "all" else NUMBERS[found["n"]]
    return NUMBERS[found["size"]] == len(state.now.sample) and said == wrong


def counted(run: Run, k: int, found: re.Match[str]) -> bool:
    """So many rows lie within the limit of the estimate in question."""
    state = run.states[k]
    estimate = state.now.estimate if state.now.phase == "inliers" else state.now.best.estimate
    limit = (
        state.params.inlier_pixels
        if state.subject.model.unit == "px"
        else state.params.inlier_distance
    )
    count = np.count_nonzero(apart(state.subject.model.name, estimate, state.subject.p) <= limit)
    return same(found["limit"], limit) and number(found["n"]) == count


def stays(run: Run, k: int, found: re.Match[str]) -> bool:
    now = run.states[k].now
    best = np.count_nonzero(now.best.inliers)
    fewer = now.trial.score <= now.best.score
    after = run.states[k + 1].now
    replaced = after.phase == "best" and after.iteration == now.iteration
    return fewer and best == number(found["n"]) and not replaced


def is_new_best(run: Run, k: int, found: re.Match[str]) -> bool:
    """It beats every best before it, and so many samples were drawn."""
    now = run.states[k].now
    before = [state.now.best.score for state in run.states[:k] if state.now.best is not None]
    share = 100.0 * np.count_nonzero(now.best.inliers) / len(now.best.inliers)
    return (
        all(now.best.score > score for score in before)
        and number(found["after"]) == now.iteration
        and number(found["n"]) == np.count_nonzero(now.best.inliers)
        and abs(float(found["share"]) - share) <= 0.5 + 1e-9
    )


def draws_needed(run: Run, k: int, found: re.Match[str]) -> bool:
    state = run.states[k]
    share = share_for_stop(state)
    confidence, said = float(found["p"]) / 100.0, number(found["n"])
    assert confidence == state.params.confidence
    if found["no"]:
        clean = share**state.subject.model.sample_size
        return said == state.params.most_samples and 1.0 - (1.0 - clean) ** (said - 1) < confidence
    return said == enough_for(share, state.subject.model.sample_size, confidence)


def error_is(run: Run, k: int, found: re.Match[str]) -> bool:
    state = run.states[k]
    return same(found["n"], error(state, state.now.best.estimate))


def refit(run: Run, k: int, found: re.Match[str]) -> bool:
    """So many inliers before and after, and the errors to the truth of both."""
    state, before = run.states[k], run.states[k - 1]
    counts = [np.count_nonzero(each.now.best.inliers) for each in (before, state)]
    errors = [error(state, each.now.best.estimate) for each in (before, state)]
    said = [number(found[name]) for name in ("n", "old", "new")]
    return (
        said == [counts[0], *counts]
        and same(found["was"], errors[0])
        and same(found["is"], errors[1])
    )


def stopped(run: Run, k: int, found: re.Match[str]) -> bool:
    state = run.states[k]
    last_best = [each for each in run.states[:k] if each.now.phase == "best"][-1]
    asked = enough_for(
        share_for_stop(last_best), state.subject.model.sample_size, state.params.confidence
    )
    drawn = number(found["n"])
    if found["why"].startswith("enough"):
        return drawn == state.now.iteration >= asked
    return drawn == state.now.iteration == state.params.most_samples <= asked


def trusted(run: Run, k: int, found: re.Match[str]) -> bool:
    length, share = most_trusted(run.states[k])
    return number(found["n"]) == length and abs(float(found["share"]) - 100 * share) <= 0.5 + 1e-9


def rms_of_best(run: Run, k: int, found: re.Match[str]) -> bool:
    best, state = run.states[k].now.best, run.states[k]
    off = apart(state.subject.model.name, best.estimate, state.subject.p)[best.inliers]
    return same(found["n"], rms(off))


def errors_are(run: Run, k: int, found: re.Match[str]) -> bool:
    """Of RANSAC, of plain least squares, and of Huber's fit, whose estimate the state carries."""
    state = run.states[k]
    squares, huber = (rival.estimate for rival in state.rivals)
    return (
        same(found["r"], error(state, state.now.best.estimate))
        and same(found["s"], error(state, squares))
        and same(found["h"], error(state, huber))
    )


ROWS = r"(points|matches)"
CAPTIONS = (
    Claim(
        rf"Of its (?P<size>\w+) {ROWS} (?P<n>\w+) (is an outlier|are outliers) in truth",
        outliers_of,
    ),
    Claim(
        rf"(?P<n>[\d,]+) of [\d,]+ {ROWS} (lie|are) within {distance('limit')} of (its|the) \w+",
        counted,
    ),
    Claim(r"The best so far has (?P<n>[\d,]+) votes?( \([^)]*\))?: it stays", stays),
    Claim(
        r"New best after (?P<after>[\d,]+) samples?: (?P<n>[\d,]+) votes?( \([^)]*\))?,"
        r" (?P<share>\d+) % of all",
        is_new_best,
    ),
    Claim(r"Of the (?P<n>[\d,]+) most trusted (?P<share>\d+) % vote for it", trusted),
    Claim(
        r"So few of the most trusted vote for it that chance can explain it",
        lambda run, k, _: most_trusted(run.states[k]) == (0, 0.0),
    ),
    Claim(
        r"If that is the share of inliers, (the )?(?P<n>[\d,]+) samples? (allowed )?give (?P<no>no"
        r" )?(?P<p>[\d.]+) %"
        r" confidence that one of them is free of outliers",
        draws_needed,
    ),
    Claim(
        r"least squares on the (?P<n>[\d,]+) that voted for it, then all vote anew: (?P<old>[\d,]+)"
        r" → (?P<new>[\d,]+) votes;"
        rf" RMS error to the truth {distance('was')} → {distance('is')}",
        refit,
    ),
    Claim(rf"RMS error to the truth {distance('n')}(?! →)\b", error_is),
    Claim(
        r"Stop after (?P<n>[\d,]+) samples?: (?P<why>enough samples for the confidence asked"
        r" for|the maximum number of"
        r" samples is reached)",
        stopped,
    ),
    Claim(rf"RMS distance {distance('n')}", rms_of_best),
    Claim(
        rf"RMS error to the truth: RANSAC {distance('r')}, least squares {distance('s')}, Huber"
        rf" {distance('h')}",
        errors_are,
    ),
    Claim(
        r"It looks settled, and it is wrong",
        lambda run, k, _: (
            not is_right(run.states[k]) and run.states[k].now.iteration < run.params.most_samples
        ),
    ),
    Claim(r"It is wrong", lambda run, k, _: not is_right(run.states[k])),
    Claim(r"of the truth|to the truth|in truth", None),
)


# preset lines -------------------------------------------------------------------------------------


def at(seed: int, holds: Callable[[Run], bool]) -> Callable[[Run, int, re.Match[str]], bool]:
    """Judge a number that is seen at the preset's own seed, and there alone."""
    return lambda run, k, found: run.params.seed != seed or holds(run)


def both_kept(run: Run) -> bool:
    by_count = kept(states(dataclasses.replace(run.params, score="count")))
    return near("5", 1e3 * kept(run.states), 1) and near("49", 1e3 * by_count, 2)


def twice_as_many(run: Run, k: int, found: re.Match[str]) -> bool:
    """Of the points on either plane: the wall is upright in the table's own directions, 1 m from
    its middle.
    """
    state = run.states[-1]
    wall = (
        state.now.best.inliers & ~state.subject.is_inlier
    )  # the final plane, where that is upright, is the wall
    upright = abs(state.now.best.estimate[2]) < 0.3
    return upright and bool(1.8 < wall.sum() / state.subject.is_inlier.sum() < 2.3)


def sooner(run: Run) -> bool:
    return (
        drawn(run),
        states(dataclasses.replace(run.params, local_refit=False))[-1].now.iteration,
    ) == (53, 80)


def trusted_ends(run: Run) -> bool:
    by_chance = states(dataclasses.replace(run.params, sampler="uniform", steps="improvements"))
    return (drawn(run), by_chance[-1].now.iteration) == (14, 375)


def picked_are_inliers(run: Run, k: int, found: re.Match[str]) -> bool:
    state = run.states[0]
    rows = state.now.sample
    spread = float(np.linalg.norm(np.ptp(state.subject.p[rows], axis=0)))
    return bool(state.chosen and state.subject.is_inlier[rows].all() and spread < 0.3)


def on_a_wire(run: Run, k: int, found: re.Match[str]) -> bool:
    """The picked points are on one line, give no plane, and another sample follows."""
    first, second = run.states[0], run.states[1]
    line = np.linalg.matrix_rank(np.diff(first.subject.p[first.now.sample], axis=0), tol=1e-9) == 1
    return (
        line
        and first.chosen
        and second.now.phase == "degenerate"
        and run.states[2].now.iteration == 2
    )


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
                and enough_for(np.count_nonzero(run.states[-1].now.best.inliers) / 600, 3, 0.99)
                > 500
            ),
        ),
        Claim(
            "the answer rests on the few that are left",
            lambda run, k, _: bool(run.states[-1].now.best.inliers.mean() < 0.15),
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
            lambda run, k, _: run.states[2].now.phase == "inliers",
        ),
    ),
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
            lambda run, k, _: len(run.states[0].now.sample) in (0, 7),
        ),
        Claim("at 30 %", lambda run, k, _: abs(clean(run, 1) - 0.7) < 0.01),
    ),
}


# explanations -------------------------------------------------------------------------------------


def of_one_sample(run: Run, k: int, found: re.Match[str]) -> bool:
    w, cube, spoilt, needed = (float(found[name]) for name in ("w", "cube", "spoilt", "n"))
    return (
        abs(w**3 - cube) < 6e-4
        and abs(1 - w**3 - spoilt) < 6e-4
        and needed == at_true_share(run, 3)
        and ((1 - w**3) ** needed < 0.01 <= (1 - w**3) ** (needed - 1))
    )


def reach_of_the_picked(run: Run, k: int, found: re.Match[str]) -> bool:
    state = next(state for state in run.states if state.now.phase == "inliers")
    inliers = state.subject.p[state.subject.is_inlier]
    reached = (apart("plane", state.now.estimate, inliers) <= state.inlier_distance).mean()
    return abs(100 * reached - float(found["n"])) <= 0.5 + 1e-9


def on_the_wall(run: Run, k: int, found: re.Match[str]) -> bool:
    state = run.states[-1]
    best = state.now.best
    of_table = (best.inliers & state.subject.is_inlier).sum() / state.subject.is_inlier.sum()
    return int(found["n"]) == best.inliers.sum() and abs(best.estimate[2]) < 0.3 and of_table < 0.1


def pull_upwards(run: Run, k: int, found: re.Match[str]) -> bool:
    """Of the outliers, nine in ten lie above the table."""
    subject = run.states[-1].subject
    truth = subject.truth * np.sign(subject.truth[2])
    off = subject.p[~subject.is_inlier] @ truth[:3] + truth[3]
    return bool((off > 0).mean() > 0.9)


def three_errors(run: Run, k: int, found: re.Match[str]) -> bool:
    return (
        same(found["r"], last_error(run))
        and same(found["h"], error_of_rival(run, "Huber"))
        and same(found["s"], error_of_rival(run, "least squares"))
    )


WHYS = {
    "predict-needed": (
        Claim(
            r"clean with probability (?P<w>[\d.]+)³ = (?P<cube>[\d.]+), and (?P<spoilt>[\d.]+) to"
            r" the power (?P<n>\d+) falls"
            r" below 0\.01",
            of_one_sample,
        ),
        Claim(r"This run drew (\d+)", lambda run, k, found: int(found[1]) == drawn(run)),
        Claim("of its best so far", None),
    ),
    "predict-near-sample": (
        Claim(r"It reaches (?P<n>\d+) % of them", reach_of_the_picked),
        Claim("The three lie so close together", picked_are_inliers),
    ),
    "predict-two-planes": (
        Claim(r"Its plane has (?P<n>\d+) points near it and stands upright: the wall", on_the_wall),
        Claim(
            rf"The points of the table are {distance('n')} from it \(RMS\)",
            lambda run, k, found: same(found["n"], last_error(run)),
        ),
    ),
    "predict-size": (
        Claim(
            r"samples of four need (\d+) draws, samples of seven (\d+)",
            lambda run, k, found: (
                (int(found[1]), int(found[2])) == (at_true_share(run, 4), at_true_share(run, 7))
            ),
        ),
        Claim(
            r"This run drew (\d+)",
            lambda run, k, found: int(found[1]) == drawn(run) >= at_true_share(run, 7),
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
