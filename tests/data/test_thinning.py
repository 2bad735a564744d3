import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.data.thinning import evenly, every, growing, some_points, spacing, voxel_means


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 99), size=st.floats(0.05, 3.0))
def test_one_mean_for_each_occupied_voxel(seed, size):
    p = np.random.default_rng(seed).normal(size=(200, 3))
    means = voxel_means(p, size)
    voxels = {}
    for row, voxel in zip(
        p, map(tuple, np.floor((p - p.min(axis=0)) / size).astype(int).tolist()), strict=True
    ):
        voxels.setdefault(voxel, []).append(row)
    wanted = np.array([np.mean(voxels[voxel], axis=0) for voxel in sorted(voxels)])
    np.testing.assert_allclose(means, wanted, atol=1e-12)


def test_moved_points_have_moved_means_also_far_from_the_origin():
    p = np.random.default_rng(0).uniform(0, 1, (500, 3))
    far = np.array([512_000.0, 5_403_000.0, 310.0])
    p = np.round(p * 4096) / 4096  # so that moving them away and back loses no digit
    np.testing.assert_allclose(voxel_means(p + far, 0.25) - far, voxel_means(p, 0.25), atol=1e-9)


def test_a_stray_point_does_not_overflow():
    p = np.array([[0.0, 0.0, 0.0], [0.01, 0.0, 0.0], [1e200, 0.0, 0.0]])
    np.testing.assert_allclose(voxel_means(p, 0.1), [[0.005, 0.0, 0.0], [1e200, 0.0, 0.0]])


@pytest.mark.parametrize("size", [0.0, -1.0, np.nan])
def test_a_voxel_has_a_size(size):
    with pytest.raises(ValueError, match="positive size"):
        voxel_means(np.zeros((2, 3)), size)


@given(seed=st.integers(0, 99), n=st.integers(0, 40), most=st.integers(0, 40))
def test_some_points_are_different_ones_in_their_order(seed, n, most):
    rows = some_points(np.arange(float(n))[:, None], most, np.random.default_rng(seed))[:, 0]
    assert len(rows) == min(n, most)
    assert (np.diff(rows) > 0).all()
    assert set(rows) <= set(range(n))


def test_every_point_has_its_chance():
    drawn = [
        some_points(np.arange(5.0)[:, None], 2, np.random.default_rng(seed))[:, 0]
        for seed in range(200)
    ]
    np.testing.assert_allclose(
        np.bincount(np.concatenate(drawn).astype(int), minlength=5) / 400, 0.2, atol=0.06
    )


@given(count=st.integers(0, 500), most=st.integers(1, 60))
def test_every_and_evenly_take_no_more_than_asked_and_the_first(count, most):
    rows = np.arange(count)
    taken = rows[every(count, most)]
    assert len(taken) <= most
    assert count == 0 or taken[0] == 0
    assert len(set(np.diff(taken))) <= 1
    if count:
        spaced = evenly(count, most)
        assert len(spaced) == min(count, most)
        assert spaced[0] == 0
        assert most == 1 or spaced[-1] == count - 1
        assert np.ptp(np.diff(spaced)) <= 1 if len(spaced) > 2 else True


def test_the_spacing_of_a_grid_is_its_step_whatever_is_there_twice():
    p = 0.25 * np.stack(np.meshgrid(*[np.arange(8.0)] * 3), axis=-1).reshape(-1, 3)
    assert spacing(np.vstack([p, p[:100]])) == pytest.approx(0.25)
    assert spacing(np.zeros((5, 3))) == 1e-9


@pytest.mark.parametrize(("most", "per_power"), [(100, 8), (1000, 6), (20_000, 8), (101, 6)])
def test_counts_grow_by_one_share_up_to_the_most(most, per_power):
    counts = np.array(growing(most, per_power))
    assert (counts[0], counts[-1]) == (10, most)
    assert (np.diff(counts) > 0).all()
    np.testing.assert_allclose(counts[1:-1] / counts[:-2], 10 ** (1 / per_power), rtol=0.08)
