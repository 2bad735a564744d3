"""Synthetic clouds: on their surface, reproducible, without and with symmetry."""

import numpy as np
import pytest
import scipy

from workbench.data.shapes.clouds import SHAPES, pair, vase
from workbench.data.shapes.rabbit import rabbit
from workbench.geometry.motions import apply, exp_so3, motion


def rms_gap(p: np.ndarray, q: np.ndarray) -> float:
    return float(np.sqrt(np.mean(scipy.spatial.KDTree(q).query(p)[0] ** 2)))


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("count", [1, 7, 2000])
def test_as_many_finite_points_as_asked_for_and_the_same_again(shape, count):
    p = SHAPES[shape](count, np.random.default_rng(3))
    assert p.shape == (count, 3)
    assert np.isfinite(p).all()
    assert np.abs(p).max() <= 1.0
    np.testing.assert_array_equal(p, SHAPES[shape](count, np.random.default_rng(3)))


def test_no_turn_takes_the_rabbit_to_itself_and_any_turn_the_vase():
    for shape, low, high in ((rabbit, 0.035, 1.0), (vase, 0.0, 0.018)):
        p, q = shape(3000, np.random.default_rng(0)), shape(3000, np.random.default_rng(1))
        for degrees in range(45, 316, 45):
            gap = rms_gap(p @ exp_so3(np.array([0, 0, np.radians(degrees)])).T, q)
            assert low < gap < high, (shape.__name__, degrees, gap)


def test_a_pair_is_two_samplings_of_one_shape_in_two_frames():
    T = motion(exp_so3(np.array([0.3, -0.2, 1.0])), np.array([0.5, 0.1, -0.2]))
    scans = pair("rabbit", 3000, T, rng=np.random.default_rng(0))
    assert rms_gap(apply(T, scans.p_source), scans.p_target) < 0.015
    assert not np.isin(apply(T, scans.p_source).round(9), scans.p_target.round(9)).all(axis=1).any()
    assert not scans.is_outlier.any()


@pytest.mark.parametrize("overlap", [0.5, 0.8])
def test_the_overlap_is_what_was_asked_for(overlap):
    scans = pair("rabbit", 4000, np.eye(4), rng=np.random.default_rng(0), overlap=overlap)
    seen = scans.p_source[:, 0] <= scans.p_target[:, 0].max()
    assert np.mean(seen) == pytest.approx(overlap, abs=0.03)


def test_noise_and_outliers_are_as_many_and_as_large_as_asked_for():
    clean = pair("corner", 5000, np.eye(4), rng=np.random.default_rng(0))
    noisy = pair("corner", 5000, np.eye(4), rng=np.random.default_rng(0), noise=0.01, outliers=0.2)
    assert noisy.is_outlier.mean() == pytest.approx(0.2)
    inlier = ~noisy.is_outlier
    off_floor = np.minimum(
        np.abs(noisy.p_source[inlier, 1] + 0.3), np.abs(noisy.p_source[inlier, 2] + 0.3)
    )
    assert np.std(off_floor) < 0.01
    assert np.abs(noisy.p_source[noisy.is_outlier, 1] + 0.3).mean() > 0.2
    assert clean.p_source.shape == noisy.p_source.shape


@pytest.mark.parametrize(
    "values", [{"overlap": 0.0}, {"outliers": 1.0}, {"shape": "teapot"}, {"count": 0}]
)
def test_misuse_is_refused(values):
    with pytest.raises(ValueError, match="shape"):
        pair(
            **{
                "shape": "rabbit",
                "count": 10,
                "T_target_source": np.eye(4),
                "rng": np.random.default_rng(0),
            }
            | values
        )
