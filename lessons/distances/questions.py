"""What to predict before looking."""

from collections.abc import Sequence

import numpy as np

from lessons.distances.presets import ERRORS, LATE, SHORTCUT, TOLD, WHITEN
from lessons.distances.state import Found, Params, Scatter, State, Trials
from workbench.certain import as_a, sure
from workbench.lesson import Choice, Question
from workbench.numerals import counted, fixed, length, percent


def found(states: Sequence[State], step: int = -1) -> Found:
    """Return the distances of a step that has them all."""
    return as_a(Found, states[step].now)


def scatter(states: Sequence[State], step: int = -1) -> Scatter:
    """Return a step of a scatter."""
    return as_a(Scatter, states[step].now)


def broken(states: Sequence[State]) -> float:
    """Return the share of all triples that broke the triangle inequality."""
    trials = as_a(Trials, states[-1].now)
    return trials.broken / trials.tried


def within_two(states: Sequence[State]) -> float:
    """Return the share of points of the plane within 2, as counted."""
    shares = sure(scatter(states).shares)
    return float(shares[0][1])


def refined(states: Sequence[State]) -> np.ndarray:
    """Return the worst errors by 8 neighbours on ever finer grids, per cent."""
    return 10 ** found(states).study["8 neighbours"][1]


def late(states: Sequence[State]) -> float:
    """Return how many times the mean error of heat is what it is after one squared edge."""
    times = sure(found(states).times)
    at = {float(t): float(error) for t, error in zip(*times, strict=True)}
    return at[2.0] / at[0.0]


def to_goal(states: Sequence[State]) -> tuple[float, float]:
    """Return how long the way to the goal is, as found and in truth."""
    distances = found(states)
    subject = sure(states[-1].subject)
    return float(distances.d[subject.goal]), float(distances.truth[subject.goal])


def _why_shortcut(states: Sequence[State]) -> str:
    subject = sure(states[-1].subject)
    d, true = to_goal(states)
    many = int(subject.shortcuts.sum())
    if not many:
        return f"{length(d)} for {length(true)}: with these points no edge leaves the sheet."
    told = counted(many, "edge leaves the sheet and joins", "edges leave the sheet and join")
    return (
        f"{length(d)} for {length(true)}: {told} two turns of it. A shortest way takes whatever is"
        " short."
    )


QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        "finer",
        "By 8 neighbours the worst distance is 8.2 % too long. The grid is made 16 times as fine."
        " The worst is now …",
        answer=lambda states: float(
            np.digitize(refined(states)[-1] / refined(states)[0], [0.2, 0.7])
        ),
        why=lambda states: (
            f"{fixed(refined(states)[-1], 2)} %, as on the coarse one,"
            f" {fixed(refined(states)[0], 2)} %. A way along eight directions zigzags towards 22.5°"
            " however small its steps: sec(22.5°) = 1.0824."
        ),
        params=Params(),
        choices=(
            Choice(
                "16 times smaller, or nearly",
                why=(
                    "That holds for steps that approach a curve ever better. Here every step has"
                    " one of eight directions, on every grid."
                ),
            ),
            Choice(
                "about 4 times smaller",
                why=(
                    "A root of 16 would need some error that shrinks. Smaller steps in the same"
                    " eight directions make the zigzag finer, not shorter."
                ),
            ),
            "the same",
        ),
    ),
    Question(
        "two-sigma",
        "95 % of a normal distribution lie within 2 standard deviations. How many percent of points"
        " in the plane lie within a Mahalanobis distance of 2?",
        answer=lambda states: 100 * within_two(states),
        why=lambda states: (
            f"{percent(within_two(states), 1)}: the squared distance has the chi-squared"
            " distribution, with as many degrees"
            f" of freedom as dimensions. In ten it is {percent(float(scatter(states).shares[0][9]), 1)}."  # type: ignore[index]  # noqa: E501
        ),
        params=WHITEN,
        unit="%",
        tolerance=3.0,
        wrong=(
            (
                94.0,
                96.0,
                (
                    "That is the share on a line. In the plane both coordinates have to be small at"
                    " once."
                ),
            ),
            (
                90.0,
                92.0,
                (
                    "95 % of 95 % is a square of half side 2. The ellipse is inside it, without its"
                    " corners."
                ),
            ),
        ),
    ),
    Question(
        "twenty",
        "Nineteen points within a few metres, one more 100 m away. Mean and covariance are those of"
        " all. How many standard deviations is that one from the mean?",
        answer=lambda states: float(scatter(states, TOLD).d.max()),
        why=lambda states: (
            f"{fixed(float(scatter(states, TOLD).d.max()), 2)}. However far it is, it stretches the"
            " covariance with it: no point of n can be farther than (n − 1)/√n."
        ),
        params=Params(stage="whiten", points=19, outliers=1, away=100.0, correlation=0.0),
        step=TOLD,
        unit="σ",
        tolerance=0.3,
        wrong=(
            (
                19.0,
                1e9,
                (
                    "That is measured by the scatter of the nineteen. The far point is part of the"
                    " covariance and stretches it."
                ),
            ),
            (
                1.5,
                3.0,
                (
                    "It is farther than nearly all points of a normal distribution. One point among"
                    " twenty weighs little."
                ),
            ),
        ),
    ),
    Question(
        "squares",
        "Three random points of a square, distances squared. In how many percent of the triples is"
        " the way from a to c longer than the one over b?",
        answer=lambda states: 100 * broken(states),
        why=lambda states: (
            f"{percent(broken(states), 0)}: wherever the angle at b is obtuse, by the law of"
            " cosines. With squared distances a stop on the way makes the trip cheaper."
        ),
        params=Params(stage="axioms", metric="squared"),
        unit="%",
        tolerance=4.0,
        wrong=(
            (
                0.0,
                5.0,
                (
                    "Squaring keeps the order of distances but not their sums: 1 and 1 make 2, and"
                    " 2 squared is 4."
                ),
            ),
            (
                30.0,
                37.0,
                (
                    "One of three angles is the largest, but it need not be obtuse, and b has it in"
                    " a third of the cases."
                ),
            ),
            (
                45.0,
                55.0,
                (
                    "Obtuse or not is no even chance: only one angle of a triangle can be obtuse,"
                    " and it must be b's."
                ),
            ),
        ),
    ),
    Question(
        "longer",
        "On the rabbit heat flows 100 times as long as one squared edge. The mean error of the"
        " distances …",
        answer=lambda states: float(np.digitize(late(states), [0.8, 1.25])),
        why=lambda states: (
            f"{fixed(late(states), 1)} times as large. Heat has had time to go round both ways, and"
            " its direction is no longer that of the shortest one. On a sphere both ways are"
            " alike, and nobody would notice."
        ),
        params=LATE,
        choices=(
            Choice(
                "falls",
                why=(
                    "More heat does arrive far away. But only its direction counts, and that gets"
                    " worse as heat evens out."
                ),
            ),
            Choice(
                "hardly changes",
                why=(
                    "That is so on a sphere, where heat comes round both sides alike. A rabbit is"
                    " not that regular."
                ),
            ),
            "multiplies",
        ),
    ),
    Question(
        "shortcut",
        "The far end of a roll is 6.42 m away along the sheet; with 15 neighbours each, 6.52 m are"
        " found. And with 20 neighbours?",
        answer=lambda states: to_goal(states)[0],
        why=_why_shortcut,
        params=SHORTCUT,
        step=ERRORS,
        unit="m",
        tolerance=0.4,
        wrong=(
            (
                5.0,
                7.0,
                (
                    "More neighbours make ways straighter, and up to 19 that is all. At 20"
                    " something else happens."
                ),
            ),
            (
                1.8,
                2.0,
                (
                    "That is straight through the air. One edge that leaves the sheet spares a"
                    " turn, not the whole way."
                ),
            ),
        ),
    ),
)
