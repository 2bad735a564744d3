"""The exercises of this lesson: find partners, align pairs, step towards planes. All judged in degrees and metres."""

import numpy as np
from jaxtyping import Float, Int

from lessons.icp import answers
from workbench.algorithms.icp import nearest
from workbench.exercise.judging import left_alone, motion_verdict, refused, rotation_verdict, worst
from workbench.exercise.model import Exercise, Function, Verdict, band, check, fail, full, partial
from workbench.geometry import alignment
from workbench.geometry.motions import apply, exp_so3, motion

STUDENTS, GRADERS = 37, 8620  # seeds of what a student sees run, and of what only a grader does

# align_rigid ----------------------------------------------------------------------------------------------------------


def align_rigid(p_target: Float[np.ndarray, "n 3"], p_source: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "4 4"]:
    """Return the rigid motion T_target_source that brings paired points closest together.

    It minimises the sum of the squared distances |p_target - (R p_source + t)| over all rotations R and translations t.

    Args:
        p_target: Points in the target frame, metres.
        p_source: Their partners in the source frame, metres: row k belongs to row k.

    Returns:
        The 4x4 motion with R in the upper left, t in the last column and (0, 0, 0, 1) as last row. R is always a rotation
        with determinant 1, also where a mirror image would fit better: flat clouds with noise, mirrored clouds. Points on
        one line, or a single pair, leave a part of the turn open; any one of the best motions is right then.

    Raises:
        ValueError: If there are no pairs (n = 0).
    """
    return alignment.align_rigid(p_target, p_source)


ALIGN_HINT = "Centre both clouds, take the SVD of their covariance, and see which way round R belongs."


def a_motion(rng: np.random.Generator, degrees: float, metres: float = 1.0) -> np.ndarray:
    """Return a motion that turns by this angle about a random axis."""
    axis, shift = rng.normal(size=(2, 3))
    turn, way = axis / np.linalg.norm(axis), shift / np.linalg.norm(shift)
    return motion(exp_so3(np.radians(degrees) * turn), metres * way)


def a_cloud(rng: np.random.Generator, n: int = 60) -> np.ndarray:
    """Return points of a lump half a metre in size, aside from the origin."""
    return rng.normal(size=(n, 3)) * [0.5, 0.3, 0.2] + [0.4, -0.7, 0.3]


def aligned(candidate: Function, p_target: np.ndarray, p_source: np.ndarray, hint: str = ALIGN_HINT) -> Verdict:
    """Judge by the least-squares motion: in degrees, and in metres at the points."""
    return motion_verdict(candidate(p_target, p_source), alignment.align_rigid(p_target, p_source), hint, p=p_source)


@check(2)
def exact_pairs(candidate: Function) -> Verdict:
    """Exact pairs 20, 60 and 120 degrees apart are brought together."""
    verdicts = []
    for k, degrees in enumerate((20.0, 60.0, 120.0)):
        rng = np.random.default_rng(STUDENTS + k)
        T, p_source = a_motion(rng, degrees), a_cloud(rng)
        found = candidate(apply(T, p_source), p_source)
        verdicts.append(motion_verdict(found, T, f"{degrees:g} degrees apart. {ALIGN_HINT}", p=p_source))
    return worst(verdicts)


@check(2)
def turned_rod(candidate: Function) -> Verdict:
    """A rod turned by up to 170 degrees is turned back, though its ends look alike: half a turn leaves a small residual."""
    rng, verdicts = np.random.default_rng(STUDENTS + 5), []
    for degrees in (170.0, 120.0, -170.0):
        p_source = rng.normal(size=(80, 3)) * [0.6, 0.012, 0.01]
        T = motion(exp_so3(np.radians(degrees) * np.array([0.0, 0.6, 0.8])), np.array([0.2, 0.1, -0.3]))
        verdicts.append(motion_verdict(candidate(apply(T, p_source), p_source), T, ALIGN_HINT, p=p_source))
    return worst(verdicts)


@check(1)
def pairs_are_left_alone(candidate: Function) -> Verdict:
    """The clouds that come in are not changed."""
    rng = np.random.default_rng(STUDENTS + 6)
    p_source = a_cloud(rng)
    return left_alone(candidate, aligned(candidate, apply(a_motion(rng, 50.0), p_source), p_source))


