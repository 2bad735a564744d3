"""Every claim of the graphs lesson in numbers: presets, questions, page, slots and what is
refused.
"""

import dataclasses

import numpy as np
import pytest

from lessons.graphs import measures
from lessons.graphs.lesson import lesson
from lessons.graphs.presets import SIGN
from lessons.graphs.state import Grown, Mode, Params
from tests.runs import finished
from workbench.algorithms.graphs.diffusion import Heat, Smoothed
from workbench.algorithms.graphs.spectral_cut import Cut
from workbench.algorithms.learning.graph_network import Layer, Trained
from workbench.errors import InputError
from workbench.run.timeline import Timeline
from workbench.scene import Classes, Curve, Points, Segments, caption_of


def states(params):
    return finished("graphs", params).states()


def preset(name):
    return lesson.preset(name).params


def now(kind, params, step=-1):
    result = states(params)[step].now
    assert isinstance(result, kind)
    return result


def cut(params, step=-1) -> Cut:
    return now(Cut, params, step)


def right(params, step=-1) -> int:
    correct = measures.right(states(params)[step])
    assert correct is not None
    return correct


# graphs -------------------------------------------------------------------------------------------


def test_neighbour_is_not_mutual():
    grown = [state.now for state in states(preset("one-way"))]
    assert [graph.k for graph in grown] == [1, 2, 3, 4, 5, 6]
    np.testing.assert_allclose(
        [grown[k].one_way for k in (0, 2, 5)], [0.391, 0.248, 0.179], atol=0.002
    )
    assert [graph.count for graph in grown[:3]] == [457, 73, 1]
    assert round(grown[2].one_way * 4500) == 1114
    mutual = dataclasses.replace(preset("one-way"), k=3, join="mutual")
    assert now(Grown, mutual).count == 227


def test_one_way_edges_are_drawn_apart():
    scene = finished("graphs", preset("one-way"))[0].scene
    both, one_way = scene["edges"], scene["one-way edges"]
    assert isinstance(both, Segments)
    assert isinstance(one_way, Segments)
    # as many pairs as components with one neighbour each
    assert (len(both.ends), len(one_way.ends)) == (457, 1043 - 457)


def test_given_edges_join_components_one_by_one():
    counts = [state.now.count for state in states(Params(graph="karate", stage="graph"))]
    assert counts[0] == 34
    assert counts[-1] == 1
    assert (np.diff(counts) < 0).all()


# cuts ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_the_bridge_is_found_between_equal_halves(seed):
    params = Params(seed=seed)
    assert all(3 <= cut(params, step).cut <= 6 for step in (SIGN, -1))
    assert all(right(params, step) >= 412 for step in (SIGN, -1))


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_the_sign_is_not_the_best_cut(seed):
    params = dataclasses.replace(preset("unbalanced"), seed=seed)
    sign = cut(params, SIGN)
    best = cut(params)
    assert 24 <= sign.cut <= 49
    assert 4 <= best.cut <= 6
    assert 0.03 < sign.conductance < 0.08
    assert 0.011 < best.conductance < 0.018
    assert right(params, SIGN) < 380 < 412 < right(params)


def test_at_95_to_5_the_sweep_fails_too():
    cuts = [cut(Params(share=0.95, seed=seed)).cut for seed in range(4)]
    assert sorted(cuts)[:2] == [4, 5]
    assert sorted(cuts)[2] > 30


def test_without_a_bridge_the_constant_is_taken_out_and_the_pieces_are_left():
    """A solver's second column is no answer: its cosine with the constant changes with the
    numbering.
    """
    base = preset("split")
    cosines = []
    for numbering in range(5):
        params = dataclasses.replace(base, numbering=numbering)
        solution = cut(params, SIGN)
        assert solution.eigenvalues[1] == pytest.approx(0, abs=1e-12)
        assert abs(solution.fiedler.sum()) < 1e-9
        np.testing.assert_allclose(np.abs(solution.fiedler), 1 / np.sqrt(200), atol=1e-9)
        assert (solution.side.sum(), solution.cut, right(params, SIGN), right(params)) == (
            100,
            0,
            200,
            200,
        )
        L = (
            np.diag(np.asarray(solution.adjacency.sum(axis=1)).ravel())
            - solution.adjacency.toarray()
        )
        cosines.append(abs(np.linalg.eigh(L)[1][:, 1].sum()) / np.sqrt(200))
    assert max(cosines) > 0.1
    assert "0 twice" in caption_of(finished("graphs", base)[1].scene).text


def test_where_the_sign_is_truer_than_the_best_cut_that_is_said():
    assert (right(Params(), SIGN), right(Params())) == (414, 412)
    assert cut(Params(), SIGN).cut == cut(Params()).cut == 6
    assert (
        "By sign it was 414, for a cut of 6"
        in caption_of(finished("graphs", Params())[-1].scene).text
    )
    assert "By sign" not in caption_of(finished("graphs", preset("unbalanced"))[-1].scene).text


