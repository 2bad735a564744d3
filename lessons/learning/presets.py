"""Experiments that show what a loss cannot see and a representation cannot say, and what to predict
before looking.
"""

from collections.abc import Sequence

import numpy as np

from lessons.learning.captions import shares_right
from lessons.learning.state import Clouds, Looks, Params, State, Turns
from workbench.algorithms.learning.point_net import Classified
from workbench.algorithms.learning.rotation_regression import Regressed
from workbench.algorithms.learning.set_regression import SetLearned
from workbench.certain import as_a
from workbench.lesson import Choice, Preset, Question, View
from workbench.numerals import angle, counted, fixed, percent

VIEW = View(eye=(0.0, -0.6, 3.6), target=(0.0, 0.0, 0.0), grid=None, axes=False)
BALL = View(eye=(1.9, -2.4, 1.3), target=(0.0, 0.0, 0.0), grid=None, axes=False)
ABOVE = View(eye=(0.0, -0.6, 4.6), target=(0.0, 0.0, 0.0), grid=None, axes=False)
RABBIT = View(eye=(2.15, -2.05, 0.9), target=(0.5, 0.35, 0.1), grid=None, axes=False)
FLAT = View(eye=(0.0, -0.7, 5.6), target=(0.0, 0.0, 0.0), grid=None, axes=False)
ROW = View(eye=(0.0, -11.4, 2.7), target=(0.3, 0.0, 0.75), grid=None, axes=False)

