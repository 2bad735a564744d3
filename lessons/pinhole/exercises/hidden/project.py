"""What project is graded by besides the checks that a student sees."""

import numpy as np

from lessons.pinhole.exercises import GRADERS
from lessons.pinhole.exercises.project import PROJECT_HINT, in_pixels, some_scenes
from workbench.exercise import Function, Verdict, check, worst
from workbench.geometry.cameras import pinhole as cameras
from workbench.geometry.motions import apply, exp_so3, inverse, motion


@check(2, public=False)
def whole_k(candidate: Function) -> Verdict:
    """All of K counts: two focal lengths, skew, and a principal point outside the picture, as after
    a crop.
    """
    verdicts = []
    for p_world, T_camera_world, _ in some_scenes(GRADERS()):
        K = cameras.crop_intrinsics(
            cameras.intrinsics(600.0, 320.0, 240.0, fy=450.0, skew=35.0), 400.0, -90.0
        )
        right = cameras.project(p_world, T_camera_world, K)
        verdicts.append(in_pixels(candidate(p_world, T_camera_world, K), right, PROJECT_HINT))
    return worst(verdicts)


@check(1, public=False)
def moves_together(candidate: Function) -> Verdict:
    """Moving world and camera together changes no pixel, nor does doubling all lengths."""
    verdicts = []
    for p_world, T_camera_world, K in some_scenes(GRADERS() + 1):
        right = cameras.project(p_world, T_camera_world, K)
        Q = motion(exp_so3(np.array([0.4, -1.1, 0.8])), np.array([3.0, -2.0, 5.0]))
        twice = motion(T_camera_world[:3, :3], 2.0 * T_camera_world[:3, 3])
        moved = candidate(apply(Q, p_world), T_camera_world @ inverse(Q), K)
        verdicts += [
            in_pixels(moved, right, PROJECT_HINT),
            in_pixels(candidate(2 * p_world, twice, K), right, PROJECT_HINT),
        ]
    return worst(verdicts)


@check(1, public=False)
def camera_amid_points(candidate: Function) -> Verdict:
    """A camera amid its points, no point, a single one, all behind it, and one a hundredth of a
    millimetre before it.
    """
    (p_world, T_camera_world, K), *_ = some_scenes(GRADERS() + 2, size=200)
    amid = motion(T_camera_world[:3, :3], np.array([0.1, -0.2, 0.3]))
    behind = motion(np.eye(3), np.array([0.0, 0.0, -50.0]))
    beside_it = np.array(
        [[1.0, 1.0, 0.0], [-2.0, 0.5, 0.0], [0.3, -0.1, 1e-3], [1e-6, -2e-6, 1e-5]]
    )
    skewed = cameras.intrinsics(500.0, 310.0, 245.0, skew=20.0)
    cases = [
        (p_world, amid, K),
        (p_world[:0], amid, K),
        (p_world, behind, K),
        (beside_it, np.eye(4), skewed),
    ]
    cases.append((p_world[:1], T_camera_world, K))
    return worst(
        in_pixels(candidate(*case), cameras.project(*case), PROJECT_HINT) for case in cases
    )
