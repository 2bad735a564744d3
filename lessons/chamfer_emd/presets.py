"""Experiments, each the picture of one misconception, and what to predict before looking."""

from collections.abc import Sequence

import numpy as np

from lessons.chamfer_emd.captions import metres, squared
from lessons.chamfer_emd.state import Params, Side, State
from workbench.lesson import Choice, Preset, Question
from workbench.numerals import counted, percent

CLUMP = Params()
FLIP = Params(start="bunched", amount=0.8, points=140)
ONE_WAY = Params(start="part missing", amount=0.5, lowers="source to target")
OUTLIER = Params(start="one outlier", amount=1.0)

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        "clump",
        "One blob, two flows",
        "Both flows leave from one blob, each down its own distance. Where will the points"
        " be when their number has become small? See the bars, and the mass astray.",
        CLUMP,
    ),
    Preset(
        "flip",
        "Bunched against 5 % larger",
        "80 % of the points in one bunch, some everywhere. The lowest table says what"
        " the ring 5 % larger costs: which cloud is closer, and by which number?",
        FLIP,
        6,
    ),
    Preset(
        "larger",
        "5 % larger",
        "Every point is 5 cm off: 2 × 0.05² = 0.0050 m² by Chamfer, 0.05 m by EMD. Squares make"
        " small distances look tiny.",
        Params(start="larger", amount=0.05, points=140),
        0,
    ),
    Preset(
        "bump",
        "Equal Chamfer, another shape",
        "A bump of 14.7 cm on an eighth of the ring has the Chamfer distance of the"
        " ring 5 % larger, 0.0050 m²; but EMD 0.019 against 0.05 m, Hausdorff 0.147 against"
        " 0.05 m.",
        Params(start="bump", amount=0.147, points=140),
        0,
    ),
    Preset(
        "missing",
        "A part is missing",
        "The source has only the left half of the target, twice. The table has both"
        " sides of Chamfer: which of them sees what is missing?",
        Params(start="part missing", amount=0.5),
        4,
    ),
    Preset(
        "outlier",
        "One far outlier",
        "One point of 80 is 1 m off, the others are at home. Compare each number with what it"
        " says of the ring 5 % larger (lowest table).",
        OUTLIER,
        0,
    ),
    Preset(
        "shuffled",
        "Rows in another order",
        "The same points: all distances are 0 except the mean square of index pairs,"
        " 2.3 m². It measures the order of a file.",
        Params(start="shuffled rows", amount=1.0),
        0,
    ),
    Preset(
        "doubled",
        "Chamfer 0, clouds different",
        "The left half of the points counts twice. Chamfer and Hausdorff are 0,"
        " EMD is 0.21 m: a distance that is 0 between different clouds is no metric.",
        Params(start="doubled points", amount=0.5),
        0,
    ),
    Preset(
        "idle",
        "Nobody's nearest never moves",
        "The left flow lowers only target to source. Where it comes to rest, 71 of 80 points"
        " (vermillion) are nearest to no target point, and nothing pulls them; the others serve"
        " all 80.",
        Params(lowers="target to source"),
        -1,
    ),
    Preset(
        "blurred",
        "Fast EMD is not exact",
        "Sinkhorn with a blur of 0.5 m says 0.99 m where EMD is 0.81 m, and after 40"
        " steps of the right flow 0.54 m where EMD is 4 mm: its zero is not zero.",
        Params(blur=0.5),
        0,
    ),
    Preset(
        "unequal",
        "40 points against 80",
        "Exact EMD splits masses: nearly every source point ends midway between the two"
        " target points it serves, 0.04 m from both. One-to-one pairs would leave 40 points out.",
        Params(source_points=40),
        -1,
    ),
    Preset(
        "sphere",
        "The same on a sphere",
        "On a surface too: compare the mass that each flow leaves astray, and turn the"
        " spheres to see where it is missing.",
        Params(shape="sphere", points=140),
        -1,
    ),
)


def nearer_side(side: Side) -> float:
    """Return the share of a cloud that is left of the middle, where the blob starts."""
    return float(np.mean(side.flow.p_moving[:, 0] < 0))


def _spread_why(states: Sequence[State]) -> str:
    left, right = states[-1].left, states[-1].right
    return (
        f"After {counted(left.flow.step, 'step')} {percent(nearer_side(left), 0)} of its points"
        f" stay on the nearer half ({percent(nearer_side(right), 0)} for earth mover's). A few"
        " points near the far side serve all target points there, and the others feel no pull"
        " across."
    )


