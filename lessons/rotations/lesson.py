"""Rotations: one turn, many names.

What it teaches: three angles are three rings, and two of them may fall into one; a triple says
nothing without its convention; any chain of turns is one turn; q and −q are one rotation; the
shortest way between two turns is one axle at constant speed; a mean of matrices is no rotation.
"""

from collections.abc import Iterator
from pathlib import Path

from lessons.rotations import drawing, moving, names, poses
from lessons.rotations.inputs import Body, Input, setup
from lessons.rotations.presets import PRESETS, SWEEPS, VIEW, VIEWS
from lessons.rotations.questions import QUESTIONS
from workbench.algorithms.interpolation import FromEuler, Rodrigues
from workbench.geometry.motions import rotations
from workbench.lesson import Lesson, Look
from workbench.scene import Scene

DRAWINGS = {
    "poses": moving.draw,
    "rings": drawing.draw_rings,
    "readings": drawing.draw_readings,
    "chain": drawing.draw_chain,
    "names": drawing.draw_names,
    "mean": drawing.draw_mean,
}


def run(
    params: Input,
    body: Body,
    *,
    rotation_from_axis_angle: Rodrigues = rotations.rotation_from_axis_angle,
    euler_to_matrix: FromEuler = rotations.euler_to_matrix,
) -> Iterator[poses.Moved | names.Named | names.Read]:
    """Yield the body at every time between two poses, or one name of a turn after the other."""
    if params.stage == "rings":
        yield from names.rings(params, euler_to_matrix)
    elif params.stage == "readings":
        yield from names.readings(params, euler_to_matrix)
    elif params.stage == "chain":
        yield from names.chain(params, rotation_from_axis_angle)
    elif params.stage == "names":
        yield from names.ends()
    elif params.stage == "mean":
        yield from names.means()
    else:
        yield from poses.move(
            params,
            body,
            rotation_from_axis_angle=rotation_from_axis_angle,
            euler_to_matrix=euler_to_matrix,
        )


def draw(look: Look) -> Scene:
    """Return the picture of one step."""
    return DRAWINGS[look.params.stage](look)


lesson = Lesson(
    name="rotations",
    title="Rotations",
    summary="A turn is an axis and an angle. Its other names each have a place where they fail.",
    page=Path(__file__).with_name("page.md"),
    params=Input,
    setup=setup,
    run=run,
    draw=draw,
    order=150,
    chapter="Move",
    minutes=20,
    needs=("transforms",),
    view=VIEW,
    views=VIEWS,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=15,
    sweeps=SWEEPS,
    telling="Turned so far",
)
