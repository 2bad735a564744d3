"""The k-d tree: as near as scipy's, whatever the points; what is passed over is farther; few are
looked at.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree  # here: loaded within a test it would be timed with it

from workbench.algorithms.spatial.kd_tree import LEAF, build_tree, looked_at, search


def tree_of(p: np.ndarray):
    return build_tree(p, p.min(axis=0), p.max(axis=0))


@settings(max_examples=40)
@given(
    n=st.integers(1, 200), d=st.integers(1, 6), seed=st.integers(0, 999), on_a_grid=st.booleans()
)
def test_the_nearest_is_the_nearest(*, n, d, seed, on_a_grid):
    rng = np.random.default_rng(seed)
    p = rng.integers(0, 3, (n, d)).astype(float) if on_a_grid else rng.random((n, d))
    q = rng.random(d) * 2
    tree = tree_of(p)
    *_, last = search(tree, q)
    assert last.distance == pytest.approx(cKDTree(p).query(q)[0])
    assert np.linalg.norm(tree.p[last.nearest] - q) == pytest.approx(last.distance)


def test_cells_hold_their_points_and_part_them():
    p = np.random.default_rng(0).random((500, 3))
    tree = tree_of(p)
    assert sorted(map(tuple, tree.p)) == sorted(map(tuple, p))
    for cell in range(len(tree.axis)):
        inside = tree.p[tree.first[cell] : tree.last[cell]]
        assert ((inside >= tree.low[cell]) & (inside <= tree.high[cell])).all()
        if tree.axis[cell] < 0:
            assert 0 < len(inside) <= LEAF
        else:
            below, above = tree.children[cell]
            assert (tree.first[cell], tree.last[cell]) == (tree.first[below], tree.last[above])
            assert tree.last[below] == tree.first[above]
            assert tree.depth[below] == tree.depth[above] == tree.depth[cell] + 1


def test_what_was_passed_over_is_farther_and_the_rest_was_looked_at():
    rng = np.random.default_rng(1)
    tree = tree_of(rng.random((1000, 3)))
    q = rng.random(3)
    visits = list(search(tree, q))
    last = visits[-1]
    for cell in last.passed:
        away = np.linalg.norm(tree.p[tree.first[cell] : tree.last[cell]] - q, axis=1)
        assert away.min() >= last.distance
    passed = sum(int(tree.last[cell] - tree.first[cell]) for cell in last.passed)
    assert last.looked + passed == 1000
    assert [visit.looked for visit in visits] == sorted(visit.looked for visit in visits)
    assert (np.diff([visit.distance for visit in visits]) <= 0).all()


def test_few_points_are_looked_at_in_three_dimensions_and_nearly_all_in_twenty():
    rng = np.random.default_rng(2)
    looked = {
        d: looked_at(tree_of(rng.random((2000, d))), rng.random((10, d))).mean() for d in (3, 20)
    }
    assert looked[3] < 60
    assert looked[20] > 1700


def test_no_points_are_refused():
    with pytest.raises(ValueError, match="no points"):
        build_tree(np.empty((0, 3)), np.zeros(3), np.ones(3))