@check(1, public=False)
def noisy_pairs(candidate: Function) -> Verdict:
    """With 2 cm of noise the least-squares motion is found, from target to source and back."""
    verdicts = []
    for k in range(3):
        rng = np.random.default_rng(GRADERS + k)
        p_source = a_cloud(rng, 200)
        p_target = apply(a_motion(rng, 60.0 + 40.0 * k), p_source) + 0.02 * rng.normal(size=p_source.shape)
        verdicts += [aligned(candidate, p_target, p_source), aligned(candidate, p_source, p_target)]
    return worst(verdicts)


@check(2, public=False)
def no_mirror_image(candidate: Function) -> Verdict:
    """Flat clouds with noise, and mirrored ones, are turned and not mirrored."""
    verdicts = []
    for k in range(8):
        rng = np.random.default_rng(GRADERS + 10 + k)
        flat = a_cloud(rng) * [1.0, 1.0, 0.0]
        p_target = apply(a_motion(rng, 20.0 * k), flat) + 0.01 * rng.normal(size=flat.shape)
        verdicts.append(aligned(candidate, p_target, flat, "Is the determinant of R 1 here?"))
        solid = a_cloud(rng)
        mirrored = apply(a_motion(rng, 20.0 * k), solid * [1.0, 1.0, -1.0])
        verdicts.append(aligned(candidate, mirrored, solid, "The cloud is mirrored: is the determinant of R 1?"))
    return worst(verdicts)


@check(1, public=False)
def far_away(candidate: Function) -> Verdict:
    """Clouds ten kilometres from the origin are aligned as well."""
    rng = np.random.default_rng(GRADERS + 30)
    p_source = a_cloud(rng) + np.array([10_000.0, -4_000.0, 300.0])
    p_target = apply(a_motion(rng, 75.0), p_source - p_source.mean(0)) + np.array([-6_000.0, 8_000.0, 0.0])
    return aligned(candidate, p_target, p_source)


@check(1, public=False)
def points_on_a_line(candidate: Function) -> Verdict:
    """Points on one line, and a single pair, get one of their best motions; no pairs are refused."""
    rng = np.random.default_rng(GRADERS + 40)
    line = np.outer(np.linspace(-1, 1, 9), [0.6, 0.0, 0.8]) + 0.3
    T = a_motion(rng, 65.0)
    verdicts = [refused(candidate, np.empty((0, 3)), np.empty((0, 3)), what="A call without pairs")]
    for what, p_source in (("Points on a line", line), ("A single pair", line[:1])):
        got, p_target = candidate(apply(T, p_source), p_source), apply(T, p_source)
        away = float(np.linalg.norm(apply(got, p_source) - p_target, axis=1).max())
        verdicts.append(rotation_verdict(got[:3, :3], got[:3, :3], f"{what}. {ALIGN_HINT}"))
        verdicts.append(band(f"{what}: largest distance left", away, "m", good=1e-3, fair=2e-2, hint=ALIGN_HINT))
    return worst(verdicts)


# match ----------------------------------------------------------------------------------------------------------------


def match(p_target: Float[np.ndarray, "m 3"], p_source: Float[np.ndarray, "n 3"]) -> Int[np.ndarray, "n"]:
    """Return for each source point the index of the target point nearest to it.

    Args:
        p_target: The cloud to find partners in, metres.
        p_source: The points that want a partner, metres; in the target frame, as ICP has moved them so far.

    Returns:
        n whole numbers from 0 to m - 1, Euclidean distances deciding. Several source points may share a partner, and target
        points may stay without one. Where two target points are equally near, either is right.

    Raises:
        ValueError: If there is no target point (m = 0).
    """
    return np.asarray(nearest(p_target, p_source), dtype=np.int64)


MATCH_HINT = "For each source point on its own: the smallest Euclidean distance to all target points."


