"""What to predict before looking, with what is said to known wrong answers."""

import numpy as np
import scipy

from lessons.disparity.above import Off, Rig, Seen
from lessons.disparity.inputs import Input
from lessons.disparity.matching import State
from lessons.disparity.pairs import Pictures
from lessons.disparity.presets import BASELINES, BOARDS, DEPTH, JUMP, NET, NOISY_WINDOWS, SINGLE
from lessons.disparity.row import Slid
from lessons.disparity.study import Tried
from lessons.disparity.truth import flat_parts, judged
from workbench.algorithms.stereo.cost_volume import sad_cost_volume
from workbench.algorithms.stereo.disparity_map import winner_takes_all
from workbench.certain import sure
from workbench.lesson import Choice, Question, States
from workbench.numerals import length, percent, pixels

Rows = States[Input, Pictures, Slid]
Maps = States[Input, Pictures, State]
Tries = States[Input, Pictures, Tried]


def far_end(states: States[Input, Rig, Seen]) -> Seen:
    """Return the point where its jump is 4 px."""
    return min(states, key=lambda state: abs(state.jump - 4.0))


def _why_quarter(states: States[Input, Rig, Seen]) -> str:
    end = far_end(states)
    near = min(states, key=lambda state: abs(state.jump - 16.0))
    return (
        f"{length(end.depth)}. The jump is one over the distance: {pixels(near.jump)} at"
        f" {length(near.depth)}, and a quarter of it four times as far away."
    )


def single(states: Rows) -> float:
    """Return the share of wrong pixels (%) where each takes its own best shift."""
    pictures = states.subject
    cost = sad_cost_volume(pictures.left, pictures.right, pictures.max_disparity, 1)
    return 100.0 * judged(pictures, winner_takes_all(cost).astype(float))[0]


def _why_single(states: Rows) -> str:
    return (
        f"{single(states):.0f} %. Thirty-two grey values compete for each pixel, and with noise"
        " one of the wrong ones is often the most alike."
    )


def near_edges(states: Tries, k: int) -> tuple[float, float]:
    """Return the share of the wrong pixels, and of all pixels, within 10 px of a jump of the true
    disparity.
    """
    pair = states.subject.pair
    truth = sure(pair.disparity)
    visible = sure(pair.visible)
    jump = scipy.ndimage.maximum_filter(truth, 3) - scipy.ndimage.minimum_filter(truth, 3) > 2.0
    near = scipy.ndimage.maximum_filter(jump, (21, 21))
    wrong = (np.abs(states[k].disparity - truth) > 1.0) & visible
    return float(near[wrong].mean()) if wrong.any() else 0.0, float(near[visible].mean())


def _edges(states: Tries) -> float:
    of_wrong, of_all = near_edges(states, -1)
    return 1.0 if of_wrong > 0.8 and of_wrong > 1.5 * of_all else 0.0


def _why_edges(states: Tries) -> str:
    of_wrong, of_all = near_edges(states, -1)
    return (
        f"{percent(states[-1].share, 0)} of the map is wrong, and {percent(of_wrong, 0)} of that"
        f" lies within 10 px, half a window, of an edge, where only {percent(of_all, 0)} of all"
        " pixels are."
    )


def hidden_at(states: Tries, baseline: float) -> float:
    """Return the share of hidden pixels at a baseline, metres."""
    return min(states, key=lambda state: abs(state.value - baseline)).share


def _why_baseline(states: Tries) -> str:
    was = hidden_at(states, 0.1)
    became = hidden_at(states, 0.2)
    return (
        f"{percent(was, 1)} became {percent(became, 1)}. The depths of the rest are twice as exact:"
        " a longer baseline is a trade, not a gain."
    )


def at_20(states: States[Input, Rig, Off], error: float) -> float:
    """Return where the board at 20 m is seen with an error of its jump, metres."""
    rig = states.subject
    assert any(abs(state.error - error) < 1e-9 for state in states)
    return float(rig.depth(rig.jump(20.0) + error))


def _why_nearer(states: States[Input, Rig, Off]) -> str:
    far = 20.0 - at_20(states, 1.0)
    other = at_20(states, -1.0) - 20.0
    return (
        f"Its 4 px became 5, and Z = f B / d with f B = 80 made of 20 m 80 / 5 = 16 m: it came"
        f" {length(far)} nearer. The formula Z² / (f B), which says 5 m, is the tangent. One pixel"
        f" too few would have put it {length(other)} further."
    )


def boards(states: Maps) -> dict[float, float]:
    """Return the median depth that was found for every board, by its true depth, metres."""
    parts = flat_parts(states.subject, states[DEPTH].depth)
    return {round(true): true + float(np.median(off)) for true, off in parts.items()}


def mean_depths(states: Maps) -> tuple[float, float]:
    """Return the mean of the boards' depths, and the depth of their mean disparity, metres."""
    depths = boards(states)
    camera = states.subject.pair.camera
    fB = camera.f * camera.baseline
    mean = float(np.mean([fB / z for z in depths.values()]))
    return float(np.mean(list(depths.values()))), fB / mean


