"""Experiments with RANSAC, and what to predict before looking."""

from collections.abc import Iterable, Sequence

from lessons.ransac.state import Params, State
from workbench.algorithms.robust.ransac import iterations_needed
from workbench.certain import sure
from workbench.lesson import Choice, Preset, Question, View
from workbench.numerals import length, percent

VIEW = View(eye=(0.8, -3.4, 1.6), target=(0.0, 0.0, 0.33), grid=None, axes=False)
FLAT = View(eye=(0.0, -3.0, 0.7), target=(0.0, 0.0, 0.7), grid=None, axes=False)
IMAGES = View(eye=(0.0, -2.6, 0.25), target=(0.0, 0.0, 0.25), grid=None, axes=False)
THIRTY = Params(outliers=0.3, seed=2)
SEVENTY = Params(outliers=0.7, seed=2)
TIGHT = Params(inlier_distance=0.004, steps="improvements")
LOOSE = Params(inlier_distance=0.3)
MSAC = Params(inlier_distance=0.15, score="MSAC")
WALL = Params(table="beside a wall")
WIRE = Params(table="with a wire", sample=(-1, 0, 1, 2))
NEAR = Params(sample=(-1, 482, 510, 3))
LOCAL = Params(outliers=0.6, local_refit=True, seed=7)
PROSAC = Params(model="homography", outliers=0.6, points=400, sampler="PROSAC")
MATCHES = Params(
    model="fundamental matrix", outliers=0.3, points=200, inlier_pixels=2.0, steps="improvements"
)

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        "line",
        "A line, seen flat",
        "Two points determine a line. Whoever lies in the band around it votes for it: the band"
        " reaches the inlier distance to either side.",
        Params(model="line", points=150, noise=0.025, inlier_distance=0.05, seed=6),
        1,
        FLAT,
    ),
    Preset(
        "thirty",
        "30 % outliers: 13 samples",
        "A third of all samples is clean, so 13 are enough here; the same outliers drag least"
        " squares 15 cm off (RMS).",
        THIRTY,
        2,
    ),
    Preset(
        "seventy",
        "70 % outliers: 126 samples",
        "Only one sample in 37 is clean, so 126 are drawn; the plane is still only 3 mm off (RMS)."
        " Half is no limit.",
        SEVENTY,
        2,
    ),
    Preset(
        "tight",
        "Inlier distance too small",
        "4 mm is a quarter of the noise: three in four true points are refused, 500 samples do not"
        " suffice, and the answer rests on the few that are left.",
        TIGHT,
        -1,
        breaks=True,
    ),
    Preset(
        "loose",
        "Inlier distance too large",
        "0.3 m is 20 sigma: clutter votes too, 13 samples satisfy the formula, and the plane ends 4"
        " cm off (RMS).",
        LOOSE,
        -1,
        breaks=True,
    ),
    Preset(
        "msac",
        "Too large, but nearness counts",
        "A count cannot tell 1 mm from 149 mm. MSAC can: the sample that it keeps is 5 mm from the"
        " truth; the one that a count keeps is 49 mm off.",
        MSAC,
        0,
    ),
    Preset(
        "two-planes",
        "Two planes",
        "A table beside a wall with twice as many points: the table is what we want. Watch on which"
        " of the two each new best lies.",
        WALL,
        2,
        breaks=True,
    ),
    Preset(
        "collinear",
        "Three points on one line",
        "You picked three points of a taut wire: a whole pencil of planes goes through them. The"
        " sample is lost, and still counts as drawn.",
        WIRE,
        1,
        breaks=True,
    ),
    Preset(
        "near-sample",
        "Three inliers, close together",
        "You picked three points that truly belong to the plane, close together. This is the plane"
        " through them: the next step counts who is near it.",
        NEAR,
        1,
    ),
    Preset(
        "rivals",
        "Least squares and Huber beside it",
        "Squares listen most to the farthest points. Huber's loss bounds each pull but does not end"
        " it. Compare both planes with RANSAC's and the truth, then take the last step for the"
        " numbers.",
        THIRTY,
        -2,
    ),
    Preset(
        "local",
        "Refit every new best",
        "A sample carries the noise of three points; refitting each new best at once gathers its"
        " votes sooner: the run ends after 53 samples in place of 80.",
        LOCAL,
        0,
    ),
    Preset(
        "prosac",
        "The most trusted first",
        "Matches have a quality, and PROSAC tries the most trusted first and counts votes among"
        " them to know when to stop: after 14 samples, where chance draws 375.",
        PROSAC,
        0,
        IMAGES,
    ),
    Preset(
        "epipolar",
        "Two views: a fundamental matrix",
        "A match has only to lie near a line, not at a point, but seven at once must be free of"
        " outliers. Look what that takes even at 30 %.",
        MATCHES,
        -1,
        IMAGES,
    ),
)