CUT = Params(angle="one number")
SMEARED = Params(task="sets")
CIRCLE = Params(task="sets", set_loss="earth mover's")
SMOOTH = Params(task="mesh")
STRAY = Params(task="classify", stray=(3.0, 3.0, 3.0))
MANY = Params(task="field", views=24)

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        "cut",
        "An angle as one number",
        "Two neighbours on the circle are asked for numbers far apart. Watch what a smooth function"
        " makes of that.",
        CUT,
        0,
        VIEW,
        breaks=True,
    ),
    Preset(
        "short",
        "The same, up to quarter turns",
        "The circle is not closed: nothing is cut, and one number per angle is enough.",
        Params(angle="one number", largest=90.0),
        -1,
        VIEW,
    ),
    Preset(
        "half",
        "Half the angle",
        "Cosine and sine of half the angle, as a quaternion has them: both signs mean one rotation,"
        " and one is asked for.",
        Params(angle="half the angle"),
        0,
        VIEW,
        breaks=True,
    ),
    Preset(
        "periodic",
        "A loss that knows of full turns",
        "The loss compares rotations, so it does not mind 360°. The output is still one number:"
        " look where its jump goes.",
        Params(angle="one number", loss="matrix"),
        0,
        VIEW,
        breaks=True,
    ),
    Preset(
        "rotation",
        "Rotations by two columns",
        "Six numbers, made orthonormal: every rotation is reached, and nowhere is a jump. After"
        " 1,500 updates the worst error is 3.6°.",
        Params(task="rotation", loss="matrix"),
        -1,
        BALL,
    ),
    Preset(
        "quaternion",
        "Rotations by quaternions",
        "The ball holds all rotation vectors. Opposite points of its border are one rotation, and w"
        " ≥ 0 asks for opposite numbers there: after 1,500 updates all errors over 20° are beyond"
        " 178°.",
        Params(task="rotation", rotation="quaternion"),
        -1,
        BALL,
        breaks=True,
    ),
    Preset(
        "quaternion-matrix",
        "Quaternions, compared as matrices",
        "Nobody asks for a sign now, so the cut need not be at the border. It is still somewhere:"
        " look for the large errors inside the ball.",
        Params(task="rotation", rotation="quaternion", loss="matrix"),
        -1,
        BALL,
        breaks=True,
    ),
    Preset(
        "euler",
        "Rotations by Euler angles",
        "Three numbers: after 1,500 updates the mean error is over seven times that of six numbers,"
        " and the worst is over 150°.",
        Params(task="rotation", rotation="Euler", loss="matrix"),
        -1,
        BALL,
        breaks=True,
    ),
    Preset(
        "nine",
        "Rotations by all nine entries",
        "The nearest rotation to any 3×3, by its SVD: 1.05° off on average after 1,500 updates,"
        " where six numbers are 1.25° off.",
        Params(task="rotation", rotation="9D", loss="matrix"),
        -1,
        BALL,
    ),
    Preset(
        "smeared",
        "Chamfer and the unknown radius",
        "Each target is a circle of another radius. Nobody knows the next: watch how the points"
        " hedge.",
        SMEARED,
        0,
        ABOVE,
        breaks=True,
    ),
    Preset(
        "circle",
        "Earth mover's and the unknown radius",
        "The same targets, matched one to one: every point gets the mean of its partners.",
        CIRCLE,
        0,
        ABOVE,
    ),
    Preset(
        "spikes",
        "A mesh without a regulariser",
        "Nothing but the distance to noisy points: it falls, while edges fold over, after 80"
        " updates 48 % of them.",
        Params(task="mesh", laplacian=0.0),
        -1,
        RABBIT,
        breaks=True,
    ),
    Preset(
        "smooth",
        "A mesh with a Laplacian",
        "Farther from the noisy points, nearer to the rabbit beside it. But its ears are cut short:"
        " smoothness is a belief.",
        SMOOTH,
        -1,
        RABBIT,
    ),
    Preset(
        "pooled",
        "PointNet and the order of points",
        "The largest of each feature over all points: it is the same, but for rounding, in whatever"
        " order they are listed.",
        Params(task="classify", shuffled=True),
        -1,
        ROW,
    ),
    Preset(
        "listed",
        "A network on the list of points",
        "Coordinates in a row, from the lowest point to the highest. Shuffled, the same clouds mean"
        " nothing to it.",
        Params(task="classify", pool="none", shuffled=True),
        -1,
        ROW,
        breaks=True,
    ),
    Preset(
        "stray",
        "One stray point",
        "One point of each cloud is moved away. Purple points are those that the maximum"
        " listens to.",
        STRAY,
        0,
        ROW,
        breaks=True,
    ),
    Preset(
        "mean",
        "One stray point and the mean",
        "The mean gives every point the same small vote: it knows less, and loses less to one"
        " point.",
        Params(task="classify", pool="mean", stray=(3.0, 3.0, 3.0)),
        -1,
        ROW,
        breaks=True,
    ),
    Preset(
        "turned",
        "Turned as never before",
        "Trained on shapes turned about z, tested on shapes turned freely: nothing in the network"
        " knows of rotations.",
        Params(task="classify", turned="freely"),
        -1,
        ROW,
        breaks=True,
    ),
    Preset(
        "two",
        "Two photographs",
        "A field that explains what it was shown. Look at the new view, and at the green discs.",
        Params(task="field", views=2),
        0,
        FLAT,
        breaks=True,
    ),
    Preset(
        "many",
        "Twenty-four photographs",
        "From all around: what fits all of them has hardly a choice left. Look at the weights along"
        " a ray of the new view.",
        MANY,
        0,
        FLAT,
    ),
)


def regressed(states: Sequence[State]) -> tuple[Turns, Regressed]:
    """Return the last state of a run on turns."""
    about, fit = as_a(Turns, states[-1].about), as_a(Regressed, states[-1].now)
    return about, fit


def _worst_at(states: Sequence[State]) -> float:
    about, fit = regressed(states)
    return abs(float(about.degrees[fit.errors.argmax()]))


def _cut_why(states: Sequence[State]) -> str:
    _, fit = regressed(states)
    return (
        f"At {fixed(_worst_at(states), 0)}°, by {angle(float(fit.errors.max()))} after"
        f" {_updates(states)}: a step to either side of half a turn the numbers asked for are +180"
        " and −180. A smooth function runs through all that lies between."
    )


def _updates(states: Sequence[State]) -> str:
    """Write how many updates were made by the end."""
    return counted(states[-1].now.updates, "update")


def _radius(states: Sequence[State]) -> tuple[float, float]:
    learned = as_a(SetLearned, states[-1].now)
    radii = np.linalg.norm(learned.p, axis=1)
    return float(radii.mean()), float(radii.std())


