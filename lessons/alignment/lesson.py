"""The frame that a cloud carries, and the frame that pairs give.

What it teaches: plane turns bring a covariance to its axes, which come without signs, and with
equal variances without directions, so that two clouds aligned by them may be half a turn apart;
pairs of points leave no such doubt, and their SVD reads off turn, mirror image and scale.
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from lessons.alignment.axes import FindAxes, Sign, axes_stage, gap
from lessons.alignment.draw import draw
from lessons.alignment.presets import FIRST, PRESETS, QUESTIONS, VIEW
from lessons.alignment.scans import scans_of
from lessons.alignment.state import Outcome, PairsState, Params, State
from workbench.algorithms.registration.procrustes import Scale, procrustes
from workbench.geometry.motions import alignment
from workbench.geometry.motions.alignment import degrees_between
from workbench.lesson import Lesson, Sweep


def run(
    params: Params,
    *,
    principal_axes: FindAxes | None = None,
    canonical_signs: Sign | None = None,
    similarity_scale: Scale = alignment.similarity_scale,
) -> Iterator[State]:
    """Yield the steps of one stage: the second scan is brought to the first by axes, or by
    pairs.
    """
    if params.stage == "axes":
        yield from axes_stage(params, principal_axes, canonical_signs)
    else:
        yield from pairs_stage(params, similarity_scale)


def pairs_stage(params: Params, similarity_scale: Scale) -> Iterator[PairsState]:
    """Yield the steps of the least-squares similarity, in the end with the scale that goes back."""
    scans = scans_of(params)
    p, q, true = scans.p_target, scans.p_source, scans.T_target_source
    sizes = float(np.sqrt(np.trace(np.cov(p.T)) / np.trace(np.cov(q.T))))
    before = float("nan")
    for now in procrustes(p, q, similarity_scale, params.flip):
        T = now.T_target_source
        yield PairsState(
            params=params,
            scans=scans,
            now=now,
            before=before,
            outcome=Outcome(
                T_target_source=T,
                rotation=(
                    float("nan")
                    if true is None or np.linalg.det(T[:3, :3]) < 0
                    else degrees_between(T, true)
                ),
                axes=None,
                gap=gap(T, scans),
            ),
            back=similarity_scale(q, p) if now.stage == "scale" else float("nan"),
            sizes=sizes,
        )
        before = now.rmse


lesson = Lesson(
    name="alignment",
    title="Principal axes and pairs",
    summary=(
        "A cloud carries a frame of its own, but no signs; pairs of points know them, and mirror"
        " and scale as well."
    ),
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=800,
    needs=("transforms",),
    view=VIEW,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=FIRST,
    sweeps=(Sweep("signs", ("none", "largest-entry", "third-moment")),),
    telling="Variance by direction",
)
