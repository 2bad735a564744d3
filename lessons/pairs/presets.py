"""Runs worth seeing, cameras, and what to predict before looking."""

from dataclasses import replace

import numpy as np

from lessons.pairs.flat import HAND, Bands, Held
from lessons.pairs.inputs import Input
from lessons.pairs.space import Scans, State
from workbench.certain import as_a
from workbench.lesson import Choice, Preset, Question, States, Sweep, View
from workbench.numerals import angle, fixed, length

TURNED = Input(stage="flat")
MIRRORED = Input(mirrored=True, noise=0.0)
NEGATED = replace(MIRRORED, flip="whole")
SCALE = Input(scale=1.5, noise=0.05)
HALF = Input(wrong=50.0)

FRONT = View(eye=(0.0, 2.15, 0.0), target=(0.0, 0.0, 0.0), grid=None, axes=False)
VIEW = View(eye=(-0.95, -2.3, 1.1), target=(-0.75, 0.0, 0.15), grid=None, axes=False)
NEAR = View(eye=(-1.1, -1.75, 0.75), target=(-1.1, 0.0, 0.15), grid=None, axes=False)
LARGE = View(eye=(-1.35, -2.6, 1.1), target=(-1.35, 0.0, 0.2), grid=None, axes=False)
ABOVE = View(eye=(-1.05, -1.5, 2.0), target=(-1.2, 0.0, 0.0), grid=None, axes=False)
VIEWS = {"front": FRONT, "both": VIEW, "near": NEAR, "large": LARGE, "above": ABOVE}
FLIP = 5  # the step where a direction is flipped
START = int(np.argmin(np.abs(HAND + 60.0)))  # the hand begins 60 degrees to the left

PRESETS: tuple[Preset[Input], ...] = (
    Preset(
        name="turned",
        title="Turned by hand",
        line="Twelve bands hold two outlines of the rabbit. Turn orange, and read the RMSE.",
        params=TURNED,
        step=START,
        view=FRONT,
    ),
    Preset(
        name="pulled",
        title="One band pulled aside",
        line="The highest of the twelve blue ends lies 1 m off: one far partner turns them all.",
        params=replace(TURNED, pull=1.0),
        step=START,
        view=FRONT,
        breaks=True,
    ),
    Preset(
        name="pairs",
        title="Two scans whose points are paired",
        line="1,500 pairs with 1 cm of noise. Vᵀ turns the second scan in, U turns it out.",
        params=Input(),
        step=3,
    ),
    Preset(
        name="mirrored",
        title="A mirror image",
        line="The determinant is −1, so one direction is flipped: the weakest, which costs least.",
        params=MIRRORED,
        step=FLIP,
        view=NEAR,
    ),
    Preset(
        name="middle-flip",
        title="The middle direction flipped",
        line="The determinant is +1 as well. Compare the RMSE.",
        params=replace(MIRRORED, flip="middle"),
        step=FLIP,
        view=NEAR,
        breaks=True,
    ),
    Preset(
        name="wrong-flip",
        title="The strongest direction flipped",
        line="“Flip any column”: the determinant is +1 as well. Compare the RMSE.",
        params=replace(MIRRORED, flip="largest"),
        step=FLIP,
        view=NEAR,
        breaks=True,
    ),
    Preset(
        name="negated",
        title="All of R negated",
        line="−R has the determinant +1 too, and flips all three directions. What does that cost?",
        params=NEGATED,
        step=4,
        view=NEAR,
        breaks=True,
    ),
    Preset(
        name="flat",
        title="A plate with noise",
        line=(
            "Nothing is mirrored, but only noise tells a plate from its mirror image: the"
            " determinant is a matter of chance."
        ),
        params=Input(shape="plate", points=200, noise=0.02),
        step=4,
        view=ABOVE,
        breaks=True,
    ),
    Preset(
        name="scale",
        title="Noise in both scans",
        line=(
            "The first scan is 1.5 times as large and both have 5 cm of noise: the scale comes out"
            " too small."
        ),
        params=SCALE,
        step=-1,
        view=LARGE,
        breaks=True,
    ),
    Preset(
        name="scale-clean",
        title="Noise in the first scan only",
        line="The noise is where least squares expects it, and the scale is 1.50 again.",
        params=replace(SCALE, noisy="target"),
        step=-1,
        view=LARGE,
    ),
    Preset(
        name="half-wrong-pairs",
        title="Half of the pairs are wrong",
        line="750 of 1,500 points have the partner of another point. Read how far the fit is off.",
        params=HALF,
        step=1,
    ),
    Preset(
        name="together",
        title="A tenth errs to the same side",
        line=(
            "The partners of the highest tenth lie 30 cm to one side: few mistakes, but they agree."
        ),
        params=Input(wrong=10.0, mistakes="together"),
        step=FLIP,
        breaks=True,
    ),
)


def of_space(states: States) -> State:
    """Return the last step in space."""
    return as_a(State, states[-1])


def rmse_after_flip(states: States) -> float:
    """Return the RMSE once a direction is flipped, before any scale, metres."""
    return as_a(State, states[FLIP]).now.rmse