def _named(states: Sequence[State]) -> tuple[float, float]:
    classified, about = as_a(Classified, states[-1].now), as_a(Clouds, states[-1].about)
    return shares_right(classified, about)


def _signals(states: Sequence[State]) -> Looks:
    return as_a(Looks, states[-1].about)


QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        "predict-cut",
        "A network learns to put out any turn in the plane as one number, signed, in degrees. At"
        " which size does it err most?",
        answer=_worst_at,
        why=_cut_why,
        params=CUT,
        unit="°",
        tolerance=20.0,
        wrong=(
            (
                0.0,
                45.0,
                (
                    "Small turns are the easiest: their neighbours on both sides are asked for"
                    " nearly the same number."
                ),
            ),
            (
                60.0,
                120.0,
                (
                    "Nothing happens there: the neighbours of a quarter turn are asked for nearly"
                    " the same number."
                ),
            ),
            (
                270.0,
                360.0,
                "Signed, no turn is larger than 180°: 270° to the left is 90° to the right.",
            ),
        ),
    ),
    Question(
        "predict-radius",
        "48 points learn from circles with radii from 0.5 m to 1.5 m, by the earth mover's loss of"
        " squares. What do they become?",
        answer=lambda states: float(np.digitize(_radius(states)[1], [0.02, 0.2])),
        why=lambda states: (
            f"After {_updates(states)} a circle of radius {fixed(_radius(states)[0], 2)} m, spread"
            f" {fixed(_radius(states)[1], 3)} m. The mean of the partners makes a sum of"
            " squares least, and all points see the same radii."
        ),
        params=CIRCLE,
        choices=(
            "one ring of no width",
            Choice(
                "a band some 0.3 m wide",
                why=(
                    "A band would hedge its bets, which pays where each point is compared with its"
                    " nearest. Here each has one partner in every circle, on average at the mean"
                    " radius."
                ),
            ),
            Choice(
                "points all over, from 0.5 m to 1.5 m",
                why=(
                    "That is what samples of the circles would be. A point that is"
                    " compared with many circles is pulled to their mean."
                ),
            ),
        ),
    ),
    Question(
        "predict-stray",
        "After 300 updates PointNet with max pooling names 93 % of new clouds of five shapes. One"
        " of 32 points is moved to (3, 3, 3). What share is named rightly now?",
        answer=lambda states: 100 * _named(states)[1],
        why=lambda states: (
            f"{percent(_named(states)[1], 0)} of them, where chance gives 20 %; untouched"
            f" {percent(_named(states)[0], 0)}. A maximum listens to whoever shouts: a far point"
            " has the largest of most features."
        ),
        params=STRAY,
        unit="%",
        tolerance=15.0,
        wrong=(
            (
                80.0,
                100.0,
                (
                    "One of 32 points would hardly count in a mean. A maximum takes the largest,"
                    " whoever has it."
                ),
            ),
            (
                60.0,
                79.0,
                (
                    "So much is left where the points are averaged. A maximum does not share the"
                    " votes out."
                ),
            ),
            (
                0.0,
                4.0,
                (
                    "That would be worse than chance. Whoever says the same name to all is right"
                    " for one shape in five."
                ),
            ),
        ),
    ),
    Question(
        "predict-views",
        "A field learns from 2 photographs, another from 24, by 225 updates each. The first matches"
        " the 2 it was shown with 37 dB. How does the second match its 24?",
        answer=lambda states: float(np.digitize(_signals(states).trained, [32, 40])),
        why=lambda states: (
            f"With {fixed(_signals(states).trained, 1)} dB: more to explain, so each is explained"
            f" less well. But views it was never shown have {fixed(_signals(states).unseen, 1)} dB,"
            " and that is what counts."
        ),
        params=MANY,
        choices=(
            "worse",
            Choice(
                "equally well",
                why=(
                    "It has the same grid for twelve times as much to explain: each photograph gets"
                    " less."
                ),
            ),
            Choice(
                "better",
                why=(
                    "More photographs help with what was not shown. What was shown becomes harder"
                    " to match."
                ),
            ),
        ),
    ),
)
