"""Presets and questions: what to look for, and why it happens."""

from collections.abc import Sequence

import numpy as np

from lessons.epipolar.state import Params, State
from workbench.algorithms.two_views import Related
from workbench.certain import as_a
from workbench.lesson import Choice, Preset, Question
from workbench.numerals import angle, fixed, pixels

HOME = Params()
PLANE = Params(scene="plane", route="eight-point")
WRONG_F = Params(heading=0.0, f_error=20.0)
PENCIL, EQUATIONS, RANK_TWO, POINTS = 7, 8, 10, 16
DEPTH = 8.0  # metres, of the point whose uncertainty is asked for

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        "home",
        "One point, one line",
        "Walk along the ray of one pixel, and watch where the other camera sees it. Then matches"
        " take over.",
        HOME,
        0,
    ),
    Preset(
        "sideways",
        "Straight to the right",
        "The second camera stands beside the first: epipoles are far outside, and rectification"
        " hardly changes anything.",
        Params(heading=0.0),
        -1,
    ),
    Preset(
        "raw",
        "Raw pixels",
        "The same matches, equations in pixels: products of coordinates weigh 100,000 times as much"
        " as 1. See the lines.",
        Params(normalise=False, route="eight-point"),
        RANK_TWO,
        breaks=True,
    ),
    Preset(
        "rank-three",
        "Lines that do not meet",
        "F as it comes from 20 matches, of rank three: near the epipole its lines miss each other.",
        Params(heading=85.0, matches=20, noise=1.0, rank_two=False, route="eight-point"),
        RANK_TWO,
        breaks=True,
    ),
    Preset(
        "plane",
        "Everything on the ground",
        "All matches lie in one plane. Look at the eighth singular value, then at how the lines"
        " fit, then at the motion.",
        PLANE,
        EQUATIONS,
        breaks=True,
    ),
    Preset(
        "turned",
        "Only turned",
        "No baseline, no lines; the rotation can be had all the same. A direction comes out too: of"
        " nothing.",
        Params(baseline=0.0),
        5,
        breaks=True,
    ),
    Preset(
        "short",
        "Five centimetres",
        "A twentieth of the baseline: the lines are as near, and the rotation stays within 1° with"
        " every seed, as before. Direction and depths pay.",
        Params(baseline=0.05),
        -1,
        breaks=True,
    ),
    Preset(
        "far",
        "Everything far away",
        "A city from a hill, nothing nearer than 180 baselines: parallax is hardly more than noise."
        " The rotation stays within 1° with every seed; see the pointers, the needles, and what is"
        " behind.",
        Params(scene="far"),
        POINTS,
        breaks=True,
    ),
    Preset(
        "forward",
        "Straight ahead",
        "The second camera stands in the first picture: the epipole is where the street runs to,"
        " and no turn aligns rows.",
        Params(heading=90.0),
        PENCIL,
    ),
    Preset(
        "oblique",
        "Half ahead",
        "Both cameras turn by more than half a right angle, across the baseline: rows correspond,"
        " and the pictures grow.",
        Params(heading=50.0),
        -1,
    ),
    Preset(
        "left",
        "The second camera on the left",
        "Left and right are swapped: the common x axis runs against the baseline, and the pictures"
        " stay upright.",
        Params(heading=180.0),
        -1,
    ),
    Preset(
        "upside-down",
        "Swapped, and turned over",
        "As the paper has it, x runs from the first camera to the second, here to the left: rows"
        " correspond, upside down.",
        Params(heading=180.0, keep_upright=False),
        -1,
    ),
    Preset(
        "wrong-f",
        "A focal length 20 % too long",
        "The matches of the run straight to the side, and another K. Compare the lines, the rows"
        " and the motion.",
        WRONG_F,
        -1,
        breaks=True,
    ),
    Preset(
        "refined-f",
        "Refined before K is used",
        "Seven numbers of F in place of the five that a motion has: the matches are nearer, the"
        " cameras are not.",
        Params(heading=0.0, route="refined F"),
        -1,
    ),
    Preset(
        "exact",
        "No noise",
        "Without noise eight-point is all there is to do: the ninth singular value is nothing but"
        " rounding.",
        Params(noise=0.0),
        EQUATIONS,
    ),
)


