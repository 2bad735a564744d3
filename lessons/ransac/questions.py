"""What to predict before looking, with what is said to known wrong answers."""

from collections.abc import Iterable

from lessons.ransac.captions import voters_of
from lessons.ransac.inputs import Input
from lessons.ransac.presets import MATCHES, NEAR, THIRTY, WALL
from lessons.ransac.rows import Subject
from workbench.algorithms.robust.ransac import State, iterations_needed
from workbench.certain import sure
from workbench.lesson import Choice, Question, States
from workbench.numerals import brief, length, percent

Search = States[Input, Subject, State]


def first(states: Iterable[State], phase: str) -> State:
    """Return the first step of a kind."""
    return next(state for state in states if state.phase == phase)


def end(states: Iterable[State]) -> State:
    """Return the step at which the run stopped."""
    return first(states, "stop")


def reached(states: Search) -> float:
    """Return the share of the true points that vote for the first model."""
    trial = sure(first(states, "inliers").trial)
    return float(trial.inliers[sure(states.subject.is_inlier)].mean())


def needed(states: Search, size: int) -> float:
    """Return how many samples of a size are needed at the true share of good points."""
    share = float(sure(states.subject.is_inlier).mean())
    return iterations_needed(share, size, states.params.confidence)


def error(states: Search, name: str = "") -> float:
    """Return how far the end is from the truth, or that of a rival."""
    subject = states.subject
    estimate = sure(subject.rivals)[name] if name else sure(end(states).best).estimate
    return subject.error(estimate)


def on_plane(states: Search) -> tuple[bool, bool]:
    """Tell whether the end lies on the table, and whether it stands upright, as the wall does."""
    best = sure(end(states).best)
    on_table = best.inliers[sure(states.subject.is_inlier)].mean()
    return bool(on_table > 0.8), bool(abs(best.estimate[2]) < 0.3)


def _choice(*holds: bool) -> float:
    """Return the first choice that holds, or else the one after them."""
    return float((*holds, True).index(True))


def _why_needed(states: Search) -> str:
    w = float(sure(states.subject.is_inlier).mean())
    return (
        f"A sample of three is clean with probability {w:.1f}³ = {w**3:.3f}, and {1 - w**3:.3f} to"
        f" the power {needed(states, 3):.0f} falls below 0.01. This run drew"
        f" {end(states).iteration}: it does not know w, and takes the share that votes for its best"
        " so far."
    )


def _why_size(states: Search) -> str:
    return (
        f"With these outliers samples of four need {needed(states, 4):.0f} draws, samples of seven"
        f" {needed(states, 7):.0f}: every further match is one more chance to draw an outlier. This"
        f" run drew {end(states).iteration:,}. Draw as few as determine the model, and use many"
        " only in the refit."
    )


def _why_near(states: Search) -> str:
    return (
        f"It reaches {percent(reached(states), 0)} of them. The three lie so close together that a"
        f" noise of {length(states.params.noise)} tilts their plane freely."
    )


def _why_plane(states: Search) -> str:
    best = sure(end(states).best)
    of = voters_of(states.subject, best)
    return (
        f"Its plane has {best.count} votes: {of['wall']} of the wall, {of['table']} of the table"
        f" and {of['clutter']} of clutter. It stands upright, and the points of the table are"
        f" {length(error(states))} from it (RMS)."
    )


def _why_huber(states: Search) -> str:
    names = ("", "Huber", "least squares")
    ours, huber, squares = (f"{brief(1e3 * error(states, name))} mm" for name in names)
    return (
        f"RANSAC {ours}, Huber {huber}, least squares {squares} off (RMS). An"
        " outlier pulls on Huber's plane as hard as a point at the corner of its loss, however far"
        " it is; here nearly all of them pull upwards."
    )


QUESTIONS: tuple[Question, ...] = (
    Question(
        name="predict-needed",
        text="Half of the points belong to a plane. How many samples of three must be drawn so that"
        " with 99 % confidence one of them is clean?",
        answer=lambda states: needed(states, 3),
        why=_why_needed,
        params=Input(),
        start=0,
        unit="samples",
        tolerance=5.0,
        wrong=(
            (
                5,
                7,
                "That is so for samples of one point: half of those are clean. All three must"
                " be clean at once.",
            ),
            (
                8,
                12,
                "One sample in eight is clean, but eight draws do not make sure of it: in 34 %"
                " of all tries none of the eight is clean.",
            ),
            (
                200,
                600,
                "The number of points does not matter. What matters is how likely one sample is"
                " clean: ½ · ½ · ½.",
            ),
        ),
    ),
    Question(
        name="predict-near-sample",
        text="Three points truly belong to a plane, and lie close together. What share of the other"
        " true points will lie within 2 sigma of the plane through the three?",
        answer=lambda states: _choice(reached(states) > 0.9, reached(states) > 0.3),
        why=_why_near,
        params=NEAR,
        start=1,
        step=2,
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
    ),
    Question(
        name="predict-huber",
        text="At 30 % outliers, Huber's loss bounds the pull of each of them. Where does its plane"
        " end?",
        answer=lambda states: _choice(
            error(states, "Huber") < 1.5 * error(states),
            error(states, "Huber") < 0.5 * error(states, "least squares"),
        ),
        why=_why_huber,
        params=THIRTY,
        start=7,
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
    Question(
        name="predict-two-planes",
        text="A table, which we want, stands beside a wall with twice as many points. What will"
        " RANSAC return?",
        answer=lambda states: _choice(*on_plane(states)),
        why=_why_plane,
        params=WALL,
        start=0,
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
        name="predict-size",
        text="A fundamental matrix needs samples of seven matches, a homography four. With the same"
        " outliers, how many samples does the larger one need?",
        answer=lambda states: _choice(
            needed(states, 7) < 0.8 * needed(states, 4),
            needed(states, 7) < 1.25 * needed(states, 4),
        ),
        why=_why_size,
        params=MATCHES,
        start=0,
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
)
