"""Runs worth seeing, cameras, and what to predict before looking."""

import numpy as np

from lessons.transforms.by_hand import roof
from lessons.transforms.factors import Built
from lessons.transforms.hands import SHEARS, SLOPES, TURNS, Held
from lessons.transforms.inputs import Input
from workbench.certain import as_a, sure
from workbench.lesson import Choice, Preset, Question, States, Sweep, View
from workbench.numerals import fixed, length

VIEW = View(eye=(2.6, -3.9, 2.2), target=(0.85, 0.2, 0.32), grid=None, axes=False)
NEAR = View(eye=(1.9, -2.8, 1.6), target=(0.2, 0.0, 0.5), grid=None, axes=False)
ABOVE = View(eye=(0.7, -1.2, 5.5), target=(0.7, 0.55, 0.0), grid=None, axes=False)
WAYS = View(eye=(0.0, -1.6, 6.6), target=(0.0, -0.25, 0.0), grid=None, axes=False)
FRONT_VIEW = View(eye=(2.9, -4.0, 2.5), target=(1.35, -0.2, 0.4), grid=None, axes=False)
LEVEL = View(eye=(0.3, -4.6, 1.2), target=(0.0, 0.0, 1.1), grid=None, axes=False)
BESIDE = View(eye=(1.2, -3.6, 1.5), target=(0.45, 0.0, 0.5), grid=None, axes=False)
VIEWS = {
    "near": NEAR,
    "above": ABOVE,
    "ways": WAYS,
    "level": LEVEL,
    "beside": BESIDE,
    "front": FRONT_VIEW,
    "wide": VIEW,
}

ONE = (1.0, 1.0, 1.0)
NO_TURN = (0.0, 0.0, 0.0)
AHEAD = (1.5, 0.0, 0.0, *NO_TURN)
ASIDE = (1.3, -0.5, 0.3, *NO_TURN)

ORDER = Input(scale=ONE, angles=(0.0, 0.0, 90.0), pose=AHEAD, compare="the other order")
SHEAR = Input(scale=ONE, shear=0.8, angles=(0.0, 0.0, 40.0))
INVERSE = Input(scale=ONE, angles=(0.0, 0.0, -90.0), pose=ASIDE, compare="undo by (Rᵀ, −t)")
COLUMNS = Input(stage="columns", z_tip=(1.0, 0.0, 0.0))
READ = Input(stage="columns", x_tip=(0.0, 1.0, 0.0), y_tip=(-1.0, 0.0, 0.0))
ORDERS = Input(stage="order", pose=AHEAD)
THERE = Input(scale=ONE, angles=(0.0, 0.0, 90.0), pose=ASIDE, compare="undo by (Rᵀ, −t)")
UNDOING = Input(stage="undo", pose=ASIDE)
SHEARING = Input(stage="shear")
DIVIDING = Input(stage="divide", shape="box", point=4)

THIRTY = int(np.argmin(np.abs(TURNS - 30.0)))
QUARTER = int(np.argmin(np.abs(TURNS - 90.0)))
UPRIGHT = int(np.argmin(np.abs(SHEARS)))
SHEARED = int(np.argmin(np.abs(SHEARS - 0.8)))
HALF = int(np.argmin(np.abs(SLOPES - 0.5)))