def _averages(states: Maps) -> float:
    of_depths, of_disparities = mean_depths(states)
    if abs(of_depths - of_disparities) < 0.1:
        return 2.0
    return 0.0 if of_depths > of_disparities else 1.0


def _why_averages(states: Maps) -> str:
    of_depths, of_disparities = mean_depths(states)
    return (
        f"The mean of the depths is {length(of_depths)}, the mean disparity stands for"
        f" {length(of_disparities)}: 1 / d is not linear, and the near board has by far the"
        " largest d."
    )


QUESTIONS: tuple[Question, ...] = (
    Question(
        name="quarter",
        text="A point 5 m away jumps by 16 px. Another jumps by 4 px, a quarter of that. How far"
        " away is it?",
        answer=lambda states: far_end(states).depth,
        why=_why_quarter,
        params=JUMP,
        start=12,
        step=-1,
        unit="m",
        tolerance=1.0,
        low=0.0,
        high=100.0,
        stride=1.0,
        wrong=(
            (
                1.0,
                2.0,
                "That is a quarter of the distance: nearer, with a smaller jump. But far things"
                " jump less.",
            ),
            (
                9.5,
                10.5,
                "That is twice as far. There is no root in it: a quarter of the jump is four"
                " times the distance.",
            ),
            (
                75.0,
                85.0,
                "That is 16 times as far, the square of four. The square belongs to the error of"
                " the distance, not to the distance.",
            ),
        ),
    ),
    Question(
        name="single",
        text="Each pixel of the picture takes its own best shift, out of 32. What percentage of"
        " them is over 1 px off?",
        answer=single,
        why=_why_single,
        params=SINGLE,
        start=31,
        step=31,
        unit="%",
        tolerance=10.0,
        low=0.0,
        high=100.0,
        stride=1.0,
        wrong=(
            (
                0.0,
                25.0,
                "Our pixel found its partner. But it was lucky: look how many other shifts cost"
                " little as well.",
            ),
            (
                90.0,
                100.0,
                "That would be pure chance: 2 shifts of 32 are within a pixel, so 94 % would be"
                " wrong. The grey value does help.",
            ),
        ),
    ),
    Question(
        name="window",
        text="The noise is twice as strong. With a window of 3 px the wrong pixels are scattered"
        " everywhere. Where are those that a window of 21 px leaves?",
        answer=_edges,
        why=_why_edges,
        params=NOISY_WINDOWS,
        start=1,
        step=-1,
        choices=(
            Choice(
                "scattered everywhere",
                why="That is the fault of a small window. Over 441 pixels noise averages out.",
            ),
            "beside the edges of things",
        ),
    ),
    Question(
        name="baseline",
        text="The cameras move apart, from 10 to 20 cm. How many pixels does the right camera not"
        " see then?",
        answer=lambda states: float(
            np.digitize(hidden_at(states, 0.2) / hidden_at(states, 0.1), [0.75, 1.5])
        ),
        why=_why_baseline,
        params=BASELINES,
        start=2,
        step=6,
        choices=(
            Choice(
                "about half as many",
                why="The errors of the depths halve. What is hidden does not: the two cameras see"
                " past an edge from places further apart.",
            ),
            Choice(
                "about as many",
                why="The hidden band is as wide as the jumps of its two sides differ, and all jumps"
                " change with the baseline.",
            ),
            "about twice as many",
        ),
    ),
    Question(
        name="nearer",
        text="Every jump is measured 1 px too large: a board with 80 px, 1 m away, comes 12 mm"
        " nearer. How much nearer does the board with 4 px come?",
        answer=lambda states: 20.0 - at_20(states, 1.0),
        why=_why_nearer,
        params=NET,
        start=8,
        step=-1,
        unit="m",
        tolerance=0.4,
        low=0.0,
        high=20.0,
        stride=0.1,
        wrong=(
            (
                4.6,
                5.2,
                "That is Z² / (f B), or 12 mm times 20²: the slope of 1 / d at 4 px. One pixel of"
                " four is too long a step to follow a slope.",
            ),
            (
                6.3,
                7.0,
                "That is a pixel too few: 80 / 3 = 26.7 m. A pixel too many leads the other way.",
            ),
            (
                0.2,
                0.3,
                "That is 20 times 12 mm, as if the error grew with the distance. It grows with its"
                " square.",
            ),
            (
                0.0,
                0.1,
                "That is about what the near board moves. The same pixel is an eightieth of its"
                " jump, and a quarter of this one's.",
            ),
            (15.0, 16.5, "That is where the board is seen now. Asked is how far it came."),
        ),
    ),
    Question(
        name="averages",
        text="Three boards have disparities of 80, 16 and 4 px. Average their depths, or average"
        " their disparities and take the depth of that: which is further?",
        answer=_averages,
        why=_why_averages,
        params=BOARDS,
        start=0,
        step=DEPTH,
        choices=(
            "the mean of the depths",
            Choice(
                "the depth of the mean disparity",
                why="The near board has 80 px of the 100: it nearly alone decides the mean"
                " disparity, which therefore stands for something near.",
            ),
            Choice(
                "both are the same",
                why="They would be if depth were proportional to disparity. It is one over it.",
            ),
        ),
    ),
)
