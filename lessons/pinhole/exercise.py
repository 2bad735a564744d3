"""The exercises of this lesson: project points, bend them by a lens, find the camera."""

from collections.abc import Iterator

import numpy as np
from jaxtyping import Float

from lessons.pinhole import answers
from workbench.exercise.judging import left_alone, worst
from workbench.exercise.model import Exercise, Function, Verdict, band, check, fail, full, partial
from workbench.geometry import cameras, distortion
from workbench.geometry.motions import apply, exp_so3, inverse, motion

STUDENTS, GRADERS = 23, 9140  # seeds of what a student sees run, and of what only a grader does

# project --------------------------------------------------------------------------------------------------------------


def project(
    p_world: Float[np.ndarray, "n 3"], T_camera_world: Float[np.ndarray, "4 4"], K: Float[np.ndarray, "3 3"]
) -> Float[np.ndarray, "n 2"]:
    """Return the pixels (u, v) = (column, row) at which a pinhole camera sees the points.

    The camera frame has +X right, +Y down, +Z forward (OpenCV's axes).

    Args:
        p_world: Points in the world, metres, one per row; there may be none (n = 0).
        T_camera_world: The motion that takes world points into the camera frame, metres.
        K: Intrinsics in pixels, [[fx, skew, cx], [0, fy, cy], [0, 0, 1]].

    Returns:
        One row per point, in the same order, also outside the picture. A row is NaN where the point's depth Z in the
        camera frame is zero or negative: the camera does not see what lies beside or behind it.
    """
    return cameras.project(p_world, T_camera_world, K)


PROJECT_HINT = "World to camera frame, divide by the depth Z, then K."


