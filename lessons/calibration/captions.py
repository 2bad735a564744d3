"""The captions: what a step did, with its numbers, and whether the end is right."""

from pathlib import PurePosixPath

import numpy as np

from lessons.calibration.state import Ending, State, Subject
from workbench.algorithms.least_squares.board_adjustment import Adjustment, Stop
from workbench.certain import sure
from workbench.errors import one_line
from workbench.numerals import brief, counted, fixed, percent, pixels, plus_minus
from workbench.scene import Caption

SHARE, NEAR = 0.01, 10.0  # a camera is right with f off by 1 % at most, and rays by 10 px at most
ORTHONORMAL = 1e-6
UNEQUAL = 0.005  # share by which fx and fy differ from which on it is told
STOPS = {
    Stop.CONVERGED: "The cost has come to rest.",
    Stop.STUCK: "No step lowers the cost any more.",
    Stop.MAX_ITERATIONS: "Stopped here, after the most iterations allowed: not at rest.",
}


def caption(state: State) -> Caption:
    """Return what happened in this step and why."""
    if state.ending is not None:
        return {"views": _views, "without": _without, "known": _known}[state.ending.kind](
            state, state.ending
        )
    return {
        "homography": _homography,
        "constraints": _constraints,
        "poses": _poses,
        "lens": _lens,
        "refine": _refine,
    }[state.now.phase](state)


def title(subject: Subject, view: int) -> str:
    """Return what the picture of a view is called, by its file where a person brought one."""
    if subject.pictures is None:
        return f"View {view}"
    name = subject.pictures.names[view]
    return (
        f"View {view}, no picture"
        if name is None
        else f"View {view}, {one_line(PurePosixPath(name).name)}"
    )


def is_right(state: State) -> bool:
    """Tell whether the camera is right: f to 1 %, and every ray of the picture to 10 px."""
    f, f_true = sure(state.now.K)[0, 0], sure(state.subject.K)[0, 0]
    return bool(abs(f - f_true) <= SHARE * f_true and state.worst_in_picture <= NEAR)


def f_of(state: State) -> str:
    """Return the focal length in words, beside the true one where it is known."""
    truth = "" if state.subject.K is None else f", in truth {fixed(state.subject.K[0, 0], 0)} px"
    return f"f = {fixed(sure(state.now.K)[0, 0], 1)} px{truth}"


def _homography(state: State) -> Caption:
    text = (
        f"View {state.subject.views[0]}: a homography takes the flat board to its picture, straight"
        f" lines to straight lines. It misses the corners by {pixels(state.rms)} (rms)"
    )
    if state.subject.K is None:
        return Caption(f"{text}: noise, and what a lens bends.{_left_out(state.subject.without)}")
    sigma = state.params.noise
    if state.rms > 1.4 * np.sqrt(2) * sigma:
        return Caption(
            f"{text}, more than noise of {pixels(sigma)} in each coordinate explains: the lens"
            " bends lines."
        )
    return Caption(f"{text}, about what noise of {pixels(sigma)} in each coordinate leaves.")


def _left_out(names: tuple[str, ...]) -> str:
    if not names:
        return ""
    some = ", ".join(one_line(PurePosixPath(name).name)[:30] for name in names[:3]) + (
        " …" if len(names) > 3 else ""
    )
    return f" No whole board was found in {counted(len(names), 'picture')}: {some}."


def _constraints(state: State) -> Caption:
    estimate = state.now
    view = state.subject.views[len(state.now.Hs_image_board) - 1]
    text = f"View {view} adds two rows: {len(estimate.rows)} in all for B = K⁻ᵀK⁻¹."
    if len(estimate.rows) < 4:
        return Caption(f"{text} They leave B open; more views are needed.")
    if estimate.K is None:
        return Caption(
            f"{text} The B that fits best is not positive definite: no camera sees such views."
        )
    cx, cy = estimate.K[:2, 2]
    return Caption(
        f"{text} K so far: {f_of(state)}; principal point ({fixed(cx, 0)}, {fixed(cy, 0)}). No lens"
        " is in it yet."
    )


def _poses(state: State) -> Caption:
    estimate = state.now
    Ts = estimate.Ts_camera_board
    start = (
        "No likely camera has these rows: f is guessed as the picture's width. "
        if estimate.guessed
        else ""
    )
    behind = int((Ts[:, 2, 3] <= 0).sum())
    R = Ts[:, :3, :3]
    off = np.abs(R @ np.swapaxes(R, 1, 2) - np.eye(3)).max(axis=(1, 2)) > ORTHONORMAL
    mirrored = int((np.linalg.det(R) < 0).sum())
    if behind or off.any() or mirrored:
        faults = [
            (behind, "stands behind the camera", "stand behind the camera"),
            (
                int(off.sum()),
                "has an R that is not orthonormal",
                "have an R that is not orthonormal",
            ),
            (mirrored, "is a mirror image", "are mirror images"),
        ]
        text = "; ".join(
            counted(count, f"board {single}", f"boards {more}")
            for count, single, more in faults
            if count
        )
        return Caption(f"{start}{text}: these are no poses.", "wrong")
    return Caption(
        f"{start}With this K every view gets a pose: {counted(len(Ts), 'board')} before the camera."
        f" {f_of(state)}. No lens yet: corners are off by {pixels(state.rms)} (rms)."
    )


