"""Circles in closed form: exact on exact points, moved with the points, biased as the theory says,
equal to circle-fit's.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lessons.fitting.fit_scenes import arc_points
from workbench.geometry.shapes.algebraic_fits import ALGEBRAIC, fit_algebraic

seeds = st.integers(0, 2**32 - 1)


@pytest.mark.parametrize("kind", ALGEBRAIC)
@settings(max_examples=30, deadline=None)
@given(seed=seeds, arc=st.floats(0.3, 6.28))
def test_points_of_a_circle_give_that_circle(kind, seed, arc):
    rng = np.random.default_rng(seed)
    circle = np.append(rng.normal(size=2) * 10, rng.uniform(0.1, 30))
    p = circle[:2] + circle[2] * arc_points(arc, 20)
    np.testing.assert_allclose(fit_algebraic(p, kind), circle, atol=1e-5 * circle[2])


@pytest.mark.parametrize("kind", ALGEBRAIC)
@settings(max_examples=30, deadline=None)
@given(seed=seeds)
def test_the_circle_turns_moves_and_grows_with_the_points(kind, seed):
    rng = np.random.default_rng(seed)
    p = arc_points(2.0, 30) + 0.05 * rng.normal(size=(30, 2))
    a = rng.uniform(0, 7)
    scale = rng.uniform(0.1, 10)
    shift = rng.normal(size=2) * 5
    R = np.array([[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]])
    circle = fit_algebraic(p, kind)
    moved = fit_algebraic(scale * p @ R.T + shift, kind)
    np.testing.assert_allclose(
        moved, np.append(scale * R @ circle[:2] + shift, scale * circle[2]), rtol=1e-6, atol=1e-7
    )


@pytest.mark.parametrize("kind", ["Kåsa", "Pratt", "Taubin"])
def test_spheres_too(kind):
    v = np.random.default_rng(0).normal(size=(30, 3))
    p = np.array([1.0, 2, 3]) + 2 * v / np.linalg.norm(v, axis=1, keepdims=True)
    np.testing.assert_allclose(fit_algebraic(p, kind), [1, 2, 3, 2], atol=1e-9)


def test_many_sets_are_each_alone():
    p = arc_points(1.5, 20) + 0.02 * np.random.default_rng(1).normal(size=(5, 20, 2))
    for kind in ALGEBRAIC:
        np.testing.assert_allclose(fit_algebraic(p, kind)[3], fit_algebraic(p[3], kind))


def test_biases_are_those_of_the_theory():
    """Essential bias all round, of R = 1: Pratt 2 σ², Taubin σ², Hyper 0 (Al-Sharadqah and Chernov
    2009, table 1).
    """
    p = arc_points(2 * np.pi, 60) + 0.05 * np.random.default_rng(0).normal(size=(20_000, 60, 2))
    means = {kind: fit_algebraic(p, kind)[:, 2].mean() - 1 for kind in ALGEBRAIC}
    for kind, theory in (("Kåsa", 0.0025), ("Pratt", 0.005), ("Taubin", 0.0025), ("Hyper", 0.0)):
        assert means[kind] == pytest.approx(theory, abs=2.5e-4)


def test_only_kasas_is_small_on_short_arcs():
    p = arc_points(np.radians(45), 60) + 0.02 * np.random.default_rng(0).normal(size=(500, 60, 2))
    medians = {kind: float(np.median(fit_algebraic(p, kind)[:, 2])) for kind in ALGEBRAIC}
    assert medians.pop("Kåsa") == pytest.approx(0.61, abs=0.02)
    assert all(abs(median - 1) < 0.03 for median in medians.values())


def test_scikit_images_circle_is_kasas():
    measure = pytest.importorskip("skimage.measure")
    p = arc_points(np.radians(90), 60) + 0.02 * np.random.default_rng(3).normal(size=(60, 2))
    model = (
        measure.CircleModel.from_estimate(p)
        if hasattr(measure.CircleModel, "from_estimate")
        else None
    )
    if model is None:
        model = measure.CircleModel()
        model.estimate(p)
    theirs = model.params if not hasattr(model, "center") else (*model.center, model.radius)
    np.testing.assert_allclose(fit_algebraic(p, "Kåsa"), theirs, rtol=1e-6)


def test_a_sphere_has_no_hyper_and_two_points_no_circle():
    with pytest.raises(ValueError, match="made for circles"):
        fit_algebraic(np.random.default_rng(0).normal(size=(9, 3)), "Hyper")
    with pytest.raises(ValueError, match="3 points are needed, got 2"):
        fit_algebraic(np.zeros((2, 2)), "Taubin")
