"""Claims of the distances lesson in numbers: the plane, grids, questions, slots and what is
refused.
"""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
import scipy

from lessons.distances import presets
from lessons.distances.lesson import lesson
from lessons.distances.stages import finer_grids
from lessons.distances.state import Ball, Found, Front, Landmarks, Params, Scatter, Trials
from tests.lessons.distances_runs import goal, now, preset, states
from tests.runs import finished
from tests.truths.distances import errors
from workbench.errors import InputError
from workbench.geometry.meshes import geodesics
from workbench.geometry.points import metrics
from workbench.run.timeline import Timeline
from workbench.scene import Mesh, Points, Segments, caption_of

# the plane ----------------------------------------------------------------------------------------


def test_other_metrics_have_other_nearest_points():
    changed = {name: now(Ball, preset(name)).changed.mean() for name in ("taxi", "units")}
    assert 0.05 < changed["taxi"] < 0.2
    assert now(Ball, Params(stage="balls", metric="cosine")).changed.mean() > 0.4
    assert changed["units"] == pytest.approx(0.80, abs=0.005)
    assert changed["taxi"] == pytest.approx(0.13, abs=0.005)
    ball = now(Ball, preset("taxi"))
    np.testing.assert_allclose(np.abs(ball.rims[0] - ball.p[ball.query]).sum(axis=1), ball.radius)
    assert ball.radius == ball.d.min()


@pytest.mark.parametrize(("name", "mine", "straight"), [("taxi", 10, 18), ("units", 9, 12)])
def test_the_point_that_is_said_to_be_nearest_is(name, mine, straight):
    ball = now(Ball, preset(name))
    apart = np.delete(ball.p, ball.query, axis=0) - ball.p[ball.query]
    others = np.delete(np.arange(len(ball.p)), ball.query)
    by = np.abs(apart).sum(axis=1) if name == "taxi" else np.hypot(apart[:, 0], 1000 * apart[:, 1])
    assert others[by.argmin()] == mine == np.argmin(ball.d)
    assert others[np.linalg.norm(apart, axis=1).argmin()] == straight == ball.straight
    text = caption_of(finished("distances", preset(name))[-1].scene).text
    assert f"first point, {mine}:" in text
    assert f"it is point {straight}." in text
    drawn = finished("distances", preset(name))[-1].scene["nearest/euclid"]
    assert isinstance(drawn, Points)
    np.testing.assert_array_equal(drawn.p[0, :2], ball.p[straight])


def test_dijkstra_needs_no_triangle_inequality_and_returns_a_metric():
    """Weights (u + 0.1)^4 break it for many triples; what comes out is Floyd's and Warshall's, and
    a metric.
    """
    rng = np.random.default_rng(0)
    n = 60
    edges = np.stack(np.triu_indices(n, 1), axis=1)
    w = (rng.random(len(edges)) + 0.1) ** 4
    given = np.zeros((n, n))  # of the graph, 0 being no edge
    given[tuple(edges.T)] = given[tuple(edges.T[::-1])] = w
    assert (given[:, None, :] > given[:, :, None] + given[None] + 1e-12).mean() > 0.2
    D = np.array([geodesics.shortest_distances(edges, w, n, source) for source in range(n)])
    np.testing.assert_allclose(D, scipy.sparse.csgraph.floyd_warshall(given), atol=1e-12)
    assert not (D[:, None, :] > D[:, :, None] + D[None] + 1e-12).any()


@pytest.mark.parametrize(
    ("metric", "share"),
    [("euclid", 0), ("squared", 0.24), ("cosine", 0.34), ("p", 0.156), ("p-sum", 0)],
)
def test_which_of_them_are_metrics(metric, share):
    trials = now(Trials, Params(stage="axioms", metric=metric))
    assert trials.broken / trials.tried == pytest.approx(share, abs=0.02)
    tone = caption_of(finished("distances", Params(stage="axioms", metric=metric))[-1].scene).tone
    assert trials.axioms["d(a, b) > 0"] == (metric == "cosine")
    assert tone in ("info", "wrong")


def test_a_scatter_is_made_round():
    run = states(preset("whiten"))
    round_ = run[3].now
    assert isinstance(round_, Scatter)
    np.testing.assert_allclose(np.cov(round_.p.T), np.eye(2), atol=1e-9)
    # Mahalanobis' distance is Euclid's now
    np.testing.assert_allclose(np.linalg.norm(round_.p, axis=1), round_.d)
    np.testing.assert_allclose(np.linalg.norm(round_.rim, axis=1), 2.4477, atol=1e-4)
    np.testing.assert_allclose(np.mean(run[1].now.p, axis=0), 0, atol=1e-12)
    assert now(Scatter, preset("whiten"), 4).flagged.mean() == pytest.approx(0.05, abs=0.03)


