"""The inputs, what is learned, and what one step holds."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from lessons.learning.labelled_shapes import Turned
from workbench.algorithms.learning.mesh_fitting import MeshFitted
from workbench.algorithms.learning.point_net import Classified, Pool
from workbench.algorithms.learning.radiance_field import Reconstructed
from workbench.algorithms.learning.rotation_regression import Compared, Regressed
from workbench.algorithms.learning.set_regression import SetLearned, SetLoss
from workbench.data.framing import Upward
from workbench.geometry.meshes import euler_characteristic
from workbench.knobs import Gizmo, Knob, Pick

Task = Literal["angle", "rotation", "sets", "mesh", "classify", "field"]
Angle = Literal["one number", "half the angle", "cosine and sine"]
Rotation = Literal["Euler", "axis-angle", "quaternion", "6D", "9D"]
Now = Regressed | SetLearned | MeshFitted | Classified | Reconstructed


def on(*tasks: Task) -> dict[str, tuple[Task, ...]]:
    """Return what a knob of some tasks needs."""
    return {"task": tasks}


@dataclass(frozen=True)
class Params:
    """What is learned, how it is written as numbers, and what the loss compares."""

    task: Annotated[Task, Knob("What is learned")] = "angle"
    angle: Annotated[Angle, Knob("The numbers put out for an angle", needs=on("angle"))] = (
        "cosine and sine"
    )
    rotation: Annotated[
        Rotation, Knob("The numbers put out for a rotation", needs=on("rotation"))
    ] = "6D"
    loss: Annotated[
        Compared,
        Knob(
            "What the loss compares: those numbers, or the matrices that they mean",
            needs=on("angle", "rotation"),
        ),
    ] = "numbers"
    largest: Annotated[
        float,
        Knob(
            "The largest turn, in training and in the test",
            45,
            180,
            step=5,
            unit="deg",
            needs=on("angle", "rotation"),
        ),
    ] = 180.0
    set_loss: Annotated[SetLoss, Knob("How two sets of points are compared", needs=on("sets"))] = (
        "Chamfer"
    )
    laplacian: Annotated[
        float, Knob("Weight of the Laplacian energy", 0, 100, step=0.5, needs=on("mesh"))
    ] = 10.0
    normal: Annotated[
        float, Knob("Weight of the energy of normals", 0, 1, step=0.01, needs=on("mesh"))
    ] = 0.0
    edge: Annotated[
        float, Knob("Weight of the energy of edges", 0, 1, step=0.01, needs=on("mesh"))
    ] = 0.0
    noise: Annotated[
        float,
        Knob(
            "Standard deviation of the given points", 0, 0.1, step=0.005, unit="m", needs=on("mesh")
        ),
    ] = 0.04
    pool: Annotated[
        Pool, Knob("How the points of a cloud become one row", needs=on("classify"))
    ] = "max"
    trained: Annotated[Turned, Knob("How shapes are turned in training", needs=on("classify"))] = (
        "about z"
    )
    turned: Annotated[Turned, Knob("How shapes are turned in the test", needs=on("classify"))] = (
        "about z"
    )
    shuffled: Annotated[bool, Knob("Test clouds are listed in any order", needs=on("classify"))] = (
        False
    )
    stray: Annotated[
        tuple[float, float, float],
        Knob(
            "Where the first point of every test cloud is put; at the origin: left alone",
            -3,
            3,
            unit="m",
            by=Gizmo(0.5),
            needs=on("classify"),
        ),
    ] = (0.0, 0.0, 0.0)
    views: Annotated[int, Knob("Photographs it is learned from", 2, 24, needs=on("field"))] = 12
    updates: Annotated[
        int, Knob("Steps of Adam; 0 takes what suits the task", 0, 2000, step=50)
    ] = 0
    picked: Annotated[
        int,
        Knob(
            "The test input that is looked at; beyond the last, the first again",
            0,
            542,
            by=Pick("inputs"),
            needs=on("angle", "rotation", "field"),
        ),
    ] = 20
    scan: Annotated[
        Path | None, Knob("Own mesh to fit: off, obj, ply, stl, glb", needs=on("mesh"))
    ] = None
    up: Annotated[
        Upward, Knob("Which axis of an own mesh points up; auto guesses", of_files=True)
    ] = "auto"
    seed: Annotated[int, Knob("What chance draws: data, first weights, batches", 0, 99)] = 0


@dataclass(frozen=True, eq=False)
class Turns:
    """Test inputs of `angle` and `rotation`.

    Attributes:
        places: Where each is shown: on the unit circle, or its rotation vector with half a turn at
            1 m.
        degrees: By how much each is turned; signed in the plane.
    """

    places: np.ndarray
    degrees: np.ndarray


@dataclass(frozen=True, eq=False)
class Target:
    """What `mesh` is fitted to.

    Attributes:
        faces: Of the mesh that is fitted.
        given: Points, with noise.
        p_true, faces_true: The true surface, a mesh.
        name: What they are of, in sentences.
    """

    faces: np.ndarray
    given: np.ndarray
    p_true: np.ndarray
    faces_true: np.ndarray
    name: str

    @property
    def euler(self) -> int:
        """Return vertices - edges + faces of the true surface; of a sphere 2."""
        return euler_characteristic(self.faces_true)


@dataclass(frozen=True, eq=False)
class Clouds:
    """Test clouds of `classify`: as in training, and changed; with their classes."""

    plain: np.ndarray
    changed: np.ndarray
    of: np.ndarray


@dataclass(frozen=True, eq=False, kw_only=True)
class Looks:
    """How a field looks after some updates.

    Attributes:
        trained, unseen: Peak signal-to-noise ratio of the photographs and of new views, dB.
        overlap: Of where it is dense with where the discs are: both over either.
        image, truth: A new view, (w, 3), and what it should be.
        angles: Where the cameras stand, radians; the new view's last.
        ray: From where to where the picked ray goes, (2, 2).
        along: Distances of its samples, m.
        weights, true_weights: How much each counts, and should.
    """

    trained: float
    unseen: float
    overlap: float
    image: np.ndarray
    truth: np.ndarray
    angles: np.ndarray
    ray: np.ndarray
    along: np.ndarray
    weights: np.ndarray
    true_weights: np.ndarray


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One step: the params, what is learned, how it looks now, and whether it is the end."""

    params: Params
    about: Turns | Target | Clouds | Looks | None
    now: Now
    last: bool = False
