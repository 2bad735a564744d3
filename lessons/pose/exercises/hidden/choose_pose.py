"""What choose_pose is graded by besides the checks that a student sees."""

import numpy as np

from lessons.pose.exercises import GRADERS, a_view
from lessons.pose.exercises.choose_pose import judged, seen, several, with_twin
from workbench.algorithms.cameras import camera_search
from workbench.exercise import Function, Verdict, check, worst
from workbench.geometry.motions import apply, exp_so3, motion


def half_behind(seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return a pose amid the points, which fits most of them, and one that is somewhat off and has
    all in front.
    """
    T, p_world, _ = a_view(np.random.default_rng(seed), 12)
    amid, off = T.copy(), T.copy()
    amid[2, 3] -= 0.5 * (apply(T, p_world)[:, 2].min() + np.median(apply(T, p_world)[:, 2]))
    off[:2, 3] += 8.0
    p_camera = apply(amid, p_world)
    return np.stack([amid, off]), p_world, p_camera[:, :2] / p_camera[:, 2:]


def told_apart(seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return poses of which the least root mean square chooses another one than each of four sums
    like it.
    """
    rng = np.random.default_rng(seed)
    while True:
        T, p_world, xy = a_view(rng, 7)
        Ts = np.stack(
            [
                motion(exp_so3(0.003 * rng.normal(size=3)), 0.02 * rng.normal(size=3)) @ T
                for _ in range(6)
            ]
        )
        xy = xy + 1e-3 * rng.standard_t(2, xy.shape)
        off = seen(Ts, p_world)[0] - xy
        away = np.linalg.norm(off, axis=2)
        rms = np.sqrt(np.square(away).mean(axis=1))
        others = (
            away.mean(axis=1),
            np.median(away, axis=1),
            np.abs(off).sum(axis=(1, 2)),
            away.max(axis=1),
        )
        first, second = np.sort(rms)[:2]
        if second > 1.02 * first and rms.argmin() not in [other.argmin() for other in others]:
            return Ts, p_world, xy


@check(2, public=False)
def some_points_behind(candidate: Function) -> Verdict:
    """A pose amid the points is refused too."""
    return worst(
        judged(candidate, *half_behind(GRADERS() + k), "All points have to be in front.")
        for k in range(2)
    )


@check(2, public=False)
def of_other_points(candidate: Function) -> Verdict:
    """Other points, noisier, a single pose, many poses, and a single point."""
    poses, p_world, xy = several(GRADERS() + 30)
    verdicts = [judged(candidate, *several(GRADERS() + 10 + k, 20, 3e-3)) for k in range(8)]
    many, p, seen_at = told_apart(GRADERS() + 31)
    nearest = camera_search.choose_pose(many, p, seen_at)
    last = np.concatenate(
        [many[np.abs(many - nearest).max(axis=(1, 2)) > 0], many + np.eye(4, k=3), nearest[None]]
    )
    others = ((poses[:1], p_world, xy), (last, p, seen_at), (last, p[:1], seen_at[:1]))
    return worst([*verdicts, *(judged(candidate, *case) for case in others)])


@check(1, public=False)
def the_root_mean_square_decides(candidate: Function) -> Verdict:
    """It is the root mean square that is least, not the mean, the median, the sum of |dx| + |dy| or
    the largest.
    """
    hint = "Square the distances, both coordinates of all points, and take their mean."
    return worst(judged(candidate, *told_apart(GRADERS() + 50 + k), hint) for k in range(3))


@check(1, public=False)
def of_small_things(candidate: Function) -> Verdict:
    """Points some millimetres before the camera are in front too, and those beside it, at Z = 0,
    are not.
    """
    Ts, p_world, xy = several(GRADERS() + 60)
    # right: last
    near = Ts[
        np.argsort(np.abs(Ts - camera_search.choose_pose(Ts, p_world, xy)).sum(axis=(1, 2)))[::-1]
    ]
    verdicts = []
    for size in (5e-3, 1e-4):
        small = near.copy()
        small[:, :3, 3] *= size
        verdicts.append(
            judged(candidate, small, size * p_world, xy, "Z > 0 is in front, however near.")
        )
    # the first is at Z = 0 for the first pose
    p = np.array([[0.0, 0.0, 0.0], [0.5, 0.25, 1.0], [-0.25, 0.5, 2.0]])
    Ts = np.stack([np.eye(4), np.eye(4)])
    Ts[1, :3, 3] = 0.5, 0.5, 1.0
    xy = np.array([[0.0, 0.0], [0.5, 0.25], [-0.125, 0.25]])
    verdicts.append(judged(candidate, Ts, p, xy, "A point at Z = 0 is not in front."))
    return worst(verdicts)


@check(1, public=False)
def none_in_front(candidate: Function) -> Verdict:
    """Where none has all points in front, it is the first, however many there are and whatever the
    others see.
    """
    Ts, p_world, xy = with_twin(GRADERS() + 40)
    behind = np.stack([Ts[0], np.diag([-1.0, 1.0, -1.0, 1.0]) @ Ts[1]])
    amid = half_behind(GRADERS() + 41)
    # it sees all points turned round, behind it
    none = np.diag([-1.0, 1.0, -1.0, 1.0]) @ amid[0][1]
    # none, most and none of the points in front
    more = np.stack([none, amid[0][0], none + np.eye(4, k=3)])
    hint = "None is in front: return the first."
    cases = ((behind[::-1].copy(), p_world, xy), (more, *amid[1:]), (behind[:1], p_world, xy))
    return worst(judged(candidate, *case, hint) for case in cases)