def scales(states: States) -> tuple[float, float]:
    """Return the scale from second to first, and the one back."""
    last = of_space(states)
    assert last.now.scale is not None
    return last.now.scale, last.back


def degrees_off(states: States) -> float:
    """Return how far the fit is off at the end, degrees."""
    return as_a(Scans, states.subject).degrees_off(of_space(states).now.T_target_source)


def valleys(states: States) -> int:
    """Return how many angles have a lower RMSE than both of their neighbours, once around."""
    # the last is the first again
    rmse = np.array([as_a(Held, state).rmse for state in states])[:-1]
    return int(np.sum((rmse < np.roll(rmse, 1)) & (rmse <= np.roll(rmse, -1))))


def _why_valleys(states: States) -> str:
    bands = as_a(Bands, states.subject)
    highest = length(float(bands.rmse.max()), 2)
    return (
        f"One valley, at {angle(abs(round(bands.best, 6)))}, and one top, {highest} high, on the"
        " opposite side. The bands keep their partners, so nothing new can hold the rabbit on the"
        " way."
    )


def _why_half(states: States) -> str:
    return (
        f"{angle(degrees_off(states))}. Each wrong band pulls its own way, and {_wrong(states):,}"
        " such pulls nearly cancel. The right ones all pull the same way."
    )


def _wrong(states: States) -> int:
    return int(np.count_nonzero(as_a(Scans, states.subject).is_wrong))


def _which_half(states: States) -> float:
    return float(np.digitize(degrees_off(states), [5.0, 60.0]))


QUESTIONS: tuple[Question, ...] = (
    Question(
        name="how-many-valleys",
        text="Turn the rabbit once all the way round. How many valleys will the curve have?",
        answer=lambda states: float(valleys(states) - 1),
        why=_why_valleys,
        params=TURNED,
        start=START,
        choices=(
            Choice("One"),
            Choice(
                "Two",
                "Upside down the outlines do lie nearly on each other. But the bands keep their"
                " partners, and upside down every partner is on the far side.",
            ),
            Choice(
                "Many",
                "There would be many if every point took a new partner at each angle. Here each"
                " point keeps its partner.",
            ),
        ),
    ),
    Question(
        name="predict-negated",
        text=(
            "Somebody takes −R instead: its determinant is +1 too, and all three directions are"
            " flipped. What RMSE does that leave?"
        ),
        answer=rmse_after_flip,
        why=lambda states: (
            f"{length(rmse_after_flip(states), 2)}. Add the three prices and take the root: squares"
            " add, lengths do not."
        ),
        params=NEGATED,
        start=4,
        step=FLIP,
        unit="m",
        tolerance=0.05,
        low=0.0,
        high=1.0,
        stride=0.01,
        wrong=(
            (
                0.0,
                0.34,
                (
                    "A determinant of +1 is not enough. The weakest direction alone costs 0.29 m,"
                    " and now two more are flipped."
                ),
            ),
            (
                0.45,
                0.55,
                (
                    "That is √3 times 0.29 m: three directions of the same price. The other two"
                    " cost more than the weakest."
                ),
            ),
            (
                0.85,
                0.9,
                "Three times 0.29 m. But it is the squares that add, and the three prices differ.",
            ),
        ),
    ),
    Question(
        name="predict-product",
        text=(
            "Find the scale from orange to blue, then the scale from blue back to orange. Their"
            " product is …"
        ),
        answer=lambda states: float(np.digitize(np.prod(scales(states)), [0.98, 1.02])),
        why=lambda states: (
            f"{fixed(scales(states)[0], 3)} there and {fixed(scales(states)[1], 3)} back:"
            f" {fixed(float(np.prod(scales(states))), 3)} in all. Both ways the scan that is moved"
            " looks larger than it is."
        ),
        params=SCALE,
        start=FLIP,
        choices=(
            Choice("less than 1"),
            Choice(
                "1: one undoes the other",
                "That is so without noise. With noise each fit treats its own moved scan as exact,"
                " so the two fits are two different questions.",
            ),
            Choice(
                "more than 1",
                "Noise does make a scan look larger. But the scan that looks larger is the one that"
                " is moved, so it is scaled down.",
            ),
        ),
    ),
    Question(
        name="half-wrong",
        text="Half of the 1,500 pairs are shuffled. How far off is the best turn?",
        answer=_which_half,
        why=_why_half,
        params=HALF,
        start=1,
        step=FLIP,
        choices=(
            Choice("Less than 5°"),
            Choice(
                "About 45°",
                "Half wrong is not half off. The wrong bands pull in all directions, and their"
                " pulls cancel.",
            ),
            Choice(
                "It could be anything",
                "It would be if no band was right. Half of them still agree, and the rest agree on"
                " nothing.",
            ),
        ),
    ),
)

SWEEPS = (
    Sweep("noise", (0.0, 0.01, 0.02, 0.05, 0.1)),
    Sweep("noise", (0.01, 0.02, 0.05, 0.1), run="scale"),
    Sweep("wrong", (0.0, 10.0, 30.0, 50.0, 80.0, 90.0), run="half-wrong-pairs"),
)
