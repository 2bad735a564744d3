"""Every claim of the representations lesson in numbers: presets, questions, page and slots."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from lessons.representations.forms import FORMS, Functions, cube
from lessons.representations.lesson import draw, lesson, run
from lessons.representations.state import Cells, Fitted, Joined, Params, Patches, Searched, State
from lessons.representations.subjects import HALF, measured, subject_of
from tests.runs import finished
from workbench.algorithms.spatial.octree import Level
from workbench.certain import sure
from workbench.geometry.fields.signed_distances import box_sdf
from workbench.geometry.level_sets import edge_crossings, level_surface
from workbench.geometry.meshes import euler_characteristic
from workbench.geometry.shapes.bezier import bezier_patch
from workbench.scene import Points, caption_of

OURS = Functions(bezier_patch=bezier_patch, edge_crossings=edge_crossings)


def states(params: Params) -> tuple[Any, ...]:
    return finished(lesson.name, params).states()


def of(name: str) -> tuple[Any, ...]:
    return states(lesson.preset(name).params)


def surfaces_of(run_: tuple[Any, ...]) -> list[Any]:
    return [state.surface for state in run_[:-1] if state.surface is not None]


def last_before_others(params: Params) -> State:
    """The last step of the form, without the comparison."""
    *_, last = FORMS[params.form](params, subject_of(params, box_sdf), OURS)
    return last


def slope(state: State, first: int = 0) -> float:
    return float(np.polyfit(np.log(state.sizes[first:]), np.log(state.errors[first:]), 1)[0])


# presets ------------------------------------------------------------------------------------------


def test_the_volume_of_bits_converges_and_area_and_normals_do_not():
    surfaces = surfaces_of(of("binary"))
    areas, volumes, tilts = (
        np.array([getattr(s, name) for s in surfaces]) for name in ("area", "volume", "tilt")
    )
    np.testing.assert_allclose(areas[[2, 4, 6]], [1.099, 1.083, 1.086], atol=0.002)
    assert abs(volumes[-1] - 1) < 0.01
    assert (tilts > 15).all()
    walls = [
        state.now.walls / state.subject.area
        for state in of("binary")[:-1]
        if isinstance(state.now, Cells)
    ]
    assert walls[-1] == pytest.approx(1.45, abs=0.03)


def test_distances_beat_bits_by_an_order():
    bits = of("binary")[-1]
    stored = states(Params())[-1]
    assert slope(bits, 2) == pytest.approx(-1 / 3, abs=0.08)
    assert slope(stored) == pytest.approx(-2 / 3, abs=0.06)
    assert stored.surface.area == pytest.approx(0.996, abs=0.001)
    assert stored.surface.tilt < 5
    assert euler_characteristic(stored.surface.faces) == 0


def test_edges_are_bevelled_by_a_share_of_a_cell_at_every_size():
    params = replace(lesson.preset("edges").params, resolution=64)
    shares = []
    for state in FORMS["distances"](params, subject_of(params, box_sdf), OURS):
        if state.surface is not None and isinstance(state.now, Cells):
            shares.append(state.surface.worst / float(state.now.grid.spacing[0]))
    assert len(shares) == 7
    assert min(shares) > 0.25
    assert max(shares) < 0.55
    assert shares[-1] > 0.8 * min(shares)


def test_what_is_thinner_than_a_cell_is_lost_though_its_cells_count():
    kept, counted = {}, {}
    for thickness in (0.2, 0.5, 0.8):
        areas, volumes = [], []
        for seed in range(8):
            subject = subject_of(Params(shape="plate", thickness=thickness, seed=seed), box_sdf)
            grid = cube(32)
            values = subject.field(grid.centres()).reshape(grid.shape)
            areas.append(measured(subject, *level_surface(values, grid)).area)
            volumes.append((values < 0).sum() * grid.cell_volume / subject.volume)
        kept[thickness], counted[thickness] = np.mean(areas), np.mean(volumes)
    assert kept[0.2] < 0.1 < 0.25 < kept[0.5] < 0.5 < 0.75 < kept[0.8] < 0.95
    np.testing.assert_allclose(list(counted.values()), 1, atol=0.1)
    end = caption_of(draw(of("thin")[-1]))
    assert end.tone == "wrong"
    assert "came back" in end.text


def test_the_smaller_of_two_distances_is_one_outside_only():
    subject = of("union")[0].subject
    q = np.random.default_rng(0).uniform(-1, 1, (3000, 3))
    stored, true = subject.field(q), subject.distance(q)
    assert np.abs(stored - true)[true > 0].max() < 1e-12
    assert subject.field(np.zeros((1, 3)))[0] == pytest.approx(-0.05)
    assert subject.distance(np.zeros((1, 3)))[0] == pytest.approx(-0.3)
    assert ((stored < 0) == (true < 0)).all()


def test_four_times_the_points_half_the_distance():
    last = of("cloud")[-1]
    assert slope(last, 2) == pytest.approx(-0.5, abs=0.03)
    at = dict(zip(last.sizes, last.errors, strict=True))
    assert at[1_200_000] == pytest.approx(3.9e-3, rel=0.05)


def test_more_neighbours_make_one_piece_and_leave_the_surface():
    graphs = [state.now for state in of("neighbours")[:-1] if isinstance(state.now, Joined)]
    assert [graph.k for graph in graphs] == list(range(11))
    pieces = np.array([graph.pieces for graph in graphs])
    assert (np.diff(pieces) <= 0).all()
    assert pieces[5] == 1 < pieces[3]
    means = [graph.mean for graph in graphs[1:]]
    assert (np.diff(means) > 0).all()
    assert graphs[10].worst > 1.5 * graphs[5].worst > 1.5 * graphs[1].worst
    assert of("neighbours")[-2].bytes == 600 * (12 + 40)


def test_twice_the_vertices_half_the_error():
    assert slope(of("triangles")[-1]) == pytest.approx(-1, abs=0.03)


def test_an_octree_grows_with_the_surface():
    levels = [state.now for state in of("octree")[:-1]]
    assert all(isinstance(level, Level) for level in levels)
    packed = np.array([level.packed_bytes for level in levels])
    np.testing.assert_allclose(packed[5:] / packed[4:-1], 4.1, atol=0.3)
    assert packed[3] > levels[3].dense_bytes
    assert packed[7] < 0.12 * levels[7].dense_bytes
    assert levels[5].pointer_bytes > 15 * levels[5].dense_bytes


def test_searches_look_at_few_points_until_there_are_many_dimensions():
    growth = of("search")[-1].growth
    assert growth is not None
    assert 0.6 < growth.looked[-1] / growth.looked[1] < 1.5
    assert (growth.looked < 45).all()
    share = dict(zip(growth.dimensions.tolist(), growth.shares, strict=True))
    assert share[3] < 0.01
    assert 0.08 < share[10] < 0.35
    assert share[20] > 0.9
    ends = {
        name: [s.now for s in of(name) if isinstance(s.now, Searched)][-1]
        for name in ("search", "twenty")
    }
    assert ends["search"].visits[-1].looked < 60
    assert ends["twenty"].visits[-1].looked > 3600
    assert all(end.done for end in ends.values())


def test_weights_make_the_torus_and_cubics_miss_it():
    cubic, rational = of("cubic")[-1], of("rational")[-1]
    assert cubic.surface.worst == pytest.approx(2.8e-4, abs=1e-5)
    assert rational.surface.worst < 1e-14
    # as the page says
    assert (cubic.surface.mean, of("cloud")[-1].errors[-1]) == pytest.approx((6e-5, 4e-3), rel=0.06)
    assert isinstance(cubic.now, Patches)
    assert (len(cubic.now.net), cubic.bytes) == (144, 1728)
    assert (len(rational.now.net), rational.bytes) == (64, 1024)


def test_a_network_learns_a_torus_in_six_kilobytes():
    run_ = of("neural")
    at = {s.now.trained.iterations: s.surface.mean for s in run_[:-1] if isinstance(s.now, Fitted)}
    assert at[100] > 1.5 * at[300] > 2 * at[1000]
    assert at[1000] < 6e-3
    assert run_[-1].bytes == 4 * 1601
    losses = [s.now.trained.loss for s in run_[:-1]]
    assert losses[-1] < 0.01 * losses[0]


def test_without_waves_it_stays_behind_and_the_clamp_can_kill_it():
    plain = of("plain")[-1]
    waves = states(Params(form="neural"))[-1]
    assert [plain.surface.mean, waves.surface.mean] == pytest.approx([0.078, 0.019], abs=0.0005)
    dead = of("clamp")
    assert len(dead[-1].surface.faces) == 0
    assert caption_of(draw(dead[-1])).tone == "wrong"
    assert dead[-1].now.values.min() > 0.1  # beyond the clamp everywhere
    clamped = lesson.preset("clamp").params
    alive = [
        len(sure(last_before_others(replace(clamped, seed=seed, iterations=100)).surface).faces) > 0
        for seed in range(8)
    ]
    assert 2 <= sum(alive) <= 6


# questions ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "answer"),
    [
        ("predict-half", 1),
        ("predict-area", 1),
        ("predict-looked", 2),
        ("predict-middle", 1),
        ("predict-weights", 0),
    ],
)
def test_answers(name, answer):
    question = next(question for question in lesson.questions if question.name == name)
    assert question.answer(states(question.params)) == answer


def test_answers_are_read_off_the_run():
    asked = {question.name: question for question in lesson.questions}
    assert asked["predict-weights"].answer(of("cubic")) == 1
    assert asked["predict-area"].answer(states(Params())) == 0
    moved = tuple(
        run(Params(shape="two boxes", resolution=8), box_sdf=lambda p, half: box_sdf(p, half) - 0.2)
    )
    assert asked["predict-middle"].answer(moved) == 0


# slots and drawing --------------------------------------------------------------------------------


def test_slots_drive_the_run():
    right = last_before_others(Params(resolution=16)).surface
    *_, last = run(Params(resolution=16), edge_crossings=lambda a, b, f_a, f_b: (a + b) / 2)
    assert right is not None
    assert last.surface is not None
    assert last.surface.mean > 2 * right.mean
    *_, last = run(Params(form="patches"), bezier_patch=lambda control, uv: np.zeros((len(uv), 3)))
    assert last.surface is not None
    assert last.surface.mean > 0.3
    *_, last = run(Params(shape="box", resolution=16), box_sdf=lambda p, half: np.ones(len(p)))
    assert caption_of(draw(last)).tone == "wrong"


def test_the_same_box_by_another_function_is_the_same_run():
    def largest(p: np.ndarray, half: np.ndarray) -> np.ndarray:
        return (np.abs(p) - half).max(axis=1)

    *_, last = run(Params(shape="box", resolution=16), box_sdf=largest)
    assert last.surface is not None
    assert last.surface.volume == pytest.approx(8 * HALF.prod() / (8 * HALF.prod()), abs=0.1)


def test_what_was_looked_at_is_drawn():
    state = next(s for s in of("search") if isinstance(s.now, Searched))
    scene = draw(state)
    looked, rest = scene["looked"], scene["points"]
    assert isinstance(looked, Points)
    assert isinstance(rest, Points)
    assert len(looked.p) + len(rest.p) == 1000
    assert isinstance(state.now, Searched)
    assert len(looked.p) == state.now.visits[-1].looked
