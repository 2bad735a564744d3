import numpy as np

from workbench.data.shapes.lidar import Street, lidar_pair, lidar_scan
from workbench.geometry.motions import apply, exp_so3, motion

NOWHERE = np.empty((0, 7)), np.empty((0, 3))


def scan(boxes, poles, T) -> np.ndarray:
    """The points in the world, without noise."""
    scene = Street(np.array(boxes, float).reshape(-1, 7), np.array(poles, float).reshape(-1, 3))
    return apply(T, lidar_scan(scene, T, np.random.default_rng(0), columns=200, noise=0.0))


def sensor(x: float = 0.0, turn: float = 0.0) -> np.ndarray:
    return motion(exp_so3(np.array([0.0, 0.0, turn])), np.array([x, 0.0, 1.73]))


def test_the_ground_is_seen_in_rings():
    p = scan(*NOWHERE, sensor())
    assert np.abs(p[:, 2]).max() < 1e-9
    radii = np.unique(np.hypot(p[:, 0], p[:, 1]).round(6))
    assert len(radii) < 64
    assert 3.7 < radii.min() < 3.8  # 1.73 m high, 24.8 degrees down


def test_every_hit_lies_on_what_was_hit():
    p = scan([[6.0, 0.0, 1.0, 1.0, 2.0, 1.0, 0.3]], [[0.0, 5.0, 0.2]], sensor(turn=0.4))
    on_ground = np.abs(p[:, 2]) < 1e-9
    q = (p - [6.0, 0.0, 1.0]) @ exp_so3(np.array([0.0, 0.0, 0.3]))
    on_box = np.isclose(np.abs(q) / [1.0, 2.0, 1.0], 1.0).any(axis=1) & (
        np.abs(q) <= np.array([1, 2, 1]) + 1e-9
    ).all(axis=1)
    on_pole = np.isclose(np.hypot(p[:, 0], p[:, 1] - 5.0), 0.2)
    assert (on_ground | on_box | on_pole).all()
    assert on_box.sum() > 50
    assert on_pole.sum() > 10
    behind = on_ground & (np.abs(p[:, 1]) < 0.5) & (p[:, 0] > 7.5) & (p[:, 0] < 9.0)
    assert not behind.any()  # the box hides it


def test_the_rings_move_with_the_scanner_and_the_street_does_not():
    T = motion(exp_so3(np.array([0.0, 0.0, 0.1])), np.array([0.5, 0.0, 0.0]))
    first, second = lidar_pair(T, np.random.default_rng(3), rings=16, columns=100, noise=0.0)
    again, _ = lidar_pair(T, np.random.default_rng(3), rings=16, columns=100, noise=0.0)
    np.testing.assert_array_equal(first, again)
    radii = [
        set(np.hypot(p[:, 0], p[:, 1])[np.abs(p[:, 2] + 1.73) < 1e-9].round(6))
        for p in (first, second)
    ]
    assert radii[0] == radii[1]  # each in its own frame
