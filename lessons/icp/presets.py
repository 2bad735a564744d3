"""Experiments that break ICP, and what to predict before looking."""

from collections.abc import Iterable, Sequence

import numpy as np

from lessons.icp.params import Params
from lessons.icp.state import State
from workbench.lesson import Preset, Question

HOME = Params()
FAR = Params(start_angle=120.0)
VASE = Params(shape="vase", start_angle=90.0, gate="all")
CORNER = Params(shape="corner", start_angle=10.0, start_shift=0.3, fit="point-to-plane", gate="3-medians")
PLANE = Params(fit="point-to-plane")
OVERLAP = Params(start_angle=20.0, overlap=0.8, noise=0.0, points=5000, fit="point-to-plane", gate="max-distance")
OVERLAP_TIGHT = Params(
    start_angle=20.0, overlap=0.8, noise=0.0, points=5000, fit="point-to-plane", gate="max-distance", max_distance=0.02
)
OVERLAP_ADAPTIVE = Params(start_angle=20.0, overlap=0.8, noise=0.0, points=5000, fit="point-to-plane", gate="3-medians")
OUTLIERS = Params(outliers=0.3, gate="all")
OUTLIERS_TRIMMED = Params(outliers=0.3, keep=0.65)

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        "home", "35° away: it comes home",
        "Few matches are right at first, yet each fit turns the source a little the right way, because wrong partners"
        " still pull downhill.",
        HOME,
    ),
    Preset(
        "far", "120° away: settled and wrong",
        "The RMSE falls at every fit and ICP reports convergence, over 150° from the truth: it found the nearest valley,"
        " not the deepest.",
        FAR, 0,
    ),
    Preset(
        "plane", "Point-to-plane: few steps",
        "Points may slide along the target's tangent planes, so flat parts stop holding the motion back: a sixth of the"
        " iterations.",
        PLANE, 0,
    ),
    Preset(
        "symmetric", "A vase: the turn is invisible",
        "A surface of revolution fits at any turn about its axis: the RMSE is as small as a right answer's, the arrow is"
        " 90° off.",
        VASE, -14,
    ),
    Preset(
        "slide", "Two planes slide",
        "A floor and a wall fix everything but the slide along their common line: the rotation is found, the 0.3 m"
        " shift stays.",
        CORNER, 0,
    ),
    Preset(
        "overlap-fixed", "Part seen by one scan only",
        "A fixed gate of 0.1 m lets in matches of points that the target never saw; they pull, and over half a degree"
        " remains.",
        OVERLAP, 0,
    ),
    Preset(
        "overlap-adaptive", "The same with d < 3 medians",
        "A gate that shrinks with the distances drops those false partners as the rest closes in: a tenth of the error.",
        OVERLAP_ADAPTIVE, 0,
    ),
    Preset(
        "overlap-tight", "The same with a 0.02 m gate",
        "A tight gate is exact too, but look at the basin: from 45° on, too few matches pass and ICP no longer comes"
        " home.",
        OVERLAP_TIGHT, -1,
    ),
    Preset(
        "outliers", "Three in ten are outliers",
        "Squared distances listen most to the farthest points: with every match in use, the outliers decide and ICP"
        " ends over 10° off.",
        OUTLIERS, 0,
    ),
    Preset(
        "outliers-trimmed", "Outliers, trimmed to 65 %",
        "Keep only the closest 65 % of the matches at each fit: the outliers fall out by themselves, and ICP comes home.",
        OUTLIERS_TRIMMED, 0,
    ),
)  # fmt: skip


def end(states: Iterable[State]) -> State:
    """Return the last step of ICP itself, before other starts are tried."""
    return next(state for state in states if state.icp.stop is not None)


def rmse_falls(states: Sequence[State]) -> bool:
    """Tell whether no fit raised the RMSE of the fit before."""
    rmses = [state.icp.rmse for state in states if state.icp.phase == "fit" and not state.tries]
    return bool(np.all(np.diff(rmses) <= 1e-12))


def _far_answer(states: Sequence[State]) -> float:
    return 0.0 if end(states).home else 2.0 if rmse_falls(states) else 1.0


def _far_why(states: Sequence[State]) -> str:
    last = end(states)
    return (
        f"It ended {last.error.rotation:.0f}° from the truth with an RMSE of {1000 * last.icp.rmse:.0f} mm. Each fit"
        " can only lower the cost for the partners it was given; nothing in it knows about other valleys."
    )


def _vase_answer(states: Sequence[State]) -> float:
    last = end(states)
    low = last.icp.rmse < 0.02
    return 2.0 if not low else 0.0 if last.error.rotation < 5.0 else 1.0


def _vase_why(states: Sequence[State]) -> str:
    last = end(states)
    return (
        f"RMSE {1000 * last.icp.rmse:.0f} mm, as for the rabbit that came home, and {last.error.rotation:.0f}° of turn"
        " left. No point of a vase can tell how far it was turned, so no method can."
    )


QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        "predict-matches",
        "35° away, each source point takes its nearest target point. How many percent of these first matches are right"
        " (within two point spacings)?",
        answer=lambda states: 100.0 * states[0].right,
        why=lambda states: (
            f"{100.0 * states[0].right:.0f} %, and ICP still came home to {end(states).error.rotation:.1f}°: partners"
            " are wrong nearly everywhere, but wrong in a way that turns the source downhill."
        ),
        params=HOME,
        unit="%",
        tolerance=8.0,
        step=0,
    ),
    Question(
        "predict-far",
        "The source starts 120° away. What will ICP do?",
        answer=_far_answer,
        why=_far_why,
        params=FAR,
        choices=(
            "Come home, only more slowly",
            "Stop because the RMSE rises",
            "Lower the RMSE to the end and be wrong",
        ),
    ),
    Question(
        "predict-plane",
        "From 35°, point-to-point takes 61 iterations to its stop. How many does point-to-plane take?",
        answer=lambda states: float(end(states).icp.iteration),
        why=lambda states: (
            f"{end(states).icp.iteration}. A point may slide along its partner's tangent plane for free, so one step"
            " turns the source as far as many point-to-point fits."
        ),
        params=PLANE,
        tolerance=8.0,
    ),
    Question(
        "predict-vase",
        "A vase starts turned by 90° about its own axis. What does the end look like?",
        answer=_vase_answer,
        why=_vase_why,
        params=VASE,
        choices=("Small RMSE, right turn", "Small RMSE, wrong turn", "Large RMSE"),
    ),
)
