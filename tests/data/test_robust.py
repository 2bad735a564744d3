import numpy as np
import pytest

from lessons.ransac.robust_scenes import (
    IMAGE_SIZE,
    circle_scene,
    line_scene,
    match_scene,
    plane_scene,
    sphere_scene,
    two_planes_scene,
    wire_scene,
)
from workbench.algorithms.robust.models import MODELS

MAKERS = {
    "line": line_scene,
    "plane": plane_scene,
    "two planes": two_planes_scene,
    "wire": wire_scene,
    "circle": circle_scene,
    "sphere": sphere_scene,
    "homography": lambda rng, **k: match_scene(rng, flat=True, **k),
    "fundamental matrix": match_scene,
}


def model_of(name: str):
    return MODELS.get(name, MODELS["plane"])


@pytest.mark.parametrize("name", list(MAKERS))
def test_the_truth_fits_the_true_rows_and_the_noise_is_as_asked_for(name):
    sigma = 0.5 if model_of(name).unit == "px" else 0.02
    scene = MAKERS[name](np.random.default_rng(1), count=900, outlier_ratio=0.3, sigma=sigma)
    model = model_of(name)
    assert scene.p.shape == (900, model.columns)
    assert len(scene.quality) == len(scene.is_inlier) == 900
    assert (
        np.count_nonzero(scene.is_inlier)
        == len(scene.p_true)
        == (210 if name == "two planes" else 630)
    )
    assert model.distances(scene.truth, scene.p_true).max() < 1e-6
    off = model.distances(scene.truth, scene.p[scene.is_inlier])
    share = np.sqrt(1 / 3) if name == "wire" else 1.0  # two thirds have no noise
    # two directions, noise of both views
    spread = share * sigma * (2.0 if name == "homography" else 1.0)
    assert np.sqrt(np.mean(off**2)) == pytest.approx(spread, rel=0.25)


@pytest.mark.parametrize("name", list(MAKERS))
def test_a_scene_is_reproducible_shuffled_and_trusts_inliers_more(name):
    first, second = (
        MAKERS[name](np.random.default_rng(2), count=300, outlier_ratio=0.4, sigma=0.01)
        for _ in range(2)
    )
    np.testing.assert_array_equal(first.p, second.p)
    half = first.is_inlier[3:150].mean(), first.is_inlier[150:].mean()
    assert abs(half[0] - half[1]) < 0.2
    assert first.quality[first.is_inlier].mean() > first.quality[~first.is_inlier].mean() + 0.15
    assert first.quality[~first.is_inlier].max() > first.quality[first.is_inlier].min()


def test_matches_lie_in_both_pictures():
    for flat in (True, False):
        scene = match_scene(
            np.random.default_rng(3), count=200, outlier_ratio=0.5, sigma=0.0, flat=flat
        )
        assert (scene.p >= 0).all()
        assert (scene.p <= np.tile(np.array(IMAGE_SIZE) - 1, 2)).all()


def test_the_first_three_points_of_the_wire_are_on_it():
    scene = wire_scene(np.random.default_rng(4), count=90, outlier_ratio=0.3, sigma=0.01)
    assert len(MODELS["plane"].solve(scene.p[None, :3])) == 0
    other = int(np.argmin(scene.is_inlier))
    assert len(MODELS["plane"].solve(scene.p[None, [0, 1, other]])) == 1


def test_impossible_scenes_are_refused():
    with pytest.raises(ValueError, match="outlier_ratio < 1"):
        plane_scene(np.random.default_rng(0), count=10, outlier_ratio=1.0, sigma=0.01)
