"""A pinhole camera: from a point in the world to a pixel, and back to a ray.

What it teaches: five small steps, each with its own classic mistake. The photograph is always true;
the calculation is laid over it in orange, so a mistake is seen where it is made.
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from lessons.pinhole import following as pinhole
from lessons.pinhole.draw import VIEW, draw
from lessons.pinhole.following import Center, Distort, Project
from lessons.pinhole.models import laid_out, model_of, overlaid
from lessons.pinhole.presets import PRESETS, QUESTIONS
from lessons.pinhole.shot import shot_of
from lessons.pinhole.state import Params, Shot, State
from workbench.data.views.street import street
from workbench.geometry.cameras import distortion
from workbench.geometry.cameras import pinhole as cameras
from workbench.lesson import Lesson, Sweep


def run(
    params: Params,
    *,
    project: Project = cameras.project,
    distort: Distort = distortion.distort,
    camera_center: Center = cameras.camera_center,
) -> Iterator[State]:
    """Yield the stages of the street's points through the calculated camera, beside the true
    one.
    """
    shot = shot_of(params)
    model = model_of(params, shot, project, distort, camera_center)
    outlines = laid_out(model)
    for now in model(street().points):
        picture = overlaid(shot, outlines, now.stage, params.point)
        error, found, missed, false = compare(shot, now)
        yield State(
            params=params,
            shot=shot,
            now=now,
            picture=picture,
            error=error,
            found=found,
            missed=missed,
            false=false,
        )


def compare(shot: Shot, now: pinhole.State) -> tuple[float, int, int, int]:
    """Return the median distance from the true pixels, and how many points are found, missed and
    false.

    Before pixels are reached, both sides are scaled with the true K, so that all stages speak of
    pixels.
    """
    if not now.reached("divide"):
        return float("nan"), 0, 0, 0
    true, got = shot.uv, pinhole.onto_pixels(now.xy_bent, shot.K)
    if not now.reached("distort"):
        true, got = pinhole.onto_pixels(shot.xy, shot.K), pinhole.onto_pixels(now.xy, shot.K)
    if now.reached("pixels"):
        got = now.uv
    seen, found = np.isfinite(true).all(axis=1), np.isfinite(got).all(axis=1)
    both = seen & found
    error = (
        float(np.median(np.linalg.norm(got[both] - true[both], axis=1)))
        if both.any()
        else float("nan")
    )
    return error, int(found.sum()), int((seen & ~found).sum()), int((found & ~seen).sum())


lesson = Lesson(
    name="pinhole",
    title="The pinhole camera",
    summary="Five steps take a point of the world to a pixel. Each step has its own typical "
    "mistake.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=800,
    chapter="See",
    minutes=20,
    needs=("transforms",),
    view=VIEW,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=2,
    sweeps=(
        Sweep("dolly", (0.5, 1.0, 2.0, 4.0, 10.0, 50.0)),
        Sweep("k1", (-0.6, -0.3, 0.0, 0.3, 0.6)),
    ),
    telling="The followed point",
)