def nearest_found(candidate: Function, p_target: np.ndarray, p_source: np.ndarray, hint: str = MATCH_HINT) -> Verdict:
    """Judge partners by their distance: all for the nearest everywhere, half where 19 of 20 have it."""
    indices = candidate(p_target, p_source)
    outside = int(((indices < 0) | (indices >= len(p_target))).sum())
    if outside:
        return fail(f"{outside} indices are outside 0 to {len(p_target) - 1}. {hint}")
    best = np.linalg.norm(p_target[nearest(p_target, p_source)] - p_source, axis=1)
    more = np.linalg.norm(p_target[indices] - p_source, axis=1) - best
    wrong = int((more > 1e-9).sum())
    said = f"{wrong} of {len(indices)} partners are not the nearest, by up to {more.max(initial=0.0):.2g} m."
    if wrong == 0:
        return full(f"All {len(indices)} partners are the nearest.")
    return partial(0.5, f"{said} {hint}") if wrong <= 0.05 * len(indices) else fail(f"{said} {hint}")


def two_clouds(seed: int, m: int, n: int) -> tuple[np.ndarray, np.ndarray]:
    """Return m target and n source points of one room, one metre in size."""
    rng = np.random.default_rng(seed)
    return rng.uniform(0, 1, (m, 3)), rng.uniform(0, 1, (n, 3))


@check(2)
def few_points(candidate: Function) -> Verdict:
    """Four points find their partners among three, and two of them share one."""
    p_target = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    p_source = np.array([[0.9, 0.1, 0.2], [0.2, 0.1, 0.9], [1.4, 0.2, 0.3], [0.1, -0.2, 0.1]])
    return nearest_found(candidate, p_target, p_source, f"Asked for were [1, 2, 1, 0]. {MATCH_HINT}")


@check(2)
def two_scans(candidate: Function) -> Verdict:
    """In clouds of 150 and 200 points every source point gets its nearest."""
    return nearest_found(candidate, *two_clouds(STUDENTS, 150, 200))


@check(1)
def clouds_are_left_alone(candidate: Function) -> Verdict:
    """The clouds that come in are not changed."""
    return left_alone(candidate, nearest_found(candidate, *two_clouds(STUDENTS + 1, 30, 40)))


@check(2, public=False)
def uneven_clouds(candidate: Function) -> Verdict:
    """Few targets for many points, many for few, and a single one are all served."""
    sizes = ((7, 300), (300, 7), (1, 20), (90, 90))
    return worst(nearest_found(candidate, *two_clouds(GRADERS + k, m, n)) for k, (m, n) in enumerate(sizes))


@check(1, public=False)
def moved_clouds(candidate: Function) -> Verdict:
    """Moving both clouds a thousand kilometres away and turning them changes no partner."""
    verdicts = []
    for k in range(3):
        p_target, p_source = two_clouds(GRADERS + 10 + k, 120, 100)
        T = a_motion(np.random.default_rng(GRADERS + k), 100.0, 1e6)
        verdicts.append(
            nearest_found(candidate, apply(T, p_target), apply(T, p_source), "Far from the origin. " + MATCH_HINT)
        )
    return worst(verdicts)


@check(1, public=False)
def double_points(candidate: Function) -> Verdict:
    """Target points that occur twice do no harm."""
    p_target, p_source = two_clouds(GRADERS + 20, 40, 60)
    return nearest_found(candidate, np.vstack([p_target, p_target]), np.vstack([p_source, p_target]))


@check(1, public=False)
def no_target(candidate: Function) -> Verdict:
    """A target without points is refused."""
    return refused(candidate, np.empty((0, 3)), two_clouds(GRADERS, 1, 5)[1], what="An empty target")


# point_to_plane_step --------------------------------------------------------------------------------------------------


def point_to_plane_step(
    p_target: Float[np.ndarray, "n 3"], p_source: Float[np.ndarray, "n 3"], n_target: Float[np.ndarray, "n 3"]
) -> Float[np.ndarray, "4 4"]:
    """Return the small rigid motion that brings points closest to the tangent planes at their partners.

    Solve the linear least-squares problem in the rotation vector w (radians) and the translation v (metres),

        sum of ((p_source + w x p_source + v - p_target) . n_target)^2,

    and return the motion that turns by |w| about w and shifts by v. You may count w from the origin or from the centroid
    of p_source, as long as the motion that you return is that of the points: near the solution both are the same.

    Args:
        p_target: A point on each plane, target frame, metres.
        p_source: The points to move, row k towards plane k; in the target frame too, moved by the motion so far.
        n_target: Unit normals of the planes, target frame. Either sign is right: n and -n are one plane.

    Returns:
        The 4x4 motion to be composed on the left, T_target_source = step @ T_target_source, with a proper rotation.
        Directions that the planes leave open (sliding along a single plane) get the smallest motion, none.
    """
    return alignment.point_to_plane_step(p_target, p_source, n_target)


