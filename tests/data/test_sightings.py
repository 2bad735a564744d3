import numpy as np
import pytest

from workbench.data.views.sightings import (
    points_on_box,
    random_views,
    read_sightings,
    seen,
    some_of,
)
from workbench.errors import InputError
from workbench.geometry.cameras import intrinsics, look_at, project

K = intrinsics(500.0, 320.0, 240.0)
T = look_at(np.array([2.0, -3.0, 2.0]), np.zeros(3))


def test_noise_and_outliers_are_as_many_and_as_large_as_asked_for():
    p = np.random.default_rng(0).uniform(-1, 1, (500, 3))
    sightings = seen(
        p,
        T,
        K,
        rng=np.random.default_rng(1),
        sigma=2.0,
        is_outlier=some_of(500, 0.3, np.random.default_rng(2)),
    )
    assert sightings.is_outlier.sum() == 150
    off = (sightings.uv - project(p, T, K))[~sightings.is_outlier]
    assert off.std() == pytest.approx(2.0, rel=0.1)
    none = np.zeros(500, bool)
    np.testing.assert_allclose(
        seen(p, T, K, rng=np.random.default_rng(1), sigma=0.0, is_outlier=none).uv, project(p, T, K)
    )


def test_points_lie_on_the_faces_of_the_box():
    size = np.array([1.0, 0.5, 0.2])
    p = points_on_box(size, 300, np.random.default_rng(0))
    on = np.isclose(np.abs(p), size / 2)
    assert on.any(axis=1).all()
    assert (np.abs(p) <= size / 2 + 1e-12).all()
    assert (on.sum(axis=0) > 70).all()


def test_random_points_are_seen_by_rotated_cameras():
    R, p, xy = random_views(50, 3, np.random.default_rng(0))
    depth = np.linalg.norm(p, axis=2) / np.sqrt(1 + np.square(xy).sum(axis=2))
    assert ((depth >= 4) & (depth <= 8)).all()
    p_camera = np.concatenate([xy, np.ones((50, 3, 1))], axis=2) * depth[..., None]
    np.testing.assert_allclose(np.linalg.det(p_camera), np.linalg.det(p))  # turned, not mirrored
    np.testing.assert_allclose(np.einsum("kxy,kny->knx", R, p), p_camera)


@pytest.mark.parametrize(
    "lines",
    [
        "0 0 0 1 2\n1 0 0 3 4\n0 1 0 5 6\n0 0 1 7 8\n",
        "X,Y,Z,u,v\n0,0,0,1,2\n1,0,0,3,4\n0,1,0,5,6\n# x\n0,0,1,7,8\n",
    ],
)
def test_rows_are_read(tmp_path, lines):
    path = tmp_path / "points.csv"
    path.write_text(lines)
    sightings = read_sightings(path)
    np.testing.assert_array_equal(sightings.p_world, [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    np.testing.assert_array_equal(sightings.uv, [[1, 2], [3, 4], [5, 6], [7, 8]])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "0 points; 4 to"),
        ("1 2 3 4 5\n" * 3, "3 points; 4 to"),
        ("1 2 3 4 5\n" * 2001, "2001 points"),
        ("1 2 3 4\n" * 5, "line 1: five numbers"),
        ("1 2 3 4 5\n1 2 three 4 5\n", "line 2: five numbers"),
        ("1 2 3 4 nan\n" * 4, "all 4 points are NaN"),
    ],
)
def test_other_files_are_refused(tmp_path, text, words):
    path = tmp_path / "points.txt"
    path.write_text(text)
    with pytest.raises(InputError, match=words):
        read_sightings(path)


def test_other_kinds_of_files_are_refused(tmp_path):
    (tmp_path / "points.ply").write_text("1 2 3 4 5\n" * 4)
    with pytest.raises(InputError, match="text files"):
        read_sightings(tmp_path / "points.ply")
    with pytest.raises(InputError, match="no such file"):
        read_sightings(tmp_path / "none.txt")