def some_scenes(seed: int, n: int = 4, size: int = 40) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Yield points, a camera that looks at them from 4 to 7 m, and its K with a principal point off the middle."""
    rng = np.random.default_rng(seed)
    for _ in range(n):
        eye = rng.normal(size=3)
        T_camera_world = cameras.look_at(eye / np.linalg.norm(eye) * rng.uniform(4, 7), rng.uniform(-0.3, 0.3, 3))
        K = cameras.intrinsics(rng.uniform(400, 900), rng.uniform(150, 250), rng.uniform(300, 400))
        yield rng.uniform(-1.5, 1.5, (size, 3)), T_camera_world, K


def in_pixels(uv: np.ndarray, right: np.ndarray, hint: str) -> Verdict:
    """Judge pixels by the largest distance to the right ones; a row that should be NaN and is not, or the reverse, fails."""
    seen, given = np.isfinite(right).all(axis=1), np.isfinite(uv).all(axis=1)
    if (lost := int((seen & ~given).sum())) > 0:
        return fail(f"{lost} of {seen.sum()} points in front of the camera got no pixel. {hint}")
    if (false := int((given & ~seen).sum())) > 0:
        return fail(f"{false} of {(~seen).sum()} points at or behind the camera got a pixel; their rows must be NaN.")
    error = float(np.linalg.norm(uv[seen] - right[seen], axis=1).max(initial=0.0))
    return band("Largest pixel error", error, "px", good=0.01, fair=1.0, hint=hint)


@check(1)
def principal_point(candidate: Function) -> Verdict:
    """A point on the optical axis is seen at the principal point, at any depth."""
    K = cameras.intrinsics(500.0, 310.0, 245.0)
    p = np.array([[0.0, 0.0, 0.5], [0.0, 0.0, 4.0], [0.0, 0.0, 90.0]])
    return in_pixels(candidate(p, np.eye(4), K), np.tile([310.0, 245.0], (3, 1)), PROJECT_HINT)


@check(2)
def right_pixels(candidate: Function) -> Verdict:
    """Points in front of cameras all around are seen at the right pixels."""
    return worst(in_pixels(candidate(*scene), cameras.project(*scene), PROJECT_HINT) for scene in some_scenes(STUDENTS))


@check(2)
def not_behind(candidate: Function) -> Verdict:
    """Points at or behind the camera get NaN, and the others keep their rows."""
    p = np.array([[0.5, 0.2, 3.0], [0.5, 0.2, -3.0], [1.0, 1.0, 0.0], [-0.4, 0.1, 0.01], [0.0, 0.0, 0.0]])
    K = cameras.intrinsics(500.0, 310.0, 245.0)
    hint = f"Two of these five have a positive depth. {PROJECT_HINT}"
    return in_pixels(candidate(p, np.eye(4), K), cameras.project(p, np.eye(4), K), hint)


@check(1)
def scene_is_left_alone(candidate: Function) -> Verdict:
    """Points, motion and K are not changed."""
    scene = next(some_scenes(STUDENTS + 1))
    return left_alone(candidate, in_pixels(candidate(*scene), cameras.project(*scene), PROJECT_HINT))


@check(2, public=False)
def whole_k(candidate: Function) -> Verdict:
    """All of K counts: two focal lengths, skew, and a principal point outside the picture, as after a crop."""
    verdicts = []
    for p_world, T_camera_world, _ in some_scenes(GRADERS):
        K = cameras.crop_intrinsics(cameras.intrinsics(600.0, 320.0, 240.0, fy=450.0, skew=35.0), 400.0, -90.0)
        right = cameras.project(p_world, T_camera_world, K)
        verdicts.append(in_pixels(candidate(p_world, T_camera_world, K), right, PROJECT_HINT))
    return worst(verdicts)


@check(1, public=False)
def moves_together(candidate: Function) -> Verdict:
    """Moving world and camera together changes no pixel, nor does doubling all lengths."""
    verdicts = []
    for p_world, T_camera_world, K in some_scenes(GRADERS + 1):
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
    """A camera amid its points, no point at all, and all points behind it are answered."""
    (p_world, T_camera_world, K), *_ = some_scenes(GRADERS + 2, size=200)
    amid = motion(T_camera_world[:3, :3], np.array([0.1, -0.2, 0.3]))
    behind = motion(np.eye(3), np.array([0.0, 0.0, -50.0]))
    cases = ((p_world, amid, K), (p_world[:0], amid, K), (p_world, behind, K))
    return worst(in_pixels(candidate(*case), cameras.project(*case), PROJECT_HINT) for case in cases)


# distort --------------------------------------------------------------------------------------------------------------


def distort(
    xy_camera: Float[np.ndarray, "n 2"], k1: float, k2: float, p1: float, p2: float
) -> Float[np.ndarray, "n 2"]:
    """Return where a lens puts ideal image points: Brown's model, with OpenCV's signs and order.

    With r^2 = x^2 + y^2 of the ideal point,

        x' = x (1 + k1 r^2 + k2 r^4) + 2 p1 x y + p2 (r^2 + 2 x^2)
        y' = y (1 + k1 r^2 + k2 r^4) + p1 (r^2 + 2 y^2) + 2 p2 x y

    Args:
        xy_camera: Ideal normalised coordinates (X/Z, Y/Z) in the camera frame, without unit: not pixels, and not yet
            multiplied by K. One point per row; there may be none (n = 0).
        k1: Radial coefficient of r^2; negative is barrel, positive pincushion distortion.
        k2: Radial coefficient of r^4.
        p1: Tangential coefficient that acts along y.
        p2: Tangential coefficient that acts along x.

    Returns:
        Distorted normalised coordinates, in a new array: the input stays as it is.
    """
    return distortion.distort(xy_camera, float(k1), float(k2), float(p1), float(p2))


F = 600.0  # pixels: the focal length at which errors of normalised coordinates are judged
DISTORT_HINT = "All terms use x, y and r^2 of the ideal point."


def some_rays(seed: int, n: int = 60) -> np.ndarray:
    """Return ideal points up to the corners of a picture of 53 by 43 degrees."""
    return np.random.default_rng(seed).uniform(-1, 1, (n, 2)) * [0.5, 0.4]


def bent(got: np.ndarray, right: np.ndarray, hint: str = DISTORT_HINT) -> Verdict:
    """Judge normalised coordinates by the pixels by which a camera with f = 600 px would be off."""
    error = F * float(np.linalg.norm(got - right, axis=1).max(initial=0.0))
    return band("Largest error at f = 600 px", error, "px", good=0.01, fair=1.0, hint=hint)


def _bent(candidate: Function, xy: np.ndarray, *lens: float) -> Verdict:
    names = ", ".join(f"{name} = {k:g}" for name, k in zip(("k1", "k2", "p1", "p2"), lens, strict=True) if k)
    return bent(candidate(xy, *lens), distortion.distort(xy, *lens), f"With {names or 'no lens'}. {DISTORT_HINT}")


@check(1)
def no_lens(candidate: Function) -> Verdict:
    """With all coefficients zero the points stay where they are, and the centre stays with any."""
    stays = candidate(np.zeros((1, 2)), -0.3, 0.1, 0.02, -0.01)
    return worst([_bent(candidate, some_rays(STUDENTS), 0.0, 0.0, 0.0, 0.0), bent(stays, np.zeros((1, 2)))])


@check(2)
def radial(candidate: Function) -> Verdict:
    """Radial terms: barrel, pincushion and r^4 are right."""
    lenses = ((-0.3, 0.0, 0.0, 0.0), (0.2, 0.0, 0.0, 0.0), (0.0, 0.4, 0.0, 0.0))
    return worst(_bent(candidate, some_rays(STUDENTS), *lens) for lens in lenses)


@check(2)
def tangential(candidate: Function) -> Verdict:
    """Tangential terms: p1 and p2 act along the right axes."""
    return worst(
        _bent(candidate, some_rays(STUDENTS), *lens) for lens in ((0.0, 0.0, 0.02, 0.0), (0.0, 0.0, 0.0, 0.02))
    )


@check(1)
def rays_are_left_alone(candidate: Function) -> Verdict:
    """The points that come in are not changed."""
    return left_alone(candidate, _bent(candidate, some_rays(STUDENTS + 1), -0.2, 0.05, 0.01, -0.01))


@check(2, public=False)
def whole_lens(candidate: Function) -> Verdict:
    """All four terms together are right, also for no point at all."""
    lenses = ((-0.28, 0.09, 0.012, -0.007), (0.15, -0.2, -0.02, 0.015))
    verdicts = [_bent(candidate, some_rays(GRADERS + k), *lens) for k, lens in enumerate(lenses)]
    return worst([*verdicts, _bent(candidate, np.empty((0, 2)), *lenses[0])])


@check(1, public=False)
def turned_lens(candidate: Function) -> Verdict:
    """Turned about the axis together with (p2, p1), a lens moves turned points alike."""
    c, s = np.cos(0.7), np.sin(0.7)
    Q, xy, (p1, p2) = np.array([[c, -s], [s, c]]), some_rays(GRADERS + 2), (0.012, -0.02)
    q = Q @ [p2, p1]
    right = distortion.distort(xy, -0.2, 0.1, p1, p2)
    return bent(candidate(xy @ Q.T, -0.2, 0.1, float(q[1]), float(q[0])), right @ Q.T)


@check(1, public=False)
def twice_the_lens(candidate: Function) -> Verdict:
    """Twice the coefficients move every point by twice as much."""
    xy, lens = some_rays(GRADERS + 3), (-0.12, 0.06, 0.006, -0.004)
    once, twice = candidate(xy, *lens) - xy, candidate(xy, *(2 * k for k in lens)) - xy
    right = distortion.distort(xy, *lens) - xy
    return worst([bent(once, right), bent(twice, 2 * right)])


# camera_center --------------------------------------------------------------------------------------------------------


def camera_center(T_camera_world: Float[np.ndarray, "4 4"]) -> Float[np.ndarray, "3"]:
    """Return where the camera is in the world, metres.

    Args:
        T_camera_world: The rigid motion that takes world points into the camera frame: p_camera = R p_world + t, metres.
            It may be the identity.

    Returns:
        The one world point that the motion takes to the camera's own origin, in a new array.
    """
    return cameras.camera_center(T_camera_world)


CENTER_HINT = "Solve 0 = R C + t for C."


def some_cameras(seed: int, n: int = 5) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield where cameras are and their motions; no two axes of world and camera agree."""
    rng = np.random.default_rng(seed)
    for _ in range(n):
        eye = rng.normal(size=3)
        eye *= rng.uniform(2, 8) / np.linalg.norm(eye)
        yield eye, cameras.look_at(eye, rng.uniform(-1, 1, 3), rng.normal(size=3))


