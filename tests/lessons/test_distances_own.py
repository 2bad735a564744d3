"""Own meshes and clouds in the distances lesson: how they are read, said to be, and which are
refused.
"""

import dataclasses

import numpy as np
import pytest
import trimesh

from lessons.distances.lesson import lesson
from lessons.distances.state import Found, Params, State
from workbench.errors import InputError
from workbench.geometry.graphs import components, graph_of
from workbench.run.timeline import Timeline
from workbench.scene import caption_of


def last(params) -> State:
    return Timeline(lesson, params).complete().states()[-1]


def found(params) -> Found:
    distances = last(params).now
    assert isinstance(distances, Found)
    return distances


@pytest.fixture
def ball(tmp_path):
    trimesh.creation.icosphere(2, radius=30).export(tmp_path / "ball.stl")
    return tmp_path / "ball.stl"


def test_an_own_mesh_is_welded_and_made_two_metres_long(ball):
    state = last(Params(stage="surface", mesh=ball))
    assert state.subject is not None
    assert len(state.subject.p) == 162
    assert np.ptp(state.subject.p, axis=0).max() == pytest.approx(2)
    assert isinstance(state.now, Found)
    assert state.now.d.max() == pytest.approx(np.pi, rel=0.12)
    assert state.now.truth.max() == pytest.approx(np.pi, rel=0.03)  # by points on edges


@pytest.mark.parametrize("time", [-2.0, 0.0, 3.0])
def test_heat_over_an_own_mesh(ball, time):
    distances = found(Params(stage="surface", mesh=ball, method="heat", time=time))
    assert distances.d.max() == pytest.approx(np.pi, rel=0.15)


def test_an_own_cloud_has_no_truth(tmp_path):
    p = np.random.default_rng(0).random((400, 3)) * [2, 1, 0]
    np.savetxt(tmp_path / "sheet.xyz", p)
    timeline = Timeline(lesson, Params(stage="roll", cloud=tmp_path / "sheet.xyz", k=8)).complete()
    distances = timeline.states()[-1].now
    assert isinstance(distances, Found)
    assert not len(distances.truth)
    assert np.isnan(distances.worst)
    caption = caption_of(timeline[-1].scene)
    assert caption.tone == "info"
    assert "Nobody knows the truth" in caption.text
    assert "worst" not in timeline[-1].scene


def test_what_is_refused(tmp_path):
    few, same, text = tmp_path / "few.xyz", tmp_path / "one.xyz", tmp_path / "words.off"
    few.write_text("\n".join(f"0 0 {k}" for k in range(20)))
    same.write_text("\n".join("1 2 3" for _ in range(60)))
    text.write_text("no mesh at all")
    for params, message in (
        (Params(stage="roll", cloud=few), "at least 31"),
        (Params(stage="roll", cloud=same), "at one place"),
        (Params(stage="surface", mesh=text), "words.off"),
    ):
        with pytest.raises(InputError, match=message):
            next(lesson.run(params))


def test_pieces_that_no_way_joins(tmp_path):
    two = trimesh.util.concatenate(
        [trimesh.creation.icosphere(1), trimesh.creation.icosphere(1).apply_translation([5, 0, 0])]
    )
    two.export(tmp_path / "two.off")
    timeline = Timeline(lesson, Params(stage="surface", mesh=tmp_path / "two.off")).complete()
    distances = timeline.states()[-1].now
    assert isinstance(distances, Found)
    assert np.isinf(distances.d).sum() == 42
    assert "42 nodes cannot be reached" in caption_of(timeline[-1].scene).text
    heat = found(Params(stage="surface", mesh=tmp_path / "two.off", method="heat"))
    assert np.isfinite(heat.mean)


# real data ----------------------------------------------------------------------------------------


def test_heat_on_a_scanned_bunny(shared_data):
    params = Params(stage="surface", method="heat", mesh=shared_data / "shapes" / "bunny_npm.ply")
    distances = found(params)
    assert distances.times is not None
    mean = dict(zip(distances.times[0], distances.times[1], strict=True))
    assert mean[0.0] < 2.5
    assert mean[2.0] > 2 * mean[0.0]
    assert mean[-2.0] > 20  # far too short


def test_edges_of_fertility_are_too_long(shared_data):
    distances = found(Params(stage="surface", mesh=shared_data / "curvature" / "fertility.off"))
    assert 0.03 < distances.mean < 0.12
    assert (
        distances.error[np.isfinite(distances.error)] > -2e-3
    ).all()  # beside two points on every edge


def test_a_scan_is_thinned_and_joined(shared_data):
    params = Params(stage="roll", cloud=shared_data / "icp" / "bun000.ply", k=8)
    state = last(params)
    assert state.subject is not None
    assert len(state.subject.p) == 3000
    parts = components(graph_of(state.subject.edges, 3000))
    assert isinstance(state.now, Found)
    assert np.isfinite(state.now.d).sum() == np.sum(parts == parts[state.subject.source])
    more = found(dataclasses.replace(params, k=20))
    both = np.isfinite(state.now.d)
    assert (more.d[both] <= state.now.d[both] + 1e-9).all()  # more edges never make a way longer