def test_equal_eigenvalues_turn_the_cut_with_the_numbering():
    angles = []
    for numbering in range(6):
        state = states(dataclasses.replace(preset("square"), numbering=numbering))[1]
        assert isinstance(state.now, Cut)
        x, y, _ = state.subject.p.T @ state.now.fiedler
        angles.append(np.degrees(np.arctan2(y, x)) % 180)
        np.testing.assert_allclose(state.now.eigenvalues[1:3], 0.0979, atol=1e-4)
    assert np.ptp(angles) > 30
    values = now(Mode, Params(graph="grid", stage="spectrum"), 0).values
    np.testing.assert_allclose(values[1:3], [0.0681, 0.0979], atol=1e-4)


def test_numbering_changes_nothing_where_eigenvalues_are_apart():
    first, other = (cut(Params(numbering=n)) for n in (0, 7))
    assert first.cut == other.cut
    assert first.conductance == pytest.approx(other.conductance)


def test_the_club():
    assert right(preset("club"), SIGN) == 32
    told = measures.predicted(states(preset("club"))[SIGN])
    np.testing.assert_array_equal(
        np.flatnonzero(told != states(preset("club"))[0].subject.classes), [2, 8]
    )
    assert right(dataclasses.replace(preset("club"), weighted=True), SIGN) == 33


def test_the_rabbit_is_thin_at_its_neck():
    state = states(preset("neck"))[-1]
    side = cut(preset("neck")).side
    p = state.subject.p
    head = side if side.sum() < len(side) / 2 else ~side
    assert p[head, 2].min() > 0.1  # head and ears, in front and above
    assert p[head, 0].mean() > 0.2
    assert 40 <= cut(preset("neck")).cut <= 80


# spectra ------------------------------------------------------------------------------------------


def values_of(name, **changes):
    return now(Mode, dataclasses.replace(preset(name), **changes), 0).values


def test_a_graph_is_not_the_surface():
    plain = values_of("sphere")
    np.testing.assert_allclose(plain[9:12], 10.99, atol=0.01)
    np.testing.assert_allclose(plain[12:16], 12.59, atol=0.01)
    np.testing.assert_array_equal(plain, values_of("sphere", jitter=0.25))  # to the last digit
    cotangent = values_of("cotangent")
    np.testing.assert_allclose(
        [cotangent[9:16].min(), cotangent[9:16].max()], [11.85, 11.92], atol=0.005
    )
    np.testing.assert_allclose(values_of("cotangent", jitter=0.25)[9:16], 12, rtol=0.015)


def test_dense_samples_change_the_spectrum():
    np.testing.assert_allclose(values_of("uneven")[1:4], [1.68, 1.80, 2.52], atol=0.02)


def test_two_graphs_have_one_spectrum():
    (star, star_L), (square, square_L) = now(Mode, preset("twins"), 0).spectra
    np.testing.assert_allclose(star, [-2, 0, 0, 0, 2], atol=1e-12)
    np.testing.assert_allclose(square, star, atol=1e-12)
    np.testing.assert_allclose(star_L, [0, 1, 1, 1, 5], atol=1e-12)
    np.testing.assert_allclose(square_L, [0, 0, 2, 2, 4], atol=1e-12)
    text = caption_of(finished("graphs", preset("twins"))[0].scene).text
    assert "of A −2, 0, 0, 0, 2 for both" in text
    assert "of L = D − A 0, 1, 1, 1, 5 for the first, 0, 0, 2, 2, 4 for the second" in text
    assert "the two taken as one graph, λ = 0." in text


def test_truth_stands_beside_the_eigenvalues_where_it_is_known():
    for params in (
        Params(graph="ring", stage="spectrum", points=40),
        Params(graph="grid", stage="spectrum"),
    ):
        scene = finished("graphs", params)[-1].scene
        computed, true = scene["eigenvalues"], scene["true eigenvalues"]
        assert isinstance(computed, Curve)
        assert isinstance(true, Curve)
        np.testing.assert_allclose(computed.y, true.y, atol=1e-8)
    assert (
        "true eigenvalues"
        not in finished("graphs", Params(graph="karate", stage="spectrum"))[-1].scene
    )


# steps of L ---------------------------------------------------------------------------------------


def test_heat_settles_up_to_two_and_explodes_beyond():
    top = {
        size: float(
            np.abs(now(Heat, dataclasses.replace(preset("blow-up"), step_size=size)).u).max()
        )
        for size in (1.99, 2.5)
    }
    assert top[1.99] < 0.01
    assert top[2.5] > 1e11
    assert states(preset("blow-up"))[0].now.u.sum() == 1
    assert now(Heat, preset("warm")).u.sum() == pytest.approx(1)
    assert now(Heat, preset("warm")).error < 1e-3


def test_smoothing_eats_volume_and_taubin_does_not():
    shrunk, kept = (states(preset(name)) for name in ("shrink", "taubin"))
    assert measures.volume_share(shrunk[10]) == pytest.approx(0.88, abs=0.01)
    assert measures.volume_share(shrunk[-1]) == pytest.approx(0.62, abs=0.01)
    assert measures.volume_share(kept[-1]) == pytest.approx(1.01, abs=0.01)
    off = [measures.from_clean(run[-1], run[-1].now.p) for run in (shrunk, kept)]
    assert off[0] == pytest.approx(1.40, abs=0.02)
    assert off[1] == pytest.approx(0.21, abs=0.02)
    assert isinstance(shrunk[0].now, Smoothed)
    start = measures.from_clean(shrunk[0], shrunk[0].now.p)
    assert off[1] < start / 2 < start < off[0]


