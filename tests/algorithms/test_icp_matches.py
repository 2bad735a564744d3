"""Which points ICP takes for partners: the nearest, by a search that is repeated only where it must
be, and the gate that keeps some of them.
"""

import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.algorithms.rabbits import SEEDS, rabbits
from workbench.algorithms.registration import icp as module
from workbench.algorithms.registration.icp import Gate, icp, nearest


class TestNearest:
    def test_it_agrees_with_looking_at_every_pair(self):
        rng = np.random.default_rng(0)
        for n in (1, 7, 3000):  # the last is searched by several threads
            p_target = rng.standard_normal((200, 3))
            p_source = rng.standard_normal((n, 3))
            expected = scipy.spatial.distance.cdist(p_source, p_target).argmin(axis=1)
            np.testing.assert_array_equal(nearest(p_target, p_source), expected)

    def test_it_is_not_symmetric(self):
        p_target = np.array([[0.0, 0, 0], [1.0, 0, 0]])
        p_source = np.array([[0.4, 0, 0], [0.45, 0, 0]])
        assert nearest(p_target, p_source).tolist() == [0, 0]
        assert nearest(p_source, p_target).tolist() == [0, 1]

    @pytest.mark.parametrize(("a", "b"), [(0, 3), (3, 0)])
    def test_empty_clouds_are_refused(self, a, b):
        with pytest.raises(ValueError, match="no points"):
            nearest(np.zeros((a, 3)), np.zeros((b, 3)))

    def test_the_tree_is_built_once(self, monkeypatch):
        built = []

        class Counting(scipy.spatial.KDTree):
            def __init__(self, p, *args, **options):
                built.append(len(p))
                super().__init__(p, *args, **options)

        monkeypatch.setattr(scipy.spatial, "KDTree", Counting)
        scans = rabbits(n=300)
        states = list(icp(scans.p_target, scans.p_source[:200]))
        assert len(states) > 10
        assert built == [300, 200]  # the target's, and the order in which the source is visited


class TestGate:
    @settings(max_examples=50, deadline=None)
    @given(
        seed=SEEDS, keep=st.floats(0.05, 1), medians=st.floats(1, 5), max_distance=st.floats(0.1, 3)
    )
    def test_the_smallest_limit_counts(self, seed, keep, medians, *, max_distance):
        distances = np.abs(np.random.default_rng(seed).standard_normal(50))
        limit = Gate(max_distance, keep, medians).limit(distances)
        near = np.sort(distances[distances <= max_distance])
        assert limit <= max_distance
        if len(near):
            kept = np.count_nonzero(distances <= limit)
            assert 1 <= kept <= int(np.ceil(keep * len(near)))
            assert limit <= medians * np.median(near) + 1e-12

    def test_trimming_keeps_exactly_the_closest_share(self):
        distances = np.random.default_rng(0).permutation(np.arange(1.0, 101.0))
        assert Gate(keep=0.7).limit(distances) == 70.0
        assert Gate(keep=1.0).limit(distances) == np.inf
        assert Gate(medians=3.0).limit(distances) == 151.5

    def test_perfect_matches_are_all_kept_by_the_median(self):
        distances = np.zeros(10)
        assert np.all(distances <= Gate(medians=3.0).limit(distances))

    @pytest.mark.parametrize(
        "values", [{"keep": 0.0}, {"keep": 1.5}, {"max_distance": 0.0}, {"medians": 0.5}]
    )
    def test_misuse_is_refused(self, values):
        with pytest.raises(ValueError, match="needed"):
            Gate(**values)


def test_the_matcher_leaves_its_arguments_alone():
    p = np.random.default_rng(0).standard_normal((30, 3))
    p.setflags(write=False)
    module.matcher(p, p)(p, p)


@pytest.mark.parametrize("step", [1.0, 0.1, 0.01, 0.001])
@pytest.mark.parametrize("m", [1, 2, 300])
def test_the_matcher_keeps_a_partner_only_while_no_other_is_nearer(m, step):
    rng = np.random.default_rng(m)
    p_target = rng.standard_normal((m, 3))
    p_source = rng.standard_normal((500, 3))
    match = module.matcher(p_target, p_source)
    for _ in range(20):  # a walk, so that moves since the search add up and cancel
        expected = scipy.spatial.distance.cdist(p_source, p_target).argmin(axis=1)
        np.testing.assert_array_equal(match(p_target, p_source), expected)
        p_source = p_source + step * rng.standard_normal(p_source.shape)


@pytest.mark.parametrize("searched_before", [False, True])
def test_the_matcher_refuses_a_point_that_is_not_finite(searched_before):
    p = np.random.default_rng(0).standard_normal((30, 3))
    match = module.matcher(p, p)
    if searched_before:
        match(p, p)
    with pytest.raises(ValueError, match="finite"):
        match(p, np.where(np.arange(30)[:, None] == 3, np.nan, p))
