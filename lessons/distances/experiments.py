"""Experiments with distances, and what to predict before looking."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lessons.distances.state import Found, Params, Scatter, State, Trials
from workbench.certain import as_a, sure
from workbench.lesson import Preset, Question, View
from workbench.numerals import counted, fixed, length, percent

VIEW = View(eye=(0.0, 0.0, 1.5), target=(0.0, 0.0, 0.0), grid=None, axes=False)
PLANE = View(eye=(0.0, 0.0, 3.0), target=(0.0, 0.0, 0.0), grid=None, axes=False)
AHEAD = View(eye=(0.0, 0.0, 4.5), target=(0.0, 0.0, 0.0), grid=None, axes=False)
CLOUD = View(eye=(0.0, 0.0, 9.0), target=(0.0, 0.0, 0.0), grid=None, axes=False)
BALL = View(eye=(1.1, -2.4, 1.6), target=(0.0, 0.0, 0.0), grid=None, axes=False)
RABBIT = View(eye=(0.82, -1.5, 0.75), target=(0.0, 0.0, 0.15), grid=None, axes=False)
ROLL = View(eye=(0.9, -2.4, 2.4), target=(0.0, 0.0, 0.0), grid=None, axes=False)

TOLD = 4  # the step of a scatter that tells who lies far out
ERRORS = 11  # the step of ways along edges that holds them against the truth
HALF = Params(stage="axioms", metric="p")
WHITEN = Params(stage="whiten", points=400)
MASKING = Params(stage="whiten", points=200, outliers=40)
SPHERE = Params(stage="surface", points=1000)
HEAT = Params(stage="surface", shape="rabbit", method="heat")
LATE = Params(stage="surface", shape="rabbit", method="heat", time=2.0)
SHORTCUT = Params(stage="roll", points=2000, k=20)

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        "taxi", "Along streets only",
        "Manhattan's ball is a square on its corner. Go to the end: red queries have another nearest point than by"
        " Euclid's.",
        Params(stage="balls", metric="manhattan"), 4, PLANE,
    ),
    Preset(
        "units", "x in metres, y in millimetres",
        "Euclid's distance adds what has different units: now y alone decides. Go to the end and count the red queries.",
        Params(stage="balls", stretch=1000), 4, PLANE,
    ),
    Preset(
        "cosine-axioms", "One minus the cosine",
        "Points on one ray are at distance 0, and many triples have a shorter way over b.",
        Params(stage="axioms", metric="cosine"), -1, PLANE, breaks=True,
    ),
    Preset(
        "half", "An exponent below one",
        "With p = ½ a detour along the axes is often shorter: the ball is a star, not convex.",
        HALF, -1, PLANE, breaks=True,
    ),
    Preset(
        "whiten", "A scatter made round",
        "Centre, turn, scale: Mahalanobis' distance is Euclid's after that. Step on and watch the ellipse.",
        WHITEN, 0, CLOUD,
    ),
    Preset(
        "masking", "Outliers hide themselves",
        "Forty points lie off to one side. They are part of the covariance that should tell them.",
        MASKING, TOLD, CLOUD, breaks=True,
    ),
    Preset(
        "robust", "The half that lies closest",
        "The covariance of the half with the smallest determinant: the second cluster lies far out.",
        replace(MASKING, estimate="robust"), TOLD, CLOUD,
    ),
    Preset(
        "stereo", "Which landmark was it?",
        "A stereo camera, 4 to 6 m away, measures depth far worse than what lies across.",
        Params(stage="stereo"), -1, AHEAD,
    ),
    Preset(
        "staircase", "Up and across only",
        "Four neighbours: every way is as long as along streets, and the front a square on its corner.",
        Params(neighbours="4", grid=31), 6, breaks=True,
    ),
    Preset(
        "marching", "Fast marching",
        "Each node takes its distance from two neighbours at once, as if a straight front came by: the front is round.",
        Params(neighbours="march"), 6,
    ),
    Preset(
        "disc", "Exact near the source",
        "The front is most curved at the source. Exact distances in a small disc mend the rest too.",
        Params(neighbours="march", wall=0.0, disc=0.1), 6,
    ),
    Preset(
        "sphere", "Along the edges of a sphere",
        "The purple way zigzags, the green one is a great circle. Most ways along edges are several per cent too long.",
        SPHERE, ERRORS, BALL, breaks=True,
    ),
    Preset(
        "jitter", "A less regular mesh",
        "Every vertex of the sphere is moved a little, edges point everywhere: ways along them are almost as much too long.",
        replace(SPHERE, jitter=0.2), -1, BALL, breaks=True,
    ),
    Preset(
        "points", "Points on the edges",
        "With three points on every edge ways may cross the faces: the same Dijkstra, and errors of about one per cent.",
        Params(stage="surface", points=1000, extra=3), ERRORS, BALL,
    ),
    Preset(
        "heat", "Distance by heat",
        "Heat flows for a moment. Its size falls by many powers of ten, but its direction is all that is kept.",
        HEAT, 1, RABBIT,
    ),
    Preset(
        "no-metric", "There and back by heat",
        "A distance by heat is no metric: there and back differ, and now and then a detour is shorter.",
        HEAT, -1, RABBIT, breaks=True,
    ),
    Preset(
        "early", "Heat for too short a time",
        "A hundredth of the time: heat counts edges instead of lengths, and distances come out far too short.",
        Params(stage="surface", shape="rabbit", method="heat", time=-2.0), 3, RABBIT, breaks=True,
    ),
    Preset(
        "flattered", "A sphere flatters",
        "Heat for a hundred times as long, on a sphere: here it is no worse. Never choose the time on a sphere.",
        Params(stage="surface", method="heat", time=2.0), -1, BALL,
    ),
    Preset(
        "roll", "Along a roll",
        "Joined to its 15 nearest, a point has its neighbours on the sheet. The way round is more than three times the"
        " straight one.",
        Params(stage="roll", points=2000), ERRORS, ROLL,
    ),
)  # fmt: skip


def found(states: Sequence[State], step: int = -1) -> Found:
    """Return the distances of a step that has them all."""
    return as_a(Found, states[step].now)


def scatter(states: Sequence[State], step: int = -1) -> Scatter:
    """Return a step of a scatter."""
    return as_a(Scatter, states[step].now)


def broken(states: Sequence[State]) -> float:
    """Return the share of all triples that broke the triangle inequality."""
    now = as_a(Trials, states[-1].now)
    return now.broken / now.tried


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
    now, subject = found(states), sure(states[-1].subject)
    return float(now.d[subject.goal]), float(now.truth[subject.goal])


def _why_shortcut(states: Sequence[State]) -> str:
    subject, (d, true) = sure(states[-1].subject), to_goal(states)
    many = int(subject.shortcuts.sum())
    if not many:
        return f"{length(d)} for {length(true)}: with these points no edge leaves the sheet."
    told = counted(many, "edge leaves the sheet and joins", "edges leave the sheet and join")
    return f"{length(d)} for {length(true)}: {told} two turns of it. A shortest way takes whatever is short."


QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        "finer",
        "By 8 neighbours the worst distance is 8.2 % too long. The grid is made 16 times as fine. The worst is now …",
        answer=lambda states: float(np.digitize(refined(states)[-1] / refined(states)[0], [0.2, 0.7])),
        why=lambda states: (
            f"{fixed(refined(states)[-1], 2)} %, as on the coarse one, {fixed(refined(states)[0], 2)} %. A way along eight"
            " directions zigzags towards 22.5° however small its steps: sec(22.5°) = 1.0824."
        ),
        params=Params(),
        choices=("16 times smaller, or nearly", "about 4 times smaller", "the same"),
    ),
    Question(
        "two-sigma",
        "95 % of a normal distribution lie within 2 standard deviations. How many percent of points in the plane lie within"
        " a Mahalanobis distance of 2?",
        answer=lambda states: 100 * within_two(states),
        why=lambda states: (
            f"{percent(within_two(states), 1)}: the squared distance has the chi-squared distribution, with as many degrees"
            f" of freedom as dimensions. In ten it is {percent(float(scatter(states).shares[0][9]), 1)}."  # type: ignore[index]
        ),
        params=WHITEN,
        unit="%",
        tolerance=3.0,
    ),
    Question(
        "twenty",
        "Nineteen points within a few metres, one more 100 m away. Mean and covariance are those of all. How many"
        " standard deviations is that one from the mean?",
        answer=lambda states: float(scatter(states, TOLD).d.max()),
        why=lambda states: (
            f"{fixed(float(scatter(states, TOLD).d.max()), 2)}. However far it is, it stretches the covariance with it: no"
            " point of n can be farther than (n − 1)/√n."
        ),
        params=Params(stage="whiten", points=19, outliers=1, away=100.0, correlation=0.0),
        step=TOLD,
        unit="σ",
        tolerance=0.3,
    ),
    Question(
        "squares",
        "Three random points of a square, distances squared. In how many percent of the triples is the way from a to c"
        " longer than the one over b?",
        answer=lambda states: 100 * broken(states),
        why=lambda states: (
            f"{percent(broken(states), 0)}: wherever the angle at b is obtuse, by the law of cosines. Taxi rides of"
            " squared distances reward every stop on the way."
        ),
        params=Params(stage="axioms", metric="squared"),
        unit="%",
        tolerance=8.0,
    ),
    Question(
        "longer",
        "On the rabbit heat flows 100 times as long as one squared edge. The mean error of the distances …",
        answer=lambda states: float(np.digitize(late(states), [0.8, 1.25])),
        why=lambda states: (
            f"{fixed(late(states), 1)} times as large. Heat has had time to go round both ways, and its direction is no"
            " longer that of the shortest one. On a sphere both ways are alike, and nobody would notice."
        ),
        params=LATE,
        choices=("falls", "hardly changes", "multiplies"),
    ),
    Question(
        "shortcut",
        "The far end of a roll is 6.42 m away along the sheet; with 15 neighbours each, 6.52 m are found. And with 20"
        " neighbours?",
        answer=lambda states: to_goal(states)[0],
        why=_why_shortcut,
        params=SHORTCUT,
        step=ERRORS,
        unit="m",
        tolerance=1.0,
    ),
)