def placed(got: np.ndarray, right: np.ndarray) -> Verdict:
    """Judge a camera's place by the distance to the right one."""
    error = float(np.linalg.norm(got - right))
    return band("Camera is off by", error, "m", good=1e-3, fair=2e-2, hint=CENTER_HINT)


@check(2)
def where_it_stands(candidate: Function) -> Verdict:
    """Cameras that were put at known places are found there."""
    return worst(placed(candidate(T_camera_world), eye) for eye, T_camera_world in some_cameras(STUDENTS))


@check(2)
def goes_to_the_origin(candidate: Function) -> Verdict:
    """The motion takes the centre to the camera's origin."""
    verdicts = []
    for _, T_camera_world in some_cameras(STUDENTS + 1):
        p_camera = T_camera_world[:3, :3] @ candidate(T_camera_world) + T_camera_world[:3, 3]
        verdicts.append(placed(p_camera, np.zeros(3)))
    return worst(verdicts)


@check(1)
def camera_is_left_alone(candidate: Function) -> Verdict:
    """The motion that comes in is not changed."""
    eye, T_camera_world = next(some_cameras(STUDENTS + 2))
    return left_alone(candidate, placed(candidate(T_camera_world), eye))


@check(3, public=False)
def moves_with_the_world(candidate: Function) -> Verdict:
    """Where the world is moved, the centre moves along."""
    verdicts = []
    for eye, T_camera_world in some_cameras(GRADERS):
        Q = motion(exp_so3(np.array([-0.9, 0.5, 1.3])), np.array([2.0, 7.0, -1.0]))
        verdicts += [
            placed(candidate(T_camera_world), eye),
            placed(candidate(T_camera_world @ inverse(Q)), apply(Q, eye)),
        ]
    return worst(verdicts)