def depth_sigma(state: State) -> float:
    """Return how uncertain the depth of a point 8 m before the first camera is, metres, from the
    true cameras.
    """
    return float(state.depth_sigma(np.array([[0.0, 0.0, DEPTH]]))[0])


def in_front(states: Sequence[State]) -> tuple[int, ...]:
    """Return how many points each of the four motions puts in front of both cameras."""
    estimate = as_a(Related, states[-1].now)
    return estimate.in_front


def lines_fit(states: Sequence[State]) -> float:
    """Return 0 where matches lie about as near to their lines as their noise is, else 1."""
    last = states[-1]
    return float(last.to_lines(last.views.matches) > 1.5 * last.params.noise)


QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        "predict-four",
        "An essential matrix allows four motions. How many of them put all points in front of both"
        " cameras?",
        answer=lambda states: float(np.count_nonzero(in_front(states))),
        why=lambda states: (
            f"They put {', '.join(str(n) for n in in_front(states))} of"
            f" {len(states[-1].views.matches)} points there. In the others points lie behind one"
            " camera or behind both."
        ),
        params=HOME,
        step=12,
        choices=(
            Choice(
                "none",
                why="One of the four is the motion itself, and its cameras saw all the points.",
            ),
            "a single one",
            Choice(
                "two",
                why=(
                    "Turn t round and each ray meets its partner behind both cameras; the other"
                    " turn fails too."
                ),
            ),
            Choice(
                "all four",
                why="All four fit the matches. But a camera sees only what is in front of it.",
            ),
        ),
    ),
    Question(
        "predict-baseline",
        "Two cameras 1 m apart, pixels good to 0.5 px: the depth of a point 8 m away has σ = 11 cm."
        " They move together, to 0.5 m. What is σ now?",
        answer=lambda states: 100 * depth_sigma(states[-1]),
        why=lambda states: (
            f"{fixed(100 * depth_sigma(states[-1]), 0)} cm. The rays meet at half the angle: σ = Z²"
            " σ_d / (f b) goes with one over the baseline, and with the square of the depth."
        ),
        params=Params(baseline=0.5, heading=0.0),
        unit="cm",
        tolerance=3.0,
        wrong=(
            (
                4.0,
                7.0,
                "Half of 11 cm would be better than before. Nearer cameras tell less about depth.",
            ),
            (
                9.0,
                13.0,
                "The pixels are as good as before, but the rays now meet at half the angle.",
            ),
            (14.5, 17.0, "That is √2 times 11 cm. The baseline itself divides, not its root."),
            (
                38.0,
                50.0,
                "Four times belongs to the depth, which counts squared. The baseline counts once.",
            ),
        ),
    ),
    Question(
        "predict-plane",
        "All 60 matches lie on level ground. Lines are as near as in any run. How far is the"
        " direction of the motion off?",
        answer=lambda states: float(np.digitize(states[-1].direction_error, [2.0, 20.0])),
        why=lambda states: (
            f"{angle(states[-1].direction_error)}. The matches of a plane obey a homography, and"
            " many F agree with that: the eighth singular value is hardly larger than the ninth."
        ),
        params=PLANE,
        choices=(
            Choice(
                "below 2°",
                why="Near lines say that this F agrees with the matches. Of a plane many F do.",
            ),
            Choice(
                "2° to 20°",
                why=(
                    "It is not a matter of some more noise: a whole family of F fits these matches."
                ),
            ),
            "beyond 20°",
        ),
    ),
    Question(
        "predict-f",
        "One believes in a focal length that is 20 % too long, and refines the motion with it. Do"
        " the lines still fit the matches?",
        answer=lines_fit,
        why=lambda states: (
            f"They are {pixels(states[-1].to_lines(states[-1].views.matches))} from them. The"
            f" motion takes the error in: it is {angle(states[-1].turn_error)} off in rotation, and"
            " nothing in the pictures tells."
        ),
        params=WRONG_F,
        choices=(
            "as well as ever",
            Choice(
                "visibly worse",
                why=(
                    "The motion is free to change: a slightly different one makes up for the"
                    " wrong f."
                ),
            ),
        ),
    ),
)