def test_within_two_in_ever_more_dimensions():
    shares = now(Scatter, preset("whiten")).shares
    assert shares is not None
    np.testing.assert_allclose(shares[1][[0, 1, 2, 9]], [0.954, 0.865, 0.739, 0.053], atol=0.001)
    np.testing.assert_allclose(shares[0], shares[1], atol=0.025)


def test_outliers_hide_themselves_and_are_found_by_the_closest_half():
    masked, robust = (now(Scatter, preset(name), presets.TOLD) for name in ("masking", "robust"))
    assert masked.d[masked.outlier].mean() == pytest.approx(2.15, abs=0.05)
    assert not masked.flagged[masked.outlier].any()
    clean = metrics.mahalanobis(masked.p, *metrics.mean_and_covariance(masked.p[~masked.outlier]))
    assert clean[masked.outlier].mean() == pytest.approx(9.0, abs=0.7)
    assert robust.d[robust.outlier].mean() == pytest.approx(9.2, abs=0.7)
    assert robust.flagged[robust.outlier].all()


def test_the_right_landmark_by_the_ellipse_of_the_measurement():
    seen = [now(Landmarks, replace(preset("stereo"), seed=seed)) for seed in range(4)]
    assert np.mean(
        [np.mean(landmarks.euclid == landmarks.true) for landmarks in seen]
    ) == pytest.approx(0.60, abs=0.06)
    assert np.mean(
        [np.mean(landmarks.mahalanobis == landmarks.true) for landmarks in seen]
    ) == pytest.approx(0.95, abs=0.03)


# grids --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("params", "worst", "mean", "way"),
    [
        (Params(), 8.24, 4.1, 4.1),
        (preset("staircase"), 41.4, 31, 39),
        (Params(neighbours="16"), 2.75, 1.0, 0.5),
        (preset("marching"), 10.0, 4.9, 6.1),
        (Params(neighbours="march", grid=81), 6.0, 2.9, 3.6),
    ],
)
def test_errors_round_the_wall(params, worst, mean, *, way):
    distances = now(Found, params)
    assert 100 * distances.worst == pytest.approx(worst, abs=0.4)
    assert 100 * distances.mean == pytest.approx(mean, abs=0.4)
    d, true = goal(params)
    assert true == pytest.approx(np.hypot(0.3, 0.3) + np.hypot(0.3, 0.5), abs=0.012)
    assert 100 * (d / true - 1) == pytest.approx(way, abs=0.6)
    np.testing.assert_allclose(
        errors(states(params)[-1]), distances.error[np.isfinite(distances.error)], atol=1e-12
    )


def test_the_error_along_edges_stays_and_that_of_marching_falls():
    study = {name: 10**error for name, (_, error) in finer_grids().items()}
    for name, worst in (("4 neighbours", 41.42), ("8 neighbours", 8.24), ("16 neighbours", 2.75)):
        np.testing.assert_allclose(study[name], worst, atol=0.012)
    np.testing.assert_allclose(study["marching"], [15.0, 12.1, 8.0, 5.3, 3.3], atol=0.06)
    np.testing.assert_allclose(study["marching, exact disc"][1:], [8.0, 3.6, 1.7, 0.8], atol=0.06)
    # coarse grids: Dijkstra is nearer the truth
    assert study["marching"][1] > study["8 neighbours"][1]


@pytest.mark.parametrize(
    ("side", "marching", "words"), [(41, 10.0, "nearer to the truth"), (81, 6.0, "farther off")]
)
def test_marching_is_held_against_eight_neighbours_on_the_same_grid(side, marching, words):
    params = Params(neighbours="march", grid=side)
    distances = now(Found, params)
    assert 100 * distances.worst == pytest.approx(marching, abs=0.4)
    assert (
        distances.eight == now(Found, Params(grid=side)).worst == pytest.approx(0.082, abs=0.0005)
    )
    assert (
        f"Ways to 8 neighbours are {words} on this grid"
        in caption_of(finished("distances", params)[-1].scene).text
    )


def test_a_disc_of_exact_distances_helps_everywhere():
    disc, bare = (now(Found, replace(preset("disc"), disc=radius)) for radius in (0.1, 0.0))
    assert disc.mean < 0.6 * bare.mean


def test_fronts_accept_in_the_order_of_distance():
    for params in (Params(), preset("marching")):
        fronts = [state.now for state in states(params) if isinstance(state.now, Front)]
        end = now(Found, params).d
        for front, later in pairwise(fronts):
            assert later.accepted[front.accepted].all()
            np.testing.assert_array_equal(end[front.accepted], front.d[front.accepted])
            assert (end[~front.accepted] >= front.reach - 1e-9).all()


def test_the_wall_is_not_walked_through():
    subject = states(Params())[0].subject
    assert np.isinf(now(Found, Params()).d[~subject.free]).all()
    path = now(Found, Params()).path
    for a, b in pairwise(path):
        if (a[0] - subject.tip[0]) * (b[0] - subject.tip[0]) < 0:
            assert min(a[1], b[1]) >= subject.tip[1] - 1e-9