def end(states: Iterable[State]) -> State:
    """Return the step at which the run stopped."""
    return next(state for state in states if state.now.stop is not None)


def first(states: Iterable[State], phase: str) -> State:
    """Return the first step of a kind."""
    return next(state for state in states if state.now.phase == phase)


def share_reached(state: State) -> float:
    """Return the share of the true inliers that the model under test reaches."""
    known, trial = sure(state.subject.is_inlier), sure(state.now.trial)
    return float(trial.inliers[known].mean())


def clean_share(state: State) -> float:
    """Return the true share of inliers."""
    assert state.subject.is_inlier is not None
    return float(state.subject.is_inlier.mean())


def needed(state: State, size: int) -> float:
    """Return how many samples of a size are needed at the true share of inliers."""
    return iterations_needed(clean_share(state), size, state.params.confidence)


def _needed_why(states: Sequence[State]) -> str:
    last = end(states)
    w = clean_share(last)
    return (
        f"A sample of three is clean with probability {w:.1f}³ = {w**3:.3f}, and {1 - w**3:.3f} to"
        f" the power {needed(last, 3):.0f} falls below 0.01. This run drew {last.now.iteration}:"
        " what it can know is only the share of inliers of its best so far."
    )


def _size_answer(states: Sequence[State]) -> float:
    four, seven = needed(end(states), 4), needed(end(states), 7)
    return 0.0 if seven < 0.8 * four else 1.0 if seven < 1.25 * four else 2.0


def _size_why(states: Sequence[State]) -> str:
    four, seven = needed(end(states), 4), needed(end(states), 7)
    return (
        f"At this share of inliers samples of four need {four:.0f} draws, samples of seven"
        f" {seven:.0f}: every further match is one more chance to draw an outlier. This run drew"
        f" {end(states).now.iteration:,}. Draw as few as determine the model, and use many only in"
        " the refit."
    )


def _near_answer(states: Sequence[State]) -> float:
    share = share_reached(first(states, "inliers"))
    return 0.0 if share > 0.9 else 1.0 if share > 0.3 else 2.0


def _near_why(states: Sequence[State]) -> str:
    state = first(states, "inliers")
    return (
        f"It reaches {percent(share_reached(state), 0)} of them (blue). The three lie so close"
        f" together that a noise of {length(state.params.noise)} tilts their plane freely. The"
        " formula for N promises a clean sample, not a good model."
    )


def _planes_answer(states: Sequence[State]) -> float:
    last = end(states)
    assert last.now.best is not None
    assert last.subject.is_inlier is not None
    on_table = last.now.best.inliers[last.subject.is_inlier].mean()
    upright = abs(last.now.best.estimate[2]) < 0.3
    return 0.0 if on_table > 0.8 else 1.0 if upright else 2.0


def _planes_why(states: Sequence[State]) -> str:
    last = end(states)
    assert last.now.best is not None
    return (
        f"Its plane has {last.now.best.count} points near it and stands upright: the wall. The"
        f" points of the table are {length(last.best_error)} from it (RMS). A score knows numbers,"
        " not wishes. For the table, take the wall's points away and run again, or say that you"
        " want a level plane."
    )


