"""A pinhole camera: from a point in the world to a pixel, and back to a ray.

What it teaches: five small steps, each with its own classic mistake. The photograph is always true; the calculation is
laid over it in orange, so a mistake is seen where it is made.

`params.py` has the inputs, `shot.py` the true camera and its photograph, `models.py` the calculation and its mistakes,
`draw.py` and `words.py` the picture, `presets.py` the experiments and questions.
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from lessons.pinhole.draw import draw
from lessons.pinhole.models import Model, model_of
from lessons.pinhole.params import Params
from lessons.pinhole.presets import PRESETS, QUESTIONS
from lessons.pinhole.shot import Shot, shot_of, wires
from lessons.pinhole.state import State
from workbench.algorithms import pinhole
from workbench.algorithms.pinhole import Center, Distort, Project
from workbench.data.street import street
from workbench.geometry import cameras, distortion
from workbench.geometry.raster import PointItem, SegmentItem, render
from workbench.lesson import Lesson, View
from workbench.scene import PALETTE, Role


def run(
    params: Params,
    *,
    project: Project = cameras.project,
    distort: Distort = distortion.distort,
    camera_center: Center = cameras.camera_center,
) -> Iterator[State]:
    """Yield the stages of the street's points through the calculated camera, beside the true one."""
    shot = shot_of(params)
    model = model_of(params, shot, project, distort, camera_center)
    picture = overlaid(shot, model, params.point)
    for now in model.follow(street().points):
        yield State(params, shot, now, picture, *compare(shot, now))


def compare(shot: Shot, now: pinhole.State) -> tuple[float, int, int, int]:
    """Return the median distance from the true pixels, and how many points are found, missed and false.

    Before pixels are reached, both sides are scaled with the true K, so that all stages speak of pixels.
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
    error = float(np.median(np.linalg.norm(got[both] - true[both], axis=1))) if both.any() else float("nan")
    return error, int(found.sum()), int((seen & ~found).sum()), int((found & ~seen).sum())


def overlaid(shot: Shot, model: Model, point: int) -> np.ndarray:
    """Return the photograph with the calculated outlines and points laid over it, whatever hides them."""
    h, w = shot.picture.shape[:2]
    lines = wires(shot.T_camera_world)
    drawn = render(
        [SegmentItem(lines, _colors("source", len(lines)))],
        shot.T_camera_world, shot.K, w, h, shot.lens, to_pixels=model.pixels,
    )  # fmt: skip
    uv = model.pixels(street().points)
    spots = [_flat(uv, "source", 3), _flat(shot.uv[point : point + 1], "truth", 9), _flat(uv[[point]], "highlight", 7)]
    picture = shot.picture.copy()
    for layer in (drawn, *(render([spot], np.eye(4), np.eye(3), w, h) for spot in spots)):
        shown = np.isfinite(layer.depth)
        picture[shown] = layer.colors[shown]
    return picture


def _flat(uv: np.ndarray, role: Role, width: int) -> PointItem:
    """Return points that a camera with K = I at the origin sees at these very pixels."""
    return PointItem(np.column_stack([uv, np.ones(len(uv))]), _colors(role, len(uv)), width)


def _colors(role: Role, n: int) -> np.ndarray:
    return np.tile(np.array([PALETTE[role]], np.uint8), (n, 1))


lesson = Lesson(
    name="pinhole",
    title="The pinhole camera",
    summary="From world point to pixel in five steps, and what each step's classic mistake looks like.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=200,
    view=View(eye=(7.6, -12.5, 6.6), target=(0.3, 0.6, 0.4), grid=2.0, grid_height=-0.02),
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=2,
)