PRESETS: tuple[Preset[Input], ...] = (
    Preset(
        name="columns",
        title="Three arrows",
        line="The z arrow leans over until it lies on the x arrow. Watch what the house does.",
        params=COLUMNS,
        step=0,
        view=NEAR,
    ),
    Preset(
        name="orders",
        title="Turn then move, move then turn",
        line="The same turn and the same shift, in both orders. The angle goes from 0° to 180°.",
        params=ORDERS,
        step=THIRTY,
        view=ABOVE,
    ),
    Preset(
        name="there",
        title="A turn, then a shift",
        line="The house is turned by 90° and then moved. The last step takes this back, twice.",
        params=THERE,
        step=2,
        view=WAYS,
        breaks=True,
    ),
    Preset(
        name="undoing",
        title="Two ways back",
        line="A turn and a shift, taken back by (Rᵀ, −Rᵀt) in green, and by (Rᵀ, −t).",
        params=UNDOING,
        step=THIRTY,
        view=WAYS,
    ),
    Preset(
        name="shearing",
        title="Shear by hand",
        line="Each edge has the colour of how much longer it is. Beside it stands the unit cube.",
        params=SHEARING,
        step=UPRIGHT,
        view=BESIDE,
    ),
    Preset(
        name="shifting",
        title="A direction and a place",
        line="The arrow to the front, once with w = 0 and once with w = 1, while the house moves.",
        params=Input(stage="shift"),
        step=0,
        view=FRONT_VIEW,
    ),
    Preset(
        name="dividing",
        title="The last row by hand",
        line="The upright edges of a box divided by w = 1 + s z are prolonged upwards.",
        params=DIVIDING,
        step=0,
        view=LEVEL,
    ),
    Preset(
        name="order",
        title="Rotate, then translate",
        line=(
            "Step on, and the same two factors in the other order appear: a rotation turns about"
            " the world's origin, so it swings along whatever was translated before."
        ),
        params=ORDER,
        step=-3,
    ),
    Preset(
        name="mirror",
        title="A reflection is no rotation",
        line=(
            "Every length and angle survives, yet det is −1. The vermillion house is the best of"
            " all rigid motions, by the sum of squared distances: it does not fit."
        ),
        params=Input(scale=ONE, mirror="x", compare="best rigid motion"),
        step=-2,
    ),
    Preset(
        name="shear",
        title="A shear",
        line=(
            "Each horizontal layer slides as it is, the higher the farther. Step on, and read in"
            " the table what survives that."
        ),
        params=SHEAR,
        step=0,
    ),
    Preset(
        name="perspective",
        title="Divide by w",
        line=(
            "A projective map keeps straight lines straight, and cross-ratios on them, but no"
            " lengths, angles or parallels."
        ),
        params=Input(scale=ONE, perspective=0.5, shape="box", point=4),
        step=1,
    ),
    Preset(
        name="inverse",
        title="Undo with (Rᵀ, −t)",
        line="The translation must be turned back too. Step on, and read where it leads.",
        params=INVERSE,
        step=-2,
        breaks=True,
    ),
    Preset(
        name="hidden-scale",
        title="A scale hidden in R",
        line=(
            "With a scale of 1.3 in its 3×3, the transpose is no inverse: the house ends 1.3² ="
            " 1.69 times as long, wide and high."
        ),
        params=Input(
            scale=(1.3, 1.3, 1.3), angles=(0.0, 0.0, 40.0), compare="undo all as if rigid"
        ),
        step=-1,
        breaks=True,
    ),
    Preset(
        name="direction",
        title="A direction with w = 1",
        line=(
            "The translation leaks into a direction that is given w = 1: the arrow to the front no"
            " longer points to the front."
        ),
        params=Input(scale=ONE, angles=(0.0, 0.0, 20.0), compare="direction with w = 1"),
        step=-2,
        breaks=True,
    ),
)


def held(states: States, k: int) -> Held:
    """Return the state of one value of the number under the hand."""
    return as_a(Held, states[k])


def kind_of_columns(states: States) -> int:
    """Return 0 for a turn by +90° about z, 1 for −90°, 2 for a mirror image."""
    T = held(states, -1).T
    if np.linalg.det(T[:3, :3]) < 0:
        return 2
    return 0 if np.arctan2(T[1, 0], T[0, 0]) > 0 else 1


def apart(states: States) -> float:
    """Return how far the two orders end apart after a quarter turn, metres."""
    state = held(states, QUARTER)
    return float(np.linalg.norm(state.T[:3, 3] - state.T_other[:3, 3]))


def _left(states: States) -> np.ndarray:
    """Return what the wrong inverse leaves of the motion, a 4x4."""
    return sure(as_a(Built, states[-1]).ghost).T


def missed(states: States) -> float:
    """Return by how much the wrong inverse misses, metres."""
    return float(np.linalg.norm(_left(states)[:3, 3]))


def _undone(states: States) -> float:
    if not np.allclose(_left(states)[:3, :3], np.eye(3)):
        return 2.0
    return 1.0 if missed(states) > 1e-9 else 0.0


def _sheared(states: States) -> float:
    det = float(np.linalg.det(held(states, SHEARED).T[:3, :3]))
    return float(np.digitize(det, [1.0 - 1e-9, 1.0 + 1e-9]))


def meeting(states: States) -> float:
    """Return how high the direction z is sent with s = 0.5 /m, metres."""
    place = held(states, HALF).T @ np.array([0.0, 0.0, 1.0, 0.0])
    return float(place[2] / place[3])


