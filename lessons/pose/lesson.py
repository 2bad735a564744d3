"""Where was the camera: three points, four places; a fourth point, all of them, and a plane that
has two answers.

What it teaches: three known points leave up to four cameras and mostly two, one more chooses; all
together average the noise, linear methods first and Gauss-Newton after them. Flat targets have two
explanations wherever perspective is weak, and no solver can know which is true. A small
reprojection error is no proof of a pose.
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from lessons.pose.draw import LOOKS, VIEW, draw
from lessons.pose.exercises.choose_pose import choose_pose
from lessons.pose.exercises.pose_from_distances import pose_from_distances
from lessons.pose.exercises.pose_step import pose_step
from lessons.pose.presets import PRESETS, QUESTIONS
from lessons.pose.scenes import subject_of
from lessons.pose.state import Params, State, Subject
from lessons.pose.trials import repeated
from workbench.algorithms.cameras.camera_search import (
    ChoosePose,
    PoseFromDistances,
    PoseStep,
    Searched,
    by_plane,
    by_three_points,
    downhill,
)
from workbench.algorithms.robust.camera_model import camera_model
from workbench.algorithms.robust.ransac import Judge, ransac
from workbench.algorithms.robust.ransac import State as Sampled
from workbench.algorithms.robust.samplers import uniform_samples
from workbench.errors import InputError
from workbench.geometry.cameras.camera_motions import dlt_motion, rms_reprojection, sqpnp
from workbench.geometry.cameras.control_points import epnp
from workbench.geometry.cameras.planar_motions import is_flat
from workbench.lesson import Lesson, Sweep

MOST_SAMPLES = 500


def run(
    params: Params,
    *,
    pose_from_distances: PoseFromDistances = pose_from_distances,
    choose_pose: ChoosePose = choose_pose,
    pose_step: PoseStep = pose_step,
) -> Iterator[State]:
    """Yield the steps of one method, those downhill from its answer, and what it finds in other
    pictures.
    """
    subject = subject_of(params)
    yield State(params=params, subject=subject)
    if params.method == "RANSAC":
        for drawn in sampled(params, subject):
            yield State(params=params, subject=subject, now=drawn)
        return
    p = subject.given.p_world
    xy = subject.xy
    T = None
    for step in first_pose(params, subject, pose_from_distances, choose_pose=choose_pose):
        T = step.T if step.phase in ("choose", "solved") else None
        yield State(params=params, subject=subject, now=step)
    if params.refine:
        for step in downhill(T, p, xy, pose_step=pose_step):
            yield State(params=params, subject=subject, now=step)
    if subject.T_true is not None:
        yield State(params=params, subject=subject, now=repeated(params, subject))


def first_pose(
    params: Params,
    subject: Subject,
    pose_from_distances: PoseFromDistances,
    *,
    choose_pose: ChoosePose,
) -> Iterator[Searched]:
    """Return the steps to a first pose by the method of the params.

    Raises:
        InputError: If the method cannot take these points.
    """
    p = subject.given.p_world
    xy = subject.xy
    if params.method == "P3P":
        return by_three_points(p, xy, pose_from_distances, choose_pose=choose_pose)
    if params.method == "IPPE":
        if not is_flat(p):
            raise InputError(
                "IPPE is for points of one plane: take the marker, or a box of thickness 0"
            )
        return by_plane(p, xy, choose_pose)
    if params.method == "DLT" and len(p) < 6:
        raise InputError(f"the direct linear transform needs 6 points, and there are only {len(p)}")
    if params.method == "EPnP" and np.linalg.matrix_rank(p - p.mean(axis=0), 1e-6) < 2:
        raise InputError("EPnP is for points that do not all lie on one line")
    if params.method == "DLT":
        T = dlt_motion(p, xy, centred=params.centred)
    else:
        T = sqpnp(p, xy) if params.method == "SQPnP" else epnp(p, xy)
    return iter([Searched(phase="solved", T=T, error=float(rms_reprojection(T, p, xy)))])


def sampled(params: Params, subject: Subject) -> Iterator[Sampled]:
    """Yield the parts of the first sample, and afterwards what became the best."""
    model = camera_model(subject.K)
    rows = np.column_stack([subject.given.p_world, subject.given.uv])
    judge = Judge(rows, model, params.inlier_pixels)
    samples = uniform_samples(len(rows), model.sample_size, np.random.default_rng([params.seed, 3]))
    for step in ransac(rows, model, samples, judge=judge, max_iterations=MOST_SAMPLES):
        if step.iteration == 1 or step.phase in ("best", "refit", "stop"):
            yield step


lesson = Lesson(
    name="pose",
    title="Pose from points",
    summary="Three known points in a picture leave up to four places for the camera. Find the "
    "one where it stood.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=1000,
    chapter="See",
    minutes=25,
    needs=("pinhole", "ransac"),
    view=VIEW,
    view_for=lambda params: LOOKS["box" if params.sightings else params.target].view,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=1,
    opening=0,
    sweeps=(Sweep("noise", (0.0, 0.5, 1.0, 2.0, 3.0)),),
    telling="Rotation error",
)
