"""A pinhole camera: from a point in the world to a pixel, and back to a ray.

What it teaches: a photograph is what rays through one point leave on a pane. Small steps write that
as numbers, each forgets something, and each has its own classic mistake with a look of its own.
"""

from collections.abc import Iterator
from pathlib import Path

from lessons.pinhole.drawing import draw
from lessons.pinhole.following import Center, Distort, Project
from lessons.pinhole.inputs import Input
from lessons.pinhole.models import State, compared, model_of, overlays
from lessons.pinhole.presets import PRESETS, SWEEPS, VIEW, VIEWS
from lessons.pinhole.questions import QUESTIONS
from lessons.pinhole.shot import Shot, setup
from workbench.geometry.cameras import distortion
from workbench.geometry.cameras import pinhole as cameras
from workbench.lesson import Lesson


def run(
    params: Input,
    shot: Shot,
    *,
    project: Project = cameras.project,
    distort: Distort = distortion.distort,
    camera_center: Center = cameras.camera_center,
) -> Iterator[State]:
    """Yield the stages of the street's points through the calculated camera."""
    model = model_of(params, shot, project, distort=distort, camera_center=camera_center)
    overlaid = overlays(shot, model)
    for state in model(shot.p_world):
        yield compared(shot, state, overlaid(state.stage))


lesson = Lesson(
    name="pinhole",
    title="The pinhole camera",
    summary="A picture keeps directions and forgets depths. Follow one point from the street to "
    "its pixel and back.",
    page=Path(__file__).with_name("page.md"),
    params=Input,
    setup=setup,
    run=run,
    draw=draw,
    order=800,
    chapter="See",
    minutes=20,
    needs=("transforms",),
    view=VIEW,
    views=VIEWS,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=2,
    sweeps=SWEEPS,
    telling="The followed point",
)
