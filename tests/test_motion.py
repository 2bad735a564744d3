"""What only moves is seen on its way: it starts and ends where the steps say, turns evenly, and stays rigid."""

from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from workbench.motion import eased, moves, way
from workbench.scene import Caption, Points, Segments, is_rigid


def pose(degrees: float, t: tuple[float, float, float]) -> np.ndarray:
    T = np.eye(4)
    T[:3, :3] = Rotation.from_rotvec([0, 0, degrees], degrees=True).as_matrix()
    T[:3, 3] = t
    return T


CLOUD = Points(np.array([[4.0, 0, 0], [6.0, 0, 0]]), T_world_object=None)
LINES = Segments(np.ones((2, 2, 3)))
BEFORE: dict[str, Any] = {"cloud": CLOUD, "still": Points(np.eye(3)), "lines": LINES, "caption": Caption("Before.")}
AFTER: dict[str, Any] = {
    "cloud": Points(CLOUD.p, T_world_object=pose(80, (1, 2, 3))),
    "still": BEFORE["still"],
    "lines": Segments(np.zeros((2, 2, 3))),
    "caption": Caption("After."),
}


def on_its_way(*shares: float) -> np.ndarray:
    found = way(BEFORE, AFTER, shares)
    assert found is not None
    assert set(found.poses) == {"cloud"}
    cloud = found.scene["cloud"]
    assert isinstance(cloud, Points)
    assert cloud.T_world_object is not None
    assert np.array_equal(cloud.T_world_object, found.poses["cloud"][0])
    return found.poses["cloud"]


def test_only_what_has_another_pose_moves():
    assert set(moves(BEFORE, AFTER)) == {"cloud"}
    assert moves(BEFORE, BEFORE) == {}
    recoloured = AFTER | {"cloud": Points(CLOUD.p, "wrong", T_world_object=pose(80, (1, 2, 3)))}
    assert moves(BEFORE, recoloured) == {}
    mirrored = AFTER | {"cloud": Points(CLOUD.p, T_world_object=np.diag([-1.0, 1, 1, 1]))}
    assert moves(BEFORE, mirrored) == {}


def test_a_move_starts_and_ends_where_the_steps_say():
    start, end = on_its_way(0.0, 1.0)
    assert start == pytest.approx(np.eye(4), abs=1e-12)
    assert end == pytest.approx(AFTER["cloud"].T_world_object, abs=1e-12)


def test_it_turns_evenly_and_its_middle_goes_straight():
    p_start, p_end = np.array([5.0, 0, 0]), pose(80, (1, 2, 3)) @ [5, 0, 0, 1]
    shares = (0.25, 0.5, 0.9)
    for share, T in zip(shares, on_its_way(*shares), strict=True):
        assert is_rigid(T)
        assert np.degrees(np.arctan2(T[1, 0], T[0, 0])) == pytest.approx(80 * share)
        assert (T @ [5, 0, 0, 1])[:3] == pytest.approx((1 - share) * p_start + share * p_end[:3])


def test_lines_that_change_are_away_meanwhile():
    found = way(BEFORE, AFTER, [0.5])
    assert found is not None
    assert "lines" not in found.scene
    assert found.scene["still"] is BEFORE["still"]
    same_lines = way(BEFORE, AFTER | {"lines": LINES}, [0.5])
    assert same_lines is not None
    assert "lines" in same_lines.scene


def test_where_nothing_only_moves_there_is_no_way():
    assert way(BEFORE, BEFORE, [0.5]) is None


def test_a_way_starts_and_ends_gently():
    shares = np.array([0.0, *eased(10), 1.0])
    assert len(shares) == 11
    assert (np.diff(shares) > 0).all()
    assert np.allclose(shares + shares[::-1], 1.0)
    assert np.diff(shares)[0] < 0.3 * np.diff(shares).max()
