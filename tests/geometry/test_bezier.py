"""Bezier patches: laws of Bernstein polynomials, de Casteljau beside the sum, arcs and tori."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import BPoly

from workbench.geometry.shapes.bezier import (
    bernstein,
    bezier_patch,
    de_casteljau,
    quarter_circles,
    raised,
    raised_patch,
    torus_patches,
)

RING, TUBE = 0.6, 0.25


def a_net(seed: int) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(4, 4, 3))


@given(st.integers(0, 6), st.floats(0, 1))
def test_weights_add_up_to_one_and_mirror(degree, t):
    row = bernstein(degree, np.array([t]))[0]
    mirrored = bernstein(degree, np.array([1 - t]))[0]
    assert row.sum() == pytest.approx(1)
    np.testing.assert_allclose(row, mirrored[::-1], atol=1e-12)


def test_a_patch_is_scipys_polynomials_along_both_directions():
    control = a_net(0)
    uv = np.random.default_rng(1).random((30, 2))
    for (u, v), p in zip(uv, bezier_patch(control, uv), strict=True):
        rows = BPoly(control.transpose(1, 0, 2)[:, None], [0, 1])(v)
        np.testing.assert_allclose(BPoly(np.asarray(rows)[:, None], [0, 1])(u), p, atol=1e-12)


@given(st.integers(0, 20), st.floats(0, 1), st.floats(0, 1))
def test_dividing_legs_gives_the_same_point(seed, u, v):
    control = a_net(seed)
    rows = np.stack([de_casteljau(row, v)[-1][0] for row in control])
    np.testing.assert_allclose(
        de_casteljau(rows, u)[-1][0], bezier_patch(control, np.array([[u, v]]))[0], atol=1e-12
    )


def test_a_patch_moves_with_its_net_and_stays_in_its_box():
    control = a_net(3)
    uv = np.random.default_rng(4).random((40, 2))
    p = bezier_patch(control, uv)
    np.testing.assert_allclose(bezier_patch(2 * control + 5, uv), 2 * p + 5)
    assert (p >= control.min(axis=(0, 1))).all()
    assert (p <= control.max(axis=(0, 1))).all()


def test_a_raised_curve_is_the_same_curve():
    control = np.random.default_rng(5).normal(size=(3, 2))
    for t in np.linspace(0, 1, 7):
        np.testing.assert_allclose(
            de_casteljau(raised(control), t)[-1], de_casteljau(control, t)[-1], atol=1e-13
        )


def test_weighted_arcs_are_circles_and_polynomial_ones_are_not():
    t = np.linspace(0, 1, 400)
    off = {}
    for rational in (True, False):
        p = np.concatenate([bernstein(len(arc) - 1, t) @ arc for arc in quarter_circles(rational)])
        off[rational] = np.abs(np.linalg.norm(p[:, :2], axis=1) / p[:, 2] - 1).max()
    assert off[True] < 1e-14
    # the known error of the usual cubic quarter
    assert off[False] == pytest.approx(2.73e-4, rel=0.01)


@pytest.mark.parametrize(("rational", "most"), [(True, 1e-15), (False, 2.9e-4)])
def test_sixteen_patches_make_a_torus(rational, most):
    uv = np.random.default_rng(6).random((300, 2))
    for control in torus_patches(RING, TUBE, rational):
        if rational:
            control = raised_patch(control)
        w = bezier_patch(np.repeat(control[..., 3:], 3, axis=-1), uv)
        x, y, z = (bezier_patch(control[..., :3], uv) / w).T
        assert np.abs(np.hypot(np.hypot(x, y) - RING, z) - TUBE).max() < most