QUESTIONS: tuple[Question, ...] = (
    Question(
        name="read-columns",
        text="The columns are (0, 1, 0), (−1, 0, 0) and (0, 0, 1). What does the house do?",
        answer=lambda states: float(kind_of_columns(states)),
        why=lambda states: (
            "x goes to (0, 1, 0), where y was, and y goes to (−1, 0, 0), opposite to where x was."
            " That is a quarter turn to the left, seen from above."
        ),
        params=READ,
        start=0,
        choices=(
            Choice("It turns by 90° about z"),
            Choice(
                "It turns by −90° about z",
                "That is what the rows say. The first column is where x goes: to (0, 1, 0), where y"
                " was.",
            ),
            Choice(
                "It becomes a mirror image",
                "A minus sign alone makes no mirror image. The determinant of these columns is +1.",
            ),
        ),
    ),
    Question(
        name="which-order",
        text=(
            "Both houses turn by 90° and move by 1.5 m, one in each order. How far apart do they"
            " end?"
        ),
        answer=apart,
        why=lambda states: (
            f"{length(apart(states), 3)}. One house ends on the x axis and the other on the y"
            " axis, each 1.5 m from the origin: √2 · 1.5 m apart."
        ),
        params=ORDERS,
        unit="m",
        tolerance=0.15,
        low=0.0,
        high=3.0,
        stride=0.1,
        start=THIRTY,
        step=QUARTER,
        wrong=(
            (
                0.0,
                0.3,
                "The parts are the same and the product is not. That would be so if the shift lay"
                " along the axis of the turn.",
            ),
            (
                1.4,
                1.6,
                "That is how far each of them is from the origin. Seen from there they lie at right"
                " angles.",
            ),
            (2.9, 3.0, "The two shifts add up only after half a turn, on opposite sides."),
        ),
    ),
    Question(
        name="undo",
        text=(
            "The house is turned by 90° and then moved. Somebody takes this back with (Rᵀ, −t)."
            " Where does the house end?"
        ),
        answer=_undone,
        why=lambda states: (
            f"It stands upright and {length(missed(states), 3)} off. The shift was made after the"
            " turn, so it must be taken back before the turn is."
        ),
        params=THERE,
        start=2,
        choices=(
            Choice(
                "At its start",
                "Each part is undone by itself, but in the wrong order: the shift was made last, so"
                " it must be undone first.",
            ),
            Choice("Unturned, somewhere else"),
            Choice("Still turned", "RᵀR is the identity, so the turn is undone."),
        ),
    ),
    Question(
        name="sheared-volume",
        text="The house is sheared by 0.8: its top slides sideways. What happens to its volume?",
        answer=_sheared,
        why=lambda states: (
            "Its volume is multiplied by"
            f" {fixed(float(np.linalg.det(held(states, SHEARED).T[:3, :3])), 2)}. Every storey only"
            " slides, as in a pile of paper that is pushed aside."
        ),
        params=SHEARING,
        start=UPRIGHT,
        step=SHEARED,
        choices=(
            Choice(
                "It shrinks",
                "The house looks thinner across its walls. But each storey only slides, and keeps"
                " its area.",
            ),
            Choice("It stays"),
            Choice(
                "It grows",
                f"The upright edges do get longer, × {fixed(float(np.hypot(1.0, 0.8)), 2)}, and the"
                f" left slope of the roof × {fixed(float(roof(np.array(0.8))), 2)}. But the room"
                " inside gets no larger.",
            ),
        ),
    ),
    Question(
        name="apex",
        text="Let s be 0.5 per metre. At which height do the prolonged upright edges meet?",
        answer=lambda states: float(np.digitize(meeting(states), [1.0, 10.0])),
        why=lambda states: (
            f"At {length(meeting(states))}. The direction (0, 0, 1, 0) goes to (0, 0, 1, 0.5), and"
            f" that is the place (0, 0, {fixed(meeting(states), 0)})."
        ),
        params=DIVIDING,
        start=0,
        step=HALF,
        choices=(
            Choice(
                "0.5 m", "That is the number itself. It stands below the line: (0, 0, 1) over s."
            ),
            Choice("2 m"),
            Choice("Nowhere", "Parallels stay parallel under affine maps. This map is not affine."),
        ),
    ),
)

SWEEPS = (Sweep("first", ("rotate, then translate", "translate, then rotate")),)