# questions ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "answer", "within"),
    [
        ("finer", 2, 0.1),
        ("two-sigma", 86.5, 1.5),
        ("twenty", 19 / np.sqrt(20), 0.05),
        ("squares", 24.2, 1.5),
        ("longer", 2, 0.1),
        ("shortcut", 2.54, 0.01),
    ],
)
def test_answers(name, answer, within):
    question = next(question for question in lesson.questions if question.name == name)
    assert question.answer(states(question.params)) == pytest.approx(answer, abs=within)


def test_answers_are_read_off_the_run():
    asked = {question.name: question for question in lesson.questions}
    assert asked["longer"].answer(states(preset("flattered"))) == 1
    assert asked["shortcut"].answer(states(preset("roll"))) == pytest.approx(6.52, abs=0.01)
    assert asked["squares"].answer(states(preset("half"))) == pytest.approx(15.6, abs=1.5)


# slots, and what is refused -----------------------------------------------------------------------


def with_slots(params, **slots):
    return Timeline(lesson, params, slots).complete().states()


def test_slots_drive_the_run():
    def hops(edges, lengths, count, source):  # noqa: PLR0917
        return np.where(np.arange(count) == source, 0.0, 1.0)

    for params in (
        Params(grid=11),
        Params(stage="surface", points=42),
        Params(stage="roll", points=100, k=6),
    ):
        distances = with_slots(params, shortest_distances=hops)[-1].now
        assert set(np.unique(distances.d)) == {0.0, 1.0}
    run = with_slots(
        Params(grid=21, wall=0.0, neighbours="march"),
        eikonal_update=lambda a, b, h: np.minimum(a, b) + h,
    )
    assert 100 * run[-1].now.worst == pytest.approx(41.4, abs=0.1)  # Manhattan's
    run = with_slots(
        Params(stage="whiten", points=50), mahalanobis=lambda p, mean, C: np.full(len(p), 7.0)
    )
    assert (run[4].now.d == 7).all()
    run = with_slots(
        preset("stereo"), mahalanobis=lambda p, mean, C: np.linalg.norm(p - mean, axis=1)
    )
    np.testing.assert_array_equal(run[-1].now.mahalanobis, run[-1].now.euclid)


def test_answers_that_are_no_distances_are_told():
    with pytest.raises(InputError, match="are no distances"):
        with_slots(Params(), shortest_distances=lambda e, w, n, s: np.full(n, np.nan))
    with pytest.raises(InputError, match="not finite"):
        with_slots(Params(stage="whiten"), mahalanobis=lambda p, m, C: np.full(len(p), np.inf))
    for update in (lambda a, b, h: np.full(len(a), np.nan), lambda a, b, h: np.minimum(a, b) - h):
        run = with_slots(Params(neighbours="march", grid=11), eikonal_update=update)
        assert np.isfinite(run[-1].now.d).sum() == 1  # the front does not get away from the source


def test_nodes_that_nobody_reaches_are_told():
    run = with_slots(
        Params(grid=11),
        shortest_distances=lambda e, w, n, s: np.where(np.arange(n) == s, 0.0, np.inf),
    )
    assert isinstance(run[-1].now, Found)
    caption = caption_of(
        Timeline(
            lesson,
            Params(grid=11),
            {"shortest_distances": lambda e, w, n, s: np.where(np.arange(n) == s, 0.0, np.inf)},
        )
        .complete()[-1]
        .scene
    )
    assert "1 of" in caption.text


def test_what_cannot_be_is_said():
    side, middle = 41, 20
    with pytest.raises(InputError, match="lies in the wall"):
        next(lesson.run(Params(source=middle * side + 3)))
    with pytest.raises(InputError, match="cannot have 15 neighbours"):
        next(lesson.run(Params(stage="roll", points=12)))


def test_a_click_moves_the_source():
    for params in (
        Params(source=5),
        Params(stage="surface", source=17),
        Params(stage="roll", points=300, source=9),
    ):
        subject = states(params)[-1].subject
        distances = now(Found, params)
        assert subject.source == params.source
        assert distances.d[params.source] == distances.truth[params.source] == 0
    assert now(Ball, Params(stage="balls", source=8)).query == 8


def test_what_is_drawn():
    scene = finished("distances", Params())[-2].scene
    assert isinstance(scene["nodes"], Mesh)
    assert isinstance(scene["way"], Segments)
    assert isinstance(scene["true way"], Segments)
    assert len(scene["true way"].ends) == 2  # over the tip of the wall
    roll = finished("distances", presets.SHORTCUT)[-1].scene
    assert isinstance(roll["nodes"], Points)
    assert isinstance(roll["shortcuts"], Segments)
    assert len(roll["shortcuts"].ends) == 1