def _lens(state: State) -> Caption:
    k1 = state.now.lens.k1
    text = f"K and poses stay, and a linear system gives the lens: k1 = {fixed(k1, 3)}"
    tail = f" The rms goes from {pixels(state.before)} to {pixels(state.rms)}."
    if state.subject.K is None:
        return Caption(
            f"{text}.{tail} K and poses were made without a lens and may have taken it up."
        )
    true = state.subject.lens.k1
    text += f", in truth {fixed(true, 2)}."
    if abs(k1 - true) > 0.3 * abs(true):
        text += " K and poses were made without a lens, and have taken up most of it."
    return Caption(text + tail)


def _refine(state: State) -> Caption:
    adjustment = sure(state.now.adjustment)
    unknowns = int(adjustment.free.sum()) + 6 * len(adjustment.Ts_camera_board)
    if not adjustment.accepted:
        text = (
            f"Iteration {adjustment.iteration}: the step would raise the cost and is not taken; the"
            " damping grows tenfold."
        )
    elif adjustment.iteration == 1:
        text = (
            f"Iteration 1: camera, lens and poses move together, {unknowns} unknowns at once. The"
            f" rms falls from {pixels(state.before)} to {pixels(state.rms)}; {f_of(state)}."
        )
    else:
        text = f"Iteration {adjustment.iteration}: rms {pixels(state.rms)}; {f_of(state)}."
    return Caption(f"{text} {STOPS[adjustment.stop]}" if adjustment.stop else text)


def _views(state: State, ending: Ending) -> Caption:
    rms = state.per_view
    others = np.delete(rms, ending.worst)
    return Caption(
        f"View {state.subject.views[ending.worst]} fits worst: {pixels(float(rms[ending.worst]))}"
        f" (rms), the others {pixels(float(np.median(others)))} in the median. Its residuals carry"
        f" {fixed(100 * float(rms[ending.worst] ** 2 / (rms**2).sum()), 0)} % of the sum of"
        " squares."
    )


def _without(state: State, ending: Ending) -> Caption:
    full = sure(state.now.adjustment)
    without = sure(ending.without)
    sd = full.deviations[0]
    moved = float(without.K[0, 0] - full.K[0, 0])
    by = (
        f"{brief(abs(moved) / sd, 2)} times its ±"
        if np.isfinite(sd) and sd > 0
        else "with no ± to compare"
    )
    return Caption(
        f"Without view {state.subject.views[ending.worst]}: f = {fixed(full.K[0, 0], 1)} px"
        f" becomes {fixed(without.K[0, 0], 1)} px, a move of {pixels(abs(moved))},"
        f" {by}.{_cut_off(full, without)}"
    )


def _cut_off(*adjustments: Adjustment) -> str:
    """Say that a refinement was ended by its limit, where one was."""
    if all(adjustment.stop is not Stop.MAX_ITERATIONS for adjustment in adjustments):
        return ""
    most = max(adjustment.iteration for adjustment in adjustments)
    return f" That is where {most} iterations came to: not at rest, f still moves."


def _known(state: State, ending: Ending) -> Caption:
    adjustment = sure(state.now.adjustment)
    sd = adjustment.deviations[0]
    f = (
        " ± ".join(plus_minus(adjustment.K[0, 0], sd))
        if 0 < sd < np.inf
        else fixed(adjustment.K[0, 0], 1)
    )
    text = f"f = {f} px" + ("" if np.isfinite(sd) else ", and the views do not determine it")
    if state.subject.K is None:
        return Caption(
            f"{text}; rms {pixels(state.rms)}. Nobody knows the truth here: the ± takes the board"
            f" for flat, and errors of corners for independent.{_cut_off(adjustment)}"
        )
    text += f", in truth {fixed(state.subject.K[0, 0], 0)} px"
    worst = state.worst_in_picture
    apart = abs(adjustment.K[0, 0] / adjustment.K[1, 1] - 1)
    if apart > UNEQUAL:
        text += f"; fx and fy are {percent(apart, 1)} apart"
    remark = "How far the lens map is off cannot be told."
    if np.isfinite(worst):
        remark = f"The largest error of the lens map anywhere in the picture is {pixels(worst)}."
    return Caption.verdict(
        f"{text}. {remark}{_cut_off(adjustment)}",
        right=is_right(state),
        settled=adjustment.stop is Stop.CONVERGED,
    )
