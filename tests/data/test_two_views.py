from pathlib import Path
from typing import get_args

import numpy as np
import pytest

from workbench.data.files.intrinsics import read_intrinsics
from workbench.data.files.matches import read_matches
from workbench.data.views.skyline import VALLEY, skyline
from workbench.data.views.two_views import What, made_views, own_views
from workbench.errors import InputError
from workbench.geometry.cameras import project
from workbench.geometry.motions import apply, exp_so3, inverse
from workbench.geometry.two_views.epipolar import fundamental_from_cameras, sampson_distances


def street(scene: What = "street", count=60, sigma=0.0, *, baseline=1.0, heading=0.0, seed=0):
    return made_views(
        scene, count, sigma, baseline=baseline, heading=heading, rng=np.random.default_rng(seed)
    )


@pytest.mark.parametrize("scene", ["street", "far"])
@pytest.mark.parametrize("heading", [0.0, 0.35, np.pi / 2, np.pi])
def test_matches_are_pictures_of_their_points(scene, heading):
    views = street(scene, heading=heading)
    assert views.p_first is not None
    assert views.T_second_first is not None
    np.testing.assert_allclose(
        project(views.p_first, np.eye(4), views.K_first), views.matches[:, :2], atol=1e-6
    )
    np.testing.assert_allclose(
        project(views.p_first, views.T_second_first, views.K_second),
        views.matches[:, 2:],
        atol=1e-6,
    )
    F = fundamental_from_cameras(views.K_first, views.K_second, views.T_second_first)
    assert np.abs(sampson_distances(F, views.clean[:, :2], views.clean[:, 2:])).max() < 1e-6
    assert np.linalg.norm(views.T_second_first[:3, 3]) == pytest.approx(1)


def test_the_ground_is_a_plane_and_noise_is_noise():
    views = street("plane", 200, sigma=0.5)
    assert views.p_first is not None
    z = apply(inverse(views.T_first_world), views.p_first)[:, 2]
    assert np.ptp(z) < 1e-6
    exact = street("plane", 200)
    assert (views.matches - exact.matches).std() == pytest.approx(0.5, rel=0.1)
    assert not np.array_equal(street(seed=1).matches, street(seed=2).matches)


def test_the_far_scene_is_far_and_stands_on_its_valley():
    views = street("far", 300)
    assert views.p_first is not None
    assert views.p_first[:, 2].min() > 180
    z = apply(inverse(views.T_first_world), views.p_first)[:, 2]
    assert z.min() == pytest.approx(VALLEY)
    assert (np.abs(z - VALLEY) < 1e-6).mean() < 0.7  # and much of it is on towers and mountains
    assert (skyline().edges[..., 2] > VALLEY - 1e-9).all()


@pytest.mark.parametrize("scene", ["street", "far"])
def test_pictures_agree_at_matches(scene):
    views = street(scene, count=300)
    first, second = views.images
    assert first is not None
    assert second is not None
    u, v = views.matches[:, :2].round().astype(int).T
    s, t = views.matches[:, 2:].round().astype(int).T
    off = np.abs(first[v, u].astype(int) - second[t, s]).max(axis=1)
    assert np.median(off) == 0
    assert (off > 40).mean() < 0.05


def test_every_knob_has_its_matches():
    for baseline in (0.0, 2.0):
        for heading in (0.0, 90.0, 180.0):
            for scene in get_args(What):
                assert (
                    len(street(scene, 500, baseline=baseline, heading=np.radians(heading)).matches)
                    == 500
                )
    with pytest.raises(InputError, match="in common"):
        street(count=10**5)


def written(folder: Path, **arrays) -> Path:
    np.savez(folder / "matches.npz", **arrays)
    return folder / "matches.npz"


def test_what_a_file_says_of_the_cameras_is_read(tmp_path):
    uv = np.random.default_rng(0).uniform(0, 500, (30, 4))
    R = exp_so3(np.array([0.1, 0.2, 0.0]))
    t = np.array([1.0, 2.0, 3.0])
    K = np.array([[500.0, 0, 250], [0, 500, 250], [0, 0, 1]])
    matches = read_matches(written(tmp_path, x1=uv[:, :2], x2=uv[:, 2:], K=K, R=R, t=t))
    np.testing.assert_array_equal(matches.K_first, matches.K_second)
    assert matches.T_second_first is not None
    np.testing.assert_allclose(matches.T_second_first[:3, 3], t)
    views = own_views(
        written(tmp_path, x1=uv[:, :2], x2=uv[:, 2:], K1=K, K2=2 * K - np.diag([0, 0, 1.0])),
        None,
        None,
        K=None,
        most=20,
    )
    assert len(views.matches) == 20
    assert views.K_second[0, 0] == 1000
    assert views.T_second_first is None


@pytest.mark.parametrize(
    ("arrays", "words"),
    [
        ({"K": np.eye(4)}, "K1 is no 3 x 3"),
        ({"K": -np.eye(3)}, "no K of a camera"),
        ({"R": 2 * np.eye(3), "t": np.ones(3)}, "R is no rotation"),
        ({"R": np.eye(3), "t": np.zeros(3)}, "t is no vector"),
        ({}, "has no K"),
    ],
)
def test_cameras_that_are_none_are_refused(tmp_path, arrays, words):
    uv = np.random.default_rng(0).uniform(0, 500, (30, 4))
    with pytest.raises(InputError, match=words):
        own_views(
            written(tmp_path, x1=uv[:, :2], x2=uv[:, 2:], **arrays), None, None, K=None, most=20
        )


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "0 numbers"),
        ("a b c d", "numbers"),
        ("1 2 3", "3 numbers"),
        ("-5 5 1 1", "no K"),
        ("nan 5 1 1", "4 numbers|9 numbers"),
    ],
)
def test_intrinsics_that_are_none_are_refused(tmp_path, text, words):
    (tmp_path / "k.txt").write_text(text)
    with pytest.raises(InputError, match=words):
        read_intrinsics(tmp_path / "k.txt")


def test_intrinsics_are_four_numbers_or_a_matrix(tmp_path):
    (tmp_path / "k.txt").write_text("# fx fy cx cy\n500, 510, 320, 240\n")
    K = read_intrinsics(tmp_path / "k.txt")
    assert K.tolist() == [[500, 0, 320], [0, 510, 240], [0, 0, 1]]
    np.savetxt(tmp_path / "k.txt", K)
    np.testing.assert_array_equal(read_intrinsics(tmp_path / "k.txt"), K)
