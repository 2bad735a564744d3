"""Experiments with boards, and what to predict before looking."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lessons.calibration.state import Params, State
from workbench.certain import sure
from workbench.lesson import Choice, Preset, Question
from workbench.numerals import brief, fixed, percent, pixels

POSES = 9  # the step of the default run that places the boards
FLAT = Params(tilt=2.0, seed=3)
FEW = Params(views=3)
BAD = Params(bad_corners=3, seed=1)
BENT = Params(fault="bent 1 mm")
LARGER = Params(fault="2 % larger")
TWO = Params(views=4)

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        "home",
        "Eight boards",
        "Closed form, then all together: step through, and read the ± at the end.",
        Params(),
        0,
    ),
    Preset(
        "flat",
        "Boards hardly tilted",
        "Tilted by 2° only: f comes to rest 43 px short of the truth. Its ± at the end is 200 px,"
        " and with boards at 30° it is 1.6 px.",
        FLAT,
        POSES,
        breaks=True,
    ),
    Preset(
        "few",
        "Three views",
        "Three views fit well and leave f uncertain: its ± at the end is 3.6 px, that of eight"
        " views is 1.6 px.",
        FEW,
        -1,
    ),
    Preset(
        "pinhole",
        "No lens in the model",
        "K and poses have to take up what the lens does: f comes out 18.5 px too long, and arrows"
        " in the picture show a pattern.",
        Params(lens="none"),
        -1,
        breaks=True,
    ),
    Preset(
        "middle",
        "Corners in the middle only",
        "Far boards, five terms of the lens: corners fit as well as ever. At the border of the"
        " picture the map is off by 82,000 px.",
        Params(lens="k1 k2 p1 p2 k3", spread=0.1, distance=0.8),
        -1,
        breaks=True,
    ),
    Preset(
        "bad",
        "Three bad corners",
        "Three corners of view 1 were found 5 px away. The bars tell which view it is.",
        BAD,
        -2,
        breaks=True,
    ),
    Preset(
        "dropped",
        "The bad view left out",
        "The same pictures without view 1. Compare f and its ± with before.",
        replace(BAD, leave_out=1),
        -1,
    ),
    Preset(
        "cauchy",
        "The bad corners hardly pull",
        "Cauchy's loss instead: view 1 stays, and its good corners count.",
        replace(BAD, loss="Cauchy"),
        -1,
    ),
    Preset(
        "stretched",
        "A stretched print",
        "The printer made x 2 % longer and nobody knows: fx and fy come out 2 % apart, though"
        " pixels are square.",
        Params(fault="stretched 2 %"),
        -1,
        breaks=True,
    ),
    Preset(
        "bent",
        "A bowed board",
        "The middle stands 1 mm nearer than it should. Compare the error of f with its ±.",
        BENT,
        POSES,
        breaks=True,
    ),
)


def f_error(states: Sequence[State]) -> float:
    """Return how far f is off at the end, px."""
    K, truth = sure(states[-1].now.K), sure(states[-1].subject.K)
    return float(K[0, 0] - truth[0, 0])


def f_deviation(states: Sequence[State]) -> float:
    """Return the ± of f at the end, px."""
    refined = sure(states[-1].now.adjustment)
    return float(refined.deviations[0])


def f_sure(states: Sequence[State]) -> str:
    """Write the ± of f at the end."""
    return f"± {brief(f_deviation(states), 2)} px"


def views_needed(states: Sequence[State]) -> float:
    """Return after how many views the rows determine B up to its scale: four of five numbers."""
    for state in states:
        s = state.now.singular_values
        if len(s) >= 4 and s[3] > 1e-6 * s[0]:
            return len(state.now.Hs_image_board)
    return float("inf")


def distance_ratio(states: Sequence[State]) -> float:
    """Return the length of t as found over the true one, of all views together."""
    estimated, true = (
        Ts[:, :3, 3] for Ts in (states[-1].now.Ts_camera_board, states[-1].subject.Ts_camera_board)
    )
    return float(np.linalg.norm(estimated, axis=1).sum() / np.linalg.norm(true, axis=1).sum())


def _changed(states: Sequence[State]) -> float:
    f_changed = abs(f_error(states)) > 5.0
    t_changed = abs(distance_ratio(states) - 1) > 0.01
    if f_changed and t_changed:
        return 3.0
    if f_changed:
        return 0.0
    return 1.0 if t_changed else 2.0


def _closed_forms(states: Sequence[State]) -> str:
    parts = []
    for state in states:
        if state.now.phase == "constraints" and state.now.K is not None:
            parts.append(f"{fixed(state.now.K[0, 0], 0)} px with {len(state.now.Hs_image_board)}")
    return ", ".join(parts) or "none"


QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        "flat-rms",
        "Boards are tilted by 2° instead of 30°, all else is the same. What becomes of the rms at"
        " the end of the calibration?",
        answer=lambda states: float(
            np.digitize(states[-1].rms / (np.sqrt(2) * states[-1].params.noise), [1.5, 4.0])
        ),
        why=lambda states: (
            f"{pixels(states[-1].rms)}, while f is off by {pixels(abs(f_error(states)))}"
            f" ({f_sure(states)}). Corners fit because f and the distances make up for each other."
            " The rms measures noise, not knowledge."
        ),
        params=FLAT,
        choices=(
            "about the same",
            Choice(
                "two or three times as large",
                why=(
                    "That takes fit for knowledge. Boards like these tell less about f, but they"
                    " are no harder to fit."
                ),
            ),
            Choice(
                "more than ten times as large",
                why=(
                    "f does get that much worse, and the rms does not: a wrong f is made good by"
                    " boards at wrong distances."
                ),
            ),
        ),
    ),
    Question(
        "noise-rms",
        "Each coordinate of each corner has noise of 0.2 px. Lens, camera and poses are estimated"
        " without a mistake. What rms is reported?",
        answer=lambda states: states[-1].rms,
        why=lambda states: (
            f"{pixels(states[-1].rms)}: the rms is that of points, and a point has two coordinates,"
            " √2 · 0.2 = 0.283 px. It is a little less, for"
            f" {6 * len(states[-1].subject.views) + 8} unknowns fit some of the noise too."
        ),
        params=Params(),
        unit="px",
        tolerance=0.03,
        wrong=(
            (
                0.13,
                0.15,
                (
                    "You divided by √2. The squares of a corner's two coordinates are added: its"
                    " error is larger."
                ),
            ),
            (
                0.19,
                0.21,
                (
                    "That is the rms of coordinates. The rms that is reported is of points, and a"
                    " point has two."
                ),
            ),
            (
                0.39,
                0.41,
                (
                    "You added both coordinates. Their squares add up, so that √2 times the noise"
                    " comes out, not twice."
                ),
            ),
        ),
    ),
    Question(
        "views",
        "The skew is known to be 0. From how many views on, at least, does the closed form"
        " determine K?",
        answer=views_needed,
        why=lambda states: (
            f"{fixed(views_needed(states), 0)}: B has five entries, four up to its scale, and each"
            " view gives two equations. Determined is not known well, for there is no lens in it:"
            f" f = {_closed_forms(states)} views."
        ),
        params=TWO,
        step=2,
        tolerance=0.1,
        wrong=(
            (
                1,
                1,
                (
                    "One view gives two equations, and four numbers are unknown: f in x and in y,"
                    " and the principal point."
                ),
            ),
            (3, 3, "Three are needed where the skew is to be found too. Here it is known."),
            (
                4,
                5,
                (
                    "Each view gives two equations and not one: r₁ and r₂ are at right angles, and"
                    " equally long."
                ),
            ),
        ),
    ),
    Question(
        "larger",
        "The board was printed 2 % larger than everybody thinks, in both directions. What comes out"
        " wrong?",
        answer=_changed,
        why=lambda states: (
            f"f is off by {pixels(abs(f_error(states)))} ({f_sure(states)}), and all distances are"
            f" {percent(abs(distance_ratio(states) - 1))} too"
            f" {'short' if distance_ratio(states) < 1 else 'long'}. A picture cannot tell a large"
            " board from a near one: no unit of length reaches K."
        ),
        params=LARGER,
        choices=(
            Choice(
                "the focal length",
                why=(
                    "f would have to turn millimetres into pixels. It turns angles into pixels, and"
                    " no angle has changed."
                ),
            ),
            "the distances to the boards",
            Choice(
                "nothing",
                why=(
                    "Something takes the scale up: a smaller board that looks the same has to be"
                    " nearer."
                ),
            ),
            Choice(
                "both of them",
                why=(
                    "One of them is enough to make all corners fit. Then nothing is left that f"
                    " would have to make good."
                ),
            ),
        ),
    ),
    Question(
        "bent-error",
        "A board is bowed by 1 mm over its 20 cm. The covariance promises a ± for f. How large is"
        " the true error of f?",
        answer=lambda states: float(
            np.digitize(abs(f_error(states)) / f_deviation(states), [1.0, 2.5])
        ),
        why=lambda states: (
            f"f is off by {pixels(abs(f_error(states)))},"
            f" {fixed(abs(f_error(states)) / f_deviation(states), 1)} times its ± of"
            f" {brief(f_deviation(states), 2)} px. The covariance knows of noise only; a wrong"
            " board is wrong in all views alike."
        ),
        params=BENT,
        choices=(
            Choice(
                "within its ±",
                why="So it would be if noise were all that is wrong. The ± is made of noise alone.",
            ),
            Choice(
                "up to 2.5 times its ±",
                why=(
                    "Noise might do that once in some runs. The bow is no noise: it is the same in"
                    " every view, and adds up."
                ),
            ),
            "over 2.5 times its ±",
        ),
    ),
)