# networks -----------------------------------------------------------------------------------------


def test_many_layers_make_all_nodes_alike():
    layers = {
        s.now.layer: s
        for s in states(preset("deep"))
        if isinstance(s.now, Layer) and s.now.part == "layer"
    }
    assert [measures.right(layers[k]) for k in (2, 4, 8, 16, 32, 64)] == [32, 33, 33, 32, 27, 17]
    assert not measures.reached(layers[1]).all()
    assert measures.reached(layers[2]).all()
    differing = [measures.apart(layers[k]) for k in (1, 4, 16, 64)]
    assert (np.diff(differing) < 0).all()
    assert differing[-1] < 1e-3


def test_the_parts_of_a_layer():
    run = states(preset("layer"))
    assert [s.now.part for s in run] == [
        "input",
        "loops",
        "normalised",
        "gathered",
        "layer",
        "layer",
    ]
    assert run[2].now.matrix[0, 0] == pytest.approx(1 / 17)
    # W is the identity, nothing is negative
    np.testing.assert_array_equal(run[3].now.features, run[4].now.features)


def test_training_two_layers_and_eight():
    assert (
        np.mean([right(dataclasses.replace(preset("trained"), seed=seed)) for seed in range(5)])
        > 32
    )
    assert right(preset("deeper")) == 17
    loss = [s.now.loss for s in states(preset("trained")) if isinstance(s.now, Trained)]
    assert loss[-1] < 1e-3 < loss[0]


def test_a_hexagon_and_two_triangles_have_one_readout():
    state = states(preset("same"))[-1]
    assert isinstance(state.now, Layer)
    sums = [state.now.features[state.subject.classes == label].sum(axis=0) for label in (0, 1)]
    np.testing.assert_allclose(*sums, rtol=1e-9)
    assert np.abs(sums[0]).max() > 0


# questions ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "answer"),
    [("mutual", 2), ("club-right", 32), ("longer", 2), ("volume", 62), ("sixty-four", 2)],
)
def test_answers(name, answer):
    question = next(question for question in lesson.questions if question.name == name)
    assert question.answer(states(question.params)) == pytest.approx(answer, abs=0.5)


def test_answers_are_read_off_the_run():
    asked = {question.name: question for question in lesson.questions}
    assert asked["mutual"].answer(states(preset("one-way"))) == 0
    assert (
        asked["club-right"].answer(states(dataclasses.replace(preset("club"), weighted=True))) == 33
    )
    assert asked["longer"].answer(states(preset("warm"))) == 0
    assert asked["volume"].answer(states(preset("taubin"))) == pytest.approx(101, abs=1)
    assert asked["sixty-four"].answer(states(dataclasses.replace(preset("deep"), layers=32))) == 1


# slots, and what is refused -----------------------------------------------------------------------


def with_slots(params, **slots):
    return Timeline(lesson, params, slots).complete().states()


def test_slots_drive_the_run():
    run = with_slots(
        Params(points=60, stage="graph", k=2), knn_adjacency=lambda p, k: np.zeros((len(p), len(p)))
    )
    assert run[-1].now.count == 74
    run = with_slots(
        Params(graph="karate", stage="spectrum"), laplacian=lambda a: a - np.diag(a.sum(axis=1))
    )
    assert run[0].now.values[0] < -10
    run = with_slots(preset("layer"), gcn_layer=lambda a, x, w: np.zeros((34, w.shape[1])))
    assert (run[-1].now.features == 0).all()
    run = with_slots(preset("trained"), gcn_layer=lambda a, x, w: np.ones((34, w.shape[1])))
    assert np.ptp(run[-1].now.scores[:, 0] / run[-1].now.scores[:, 1]) < 1e-6


def test_answers_without_numbers_are_told():
    with pytest.raises(InputError, match="laplacian returned values that are not finite"):
        with_slots(Params(graph="karate"), laplacian=lambda a: np.full(a.shape, np.nan))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"join": "directed"}, "set join to union or mutual"),
        ({"laplacian": "cotangent"}, "cotangents need triangles"),
        ({"stage": "smooth", "k": 1, "join": "mutual"}, "no mean to move to"),
    ],
)
def test_what_cannot_be_is_said(changes, message):
    with pytest.raises(InputError, match=message):
        next(lesson.run(Params(**changes)))


def test_a_cut_is_drawn_in_two_colours_with_its_edges():
    scene = finished("graphs", Params())[-1].scene
    nodes, edges = scene["nodes"], scene["cut edges"]
    assert isinstance(nodes, Points)
    assert isinstance(nodes.color, Classes)
    assert isinstance(edges, Segments)
    assert len(edges.ends) == cut(Params()).cut
