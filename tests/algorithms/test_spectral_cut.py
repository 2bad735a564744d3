"""Cuts, flows and networks on graphs, step by step, beside what must hold and what finite
differences say.
"""

import numpy as np
import pytest

from workbench.algorithms.graphs.diffusion import heat, smooth
from workbench.algorithms.graphs.spectral_cut import spectral_cut
from workbench.algorithms.learning.graph_network import softmax, spread, train
from workbench.data import networks
from workbench.data.networks import dumbbell
from workbench.data.shapes import surfaces
from workbench.geometry.graphs import adjacency as graphs
from workbench.geometry.graphs.spectra import Laplacian
from workbench.geometry.meshes import triangles as meshes
from workbench.geometry.meshes.invariants import signed_volume

CLUB = networks.karate()
KARATE = graphs.graph_of(CLUB.edges, 34)


def plain(adjacency):
    return Laplacian(graphs.laplacian(adjacency), np.ones(adjacency.shape[0]))


def test_the_club():
    assert KARATE.sum() == 2 * 78
    assert CLUB.classes.sum() == 17
    assert networks.karate(weighted=True).weights.sum() == 231  # as in Zachary's matrix


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_a_cut_finds_the_bridge(seed):
    p, classes = dumbbell(200, 0.5, 14, rng=np.random.default_rng(seed))
    adjacency = graphs.joined(graphs.directed_graph(graphs.neighbours(p, 6)[0]), "union")
    steps = list(spectral_cut(adjacency, plain(adjacency)))
    assert [step.phase for step in steps] == ["graph", "fiedler", "sign", *["sweep"] * 6, "best"]
    best = steps[-1]
    assert best.conductance == pytest.approx(best.conductances.min())
    assert best.conductance == pytest.approx(graphs.conductance(adjacency, best.side))
    assert best.conductance <= min(step.conductance for step in steps[2:])
    assert max(np.mean(best.side == classes), np.mean(best.side != classes)) > 0.95


@pytest.mark.parametrize("kind", ["plain", "normalised", "cotangent"])
def test_heat_is_kept_and_tends_to_the_exact_one(kind):
    ball = surfaces.sphere(162)
    adjacency = meshes.adjacency(ball.faces, len(ball.p))
    if kind == "cotangent":
        from workbench.geometry.meshes.laplacian import cotangent_laplacian, mixed_areas

        laplacian = Laplacian(
            cotangent_laplacian(ball.p, ball.faces), mixed_areas(ball.p, ball.faces)
        )
    else:
        mass = np.ones(len(ball.p)) if kind == "plain" else graphs.degrees(adjacency)
        laplacian = Laplacian(graphs.laplacian(adjacency), mass)
    u = np.eye(len(ball.p))[0]
    top = laplacian.largest()
    values, functions = laplacian.smallest(len(u))
    last = list(heat(u, laplacian, 1.0 / top, steps=40))[-1]
    exact = functions @ (np.exp(-40 * values / top) * (functions.T @ (laplacian.mass * u)))
    np.testing.assert_allclose(last.exact, exact, atol=1e-9)
    assert laplacian.mass @ last.u == pytest.approx(laplacian.mass @ u)
    finer = list(heat(u, laplacian, 0.25 / top, steps=160))[-1]
    assert finer.error < last.error / 3


def test_longer_steps_than_two_over_the_largest_eigenvalue_explode():
    laplacian = plain(KARATE)
    u = np.eye(34)[0]
    top = laplacian.largest()
    sizes = {
        c: np.abs(list(heat(u, laplacian, c / top, steps=100))[-1].u).max() for c in (1.9, 2.5)
    }
    assert sizes[1.9] < 1
    assert sizes[2.5] > 1e6


def test_smoothing_shrinks_and_taubins_does_not():
    ball = surfaces.sphere(642)
    adjacency = meshes.adjacency(ball.faces, 642)
    shrunk, kept = (list(smooth(ball.p, adjacency, 50, outward=mu))[-1].p for mu in (0.0, 0.526))
    volumes = [
        signed_volume(p, ball.faces) / signed_volume(ball.p, ball.faces) for p in (shrunk, kept)
    ]
    assert volumes[0] < 0.7
    assert volumes[1] == pytest.approx(1, abs=0.05)  # the slow parts grow a little


def test_layers_are_powers_where_weights_are_the_identity():
    features = np.zeros((34, 2))
    features[[0, 33], [0, 1]] = 1
    steps = list(spread(KARATE.toarray(), features, [np.eye(2)] * 3))
    assert [step.part for step in steps] == [
        "input",
        "loops",
        "normalised",
        "gathered",
        *["layer"] * 3,
    ]
    power = np.linalg.matrix_power(graphs.propagation(KARATE.toarray()), 3)
    np.testing.assert_allclose(steps[-1].features, power @ features)
    assert len(list(spread(KARATE.toarray(), features, []))) == 1


def test_training_goes_down_the_gradient():
    """The first step of Adam is the sign of the slope: beside finite differences of the loss."""
    rng = np.random.default_rng(3)
    labelled = np.array([0, 33, 5])
    classes = np.array([0, 1, 0])
    dense = KARATE.toarray()
    x = rng.normal(size=(34, 4))
    weights = [rng.normal(size=(4, 3)), rng.normal(size=(3, 3)), rng.normal(size=(3, 2))]

    def loss(changed):
        return next(
            iter(train(dense, x, changed, labelled=labelled, classes=classes, iterations=0))
        ).loss

    step = 1e-6
    slopes = []
    for layer, w in enumerate(weights):
        slope = np.zeros_like(w)
        for at in np.ndindex(w.shape):
            ends = []
            for sign in (1, -1):
                moved = [matrix.copy() for matrix in weights]
                moved[layer][at] += sign * step
                ends.append(loss(moved))
            slope[at] = (ends[0] - ends[1]) / (2 * step)
        slopes.append(slope)
    rate = 1e-4
    taken = list(
        train(dense, x, weights, labelled=labelled, classes=classes, iterations=1, rate=rate)
    )
    expected = loss(
        [
            w - rate * np.sign(np.where(np.abs(s) > 1e-6, s, 0))
            for w, s in zip(weights, slopes, strict=True)
        ]
    )
    assert taken[1].loss == pytest.approx(expected, abs=1e-7)
    assert taken[1].loss < taken[0].loss


def test_probabilities_add_up_however_large_the_scores():
    np.testing.assert_allclose(softmax(np.array([[1e4, 0.0], [3.0, 3.0]])), [[1, 0], [0.5, 0.5]])
