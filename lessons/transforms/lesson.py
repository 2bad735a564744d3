"""Transforms: one motion, many numbers, and what each kind of map leaves as it was.

What it teaches: a 4x4 is a product in which the order counts; lengths, angles, volumes and
orientation tell the kinds of maps apart; Euler angles, matrices and quaternions are names of one
rotation, and only some of them can be blended.
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from lessons.transforms.body import body_of, motion_factors, numbers_of, shape_factors
from lessons.transforms.compare import ghosts_of, undo_ghosts_of
from lessons.transforms.composition import Invert, compose
from lessons.transforms.draw import draw
from lessons.transforms.presets import PRESETS, QUESTIONS, VIEW
from lessons.transforms.state import Built, Moved, Params, State, Way
from workbench.algorithms import interpolation as between
from workbench.algorithms.interpolation import FromEuler, Rodrigues
from workbench.geometry.meshes.invariants import changes, measure
from workbench.geometry.motions import apply, exp_so3, inverse, motion, rotations
from workbench.geometry.motions.affine import transform
from workbench.geometry.motions.alignment import degrees_between, nearest_rotation
from workbench.lesson import Lesson, Sweep


def run(
    params: Params,
    *,
    invert_rigid: Invert = inverse,
    rotation_from_axis_angle: Rodrigues = rotations.rotation_from_axis_angle,
    euler_to_matrix: FromEuler = rotations.euler_to_matrix,
) -> Iterator[State]:
    """Yield the body after every factor, or at every time between the two poses."""
    if params.half == "build a map":
        yield from _build(params, invert_rigid, rotation_from_axis_angle, euler_to_matrix)
    else:
        yield from _move(params, invert_rigid, rotation_from_axis_angle, euler_to_matrix)


def _build(
    params: Params,
    invert_rigid: Invert,
    rotation_from_axis_angle: Rodrigues,
    euler_to_matrix: FromEuler,
) -> Iterator[Built]:
    body, numbers = body_of(params), numbers_of(params)
    shape, motions = (
        shape_factors(params),
        motion_factors(params, euler_to_matrix, rotation_from_axis_angle),
    )
    p, faces = body.solid.p, body.solid.faces
    A = np.eye(4)
    for factor in shape:
        A = factor.matrix @ A
    ghosts, p_shaped = ghosts_of(params, body, numbers, A), transform(A, p)
    before, trail, turns = body.measures, np.empty((0, 3)), 0
    for now in compose(shape, motions, invert_rigid):
        p_now = transform(now.T, p)
        after, trail = measure(p_now, faces), np.vstack([trail, p_now[body.point]])
        turns += now.factor.kind == "turn"
        undone, complete = now.factor.kind == "undo", len(trail) == len(shape) + len(motions) + 1
        yield Built(
            params=params,
            body=body,
            factor=now.factor,
            T=now.T,
            T_world_body=now.T_world_body,
            turns=turns,
            angles=np.where(np.arange(3) < turns, numbers.angles, 0.0),
            by_factor=changes(before, after),
            by_all=changes(body.measures, after),
            trail=trail,
            complete=complete,
            ghosts=undo_ghosts_of(params, body, now.T_world_body, A)
            if undone
            else ghosts
            if complete
            else (),
            left=float(np.linalg.norm(p_now - p_shaped, axis=1).max()) if undone else float("nan"),
        )
        before = after


def _move(
    params: Params,
    invert_rigid: Invert,
    rotation_from_axis_angle: Rodrigues,
    euler_to_matrix: FromEuler,
) -> Iterator[Moved]:
    body, numbers, times = (
        body_of(params),
        numbers_of(params),
        np.linspace(0.0, 1.0, params.steps + 1),
    )
    angles_end = np.radians(params.angles_end)
    R_end = euler_to_matrix(angles_end, params.order)
    if numbers.turn.any():  # the handle turns the end further, so that other angles make it
        R_end = exp_so3(numbers.turn) @ R_end
        angles_end = rotations.matrix_to_euler(nearest_rotation(R_end), params.order)
    T_start = motion(euler_to_matrix(numbers.angles, params.order), np.zeros(3))
    T_end = motion(R_end, numbers.offset)
    shortest = list(
        between.slerp_and_lerp(
            T_start, T_end, times, rotation_from_axis_angle=rotations.rotation_from_axis_angle
        )
    )
    shortest_way = way = Way(
        times=times[:0], path=np.empty((0, 3)), turned=times[:0], volume=times[:0]
    )
    for k, now in enumerate(shortest):
        shortest_way = _gone(shortest_way, now, shortest[max(k - 1, 0)], body.p_point)
    if params.method == "slerp + lerp":
        states = between.slerp_and_lerp(
            T_start, T_end, times, rotation_from_axis_angle=rotation_from_axis_angle
        )
    elif params.method == "Euler angles":
        states = between.lerp_of_euler_angles(
            numbers.angles,
            angles_end,
            params.order,
            p_start=T_start[:3, 3],
            p_end=T_end[:3, 3],
            times=times,
            euler_to_matrix=euler_to_matrix,
        )
    elif params.method == "matrix entries":
        states = between.lerp_of_entries(T_start, T_end, times)
    elif params.method == "slerp to -q":
        states = between.slerp_to_minus_q(T_start, T_end, times)
    else:
        states = between.along_a_screw(T_start, T_end, times, invert_rigid=invert_rigid)
    before = None
    for now, best in zip(states, shortest, strict=True):
        before = before or now
        way = _gone(way, now, before, body.p_point)
        T, T_before, before = now.T_world_body, before.T_world_body, now
        after = measure(apply(T, body.solid.p), body.solid.faces)
        yield Moved(
            params=params,
            body=body,
            T_world_start=T_start,
            T_world_end=T_end,
            T_world_body=T,
            T_world_before=T_before,
            T_world_shortest=best.T_world_body,
            way=way,
            shortest=shortest_way,
            off=degrees_between(best.T_world_body, T),
            by_all=changes(body.measures, after),
        )


def _gone(way: Way, now: between.State, before: between.State, p_point: np.ndarray) -> Way:
    turned = (way.turned[-1] if len(way.turned) else 0.0) + degrees_between(
        before.T_world_body, now.T_world_body
    )
    path = np.vstack([way.path, apply(now.T_world_body, p_point)])
    volume = np.linalg.det(now.T_world_body[:3, :3])
    return Way(
        times=np.append(way.times, now.t),
        path=path,
        turned=np.append(way.turned, turned),
        volume=np.append(way.volume, volume),
    )


lesson = Lesson(
    name="transforms",
    title="Transforms",
    summary="A 4×4 matrix turns, moves and stretches a body. Build one factor by factor, then go "
    "from one pose to another.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=100,
    chapter="Move",
    minutes=20,
    view=VIEW,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=5,
    sweeps=(Sweep("first", ("rotate, then translate", "translate, then rotate")),),
    telling="What survives",
)
