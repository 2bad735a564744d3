import numpy as np
import pytest

from tests.geometry.views import view
from workbench.geometry.cameras import look_at, normalize
from workbench.geometry.cameras.camera_motions import refined, rms_reprojection
from workbench.geometry.cameras.distortion import Distortion
from workbench.geometry.cameras.planar_motions import is_flat, planar_motions
from workbench.geometry.motions import apply, exp_se3, exp_so3, inverse, motion
from workbench.geometry.motions.alignment import degrees_between, nearest_rotation

SQUARE = 0.05 * np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])


def seen(T: np.ndarray, p: np.ndarray) -> np.ndarray:
    p_camera = apply(T, p)
    return p_camera[:, :2] / p_camera[:, 2:]


@pytest.mark.parametrize(
    "moved", [np.zeros(6), np.array([3.0, -2, 1, 0.5, 0.8, -0.3])], ids=["z = 0", "any plane"]
)
def test_the_truth_is_one_of_the_two(moved):
    for seed in range(12):
        T, p_world, xy = view(seed, 5 + seed, flat=True)
        p_world = apply(exp_se3(moved), p_world)
        T = T @ inverse(exp_se3(moved))
        assert np.abs(planar_motions(p_world, xy) - T).max(axis=(1, 2)).min() < 1e-6


def test_to_first_order_the_two_project_alike():
    T = look_at(np.array([0.6, 0.2, 0.9]), np.zeros(3))
    errors = []
    for scale in (1.0, 0.1):
        p = scale * SQUARE
        two = planar_motions(p, seen(T, p))
        errors.append(float(rms_reprojection(two, p, seen(T, p)).max()) / scale)
        assert degrees_between(*two) > 50
    assert errors[1] < 0.2 * errors[0]  # the difference falls faster than the size


@pytest.mark.parametrize("sign", [1.0, -1.0], ids=["z away", "z towards the camera"])
def test_exactly_frontal_both_are_one_and_right(sign):
    """OpenCV 5.0.0's IPPE says success here for z towards the camera, with a pose that misses by
    113 px.
    """
    T = motion(np.diag([1.0, sign, sign]), np.array([0.0, 0.0, 1.0]))
    two = planar_motions(SQUARE, seen(T, SQUARE))
    np.testing.assert_allclose(two, np.stack([T, T]), atol=1e-6)


def test_the_two_are_opencvs():
    cv2 = pytest.importorskip("cv2", reason="opencv-python-headless is not installed")
    for seed in range(10):
        rng = np.random.default_rng(seed)
        p = rng.uniform(-0.2, 0.2, (12, 3)) * [1, 1, 0]
        turned = exp_so3(
            np.radians(rng.uniform(15, 60)) * np.array([np.cos(seed), np.sin(seed), 0.0])
        )
        xy = seen(motion(turned, np.array([0.1, 0.0, 1.0])), p) + 3e-4 * rng.normal(size=(12, 2))
        _, turns, ts, _ = cv2.solvePnPGeneric(
            p[:, None], xy[:, None].copy(), np.eye(3), None, flags=cv2.SOLVEPNP_IPPE
        )
        theirs = [
            motion(cv2.Rodrigues(turn)[0], t.ravel()) for turn, t in zip(turns, ts, strict=True)
        ]
        for ours in planar_motions(p, xy):
            assert min(np.abs(ours - T).max() for T in theirs) < 1e-3


def test_side_by_side_is_one_by_one():
    views = [view(seed, 9, sigma=1e-3, flat=True) for seed in range(6)]
    p, xy = np.stack([sample[1] for sample in views]), np.stack([sample[2] for sample in views])
    for together, a, b in zip(planar_motions(p, xy), p, xy, strict=True):
        np.testing.assert_allclose(together, planar_motions(a, b), atol=1e-9)
    noisy = xy[0] + 1e-3 * np.random.default_rng(0).normal(size=(4, 9, 2))
    for together, b in zip(planar_motions(p[0], noisy), noisy, strict=True):
        np.testing.assert_allclose(together, planar_motions(p[0], b), atol=1e-9)


def test_what_is_no_plane_is_refused():
    _, p_world, xy = view(0, 6)
    for p in (p_world, SQUARE[:3], np.linspace(0, 1, 6)[:, None] * [1.0, 2, 0]):
        with pytest.raises(ValueError, match="four points or more of one plane"):
            planar_motions(p, xy[: len(p)])
    assert not is_flat(p_world)
    assert is_flat(SQUARE + 1e4)


def test_the_stereo_rig_has_one_motion_in_all_views(shared_data):
    """Left and right camera of 13 views of a board, their K and lens as cv2.calibrateCamera finds
    them (k3 = 0).
    """
    corners = np.load(shared_data / "calibration" / "corners_9x6.npz")
    board = corners["object_points"].astype(float)
    lenses = {
        "left": ((536.46, 536.41, 342.37, 235.55), Distortion(-0.2786, 0.0672, 0.0018, -0.0003)),
        "right": ((542.27, 541.53, 328.31, 246.98), Distortion(-0.2777, 0.0886, -0.0006, 0.0013)),
    }
    limits = {
        "whole board": (slice(None), 0.25, 84.0, 0.5),
        "inner corners": ([21, 22, 30, 31], 1.0, 83.1, 3.0),
    }
    for rows, degrees, millimetres, spread in limits.values():
        p = board[rows]
        poses = {}
        same = []
        for side, ((fx, fy, cx, cy), lens) in lenses.items():
            K = np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]])
            views = [normalize(uv.astype(float), K, lens)[rows] for uv in corners[side]]
            both = [refined(planar_motions(p, xy), p, xy) for xy in views]
            same += [degrees_between(*two) < 1 for two in both]
            poses[side] = [
                two[np.argmin(rms_reprojection(two, p, xy))]
                for two, xy in zip(both, views, strict=True)
            ]
        rig = [
            right @ inverse(left) for left, right in zip(poses["left"], poses["right"], strict=True)
        ]
        R = nearest_rotation(np.sum([T[:3, :3] for T in rig], axis=0))
        baselines = 1e3 * np.linalg.norm([T[:3, 3] for T in rig], axis=1)
        assert np.median([degrees_between(T[:3, :3], R) for T in rig]) < degrees
        # cv2.stereoCalibrate says 83.6
        assert np.median(baselines) == pytest.approx(millimetres, abs=0.3)
        assert np.subtract(*np.percentile(baselines, [75, 25])) < spread
        if len(p) == 54:
            assert np.mean(same) > 0.8  # of the whole board both refine to one
        else:
            assert not any(same)  # 25 mm: two poses, and the better one is right in all of 26
            assert max(degrees_between(T[:3, :3], R) for T in rig) < 3
