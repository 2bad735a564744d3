"""Iterative closest point: match every source point to its nearest target point, fit a motion, repeat.

What it teaches: ICP walks downhill from where it starts, home or into another valley, so a small RMSE proves nothing; the
start, the gate, the error measure and how evenly the scans are sampled decide.
"""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from lessons.icp.basin import align_of, gate_of, tries_of
from lessons.icp.draw import draw
from lessons.icp.presets import PRESETS, QUESTIONS, VIEW
from lessons.icp.scans import scans_of
from lessons.icp.state import Params, State, Try
from workbench.algorithms.icp import Align, Match, PlaneStep, icp
from workbench.geometry.alignment import align_rigid, degrees_between, point_to_plane_step
from workbench.lesson import Lesson, Sweep

MAX_ITERATIONS, TOLERANCE = 150, 1e-5


def run(
    params: Params, *, align: Align | None = None, match: Match | None = None, step: PlaneStep | None = None
) -> Iterator[State]:
    """Yield the steps of ICP on the scans, then, where the truth is known, one try from each of a row of starts.

    There are none where a shape can be moved onto itself, nor where a function is given in place of ours (None).
    """
    scans = scans_of(params)
    T_before, rmse_before, state = scans.T_start, float("nan"), None
    for now in icp(
        scans.p_target,
        scans.p_source,
        scans.T_start,
        n_target=scans.n_target() if params.fit == "point-to-plane" else None,
        gate=gate_of(params, scans),
        match=match,
        align=align_of(params, align or align_rigid),
        step=step or point_to_plane_step,
        max_iterations=MAX_ITERATIONS,
        tolerance=TOLERANCE,
    ):
        state = State(
            params=params,
            scans=scans,
            icp=now,
            rmse_before=rmse_before,
            turned=degrees_between(now.T_target_source, T_before),
            error=scans.error(now.T_target_source),
            right=scans.right_share(now.indices, now.kept),
        )
        yield state
        T_before, rmse_before = now.T_target_source, now.rmse
    ours = align is None and match is None and step is None
    if state is None or scans.T_truth is None or not ours:
        return
    tries: tuple[Try, ...] = ()
    for attempt in tries_of(params):
        tries = (*tries, attempt)
        yield replace(state, tries=tries)


lesson = Lesson(
    name="icp",
    title="Iterative closest point",
    summary="Two scans find each other: match, move, match again. Sometimes they settle in the "
    "wrong place.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=400,
    chapter="Estimate",
    minutes=20,
    needs=("pairs",),
    view=VIEW,
    presets=PRESETS,
    questions=QUESTIONS,
    sweeps=(Sweep("start_angle", tuple(float(angle) for angle in range(0, 181, 30))),),
    telling="Rotation error",
    tries=lambda state: bool(state.tries),
)