STEP_HINT = "Each pair gives one row: (p_source x n, n) times (w, v) is (p_target - p_source) . n."


def planes(rng: np.random.Generator, n: int = 80) -> tuple[np.ndarray, np.ndarray]:
    """Return points and unit normals of a closed, uneven surface half a metre in size, aside from the origin."""
    n_target = rng.normal(size=(n, 3))
    n_target /= np.linalg.norm(n_target, axis=1, keepdims=True)
    return n_target * [0.6, 0.4, 0.25] + [0.2, -0.1, 0.3], n_target


def slid(rng: np.random.Generator, p: np.ndarray, normals: np.ndarray, metres: float = 0.1) -> np.ndarray:
    """Return other points of the same planes: nearest neighbours are never the very same points."""
    return p + np.cross(normals, rng.normal(size=p.shape)) * metres


def arrived(candidate: Function, seed: int, degrees: float, metres: float, aside: float = 0.0) -> Verdict:
    """Judge the motion that six steps make of a start that is this far off."""
    rng = np.random.default_rng(seed)
    p_true, n_target = planes(rng)
    p_true = p_true + np.array([aside, 0.0, 0.0])
    p_target, off, c = slid(rng, p_true, n_target), a_motion(rng, degrees, metres), p_true.mean(0)
    p_source = apply(off, p_true - c) + c
    T = np.eye(4)
    for _ in range(6):
        T = candidate(p_target, apply(T, p_source), n_target) @ T
        if not np.abs(T).max() < 1e9:
            return fail(f"The steps run away: after six a number is {np.abs(T).max():.2g}. {STEP_HINT}")
    away = motion(off[:3, :3], c + off[:3, 3] - off[:3, :3] @ c)
    return motion_verdict(T @ away, np.eye(4), STEP_HINT, p=p_true)


@check(1)
def shift_only(candidate: Function) -> Verdict:
    """Points that are only shifted come back in one step, though their partners lie elsewhere on the planes."""
    rng = np.random.default_rng(STUDENTS)
    p_true, n_target = planes(rng)
    right = motion(np.eye(3), np.array([0.03, -0.05, 0.08]))
    p_target = slid(rng, apply(right, p_true), n_target)
    return motion_verdict(candidate(p_target, p_true, n_target), right, STEP_HINT, p=p_true)


@check(3)
def steps_arrive(candidate: Function) -> Verdict:
    """Six steps from 12 degrees and 10 cm away arrive within 0.1 degrees and a millimetre."""
    return worst(arrived(candidate, STUDENTS + k, 12.0, 0.1) for k in range(2))


@check(1)
def planes_are_left_alone(candidate: Function) -> Verdict:
    """Points and normals are not changed."""
    rng = np.random.default_rng(STUDENTS + 3)
    p_true, n_target = planes(rng)
    p_source = apply(a_motion(rng, 1.0, 0.02), p_true)
    return left_alone(candidate, _stepped(candidate(p_true, p_source, n_target), p_true, p_source, n_target))


def _stepped(step: np.ndarray, p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray) -> Verdict:
    right = alignment.point_to_plane_step(p_target, p_source, n_target)
    return motion_verdict(step, right, STEP_HINT, p=p_source)


@check(2, public=False)
def noisy_step(candidate: Function) -> Verdict:
    """With noise and normals of either sign, one step is the least-squares step."""
    verdicts = []
    for k in range(3):
        rng = np.random.default_rng(GRADERS + k)
        p_true, n_target = planes(rng, 150)
        p_source = apply(a_motion(rng, 1.5, 0.02), p_true) + 0.01 * rng.normal(size=p_true.shape)
        p_target, signs = slid(rng, p_true, n_target), rng.choice([-1.0, 1.0], (150, 1))
        verdicts.append(_stepped(candidate(p_target, p_source, signs * n_target), p_target, p_source, n_target))
    return worst(verdicts)