@check(2, public=False)
def special_cameras(candidate: Function) -> Verdict:
    """The identity, a camera that is not turned, half a turn, and one a kilometre away are found."""
    far = np.array([900.0, -300.0, 400.0])
    T_turned = motion(exp_so3(np.array([0.3, 1.0, -0.6])), far)
    cases = (np.eye(4), motion(np.eye(3), far), motion(np.diag([-1.0, -1.0, 1.0]), far), T_turned)
    found = [placed(candidate(T), inverse(T)[:3, 3]) for T in cases]
    right = sum(verdict.share == 1.0 for verdict in found)
    if right == len(found):
        return full(f"All {right} are found.")
    said = f"{right} of {len(found)} are found. {worst(found).message}"
    return partial(0.5, said) if right == 3 else fail(said)


EXERCISES = (
    Exercise(
        name="project",
        lesson="pinhole",
        slot="project",
        reference=project,
        task="Write the pinhole camera without a lens: from points in the world to pixels. The lesson lays your pixels in "
        "orange over the true photograph, so a mistake is seen where it is made.",
        checks=(
            principal_point,
            right_pixels,
            not_behind,
            scene_is_left_alone,
            whole_k,
            moves_together,
            camera_amid_points,
        ),
        mistakes=answers.PROJECT_MISTAKES,
        alternatives=(answers.project_with_one_matrix, answers.project_point_by_point),
        examples=(
            (
                "project(np.array([[1.0, 0.5, 2]]), np.eye(4), np.array([[500.0, 0, 320], [0, 500, 240], [0, 0, 1]]))",
                "[[570, 365]]",
            ),
            (
                "project(np.array([[1.0, 0, -2]]), np.eye(4), np.array([[500.0, 0, 320], [0, 500, 240], [0, 0, 1]]))",
                "[[nan, nan]]",
            ),
        ),
    ),
    Exercise(
        name="distort",
        lesson="pinhole",
        slot="distort",
        reference=distort,
        task="Write the lens: where radial and tangential distortion move ideal image points. The lesson bends the street's "
        "outlines with it; choose the presets barrel, pincushion and tangential to see it at work.",
        checks=(no_lens, radial, tangential, rays_are_left_alone, whole_lens, turned_lens, twice_the_lens),
        mistakes=answers.DISTORT_MISTAKES,
        alternatives=(answers.distort_by_coordinates, answers.distort_in_the_complex_plane),
        examples=(
            ("distort(np.array([[0.5, 0.0], [0.0, 0.0]]), -0.2, 0.0, 0.0, 0.0)", "[[0.475, 0], [0, 0]]"),
            ("distort(np.array([[0.5, 0.2]]), 0.0, 0.0, 0.01, 0.0)", "[[0.502, 0.2037]]"),
        ),
    ),
    Exercise(
        name="camera_center",
        lesson="pinhole",
        slot="camera_center",
        reference=camera_center,
        task="Write where a camera is in the world, given the motion from world to camera. The lesson's last step sends the "
        "rays back into the scene from there.",
        checks=(where_it_stands, goes_to_the_origin, camera_is_left_alone, moves_with_the_world, special_cameras),
        mistakes=answers.CENTER_MISTAKES,
        alternatives=(answers.center_by_solving, answers.center_by_inverse),
        examples=(
            ("camera_center(np.array([[1.0, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 5], [0, 0, 0, 1]]))", "[-2, 0, -5]"),
            ("camera_center(np.array([[0.0, -1, 0, 2], [1, 0, 0, 5], [0, 0, 1, 0], [0, 0, 0, 1]]))", "[-5, 2, 0]"),
        ),
    ),
)
