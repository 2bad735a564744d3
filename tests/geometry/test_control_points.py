"""EPnP: against planted poses, OpenCV's, and as often as it fails on four points."""

import numpy as np
import pytest

from tests.geometry.views import view
from workbench.geometry.cameras.camera_motions import rms_reprojection, sqpnp
from workbench.geometry.cameras.control_points import epnp
from workbench.geometry.motions import apply, exp_se3
from workbench.geometry.motions.alignment import degrees_between

PIXEL = 1 / 800


def views(n: int, count: int, *, sigma: float = PIXEL, flat: bool = False):
    samples = [view(seed, n, sigma=sigma, flat=flat) for seed in range(count)]
    return tuple(np.stack([sample[k] for sample in samples]) for k in range(3))


def far(Ts: np.ndarray, Ts_true: np.ndarray) -> float:
    return float(
        np.mean([degrees_between(T, T_true) > 5 for T, T_true in zip(Ts, Ts_true, strict=True)])
    )


@pytest.mark.parametrize(
    ("n", "flat"), [(5, False), (6, False), (60, False), (4, True), (12, True)]
)
def test_exact_points_give_the_pose_back(n, flat):
    Ts, p_world, xy = views(n, 50, sigma=0.0, flat=flat)
    np.testing.assert_allclose(epnp(p_world, xy), Ts, atol=1e-6)


@pytest.mark.parametrize("n", [6, 10, 50])
def test_epnp_is_opencvs(n):
    cv2 = pytest.importorskip("cv2", reason="opencv-python-headless is not installed")
    Ts, p_world, xy = views(n, 300)
    errors, apart = [], []
    for T, p, seen, T_true in zip(epnp(p_world, xy), p_world, xy, Ts, strict=True):
        _, turn, t = cv2.solvePnP(
            p[:, None], seen[:, None].copy(), np.eye(3), None, flags=cv2.SOLVEPNP_EPNP
        )
        R = cv2.Rodrigues(turn)[0]
        apart.append(degrees_between(T[:3, :3], R))
        errors.append([degrees_between(T, T_true), degrees_between(R, T_true[:3, :3])])
        np.testing.assert_allclose(T[:3, 3], t.ravel(), atol=0.2)
    ours, theirs = np.median(errors, axis=0)
    assert np.median(apart) < 0.5 * theirs  # nearer to each other than to the truth
    assert ours == pytest.approx(theirs, rel=0.1)


def test_four_points_are_too_few_where_sqpnp_hardly_fails():
    """OpenCV 5.0.0's EPnP is over 5 degrees off in 29 % of these pictures, its SQPnP in 1.8 %."""
    Ts, p_world, xy = views(4, 400)
    assert 0.08 < far(epnp(p_world, xy), Ts) < 0.15
    # 5 or 6 of 400, by how the machine rounds; never as many as OpenCV's
    assert far(sqpnp(p_world, xy), Ts) < 0.018
    exact = views(4, 400, sigma=0.0)
    assert 0.10 < far(epnp(*exact[1:]), Ts) < 0.2  # it is not the noise
    for n in (5, 6, 20):
        Ts, p_world, xy = views(n, 200)
        assert far(epnp(p_world, xy), Ts) == 0


def test_points_of_a_plane_have_three_control_points():
    """OpenCV 5.0.0's EPnP, which takes four, is over 5 degrees off in 57 % of these pictures, its
    SQPnP in 1.5 %.
    """
    Ts, p_world, xy = views(8, 200, flat=True)
    assert far(epnp(p_world, xy), Ts) < 0.04


def test_moving_the_world_moves_the_answer_and_side_by_side_is_one_by_one():
    for flat in (False, True):
        _, p_world, xy = views(9, 12, flat=flat)
        together = epnp(p_world, xy)
        T_moved = exp_se3(np.array([3.0, -2.0, 5.0, 0.4, -1.0, 2.0]))
        for T, p, seen in zip(together, p_world, xy, strict=True):
            np.testing.assert_allclose(epnp(p, seen), T, atol=1e-7)
            np.testing.assert_allclose(epnp(apply(T_moved, p), seen) @ T_moved, T, atol=1e-6)


def test_the_order_of_four_points_does_not_matter():
    _, p_world, xy = views(4, 100)
    apart = np.abs(epnp(p_world, xy) - epnp(p_world[:, [2, 0, 3, 1]], xy[:, [2, 0, 3, 1]])).max(
        axis=(1, 2)
    )
    assert np.mean(apart < 1e-3) > 0.95  # of many null vectors rounding would choose


def test_flat_and_solid_points_may_be_solved_side_by_side():
    solid = views(8, 3)
    flat = views(8, 3, flat=True)
    p_world, xy = (
        np.concatenate([a, b])[[0, 3, 1, 4, 2, 5]] for a, b in zip(solid[1:], flat[1:], strict=True)
    )
    assert rms_reprojection(epnp(p_world, xy), p_world, xy).max() < 5 * PIXEL


def test_an_origin_ten_kilometres_off_changes_nothing():
    T, p_world, xy = view(3, 30)
    far_off = np.array([7800.0, 6200.0, 400.0])
    np.testing.assert_allclose(epnp(p_world + far_off, xy)[:3, :3], T[:3, :3], atol=1e-8)


def test_what_cannot_be_solved_is_refused_or_comes_to_an_end():
    _, p_world, xy = view(0, 6)
    with pytest.raises(ValueError, match="four points or more, not 3"):
        epnp(p_world[:3], xy[:3])
    with pytest.raises(ValueError, match="one line"):
        epnp(np.linspace(0, 1, 6)[:, None] * [1.0, 2.0, 3.0], xy)
    assert np.isfinite(epnp(p_world, np.zeros((6, 2)))).all()  # all seen in one place
    assert np.isfinite(
        epnp(p_world, np.random.default_rng(0).normal(size=(6, 2)))
    ).all()  # seen anywhere