def _huber_answer(states: Sequence[State]) -> float:
    last = end(states)
    squares, huber = (rival.error for rival in last.rivals)
    return 0.0 if huber < 1.5 * last.best_error else 1.0 if huber < 0.5 * squares else 2.0


def _huber_why(states: Sequence[State]) -> str:
    last = end(states)
    squares, huber = (length(rival.error) for rival in last.rivals)
    return (
        f"RANSAC {length(last.best_error)}, Huber {huber}, least squares {squares} off (RMS). An"
        " outlier pulls on Huber's fit with the force of a point at the corner of its loss,"
        " however far it is; here nearly all of them pull upwards."
    )


QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        "predict-needed",
        "Half of the points are outliers. How many samples of three must be drawn so that with 99 %"
        " confidence one of them is free of outliers?",
        answer=lambda states: needed(end(states), 3),
        why=_needed_why,
        params=Params(),
        unit="samples",
        tolerance=5.0,
        wrong=(
            (
                5,
                7,
                (
                    "That is so for samples of one point: half of those are clean. All three must"
                    " be free of outliers."
                ),
            ),
            (
                8,
                12,
                (
                    "One sample in eight is clean, but eight draws do not make sure of it: in 34 %"
                    " of all tries none of the eight is clean."
                ),
            ),
            (
                200,
                600,
                (
                    "The number of points does not matter. What matters is how likely one sample is"
                    " clean: ½ · ½ · ½."
                ),
            ),
        ),
    ),
    Question(
        "predict-near-sample",
        "You pick three points that truly belong to the plane, close together. What share of the"
        " other true points will lie within 2 sigma of the plane through them?",
        answer=_near_answer,
        why=_near_why,
        params=NEAR,
        choices=(
            Choice(
                "Nearly all: there is no outlier among the three",
                "A clean sample is not yet a good one. Its points carry noise, and three that lie"
                " close together turn it into a large tilt.",
            ),
            Choice(
                "About half",
                "The noise tilts the plane more than that: its error grows with the distance from"
                " the three.",
            ),
            Choice("Less than a third"),
        ),
        step=2,
    ),
    Question(
        "predict-two-planes",
        "A table, which we want, stands beside a wall with twice as many points. What will RANSAC"
        " return?",
        answer=_planes_answer,
        why=_planes_why,
        params=WALL,
        choices=(
            Choice(
                "The table", "That is what we want, but nothing tells RANSAC so. It counts votes."
            ),
            Choice("The wall"),
            Choice(
                "A plane between the two",
                "Least squares would compromise. RANSAC does not: a plane between the two is near"
                " the points of neither.",
            ),
        ),
    ),
    Question(
        "predict-size",
        "A fundamental matrix needs samples of seven matches, a homography four. With the same"
        " outliers, how many samples does the larger one need?",
        answer=_size_answer,
        why=_size_why,
        params=MATCHES,
        choices=(
            Choice(
                "Fewer: seven pin a model down better than four",
                "More points average the noise better, but the number of samples depends on"
                " outliers: all seven must be clean.",
            ),
            Choice(
                "About as many",
                "Each further match must be clean too, which multiplies the chance of a clean"
                " sample by w.",
            ),
            Choice("Many more"),
        ),
    ),
    Question(
        "predict-huber",
        "At 30 % outliers, Huber's loss bounds the pull of each of them. Where does its plane end?",
        answer=_huber_answer,
        why=_huber_why,
        params=THIRTY,
        choices=(
            Choice(
                "At the truth, as RANSAC's",
                "Huber's loss bounds the pull of an outlier, but does not end it. Many outliers on"
                " one side still add up.",
            ),
            Choice("In between"),
            Choice(
                "As far off as least squares",
                "There the pull grows with the distance. Under Huber's loss a far outlier pulls no"
                " harder than a near one.",
            ),
        ),
    ),
)