@check(2, public=False)
def steps_arrive_elsewhere(candidate: Function) -> Verdict:
    """Six steps arrive from other starts too, also five metres from the origin."""
    return worst([arrived(candidate, GRADERS + 10, 15.0, 0.1), arrived(candidate, GRADERS + 11, 8.0, 0.05, aside=5.0)])


@check(1, public=False)
def sliding(candidate: Function) -> Verdict:
    """A single plane pulls points onto itself and does not slide or spin them."""
    rng = np.random.default_rng(GRADERS + 20)
    flat = rng.uniform(-1, 1, (40, 3)) * [1.0, 1.0, 0.0]
    flat -= flat.mean(0)
    n_target = np.tile([0.0, 0.0, 1.0], (40, 1))
    p_target = flat + rng.uniform(-0.2, 0.2, flat.shape) * [1.0, 1.0, 0.0]
    right = motion(np.eye(3), np.array([0.0, 0.0, -0.04]))
    lifted = flat + np.array([0.0, 0.0, 0.04])
    return motion_verdict(
        candidate(p_target, lifted, n_target), right, "What no plane holds stays. " + STEP_HINT, p=lifted
    )


EXERCISES = (
    Exercise(
        name="align_rigid",
        lesson="icp",
        slot="align",
        reference=align_rigid,
        task="Write the rigid alignment of paired points (Kabsch), with the mirror image ruled out. The lesson's fit steps "
        "are made by it; it is judged in degrees and metres, never by its residual.",
        checks=(
            exact_pairs,
            turned_rod,
            pairs_are_left_alone,
            noisy_pairs,
            no_mirror_image,
            far_away,
            points_on_a_line,
        ),
        mistakes=answers.ALIGN_MISTAKES,
        alternatives=(answers.align_by_svd, answers.align_by_quaternion),
        examples=(
            (
                "align_rigid(np.array([[2.0, 0, 0], [3, 0, 0], [2, 1, 0]]), np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]))",
                "[[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]",
            ),
            (
                "align_rigid(np.array([[0.0, 0, 0], [0, 1, 0], [-1, 0, 0]]), np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]))",
                "[[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]",
            ),
        ),
    ),
    Exercise(
        name="match",
        lesson="icp",
        slot="match",
        reference=match,
        task="Write ICP's first half: for every source point the index of its nearest target point. The lesson draws your "
        "correspondences, and fits the motion to them.",
        checks=(few_points, two_scans, clouds_are_left_alone, uneven_clouds, moved_clouds, double_points, no_target),
        mistakes=answers.MATCH_MISTAKES,
        alternatives=(answers.match_all_at_once, answers.match_one_by_one, answers.match_with_a_tree),
        examples=(
            ("match(np.array([[0.0, 0, 0], [1, 0, 0]]), np.array([[0.9, 0, 0], [0.2, 0, 0], [5, 0, 0]]))", "[1, 0, 1]"),
            ("match(np.array([[0.0, 0, 0], [0, 0, 1]]), np.array([[0.0, 0, 0.7]]))", "[1]"),
        ),
    ),
    Exercise(
        name="point_to_plane_step",
        lesson="icp",
        slot="step",
        reference=point_to_plane_step,
        task="Write one linear point-to-plane step: the small motion that brings points closest to the tangent planes at "
        "their partners. The lesson uses it where its fit is point-to-plane: choose the preset plane to watch yours.",
        checks=(shift_only, steps_arrive, planes_are_left_alone, noisy_step, steps_arrive_elsewhere, sliding),
        mistakes=answers.STEP_MISTAKES,
        alternatives=(answers.step_about_the_origin, answers.step_by_pseudo_inverse),
        examples=(
            (
                "point_to_plane_step(np.array([[9.0, 0, 0]]), np.array([[0.0, 0, 0]]), np.array([[0.0, 0, 1]]))",
                "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]",
            ),
            (
                "point_to_plane_step(np.array([[9.0, 0, 0]]), np.array([[0.0, 0, 0.5]]), np.array([[0.0, 0, 1]]))",
                "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, -0.5], [0, 0, 0, 1]]",
            ),
        ),
    ),
)
