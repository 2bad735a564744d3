import numpy as np
import pytest

from lessons.chamfer_emd.point_sets import (
    SHAPES,
    blob,
    bumped,
    bunched,
    doubled,
    grown,
    part_missing,
    shape_at,
    shuffled,
    spread,
    with_outlier,
)
from workbench.algorithms.transport import earth_movers
from workbench.geometry.points.shape_distances import chamfer, index_mse, one_sided


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("count", [1, 2, 80])
def test_shapes_are_about_a_metre_and_reproducible(shape, count):
    p = spread(shape, count)
    assert p.shape == (count, 3)
    assert np.abs(p).max() <= 1.0 + 1e-9
    assert np.array_equal(p, spread(shape, count))
    assert (np.ptp(p[:, 1]) == 0) == (shape in ("ring", "two discs", "spiral") or count == 1)


@pytest.mark.parametrize("shape", SHAPES)
def test_points_are_spread_evenly(shape):
    p = spread(shape, 200)
    gaps = np.sort(np.linalg.norm(p[:, None] - p, axis=2), axis=1)[:, 1]
    assert np.percentile(gaps, 5) > 0.5 * gaps.mean()
    assert gaps.max() < 2 * gaps.mean()


def test_surfaces_are_where_they_should_be():
    assert np.allclose(np.linalg.norm(spread("sphere", 50), axis=1), 1)
    assert np.allclose(np.linalg.norm(spread("ring", 50), axis=1), 1)
    x, y, z = spread("torus", 50).T
    assert np.allclose((np.hypot(x, y) - 0.7) ** 2 + z**2, 0.09)
    assert np.allclose(
        shape_at("ring", np.array([0.25, 1.25]), 4)[0], shape_at("ring", np.array([1.25]), 4)
    )


def test_what_is_done_to_a_cloud_is_what_it_says():
    p = spread("ring", 80)
    rng = np.random.default_rng(0)
    assert earth_movers(grown(p, 0.05), p) == pytest.approx(0.05)
    assert chamfer(grown(p, 0.05), p) == pytest.approx(0.005)
    assert earth_movers(bumped(p, 0.16), p) == pytest.approx(0.02)
    assert np.linalg.norm(with_outlier(p, 2.0) - p, axis=1).max() == pytest.approx(2.0)
    half = part_missing(p, 0.5)
    assert half.shape == p.shape
    assert half[:, 0].max() < 0.1
    assert one_sided(half, p) == 0.0
    mixed = shuffled(p, 1.0, rng)
    assert earth_movers(mixed, p) == 0.0
    assert index_mse(mixed, p) > 1.0
    assert index_mse(shuffled(p, 0.0, rng), p) == 0.0
    heavy = doubled(p, 0.5)
    assert len(heavy) == 120
    assert chamfer(heavy, p) == 0.0
    assert np.sum(bunched("ring", 140, 0.8)[:, 2] > 0) > 120


def test_blobs_lie_inside_their_radius():
    for flat in (True, False):
        p = blob(200, 0.3, flat, rng=np.random.default_rng(0)) - np.array([-0.25, 0.0, 0.1])
        assert 0.25 < np.linalg.norm(p, axis=1).max() <= 0.3
        assert (np.ptp(p[:, 1]) == 0) == flat


@pytest.mark.parametrize("count", [1, 2, 3])
def test_small_clouds_survive_everything(count):
    p = spread("spiral", count)
    rng = np.random.default_rng(0)
    for changed in (
        grown(p, 1),
        bumped(p, 1),
        part_missing(p, 1),
        with_outlier(p, 1),
        shuffled(p, 1, rng),
        doubled(p, 1),
    ):
        assert np.isfinite(changed).all()
        assert len(changed) >= count
    assert bunched("ring", count, 1.0).shape == (count, 3)
