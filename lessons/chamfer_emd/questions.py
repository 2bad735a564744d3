"""What to predict before looking, with known wrong answers."""

import numpy as np

from lessons.chamfer_emd import blurred, bunch, far_dot
from lessons.chamfer_emd.panels import metres, squared, step_at
from lessons.chamfer_emd.presets import BLUR, BUNCH, CLUMP, FAR_DOT, MISSING, ROWS
from lessons.chamfer_emd.state import Side
from workbench.lesson import Choice, Question, States
from workbench.numerals import brief, counted, percent

SHUFFLED = 1  # the step in which the rows are no longer in order
ASKED_BUNCH = step_at(bunch.SHARES, 0.8)
ASKED_FAR = step_at(far_dot.FAR, 1.0)
ASKED_BLUR = step_at(blurred.BLURS, 0.5)


def nearer_side(side: Side) -> float:
    """Return the share of a cloud that is left of the middle, where the blob starts."""
    return float(np.mean(side.flow.p_moving[:, 0] < 0))


def _changed(states: States) -> float:
    """Return which of the numbers of the shuffled rows is not 0: one of them, all, or none."""
    state = states[SHUFFLED]
    changed = [value > 1e-9 for value in (state.by_row, state.chamfer, state.earth_movers)]
    return {(True, False, False): 0.0, (True, True, True): 1.0, (False, False, False): 2.0}[
        tuple(changed)
    ]


def _spread_why(states: States) -> str:
    left, right = states[-1].left, states[-1].right
    return (
        f"After {counted(left.flow.step, 'step')} {percent(nearer_side(left), 0)} of its points"
        f" stay on the nearer half ({percent(nearer_side(right), 0)} for earth mover's). A few"
        " points near the far side serve all target points there, and the others feel no pull"
        " across."
    )


def _flip_answer(states: States) -> float:
    state = states[ASKED_BUNCH]
    return 2.0 * (state.chamfer > state.larger_chamfer) + 1.0 * (
        state.earth_movers > state.larger_emd
    )


def _flip_why(states: States) -> str:
    state = states[ASKED_BUNCH]
    return (
        f"B has Chamfer {squared(state.chamfer)} and EMD {metres(state.earth_movers)}; L has"
        f" {squared(state.larger_chamfer)} and {metres(state.larger_emd)}. One point in five"
        " is enough to have a neighbour nearby everywhere, and Chamfer asks for no more."
    )


def back_share(side: Side) -> float:
    """Return which share of the two-sided Chamfer distance is the side from target to source."""
    n = side.numbers
    return n.to_source / (n.to_target + n.to_source)


def _missing_why(states: States) -> str:
    side = states[0].left
    return (
        f"At the start {percent(back_share(side), 0)} of {squared(side.numbers.chamfer)}. Every"
        " orange dot lies on a blue place, so the other side is"
        f" {squared(side.numbers.to_target)}: it cannot see what the cloud lacks."
    )


def _far_answer(states: States) -> float:
    """Return which number has grown most against what it says of the larger ring."""
    return float(np.argmax(states[ASKED_FAR].times))


def _far_why(states: States) -> str:
    most, chamfer_times, emd_times = states[ASKED_FAR].times
    return (
        f"Hausdorff is {most:.0f} times that of the larger ring, Chamfer {chamfer_times:.1f} times,"
        f" EMD {emd_times:.2f} times. A largest distance is one point's; a mean of squares still"
        " leans on it; a mean of distances hardly."
    )


def _blur_why(states: States) -> str:
    state = states[ASKED_BLUR]
    pairs = states.subject
    return (
        f"It says {metres(state.costs[1])}, where the exact distance is"
        f" {brief(1000 * pairs.exact[1], 2)} mm. Every dot pays a little to many places, however"
        " near its own is."
    )


