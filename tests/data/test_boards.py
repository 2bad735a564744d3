"""Boards: where they stand, how they are printed, and that a seed keeps their places."""

import numpy as np
import pytest

from workbench.data.views import boards
from workbench.geometry.cameras import project


def poses(seed: int = 0, **options) -> np.ndarray:
    given = {"tilt": 0.5, "distance": 0.4, "spread": 1.0} | options
    return boards.board_poses(np.random.default_rng(seed), 8, **given)


def test_corners_lie_row_by_row_on_squares_of_25_mm():
    p = boards.board_points()
    assert p.shape == (54, 3)
    np.testing.assert_allclose(
        p[[0, 1, 9, 53]], [[0, 0, 0], [0.025, 0, 0], [0, 0.025, 0], [0.2, 0.125, 0]]
    )
    mesh, faces, colors = boards.board_mesh()
    for corner in p:  # four squares meet in each, dark and light in turn
        meeting = np.unique(
            np.flatnonzero((np.abs(mesh[faces] - corner).max(axis=2) < 1e-9).any(axis=1)) // 2
        )
        assert sorted(colors[2 * meeting, 0]) == [60, 60, 245, 245]


@pytest.mark.parametrize(
    "options",
    [{}, {"tilt": 0.0}, {"tilt": 1.0}, {"distance": 0.3}, {"distance": 1.2}, {"spread": 0.0}],
)
def test_all_corners_are_in_the_picture(options):
    for T in poses(**options):
        uv = project(boards.board_points(), T, boards.K_TRUE, boards.LENS_TRUE)
        assert (uv >= 0).all()
        assert (uv < boards.SIZE).all()


@pytest.mark.parametrize("tilt", [0.0, 0.2, 1.0])
def test_tilts_are_what_was_asked_for(tilt):
    tilts = np.arccos(np.clip(poses(tilt=tilt)[:, 2, 2], -1, 1))
    assert (tilts >= 0.6 * tilt - 1e-6).all()
    assert (tilts <= 1.2 * tilt + 1e-6).all()


def test_a_seed_keeps_its_directions_at_every_tilt():
    little, much = poses(tilt=0.1)[:, :2, 2], poses(tilt=0.4)[:, :2, 2]
    cosine = (
        (little * much).sum(axis=1) / np.linalg.norm(little, axis=1) / np.linalg.norm(much, axis=1)
    )
    # those whose first place fits at both
    np.testing.assert_allclose(cosine[cosine > 0.999].size, 8, atol=3)


def test_prints():
    p = boards.board_points()
    np.testing.assert_array_equal(boards.printed(p, "none"), p)
    np.testing.assert_allclose(boards.printed(p, "stretched 2 %"), p * [1.02, 1, 1])
    np.testing.assert_allclose(boards.printed(p, "2 % larger"), 1.02 * p)
    bent = boards.printed(p, "bent 1 mm")
    assert bent[:, 2].min() == pytest.approx(-0.001)  # towards the camera, in the middle
    np.testing.assert_allclose(bent[[0, 8], 2], 0, atol=1e-12)


def test_noise_and_bad_corners():
    Ts = poses()
    clean = boards.board_pixels(np.random.default_rng(1), Ts, sigma=0.0)
    noisy = boards.board_pixels(np.random.default_rng(1), Ts, sigma=0.5)
    assert (noisy - clean).std() == pytest.approx(0.5, rel=0.1)
    for count in (1, 3, 10):
        off = np.linalg.norm(
            boards.board_pixels(np.random.default_rng(1), Ts, sigma=0.0, bad_corners=count) - clean,
            axis=2,
        )
        assert (off > 4.9).sum() == count
        assert (off[1] > 4.9).sum() == count
