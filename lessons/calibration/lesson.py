"""A camera from pictures of a board: closed form, refinement, and how well the answer is known.

What it teaches: each picture of a flat board is a homography and gives two equations about K; that
is only a start, for lens and poses have to be refined together; and the residual alone tells
neither whether the views determine f, nor whether the model holds beyond the corners, nor whether
the board was printed as one believes.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from lessons.calibration.draw import VIEW, draw
from lessons.calibration.presets import PRESETS, QUESTIONS
from lessons.calibration.state import COEFFICIENTS, Ending, Params, State
from lessons.calibration.views import deviations, map_error, over_tilt, subject_of
from workbench.algorithms.cameras import calibration as calibration_steps
from workbench.algorithms.cameras.calibration import Pose, Rows, calibrate
from workbench.algorithms.least_squares.board_adjustment import adjust
from workbench.certain import sure
from workbench.errors import InputError
from workbench.geometry.cameras import calibration
from workbench.lesson import Lesson, Sweep

Rms = Callable[[np.ndarray], float]
MOST_ITERATIONS = 400
# of the cost: where boards are hardly tilted, the valley is so flat that a millionth is no rest
TOLERANCE = 1e-8
EACH, EVERY = 30, 10  # iterations that are shown one by one, and of those after them, which


def run(
    params: Params,
    *,
    constraint_rows: Rows = calibration.constraint_rows,
    pose_from_homography: Pose = calibration.pose_from_homography,
    reprojection_rms: Rms = calibration.reprojection_rms,
) -> Iterator[State]:
    """Yield the steps of the calibration, and then what can be asked of it."""
    subject = subject_of(params)
    corner = params.corner if params.loss == "Cauchy" else None
    shown = subject.views.index(params.shown) if params.shown in subject.views else 0
    rms = float("nan")
    state = None
    for step in calibrate(
        subject.p_board,
        subject.uv,
        subject.size,
        constraint_rows=constraint_rows,
        pose_from_homography=pose_from_homography,
        coefficients=COEFFICIENTS[params.lens],
        corner=corner,
        max_iterations=MOST_ITERATIONS,
        tolerance=TOLERANCE,
    ):
        if passed_over(step):
            continue
        before = rms
        rms = float(reprojection_rms(step.residuals.reshape(-1, 2)))
        if not np.isfinite(step.residuals).all():
            raise InputError("the poses put corners at depth 0: nothing can be projected")
        state = State(
            params=params,
            subject=subject,
            now=step,
            rms=rms,
            before=before,
            shown=len(step.residuals) - 1 if step.phase in ("homography", "constraints") else shown,
            map_error=np.empty(0) if step.K is None else map_error(subject, step.K, step.lens),
        )
        yield state
    if state is not None:
        yield from endings(state, corner)


def passed_over(step: calibration_steps.State) -> bool:
    """Tell whether an iteration is not shown: of a long refinement every tenth is, and the last."""
    refined = step.adjustment
    return bool(
        refined and refined.iteration > EACH and refined.iteration % EVERY and not refined.stop
    )


def endings(state: State, corner: float | None) -> Iterator[State]:
    """Yield how well each view fits, what changes without the worst one, and how well all is
    known.
    """
    subject = state.subject
    refined = sure(state.now.adjustment)
    worst = int(np.argmax(state.per_view))
    views = Ending(kind="views", worst=worst)
    yield replace(state, shown=worst, ending=views)
    if len(subject.views) > 2:
        keep = np.arange(len(subject.views)) != worst
        *_, without = adjust(
            refined.K,
            refined.lens,
            refined.Ts_camera_board[keep],
            p_board=subject.p_board,
            uv=subject.uv[keep],
            coefficients=COEFFICIENTS[state.params.lens],
            corner=corner,
            max_iterations=MOST_ITERATIONS,
            tolerance=TOLERANCE,
        )
        yield replace(state, shown=worst, ending=replace(views, kind="without", without=without))
    known = Ending(
        kind="known",
        worst=worst,
        deviation=deviations(subject.size, refined.K, refined.lens, covariance=refined.covariance),
        tilts=over_tilt(state.params) if subject.K is not None and state.params.noise > 0 else None,
    )
    yield replace(state, ending=known)


lesson = Lesson(
    name="calibration",
    title="Calibration",
    summary="Photographs of a chessboard tell what a camera's lens does. See how sure of it you "
    "can be.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=900,
    chapter="See",
    minutes=25,
    needs=("pinhole", "fitting"),
    view=VIEW,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=9,
    opening=0,
    sweeps=(Sweep("tilt", (2.0, 5.0, 10.0, 20.0, 30.0, 45.0)),),
    telling="Focal length",
)