QUESTIONS: tuple[Question, ...] = (
    Question(
        name="whose-row",
        text=(
            "The twelve dots lie on their twelve places, but the rows of their file are shuffled. "
            "Which numbers are no longer 0?"
        ),
        answer=_changed,
        why=lambda states: (
            f"Pairs of the same row say {squared(states[SHUFFLED].by_row)}, Chamfer and earth"
            " mover's 0. A cloud has no order; a file has."
        ),
        params=ROWS,
        choices=(
            "only the mean square of pairs with the same row",
            Choice(
                "all three",
                why="Rows are no names. Both rules look where the dots are, and they are at home.",
            ),
            Choice(
                "none",
                why=(
                    "Chamfer and earth mover's stay 0. Who pairs row 1 with row 1 measures the"
                    " file."
                ),
            ),
        ),
        start=0,
        step=SHUFFLED,
    ),
    Question(
        name="predict-missing",
        text=(
            "The dots lie on the left half only. How much of the Chamfer distance comes from the "
            "side that goes from blue to orange?"
        ),
        answer=lambda states: round(100 * back_share(states[0].left), 6),
        why=_missing_why,
        params=MISSING,
        unit="%",
        tolerance=2.0,
        low=0.0,
        high=100.0,
        stride=5.0,
        start=0,
        step=0,
        wrong=(
            (
                0.0,
                5.0,
                "That is the other side, from orange to blue: it asks whether all that is there is"
                " right.",
            ),
            (
                40.0,
                60.0,
                "The two sides need not be equal: what is missing is seen from one of them only.",
            ),
        ),
    ),
    Question(
        name="predict-flip",
        text=(
            "Cloud B has 80 % of the ring's points in one bunch. Cloud L is the ring 5 % larger. "
            "Which is closer to the ring?"
        ),
        answer=_flip_answer,
        why=_flip_why,
        params=BUNCH,
        choices=(
            Choice(
                "B by both distances",
                why=(
                    "The bunch must be carried all around the ring, and earth mover's counts every"
                    " metre of it."
                ),
            ),
            "B by Chamfer, L by earth mover's",
            Choice(
                "L by Chamfer, B by earth mover's",
                why=(
                    "It is the other way round: earth mover's counts how many points"
                    " there are where, Chamfer does not."
                ),
            ),
            Choice(
                "L by both distances",
                why=(
                    "The bunch is seen at once. Chamfer does not see it: to each point it gives the"
                    " nearest neighbour, however many share it."
                ),
            ),
        ),
        start=0,
        step=ASKED_BUNCH,
    ),
    Question(
        name="predict-spread",
        text=(
            "A blob inside the ring, left of its middle, flows down the two-sided Chamfer distance"
            " until it settles. How will its points lie on the ring?"
        ),
        answer=lambda states: float(np.digitize(nearer_side(states[-1].left), [0.6, 0.99])),
        why=_spread_why,
        params=CLUMP,
        choices=(
            Choice(
                "Spread evenly",
                why=(
                    "A small distance seems to mean alike. But Chamfer asks only for a neighbour"
                    " near by, and one point can serve many target points."
                ),
            ),
            "Most of them on the nearer half",
            Choice(
                "All of them on the nearer half",
                why=(
                    "The far target points pull at whoever is nearest to them, and these few cross"
                    " over."
                ),
            ),
        ),
        start=8,
    ),
    Question(
        name="predict-outlier",
        text=(
            "One dot of 80 goes 1 m off. Which number grows most, compared with what it says of "
            "the ring 5 % larger?"
        ),
        answer=_far_answer,
        why=_far_why,
        params=FAR_DOT,
        choices=(
            "Hausdorff",
            Choice(
                "Chamfer (mean of squares)",
                why="A square of 1 m is large, but it is divided by 80. A maximum is not.",
            ),
            Choice(
                "Earth mover's",
                why=(
                    "It counts the metre of this one point, divided by 80: less than 5 cm for every"
                    " point."
                ),
            ),
        ),
        start=0,
        step=ASKED_FAR,
    ),
    Question(
        name="blurred-home",
        text=(
            "The right cloud is 4 mm from home, on average. What does Sinkhorn say with a blur of "
            "half a metre?"
        ),
        answer=lambda states: round(float(states[ASKED_BLUR].costs[1]), 6),
        why=_blur_why,
        params=BLUR,
        unit="m",
        tolerance=0.06,
        low=0.0,
        high=1.2,
        stride=0.02,
        start=0,
        step=ASKED_BLUR,
        wrong=(
            (
                0.0,
                0.1,
                "Fast does not mean exact. The blur makes every dot pay to many places.",
            ),
            (
                0.8,
                1.2,
                "So much it says of a blob that is far away. Here most mass still stays near.",
            ),
        ),
    ),
)
