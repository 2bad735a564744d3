"""Own graphs, meshes and clouds in the graphs lesson: how they are read, said to be, and which are
refused.
"""

import dataclasses

import numpy as np
import pytest
import trimesh

from lessons.graphs import measures
from lessons.graphs.lesson import lesson
from lessons.graphs.state import Grown, Mode, Params, State
from workbench.algorithms.graphs.diffusion import Heat
from workbench.algorithms.graphs.spectral_cut import Cut
from workbench.data.networks import karate
from workbench.errors import InputError
from workbench.geometry.graphs import adjacency as graphs
from workbench.geometry.meshes import triangles as meshes
from workbench.run.timeline import Timeline
from workbench.scene import Scalar, Table, caption_of


def last(params) -> State:
    return Timeline(lesson, params).complete().states()[-1]


def cut_of(params) -> Cut:
    cut = last(params).now
    assert isinstance(cut, Cut)
    return cut


@pytest.fixture
def friends(tmp_path):
    path = tmp_path / "friends.csv"
    path.write_text(
        "source,target\n" + "\n".join(f"actor {a + 1},actor {b + 1}" for a, b in karate().edges)
    )
    return path


def test_an_edge_list_is_the_graph_that_it_lists(friends):
    timeline = Timeline(lesson, Params(edges=friends)).complete()
    ours = next(
        step.state.now
        for step in Timeline(lesson, Params(graph="karate")).complete().known()
        if step.state.last
    )
    cut = timeline.states()[-1].now
    assert isinstance(cut, Cut)
    assert isinstance(ours, Cut)
    assert cut.conductance == pytest.approx(ours.conductance)
    assert measures.right(timeline.states()[-1]) is None  # nobody knows
    assert caption_of(timeline[9].scene).tone == "info"
    assert not any(
        isinstance(primitive, Scalar) and primitive.chart == "Right"
        for primitive in timeline[9].scene.values()
    )
    table = (
        Timeline(lesson, Params(edges=friends, stage="network")).complete()[3].scene["sum table"]
    )
    assert isinstance(table, Table)
    assert table.rows[0][0].startswith("node actor ")


@pytest.mark.parametrize(
    "stage", ["graph", "matrix", "spectrum", "cut", "heat", "smooth", "network", "training"]
)
def test_every_stage_takes_an_own_graph(friends, stage):
    assert last(Params(edges=friends, stage=stage, steps=3)).last


def test_an_own_mesh_is_welded_and_made_two_metres_long(tmp_path):
    ball = trimesh.creation.icosphere(2)
    soup = trimesh.Trimesh(
        ball.triangles.reshape(-1, 3), np.arange(3 * len(ball.faces)).reshape(-1, 3), process=False
    )
    soup.export(tmp_path / "ball.stl")
    state = last(
        Params(mesh=tmp_path / "ball.stl", stage="spectrum", laplacian="cotangent", modes=9)
    )
    assert len(state.subject.p) == len(ball.vertices)
    assert np.ptp(state.subject.p, axis=0).max() == pytest.approx(2)
    assert isinstance(state.now, Mode)
    np.testing.assert_allclose(state.now.values[1:4], 2, rtol=0.03)
    np.testing.assert_allclose(state.now.values[4:9], 6, rtol=0.05)


def test_what_is_refused(tmp_path, friends):
    few, same = tmp_path / "few.xyz", tmp_path / "one.xyz"
    few.write_text("\n".join(f"0 0 {k}" for k in range(20)))
    same.write_text("\n".join("1 2 3" for _ in range(30)))
    for params, message in (
        (Params(edges=friends, cloud=few), "one own file at a time"),
        (Params(cloud=few), "at least 21"),
        (Params(cloud=same), "at one place"),
        (Params(edges=few), "text files"),
        (Params(edges=friends, laplacian="cotangent"), "need triangles"),
    ):
        with pytest.raises(InputError, match=message):
            next(lesson.run(params))


# real data ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(("name", "genus"), [("bunny", 0), ("fertility", 4)])
def test_scanned_meshes(shared_data, name, genus):
    params = Params(mesh=shared_data / "curvature" / f"{name}.off", stage="spectrum", modes=6)
    state = last(params)
    count = len(state.subject.p)
    mean = graphs.degrees(state.adjacency).mean()
    assert mean == pytest.approx(6 - 12 * (1 - genus) / count)  # Euler, on a closed mesh
    assert isinstance(state.now, Mode)
    values, functions = state.now.values, state.now.functions
    assert values[0] == pytest.approx(0, abs=1e-9)
    assert (values[1:] > 1e-6).all()
    L = graphs.laplacian(meshes.adjacency(state.subject.faces, count))
    np.testing.assert_allclose(L @ functions, functions * values, atol=1e-7)


def test_a_scanned_mesh_is_cut_and_smoothed(shared_data):
    mesh = shared_data / "shapes" / "bunny_npm.ply"
    cut = cut_of(Params(mesh=mesh))
    assert cut.conductance == cut.conductances.min() < 0.05
    shrunk, kept = (
        measures.volume_share(last(Params(mesh=mesh, stage="smooth", filter=how)))
        for how in ("laplace", "taubin")
    )
    assert shrunk == pytest.approx(0.66, abs=0.03)
    assert kept == pytest.approx(1.01, abs=0.02)
    blown = last(Params(mesh=mesh, stage="heat", steps=100, step_size=2.5))
    assert isinstance(blown.now, Heat)
    assert np.abs(blown.now.u).max() > 1e8


def test_a_scan_is_thinned_and_grows(shared_data):
    params = Params(cloud=shared_data / "icp" / "bun000.ply", stage="graph", k=6)
    state = last(params)
    assert isinstance(state.now, Grown)
    assert len(state.subject.p) == 3000
    assert state.now.count <= 4
    assert 0.1 < state.now.one_way < 0.3
    mutual = last(dataclasses.replace(params, join="mutual"))
    assert isinstance(mutual.now, Grown)
    assert mutual.now.count > state.now.count
