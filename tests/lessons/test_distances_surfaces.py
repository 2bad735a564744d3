"""The claims of the distances lesson over surfaces in numbers: spheres, the rabbit, flipped edges,
heat and a roll.
"""

from dataclasses import replace

import numpy as np
import pytest

from lessons.distances import presets
from lessons.distances.lesson import lesson
from lessons.distances.stages import finer_spheres
from lessons.distances.state import Found, Params
from tests.lessons.distances_runs import goal, now, preset, states
from tests.runs import finished
from tests.truths.distances import true_distances
from workbench.geometry.meshes import geodesics
from workbench.run.timeline import Timeline
from workbench.scene import Table, caption_of

# surfaces -----------------------------------------------------------------------------------------


def test_over_a_sphere():
    edges, points = (now(Found, preset(name)) for name in ("sphere", "points"))
    assert 100 * edges.mean == pytest.approx(6.2, abs=0.1)
    assert 100 * edges.worst == pytest.approx(16.1, abs=0.2)
    assert 100 * points.mean == pytest.approx(0.4, abs=0.05)
    study = {name: 10**error for name, (_, error) in finer_spheres().items()}
    assert (study["edges"][1:] > 18).all()
    assert (np.diff(study["heat"]) < 0).all()
    assert study["heat"][-1] == pytest.approx(2.07, abs=0.05)
    assert study["3 points on each edge"][-1] == pytest.approx(1.16, abs=0.03)
    assert (
        np.diff(study["3 points on each edge"][1:]) > 0
    ).all()  # nor do a fixed number of points converge


def test_obtuse_triangles_and_their_edges_flipped():
    wrung, flipped = (now(Found, preset(name)) for name in ("wrung", "delaunay"))
    assert (wrung.negative, flipped.negative) == (848, 0)
    off = [
        [
            100 * f(np.abs(distances.error[np.isfinite(distances.error)]))
            for f in (np.mean, np.median, np.max)
        ]
        for distances in (wrung, flipped)
    ]
    np.testing.assert_allclose(off, [[19.9, 20.0, 48.5], [1.45, 1.31, 5.01]], atol=0.06)
    np.testing.assert_array_equal(
        *(states(preset(name))[0].subject.p for name in ("wrung", "delaunay"))
    )
    texts = [
        caption_of(finished("distances", preset(name))[3].scene).text
        for name in ("wrung", "delaunay")
    ]
    assert "848 edges have a negative weight" in texts[0]
    assert "negative" not in texts[1]
    assert texts[1].endswith("Right to 2 %.")


def test_distances_below_zero_are_told(tmp_path):
    import trimesh

    from workbench.data.shapes.rabbit import rabbit_mesh

    p, faces = rabbit_mesh(0.05)
    trimesh.Trimesh(p * [1, 1, 6], faces, process=False).export(tmp_path / "tall.ply")
    tall = Params(stage="surface", method="heat", mesh=tmp_path / "tall.ply", source=590)
    before, mended = (
        Timeline(lesson, replace(tall, delaunay=flip)).complete() for flip in (False, True)
    )
    assert "72 % of the distances are below 0." in caption_of(before[3].scene).text
    assert mended.states()[3].now.below == 0
    assert "below 0" not in caption_of(mended[3].scene).text


def test_the_time_of_heat():
    plain, early, late = (
        now(Found, params) for params in (preset("heat"), preset("early"), presets.LATE)
    )
    assert tuple(
        round(100 * float(np.nanmean(np.abs(distances.error))), 1)
        for distances in (plain, early, late)
    ) == (
        1.9,
        26.0,
        8.4,
    )
    assert early.mean < -0.25
    assert late.times is not None
    np.testing.assert_allclose(late.times[1][[0, 4, 8]], [26.0, 1.95, 8.35], atol=0.1)
    flattered = now(Found, preset("flattered")).times
    assert flattered is not None
    assert flattered[1][8] < flattered[1][4]  # on a sphere a longer time looks better


def test_a_less_regular_mesh_does_not_help_ways_along_edges():
    regular, moved = (now(Found, preset(name)) for name in ("sphere", "jitter"))
    assert 0.045 < moved.mean < regular.mean
    np.testing.assert_allclose(np.linalg.norm(states(preset("jitter"))[0].subject.p, axis=1), 1)
    for distances in (regular, moved):
        coarse, fine = 10 ** distances.study["edges"][1][[0, -1]]
        assert fine > 0.6 * coarse  # while its edges are an eighth as long
        assert 10 ** distances.study["heat"][1][-1] < 0.25 * 10 ** distances.study["heat"][1][0]


def test_heat_distance_is_no_metric():
    distances = now(Found, preset("heat"))
    assert distances.broken == pytest.approx(0.015, abs=0.0005)
    assert np.median(distances.asymmetry) == pytest.approx(0.014, abs=0.0005)
    assert distances.asymmetry.max() == pytest.approx(0.17, abs=0.005)
    run = finished("distances", preset("heat"))
    # right, and no metric
    assert [caption_of(run[step].scene).tone for step in (-2, -1)] == ["good", "info"]
    table = finished("distances", preset("heat"))[-1].scene["metric"]
    assert isinstance(table, Table)


def test_the_reference_of_the_rabbit_is_near_that_of_more_points():
    from lessons.distances.subjects import subject_of

    subject = subject_of(preset("heat"))
    nodes, edges, lengths = geodesics.with_points_on_edges(subject.p, subject.faces, 7)
    finer = geodesics.shortest_distances(edges, lengths, len(nodes), subject.source)[
        : len(subject.p)
    ]
    known = now(Found, preset("heat")).truth
    off = known[finer > 0.1] / finer[finer > 0.1] - 1
    assert (off > -1e-9).all() or off.min() > -2e-3  # other points, not the same ones and more
    assert off.mean() < 2.5e-3


def test_one_edge_ruins_the_ways_over_a_roll():
    d, true = goal(preset("roll"))
    assert d / true == pytest.approx(1.015, abs=0.003)
    assert not states(preset("roll"))[0].subject.shortcuts.any()
    d, true = goal(presets.SHORTCUT)
    assert states(presets.SHORTCUT)[0].subject.shortcuts.sum() == 1
    assert (round(d, 2), round(true, 2)) == (2.54, 6.42)
    np.testing.assert_allclose(
        true_distances(states(preset("roll"))[-1]), now(Found, preset("roll")).truth, atol=1e-4
    )
