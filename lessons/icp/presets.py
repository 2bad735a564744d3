"""Runs that work and runs that break ICP, cameras, and what to predict before looking."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from lessons.icp.flat import HAND, Outlines
from lessons.icp.inputs import Input
from lessons.icp.scans import Scans
from lessons.icp.space import ANGLES
from workbench.algorithms import icp, turning
from workbench.algorithms.turning import within_half
from workbench.certain import as_a
from workbench.lesson import Choice, Preset, Question, States, Sweep, View
from workbench.numerals import angle, length

BY_HAND = Input(stage="flat", by="hand", start_angle=-66.0)
FROM_45 = Input(stage="flat", start_angle=45.0)
FROM_75 = Input(stage="flat", start_angle=75.0)
FAR = Input(start_angle=120.0)
VASE = Input(shape="vase", start_angle=90.0, gate="all")
PLANE = Input(fit="point-to-plane")
OUTLIERS = Input(outliers=0.3, keep=1.0)
KEEP_70 = replace(OUTLIERS, keep=0.7)
OVERLAP = Input(
    start_angle=20.0,
    overlap=0.8,
    noise=0.0,
    points=5000,
    fit="point-to-plane",
    gate="max-distance",
)
OVERLAP_TIGHT = replace(OVERLAP, max_distance=0.02)
RINGS = Input(
    shape="lidar",
    start_angle=0.7,
    start_shift=0.5,
    fit="point-to-plane",
    noise=0.02,
    thinning="chance",
    planes="all",
)
FRONT = View(eye=(0.0, 2.15, 0.0), target=(0.0, 0.0, 0.0), grid=None, axes=False)
VIEW = View(eye=(1.25, 1.45, 0.8), target=(0.02, 0.0, 0.08), grid=None, axes=False)
NEAR = View(eye=(0.75, 0.75, 0.75), target=(0.12, 0.0, 0.4), grid=None, axes=False)
ABOVE = View(eye=(0.4, 1.0, 2.0), target=(0.0, 0.05, 0.0), grid=None, axes=False)
SIDE = View(eye=(0.3, 1.9, 0.7), target=(0.0, 0.0, 0.0), grid=None, axes=False)
WALL = View(eye=(1.9, -1.9, 1.3), target=(0.0, -0.1, 0.0), grid=None, axes=False)
STREET = View(eye=(0.55, -0.95, 1.0), target=(0.0, 0.0, -0.05), grid=None, axes=False)
VIEWS = {
    "front": FRONT,
    "rabbit": VIEW,
    "near": NEAR,
    "above": ABOVE,
    "side": SIDE,
    "wall": WALL,
    "street": STREET,
}
END = -1 - len(ANGLES)  # the last step of ICP itself, before the tries
START = int(np.argmin(np.abs(HAND - BY_HAND.start_angle)))  # where the hand begins

PRESETS: tuple[Preset[Input], ...] = (
    Preset(
        name="hand",
        title="Turned by hand",
        line="Each line leads to the nearest blue point. Turn the rabbit and read the RMSE.",
        params=BY_HAND,
        step=START,
        view=FRONT,
    ),
    Preset(
        name="from-45",
        title="In the flat, from 45°",
        line="Only a turn is missing, so the cost is a curve. Follow the ball.",
        params=FROM_45,
        step=0,
        view=FRONT,
    ),
    Preset(
        name="from-75",
        title="In the flat, from 75°",
        line="The same rules, a start 30° farther away, and another valley.",
        params=FROM_75,
        step=0,
        view=FRONT,
        breaks=True,
    ),
    Preset(
        name="lines-45",
        title="In the flat, along the lines",
        line="Points may slide along the outline, so each swing is larger.",
        params=replace(FROM_45, fit="point-to-plane"),
        step=0,
        view=FRONT,
    ),
    Preset(
        name="home",
        title="From 35° away",
        line="Compare what ICP sees, the RMSE, with what you want to know, the green errors.",
        params=Input(),
    ),
    Preset(
        name="far",
        title="From 120° away",
        line="Every fit lowers the RMSE. Compare it with the rotation error.",
        params=FAR,
        step=0,
        breaks=True,
    ),
    Preset(
        name="plane",
        title="Point-to-plane, from 35° away",
        line="Points may slide along the target's tangent planes. Count the rounds.",
        params=PLANE,
        step=0,
    ),
    Preset(
        name="symmetric",
        title="A vase turned about its axis",
        line="A surface of revolution, started 90° away about its own axis: watch the arrows.",
        params=VASE,
        step=0,
        view=SIDE,
        breaks=True,
    ),
    Preset(
        name="slide",
        title="Two planes slide",
        line="A floor and a wall hold everything but the slide along their common edge: the turn is"
        " off by less than 0.1°, and the source ends as far off as it started, 0.31 m.",
        params=Input(
            shape="corner", start_angle=10.0, start_shift=0.3, fit="point-to-plane", keep=0.5
        ),
        step=0,
        view=WALL,
        breaks=True,
    ),
    Preset(
        name="overlap-fixed",
        title="Part seen by one scan only",
        line="A fixed gate of 0.1 m lets in matches of points that the target never saw, and they"
        " pull.",
        params=OVERLAP,
        step=0,
        breaks=True,
    ),
    Preset(
        name="overlap-adaptive",
        title="The same with d < 3 medians",
        line="A gate that shrinks with the distances leaves a tenth of the fixed gate's rotation"
        " error, 0.06° of 0.63°.",
        params=replace(OVERLAP, gate="3-medians"),
        step=0,
    ),
    Preset(
        name="overlap-tight",
        title="The same with a 0.02 m gate",
        line="A tight gate leaves 0.02°, but look at the starts: from 60° on too few good matches"
        " pass.",
        params=OVERLAP_TIGHT,
        step=-1,
        breaks=True,
    ),
    Preset(
        name="outliers",
        title="Three in ten are outliers",
        line="Squared distances listen most to the farthest points: with all matches in use the"
        " source stays 15° off.",
        params=OUTLIERS,
        step=0,
        breaks=True,
    ),
    Preset(
        name="keep-70",
        title="Outliers, trimmed to 70 %",
        line="Keep the closest 70 % of the matches at each fit, and ICP comes home.",
        params=KEEP_70,
        step=0,
    ),
    Preset(
        name="outliers-trimmed",
        title="Outliers, trimmed to 65 %",
        line="Keep only the closest 65 % of the matches: nearly all outliers fall out, and ICP comes"
        " home.",
        params=replace(OUTLIERS, keep=0.65),
        step=0,
    ),
    Preset(
        name="rings-chance",
        title="A lidar's rings, thinned by chance",
        line="The scanner moved 0.5 m, and its rings moved with it. Most planes are laid through one"
        " ring, so rings lock onto rings: 0.49 m stay.",
        params=RINGS,
        step=0,
        view=STREET,
        breaks=True,
    ),
    Preset(
        name="rings-voxel",
        title="The rings, thinned by voxels",
        line="The means of the points in each voxel, 1 % of the width: dense rings and sparse walls"
        " count alike, and 36 mm stay.",
        params=replace(RINGS, thinning="voxel", voxel=1.0),
        step=0,
        view=STREET,
        breaks=True,
    ),
    Preset(
        name="rings-spread",
        title="The rings, and no plane through a line",
        line="Finer voxels of 0.2 %, and a point whose neighbours lie along a line does not pull:"
        " 6 mm stay.",
        params=replace(RINGS, thinning="voxel", planes="spread"),
        step=0,
        view=STREET,
    ),
)


def end(states: Iterable) -> icp.State:
    """Return the last step of ICP itself in space, before other starts are tried."""
    return next(s for s in states if isinstance(s, icp.State) and s.stop is not None)


def flat_end(states: Sequence) -> turning.State:
    """Return the last step of a run in the flat."""
    return as_a(turning.State, states[-1])


def fits(states: Iterable) -> list[float]:
    """Return the RMSE after each fit in space, metres."""
    return [s.rmse for s in states if isinstance(s, icp.State) and s.phase == "fit"]


def rmse_falls(states: Iterable) -> bool:
    """Tell whether no fit raised the RMSE of the fit before."""
    return bool(np.all(np.diff(fits(states)) <= 1e-12))


def came_home(states: States) -> bool:
    """Tell whether ICP itself, in space, ended at the truth, but for sampling."""
    scans = as_a(Scans, states.subject)
    return scans.at_home(scans.error(end(states).T_target_source))


def off(states: States) -> str:
    """Return how far the end of ICP itself, in space, is from the truth: turn and shift."""
    error = as_a(Scans, states.subject).error(end(states).T_target_source)
    return f"{angle(error.rotation)} and {length(error.translation)}"


def valleys(states: States) -> int:
    """Return how many angles have a lower RMSE than both of their neighbours, once around."""
    rmse = np.array([as_a(turning.State, state).rmse for state in states])[:-1]
    return int(np.sum((rmse < np.roll(rmse, 1)) & (rmse <= np.roll(rmse, -1))))


def right_at_first(states: States) -> int:
    """Return how many of the first partners in the flat are right."""
    first = as_a(turning.State, states[0])
    return int(as_a(Outlines, states.subject).right(first.partners).sum())


def _why_valleys(states: States) -> str:
    lines = as_a(Outlines, states.subject)
    return (
        f"{valleys(states)} of them, most of them shallow. One is deep: it reaches down to"
        f" {length(float(lines.rmse.min()), 2)}. Partners change while you turn, and each new set of"
        " partners brings a valley of its own."
    )


def _which_matches(states: States) -> float:
    share = right_at_first(states) / len(as_a(Outlines, states.subject).p_source)
    return float(np.digitize(-share, [-0.75, -0.35, -0.12]))


def _why_matches(states: States) -> str:
    n = len(as_a(Outlines, states.subject).p_source)
    at = within_half(flat_end(states).angle)
    return (
        f"{right_at_first(states)} of {n}. And still it ends at {angle(at)}: wrong partners turn the"
        " rabbit too little, but together they turn it the right way."
    )


def _why_rest(states: States) -> str:
    last = flat_end(states)
    return (
        f"{angle(within_half(last.angle), 2)}, at an RMSE of {length(last.rmse)}. From 75° the way"
        " down leads to the right, away from home."
    )


def _why_far(states: States) -> str:
    return (
        f"It ended {off(states)} from the truth, at an RMSE of {length(end(states).rmse)}. No match"
        " and no fit raised the cost, and nothing in them knows of other valleys."
    )


def _why_plane(states: States) -> str:
    return (
        f"{end(states).iteration} rounds. A point may slide along its partner's tangent plane at no"
        " cost, so one fit turns the source as far as many point-to-point fits."
    )


def _which_share(states: States) -> float:
    return 2.0 if came_home(states) else 0.0


def _why_share(states: States) -> str:
    return (
        f"With 70 % it ends {off(states)} from the truth. Now the outliers are left out and nearly"
        " all others are kept."
    )


def _which_vase(states: States) -> float:
    small = end(states).rmse < 2.0 * as_a(Scans, states.subject).spacing
    return 2.0 if not small else 0.0 if came_home(states) else 1.0


def _why_vase(states: States) -> str:
    scans = as_a(Scans, states.subject)
    left = scans.error(end(states).T_target_source).rotation
    return (
        f"The RMSE is {length(end(states).rmse)}, where neighbouring target points lie"
        f" {length(scans.spacing)} apart, and {left:.0f}° of the turn are left. No point of a vase can"
        " tell how far it was turned, so no method can."
    )


QUESTIONS: tuple[Question, ...] = (
    Question(
        name="how-many-now",
        text="Turn the rabbit once all the way round. How many valleys will this curve have?",
        answer=lambda states: 0.0 if valleys(states) > 1 else 1.0,
        why=_why_valleys,
        params=BY_HAND,
        start=START,
        choices=(
            Choice("More than one"),
            Choice(
                "One, as with the rubber bands",
                "The bands kept their partners, and then there is one valley. Here every point takes"
                " a new partner as soon as another one is nearer.",
            ),
        ),
    ),
    Question(
        name="predict-matches",
        text="How many of these 50 partners are right, so that they lie within one gap of where the"
        " orange point belongs?",
        answer=_which_matches,
        why=_why_matches,
        params=FROM_45,
        step=0,
        choices=(
            Choice(
                "Nearly all",
                "Then one fit would be enough. At 45° most points have moved much farther than their"
                " neighbours are apart.",
            ),
            Choice(
                "About half",
                "You may have counted those that pull the right way. Only a few end where they"
                " belong.",
            ),
            Choice(
                "About a fifth",
                "Still too many. The outlines cross at some places, and there the nearest point"
                " is another part of the rabbit.",
            ),
            Choice("Fewer than one in ten"),
        ),
    ),
    Question(
        name="where-it-rests",
        text="This time the ball starts at 75°. Where will it come to rest? Put the flag there.",
        answer=lambda states: within_half(flat_end(states).angle),
        why=_why_rest,
        params=FROM_75,
        step=-1,
        unit="°",
        tolerance=8.0,
        low=-180.0,
        high=180.0,
        stride=1.0,
        mark="ball",
        wrong=(
            (
                -30.0,
                63.0,
                "To get there the ball would have to climb over the rim at 68° first, and it never"
                " climbs.",
            ),
            (
                64.0,
                85.0,
                "The ball stops only where new partners change nothing any more. Here they still do.",
            ),
            (
                105.0,
                180.0,
                "It would have to leave the first valley on its way, and to climb for that.",
            ),
        ),
    ),
    Question(
        name="predict-far",
        text="In space, the rabbit starts 120° away. What will ICP do?",
        answer=lambda states: 0.0 if came_home(states) else 2.0 if rmse_falls(states) else 1.0,
        why=_why_far,
        params=FAR,
        step=END,
        choices=(
            Choice(
                "Come home, only more slowly",
                "Every run comes to rest in a valley of the cost. From far away it may be another one"
                " than the true one.",
            ),
            Choice(
                "Stop because the RMSE rises",
                "It cannot rise here. The nearest partners lower the cost, and so does the best motion"
                " for these partners.",
            ),
            Choice("Lower the RMSE to the end and be wrong"),
        ),
    ),
    Question(
        name="predict-plane",
        text="From 35° the rabbit took 61 rounds. How many will it take with planes?",
        answer=lambda states: float(end(states).iteration),
        why=_why_plane,
        params=PLANE,
        step=END,
        tolerance=3.0,
        low=1.0,
        high=80.0,
        stride=1.0,
        wrong=(
            (
                1,
                4,
                "One fit would do if the partners were right. They are not, so even planes need new"
                " matches some times.",
            ),
            (
                20,
                40,
                "Half as many would be the gain if each swing were twice as long. The first fit turns"
                " the source by 8.6° with planes and by 1.65° without.",
            ),
            (
                41,
                200,
                "The matches are made in the same way, but the fit differs: without a price for"
                " sliding along the surface each fit turns the source farther.",
            ),
        ),
    ),
    Question(
        name="best-share",
        text="Three in ten orange points belong to nothing. Which share of the closest matches would"
        " you keep?",
        answer=_which_share,
        why=_why_share,
        params=KEEP_70,
        step=END,
        choices=(
            Choice(
                "100 %",
                "Then every outlier pulls, and the farthest pull most: the rabbit ends 15° off.",
            ),
            Choice(
                "90 %",
                "A third of the outliers is gone, but the others still pull: the rabbit ends 4° off.",
            ),
            Choice("70 %"),
            Choice(
                "30 %",
                "The closest matches are those that hold the rabbit where it stands now. Too few are"
                " left that could pull it home: it ends 30° off.",
            ),
        ),
    ),
    Question(
        name="predict-vase",
        text="A vase starts turned by 90° about its own axis. What will the end look like?",
        answer=_which_vase,
        why=_why_vase,
        params=VASE,
        choices=(
            Choice(
                "Small RMSE, right turn",
                "The RMSE is small, but it does not say that the turn is right: turned about its axis,"
                " the vase looks the same, so no match pulls it back.",
            ),
            Choice("Small RMSE, wrong turn"),
            Choice(
                "Large RMSE",
                "A wrong turn raises the RMSE only where the turned shape looks different. A vase"
                " turned about its axis looks the same.",
            ),
        ),
    ),
)

SWEEPS = (
    Sweep("start_angle", tuple(float(degrees) for degrees in range(0, 181, 30))),
    Sweep(
        "start_angle",
        (-180.0, -120.0, -90.0, -60.0, -30.0, 0.0, 30.0, 45.0, 60.0, 75.0, 90.0, 120.0, 150.0),
        run="from-75",
    ),
    Sweep("keep", (0.3, 0.5, 0.6, 0.65, 0.7, 0.8, 0.9, 1.0), run="keep-70"),
    Sweep("start_angle", (0.0, 45.0, 90.0, 135.0, 180.0), run="symmetric"),
)