def _flip_answer(states: Sequence[State]) -> float:
    now, larger = states[0].left.numbers, states[0].yardsticks["5 % larger"]
    return 2.0 * (now.chamfer > larger.chamfer) + 1.0 * (now.earth_movers > larger.earth_movers)


def _flip_why(states: Sequence[State]) -> str:
    now, larger = states[0].left.numbers, states[0].yardsticks["5 % larger"]
    return (
        f"At the start, bunched: Chamfer {squared(now.chamfer)}, EMD {metres(now.earth_movers)}; 5"
        f" % larger: {squared(larger.chamfer)} and {metres(larger.earth_movers)}. One point in five"
        " is enough to have a neighbour nearby everywhere, and Chamfer asks for no more."
    )


def back_share(side: Side) -> float:
    """Return which share of the two-sided Chamfer distance is the side from target to source."""
    n = side.numbers
    return n.to_source / (n.to_target + n.to_source)


def _missing_why(states: Sequence[State]) -> str:
    side = states[0].left
    return (
        f"At the start {percent(back_share(side), 0)} of {squared(side.numbers.chamfer)}. Every"
        " source point lies on a target point, so that the other side is"
        f" {squared(side.numbers.to_target)} and its flow, on the left, stays where it is: it"
        " cannot see what the source lacks."
    )


def _outlier_answer(states: Sequence[State]) -> float:
    """Return which number grew most against what it says of the target 5 % larger."""
    now, larger = states[0].left.numbers, states[0].yardsticks["5 % larger"]
    return float(
        np.argmax(
            [
                getattr(now, name) / getattr(larger, name)
                for name in ("chamfer", "earth_movers", "hausdorff")
            ]
        )
    )


def _outlier_why(states: Sequence[State]) -> str:
    now, larger = states[0].left.numbers, states[0].yardsticks["5 % larger"]
    return (
        f"Hausdorff: {metres(now.hausdorff)}, {now.hausdorff / larger.hausdorff:.0f} times that of"
        f" the ring 5 % larger; Chamfer {now.chamfer / larger.chamfer:.1f} times; EMD"
        f" {now.earth_movers / larger.earth_movers:.2f} times. A largest distance is one point's; a"
        " mean of squares still leans on it; a mean of distances hardly."
    )


QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        "predict-spread",
        "A blob inside the ring, left of its middle, flows down the two-sided Chamfer distance"
        " until it settles. How will its points lie on the ring?",
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
    ),
    Question(
        "predict-flip",
        "Cloud B has 80 % of the ring's points bunched at one place, cloud L is the ring 5 %"
        " larger. Which is closer to the ring?",
        answer=_flip_answer,
        why=_flip_why,
        params=FLIP,
        choices=(
            Choice(
                "B by both distances",
                why=(
                    "The bunch must be carried all around the ring, and earth mover's counts that"
                    " way."
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
        step=0,
    ),
    Question(
        "predict-missing",
        "The source is the target without its right half: each point that is left counts twice."
        " Chamfer adds up two sides. How much of the sum comes from the side from target to"
        " source?",
        answer=lambda states: round(100 * back_share(states[0].left), 6),
        why=_missing_why,
        params=ONE_WAY,
        unit="%",
        tolerance=2.0,
        step=0,
        wrong=(
            (
                0.0,
                5.0,
                (
                    "That is the other side, from source to target: it asks whether all that is"
                    " there is right."
                ),
            ),
            (
                40.0,
                60.0,
                "The two sides need not be equal: what is missing is seen from one of them only.",
            ),
        ),
    ),
    Question(
        "predict-outlier",
        "One point of 80 lies 1 m off. Which number grows most, compared with what it says of the"
        " ring 5 % larger?",
        answer=_outlier_answer,
        why=_outlier_why,
        params=OUTLIER,
        choices=(
            Choice(
                "Chamfer (mean of squares)",
                why="A square of 1 m is large, but it is divided by 80. A maximum is not.",
            ),
            Choice(
                "Earth mover's",
                why=(
                    "It counts the way of this one point, divided by 80: less than 5 cm for every"
                    " point."
                ),
            ),
            "Hausdorff",
        ),
        step=0,
    ),
)
