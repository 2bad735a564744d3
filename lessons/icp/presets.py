"""Experiments that break ICP, and what to predict before looking."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from lessons.icp.basin import ANGLES
from lessons.icp.captions import off
from lessons.icp.state import Params, State
from workbench.lesson import Choice, Preset, Question, View
from workbench.numerals import length, percent

HOME = Params()
FAR = Params(start_angle=120.0)
VASE = Params(shape="vase", start_angle=90.0, gate="all")
PLANE = Params(fit="point-to-plane")
OVERLAP = Params(
    start_angle=20.0, overlap=0.8, noise=0.0, points=5000, fit="point-to-plane", gate="max-distance"
)
OVERLAP_TIGHT = Params(
    start_angle=20.0,
    overlap=0.8,
    noise=0.0,
    points=5000,
    fit="point-to-plane",
    gate="max-distance",
    max_distance=0.02,
)
RINGS = Params(
    shape="lidar",
    start_angle=0.7,
    start_shift=0.5,
    fit="point-to-plane",
    noise=0.02,
    thinning="chance",
    planes="all",
)
VIEW = View(eye=(1.6, -0.85, 1.0), target=(0.05, 0.02, 0.0), grid=None, axes=False)
WALL = View(eye=(1.9, -1.9, 1.3), target=(0.0, -0.1, 0.0), grid=None, axes=False)
STREET = View(eye=(0.55, -0.95, 1.0), target=(0.0, 0.0, -0.05), grid=None, axes=False)
END = -1 - len(ANGLES)  # the last step of ICP itself, before the tries

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        "home",
        "From 35° away",
        "Each fit turns the source a little. Read how many of its matches were right, and compare"
        " the RMSE with the green errors.",
        HOME,
    ),
    Preset(
        "far",
        "From 120° away",
        "ICP sees the distances of its matches and nothing else. Compare what it sees, the RMSE,"
        " with the rotation error.",
        FAR,
        0,
        breaks=True,
    ),
    Preset(
        "plane",
        "Point-to-plane, from 35° away",
        "Points may slide along the target's tangent planes, so flat parts stop holding the motion"
        " back: count the iterations.",
        PLANE,
        0,
    ),
    Preset(
        "symmetric",
        "A vase turned about its axis",
        "A surface of revolution, started 90° away about its own axis: watch the turn of each fit"
        " and the arrows.",
        VASE,
        0,
        breaks=True,
    ),
    Preset(
        "slide",
        "Two planes slide",
        "A floor and a wall hold everything but the slide along their common line: the rotation is"
        " found to 0.1°, and the source ends as far off as it started, 0.31 m.",
        Params(shape="corner", start_angle=10.0, start_shift=0.3, fit="point-to-plane", keep=0.5),
        0,
        WALL,
        breaks=True,
    ),
    Preset(
        "overlap-fixed",
        "Part seen by one scan only",
        "A fixed gate of 0.1 m lets in matches of points that the target never saw, and they pull:"
        " at the end look at the rotation error.",
        OVERLAP,
        0,
        breaks=True,
    ),
    Preset(
        "overlap-adaptive",
        "The same with d < 3 medians",
        "A gate that shrinks with the distances drops such false partners as the rest closes in: a"
        " tenth of the fixed gate's rotation error is left, 0.06° of 0.63°.",
        Params(
            start_angle=20.0,
            overlap=0.8,
            noise=0.0,
            points=5000,
            fit="point-to-plane",
            gate="3-medians",
        ),
        0,
    ),
    Preset(
        "overlap-tight",
        "The same with a 0.02 m gate",
        "A tight gate drops them too, but look at the basin: from 45° on, too few good matches pass"
        " and no start comes home.",
        OVERLAP_TIGHT,
        -1,
        breaks=True,
    ),
    Preset(
        "outliers",
        "Three in ten are outliers",
        "Squared distances listen most to the farthest points: with every match in use the outliers"
        " pull the source 15° astray.",
        Params(outliers=0.3, gate="all"),
        0,
        breaks=True,
    ),
    Preset(
        "outliers-trimmed",
        "Outliers, trimmed to 65 %",
        "Keep only the closest 65 % of the matches at each fit: nearly all outliers fall out, and"
        " ICP comes home.",
        Params(outliers=0.3, keep=0.65),
        0,
    ),
    Preset(
        "rings-chance",
        "A lidar's rings, thinned by chance",
        "The scanner moved 0.5 m, and its rings moved with it. Most planes are laid through one"
        " ring, so rings lock onto rings: 0.49 m stay.",
        RINGS,
        0,
        STREET,
        breaks=True,
    ),
    Preset(
        "rings-voxel",
        "The rings, thinned by voxels",
        "The means of the points in each voxel, 1 % of the width: dense rings and sparse walls"
        " count alike, and 36 mm stay.",
        replace(RINGS, thinning="voxel", voxel=1.0),
        0,
        STREET,
        breaks=True,
    ),
    Preset(
        "rings-spread",
        "The rings, and no plane through a line",
        "Finer voxels of 0.2 %, and a point whose neighbours lie along a line does not pull: 6 mm"
        " stay.",
        replace(RINGS, thinning="voxel", planes="spread"),
        0,
        STREET,
    ),
)


def end(states: Iterable[State]) -> State:
    """Return the last step of ICP itself, before other starts are tried."""
    return next(state for state in states if state.icp.stop is not None)


def rmse_falls(states: Sequence[State]) -> bool:
    """Tell whether no fit raised the RMSE of the fit before."""
    rmses = [state.icp.rmse for state in states if state.icp.phase == "fit" and not state.tries]
    return bool(np.all(np.diff(rmses) <= 1e-12))


def _matches_why(states: Sequence[State]) -> str:
    last = end(states)
    came = "came home to" if last.home else "ended"
    return (
        f"{percent(states[0].right, 0)}, and ICP still {came} {off(last)} from the truth: partners"
        " need not be right for a fit to turn the source downhill."
    )


def _far_why(states: Sequence[State]) -> str:
    last = end(states)
    return (
        f"It ended {off(last)} from the truth, at an RMSE of {length(last.icp.rmse)}. Each fit can"
        " only lower the cost for the partners it was given; nothing in it knows about other"
        " valleys."
    )


def _vase_answer(states: Sequence[State]) -> float:
    last = end(states)
    small = last.icp.rmse < 2.0 * last.scans.spacing
    return 2.0 if not small else 0.0 if last.home else 1.0


def _vase_why(states: Sequence[State]) -> str:
    last = end(states)
    return (
        f"RMSE {length(last.icp.rmse)}, where neighbouring target points lie"
        f" {length(last.scans.spacing)} apart, and {last.error.rotation:.0f}° of turn left. No"
        " point of a vase can tell how far it was turned, so no method can."
    )


QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        "predict-matches",
        "35° away, each source point takes its nearest target point. How many percent of these"
        " first matches are right (within two point spacings)?",
        answer=lambda states: 100.0 * states[0].right,
        why=_matches_why,
        params=HOME,
        unit="%",
        tolerance=3.0,
        step=1,
        wrong=(
            (
                5,
                34,
                (
                    "At a turn of 35° the two rabbits still overlap, but the nearest point is a"
                    " neighbour from another part of the surface. Two spacings are 3 cm, and most"
                    " points have moved by more."
                ),
            ),
            (
                34,
                66,
                (
                    "You may have taken those that point the right way. A partner is right only"
                    " where it lies within two spacings, 3 cm, of where the source point belongs."
                ),
            ),
            (
                66,
                100,
                (
                    "ICP does not need right partners. It needs partners that pull the source the"
                    " right way, on average."
                ),
            ),
        ),
    ),
    Question(
        "predict-far",
        "The source starts 120° away. What will ICP do?",
        answer=lambda states: 0.0 if end(states).home else 2.0 if rmse_falls(states) else 1.0,
        why=_far_why,
        params=FAR,
        step=END,
        choices=(
            Choice(
                "Come home, only more slowly",
                "Every run comes to a valley of the cost. From far away it may be another valley"
                " than the true one.",
            ),
            Choice(
                "Stop because the RMSE rises",
                "It cannot rise here. The nearest partners lower the cost, and so does the best"
                " motion for these partners.",
            ),
            Choice("Lower the RMSE to the end and be wrong"),
        ),
    ),
    Question(
        "predict-plane",
        "From 35°, point-to-point takes 61 iterations to its stop. How many does point-to-plane"
        " take?",
        answer=lambda states: float(end(states).icp.iteration),
        why=lambda states: (
            f"{end(states).icp.iteration}. A point may slide along its partner's tangent plane for"
            " free, so one step turns the source as far as many point-to-point fits."
        ),
        params=PLANE,
        step=END,
        tolerance=3.0,
        wrong=(
            (
                1,
                4,
                (
                    "One fit would do if the partners were right. They are not, so even planes need"
                    " new matches some times."
                ),
            ),
            (
                20,
                40,
                (
                    "Half as many would be the gain if each step were twice as long. The first fit"
                    " turns the source by 8.6° with planes and by 1.65° without."
                ),
            ),
            (
                41,
                200,
                (
                    "The matches are made in the same way, but the fit differs: without a penalty"
                    " for sliding along the surface each fit turns the source farther."
                ),
            ),
        ),
    ),
    Question(
        "predict-vase",
        "A vase starts turned by 90° about its own axis. What does the end look like?",
        answer=_vase_answer,
        why=_vase_why,
        params=VASE,
        choices=(
            Choice(
                "Small RMSE, right turn",
                "The RMSE is small, but it does not say that the turn is right: turned about its"
                " axis, the vase looks the same, so no match pulls it back.",
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
