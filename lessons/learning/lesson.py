"""When geometry is the loss: a network makes small what the loss measures, over what its output can
express.

What it teaches: numbers with a cut cannot be learned across it; a mean is what the loss calls one;
what a loss does not measure is left to chance; and training error is no geometry.
"""

from collections.abc import Iterator
from pathlib import Path

from lessons.learning.draw import draw
from lessons.learning.presets import PRESETS, QUESTIONS, VIEW
from lessons.learning.state import Params, State
from lessons.learning.tasks import Functions, steps
from workbench.algorithms.learning.set_regression import ChamferGradient
from workbench.geometry.cameras import volume_rendering
from workbench.geometry.cameras.volume_rendering import RayWeights
from workbench.geometry.motions import rotation_outputs
from workbench.geometry.motions.rotation_outputs import Decode
from workbench.geometry.points import shape_distances
from workbench.lesson import Lesson, Sweep


def run(
    params: Params,
    *,
    rotation_from_six: Decode = rotation_outputs.rotation_from_six,
    chamfer_gradient: ChamferGradient = shape_distances.chamfer_gradient,
    ray_weights: RayWeights = volume_rendering.ray_weights,
) -> Iterator[State]:
    """Yield the steps of learning one task."""
    functions = Functions(
        rotation_from_six=rotation_from_six,
        chamfer_gradient=chamfer_gradient,
        ray_weights=ray_weights,
    )
    yield from steps(params, functions)


lesson = Lesson(
    name="learning",
    title="Learning geometry",
    summary="Train small networks on shapes. See what their output cannot say and what their "
    "loss does not notice.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=2000,
    chapter="Learn",
    minutes=25,
    needs=("rotations", "chamfer_emd"),
    view=VIEW,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=-1,
    opening=0,
    sweeps=(Sweep("angle", ("one number", "half the angle", "cosine and sine")),),
    telling="Output over turn",
)
