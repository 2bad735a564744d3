"""Every claim of the curvature lesson in numbers: presets, questions, page, slots, own meshes, and what is drawn."""

import dataclasses
import re
from typing import TypeVar

import numpy as np
import pytest
import trimesh

from lessons.curvature import ring
from lessons.curvature.lesson import lesson
from lessons.curvature.params import Params
from lessons.curvature.presets import GAUSSIAN, MEAN, PRINCIPAL, TOTAL
from lessons.curvature.state import State, at_stage, surface_variation, two_rings
from lessons.curvature.study import Study
from lessons.curvature.subject import EYE
from tests.runs import finished
from tests.verdicts import curvature as judge
from workbench.data.files import read_mesh
from workbench.errors import InputError
from workbench.geometry import curvature
from workbench.geometry.laplacian import mixed_areas
from workbench.scene import Curve, Field, Mesh, Points, Scalar, Scene, Segments, Table, caption_of
from workbench.timeline import Timeline

Kind = TypeVar("Kind")
STAGES = ["mesh", "ring", "defect", "gaussian", "normal", "mean", "principal", "quadric", "total", "finer"]


def timeline(params: Params) -> Timeline:
    return finished(lesson.name, params)


def at(params: Params, stage: str) -> State:
    return at_stage(timeline(params).states(), stage)


def scene(params: Params, stage: str):
    return timeline(params)[STAGES.index(stage)].scene


def part(kind: type[Kind], scene: Scene, path: str) -> Kind:
    """Return one thing of a picture, which must be of its kind."""
    primitive = scene[path]
    assert isinstance(primitive, kind)
    return primitive


def study_in(state: State) -> Study:
    assert state.study is not None
    return state.study


def surface_field(params: Params, stage: str) -> Field:
    color = part(Mesh, scene(params, stage), "surface").color
    assert isinstance(color, Field)
    return color


def preset(name: str) -> Params:
    return lesson.preset(name).params


def test_stages_come_in_the_order_of_the_page():
    assert [state.stage for state in timeline(Params()).states()] == STAGES
    assert (STAGES[GAUSSIAN], STAGES[MEAN], STAGES[PRINCIPAL], STAGES[TOTAL]) == (
        "gaussian", "mean", "principal", "total"
    )  # fmt: skip
    assert STAGES[lesson.first_step] == "gaussian"


# presets --------------------------------------------------------------------------------------------------------------


def test_cylinder_has_no_gaussian_curvature_and_h_one():
    now = at(preset("cylinder"), "mean").now
    inside = at(preset("cylinder"), "mean").subject.inside
    np.testing.assert_allclose(now.K[inside], 0, atol=1e-9)
    np.testing.assert_allclose(now.H[inside], 1 / (2 * 0.5), rtol=2e-3)


def test_catenoid_has_no_mean_curvature_and_negative_k():
    state = at(preset("catenoid"), "principal")
    inside = state.subject.inside
    assert np.abs(state.now.H[inside]).max() < 0.02
    assert (state.now.K[inside] < 0).all()
    np.testing.assert_allclose(state.now.k1[inside], -state.now.k2[inside], atol=0.04)


def test_twice_as_large_leaves_a_quarter_a_half_and_what_has_no_unit():
    one, two = (at(params, "quadric") for params in (Params(), preset("double")))
    np.testing.assert_allclose(two.now.K, one.now.K / 4, atol=1e-9)
    np.testing.assert_allclose(two.now.H, one.now.H / 2, atol=1e-9)
    np.testing.assert_allclose(two.now.defects, one.now.defects, atol=1e-12)
    assert one.now.vertex == two.now.vertex
    assert surface_variation(two) == pytest.approx(surface_variation(one), rel=1e-9)


def test_inside_out_turns_h_and_principal_curvatures_but_not_k():
    one, two = (at(params, "principal") for params in (Params(), preset("inside-out")))
    np.testing.assert_allclose(two.now.K, one.now.K, atol=1e-9)
    np.testing.assert_allclose(two.now.H, -one.now.H, atol=1e-9)
    np.testing.assert_allclose(two.now.k1, -one.now.k2, atol=1e-7)
    assert one.now.vertex == two.now.vertex
    assert two.errors["H"] == pytest.approx(one.errors["H"])


def test_a_defect_taken_for_k_is_far_too_small_and_smaller_on_finer_meshes():
    wrong = at(preset("no-area"), "gaussian")
    v = wrong.now.vertex
    assert wrong.true("gaussian") / wrong.now.K[v] > 50
    finer = at(dataclasses.replace(preset("no-area"), vertices=6000), "gaussian")
    outside = [np.percentile(state.now.K, 90) for state in (wrong, finer)]
    assert outside[0] / outside[1] == pytest.approx(4, rel=0.15)
    assert caption_of(scene(preset("no-area"), "gaussian")).tone == "wrong"
    assert caption_of(scene(preset("no-area"), "finer")).tone == "wrong"


def test_the_forgotten_half_doubles_h_and_tears_k1_and_k2_apart():
    now = at(preset("no-half"), "principal").now
    np.testing.assert_allclose(now.H, 2, rtol=1e-3)
    np.testing.assert_allclose(now.H**2 - now.K, 3, rtol=0.05)
    assert (now.k1 - now.k2).min() > 3
    right = at(dataclasses.replace(preset("no-half"), mistake="none"), "principal").now
    assert (right.k1 - right.k2).max() < 0.4


def test_the_border_takes_pi_and_leaves_k_and_h_open():
    state = at(preset("border"), "mean")
    assert state.on_border
    assert 0 < np.degrees(state.now.defects[state.now.vertex]) < 10
    assert np.isnan(state.now.K[state.subject.border]).all()
    assert np.isnan(state.now.H[state.subject.border]).all()
    field = surface_field(preset("border"), "gaussian")
    assert (field.rgb()[state.subject.border] == 128).all()
    assert at(preset("border"), "total").now.total == pytest.approx(2 * np.pi, abs=1e-9)


def test_two_pi_on_the_border_adds_pi_for_each_of_its_vertices():
    state = at(preset("border-2pi"), "total")
    border = int(state.subject.border.sum())
    assert state.now.total == pytest.approx(2 * np.pi + np.pi * border)
    caption = caption_of(scene(preset("border-2pi"), "total"))
    assert caption.tone == "wrong"
    assert f"each of the {border} border vertices" in caption.text
    right = at(dataclasses.replace(preset("border-2pi"), mistake="none"), "total")
    assert right.now.total == pytest.approx(2 * np.pi, abs=1e-9)


def test_coarse_and_fine():
    assert 8 < at(preset("coarse"), "gaussian").errors["K"] < 13
    assert at(preset("fine"), "gaussian").errors["K"] < 0.2
    study = study_in(at(preset("fine"), "finer"))
    # Errors fall with the square of the edges, that is in proportion to the number of vertices.
    assert study.K[0] / study.K[-1] == pytest.approx(study.counts[-1] / study.counts[0], rel=0.15)


def test_noise_is_amplified_and_more_so_on_finer_meshes():
    params = preset("noise")
    assert params.noise == 0.003
    assert at(params, "gaussian").errors["K"] > 100
    study = study_in(at(params, "finer"))
    assert (np.diff(study.K) > 0).all()
    assert study.K[-1] > 5 * study.K[0]
    assert "Finer is worse" in caption_of(scene(params, "finer")).text


def test_irregular_meshes_do_not_help_formulas_but_fits():
    state = at(preset("irregular"), "finer")
    study = study_in(state)
    np.testing.assert_allclose((np.linalg.norm(state.subject.p[:, :2], axis=1) - 1) ** 2 + state.subject.p[:, 2] ** 2,
                               0.16, rtol=1e-9)  # fmt: skip
    assert (study.K > 0.08).all()
    assert (study.K < 0.11).all()
    assert (study.H > 0.07).all()
    assert study.K_fit[0] == pytest.approx(0.25, abs=0.01)
    assert study.K_fit[-1] == pytest.approx(0.02, abs=0.002)
    assert study.H_fit[-1] < study.H_fit[0] / 10
    assert "does not converge to K" in caption_of(scene(preset("irregular"), "finer")).text


@pytest.mark.parametrize(("name", "sum_over_pi"), [("sphere-sum", 4.0), ("torus-sum", 0.0)])
def test_dents_do_not_change_the_sum(name, sum_over_pi):
    state = at(preset(name), "total")
    assert state.errors["K"] > 100
    assert state.now.total / np.pi == pytest.approx(sum_over_pi, abs=1e-9)
    assert caption_of(scene(preset(name), "total")).tone == "good"


# questions ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "answer"),
    [("which-rolled", 0), ("which-double", 2), ("which-sides", 1), ("which-finer", 2), ("which-sum", 4)],
)
def test_answers(name, answer):
    question = next(question for question in lesson.questions if question.name == name)
    assert question.answer(timeline(question.params).states()) == pytest.approx(answer, abs=1e-6)


def test_answers_are_read_off_the_run():
    asked = {question.name: question for question in lesson.questions}
    spheres = timeline(Params(surface="sphere")).states()
    assert asked["which-rolled"].answer(spheres) == 1
    assert asked["which-sum"].answer(timeline(Params()).states()) == 0
    assert asked["which-finer"].answer(timeline(Params()).states()) == 0


# the page -------------------------------------------------------------------------------------------------------------


def test_numbers_of_the_page():
    now = at(Params(), "gaussian").now
    assert np.degrees(now.defects[now.vertex]) == pytest.approx(3.2, abs=0.05)
    assert now.K[now.vertex] == pytest.approx(1.17, abs=0.005)
    assert at(Params(), "gaussian").true("gaussian") == pytest.approx(1.16, abs=0.005)
    inner = np.linalg.norm(now.p[:, :2], axis=1) < 0.85
    assert (now.defects[inner] < 0).all()
    now = at(Params(), "principal").now
    assert 1 / now.k1[now.vertex] == pytest.approx(0.4, rel=0.02)
    along_ring = np.cross([0, 0, 1], now.p[now.vertex])
    assert abs(now.along_k2[now.vertex] @ along_ring) / np.linalg.norm(along_ring) > 0.99
    assert at(Params(), "quadric").errors["K by fit"] > 10 * at(Params(), "quadric").errors["K"]


def test_the_fit_stays_level_with_its_vertex():
    state = at(preset("irregular"), "quadric")
    assert state.errors["K by fit"] < 4
    assert state.errors["H by fit"] < 4
    assert state.errors["K"] > 8


# slots ----------------------------------------------------------------------------------------------------------------


def states_with(params=None, **slots):
    return Timeline(lesson, params or Params(), slots).states()


def test_slots_drive_the_run():
    states = states_with(angle_defects=lambda p, faces: np.full(len(p), 0.5))
    assert at_stage(states, "total").now.total == pytest.approx(0.5 * len(states[0].now.p))
    states = states_with(gaussian_curvature=lambda p, faces: np.full(len(p), -2.0))
    assert (at_stage(states, "principal").now.k2 < 0).all()
    assert at_stage(states, "gaussian").errors["K"] > 100
    study = study_in(at_stage(states, "finer"))
    assert (study.K > 1).all()
    states = states_with(mean_curvature_normals=lambda p, faces: np.zeros((len(p), 3)))
    assert (at_stage(states, "mean").now.H == 0).all()
    study = study_in(at_stage(states, "finer"))
    np.testing.assert_allclose(study.H, 1)


def test_mistakes_spoil_what_the_slots_give():
    flat = dataclasses.replace(preset("border-2pi"), mistake="2 pi on the border")
    states = states_with(flat, angle_defects=lambda p, faces: np.zeros(len(p)))
    assert at_stage(states, "total").now.total == pytest.approx(76 * np.pi)


def test_a_borders_rows_of_a_students_function_may_hold_anything():
    def everywhere(p, faces):
        return curvature.angle_defects(p, faces) / mixed_areas(p, faces)

    states = states_with(preset("border"), gaussian_curvature=everywhere)
    assert at_stage(states, "gaussian").errors["K"] == pytest.approx(at(preset("border"), "gaussian").errors["K"])


# own meshes -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("name", "chi"), [("bunny", 2), ("fertility", -6)])
def test_scans_are_enlarged_and_their_sum_is_theirs(shared_data, name, chi):
    done = timeline(Params(mesh=shared_data / "curvature" / f"{name}.off"))
    assert [state.stage for state in done.states()] == STAGES[:-1]
    state = done.states()[-1]
    assert abs(state.now.total - 2 * np.pi * chi) < 1e-9
    p, _ = read_mesh(shared_data / "curvature" / f"{name}.off")
    assert state.subject.enlarged == pytest.approx(2.0 / np.ptp(p, axis=0).max())
    assert abs(state.subject.p.min(axis=0) + state.subject.p.max(axis=0)).max() < 1e-9
    assert state.subject.up == "y"
    assert np.ptp(state.subject.p[:, 2]) == pytest.approx(state.subject.enlarged * np.ptp(p[:, 1]))
    for stage in ("gaussian", "mean", "defect"):  # the colours tell most vertices apart, and the caption says so
        field = surface_field(Params(mesh=shared_data / "curvature" / f"{name}.off"), stage)
        assert np.mean(np.abs(field.values) <= field.high) == pytest.approx(0.9, abs=0.015)
        assert np.std(np.clip(field.values / field.high, -1, 1)) > 0.2
    caption = caption_of(done[GAUSSIAN].scene).text
    limit = surface_field(Params(mesh=shared_data / "curvature" / f"{name}.off"), "gaussian").high
    assert f"colours reach to ±{limit:g} m⁻²; " in caption
    assert not state.errors
    for step in done.known():
        assert not any(isinstance(primitive, Scalar) for primitive in step.scene.values())
    histogram = part(Curve, done[GAUSSIAN].scene, "histogram K")
    assert histogram.y.sum() == len(state.subject.p)


def test_a_soup_is_welded(tmp_path):
    ball = trimesh.creation.icosphere(2)
    soup = trimesh.Trimesh(ball.triangles.reshape(-1, 3), np.arange(3 * len(ball.faces)).reshape(-1, 3), process=False)
    soup.export(tmp_path / "ball.stl")
    state = at(Params(mesh=tmp_path / "ball.stl"), "total")
    assert len(state.subject.p) == len(ball.vertices)
    assert state.now.total == pytest.approx(4 * np.pi, abs=1e-9)


def written(folder, p, faces, name="own.off"):
    rows = [" ".join(f"{x:.17g}" for x in q) for q in p] + [f"3 {a} {b} {c}" for a, b, c in faces]
    (folder / name).write_text("\n".join([f"OFF\n{len(p)} {len(faces)} 0", *rows]))
    return Params(mesh=folder / name)


BALL = trimesh.creation.icosphere(1)


@pytest.mark.parametrize(
    ("p", "faces", "words", "chi"),
    [
        (
            np.vstack([BALL.vertices, 2 * BALL.vertices[0] - BALL.vertices[1:]]),
            np.vstack([BALL.faces, np.where(BALL.faces == 0, 0, BALL.faces + 41)[:, ::-1]]),
            "1 vertex added where sheets only touch, one for each sheet",
            4,
        ),
        (
            BALL.vertices,
            np.vstack([BALL.faces[:70], BALL.faces[70:, ::-1]]),
            "10 faces turned round to agree with the others",
            2,
        ),
        (BALL.vertices, np.vstack([BALL.faces, BALL.faces[3:5]]), "2 faces listed twice left out", 2),
        (np.vstack([BALL.vertices, [[9.0, 9.0, 9.0]]]), BALL.faces, "", 2),
        (np.vstack([BALL.vertices, BALL.vertices + 5]), np.vstack([BALL.faces, BALL.faces + 42]), "", 4),
        (BALL.vertices, BALL.faces[1:], "", 1),
    ],
    ids=["sheets touch", "turned", "twice", "unused", "two pieces", "open"],
)
def test_awkward_meshes_are_mended_and_the_caption_says_how(tmp_path, p, faces, words, chi):
    run = timeline(written(tmp_path, p, faces))
    start, total = run.states()[0], run.states()[-1]
    said = caption_of(run[0].scene).text
    assert f"Mended: {words}." in said if words else "Mended" not in said
    assert total.now.chi == chi
    assert total.now.total == pytest.approx(2 * np.pi * total.now.chi, abs=1e-9)
    assert len(start.subject.faces) == len(np.unique(np.sort(faces, axis=1), axis=0))
    assert total.now.H[~start.subject.border].min() > 0  # most faces tell the side


@pytest.mark.parametrize("unit", [1e-6, 1e-3, 1e3])
def test_a_mesh_in_any_unit_looks_the_same_and_its_size_is_said_without_exponents(tmp_path, unit):
    run = timeline(written(tmp_path, unit * BALL.vertices, BALL.faces))
    state = run.states()[-1]
    np.testing.assert_allclose(
        state.now.K, timeline(written(tmp_path, BALL.vertices, BALL.faces, "1.off"))[-1].state.now.K
    )
    assert f"{1 / unit:,.10g} m here" in caption_of(run[0].scene).text.replace("1.00", "1")
    for step in run.known():
        assert "e+" not in caption_of(step.scene).text
        assert "e-" not in caption_of(step.scene).text


def tower(lying):
    """A slab 3 high, 2 broad, 1 deep, standing at height 0 on the axis `lying`."""
    box = trimesh.creation.box((2.0, 1.0, 3.0)).subdivide()
    p = np.array(box.vertices) + np.array([0.0, 0.0, 1.5])
    return (p if lying == "z" else np.stack([p[:, 0], p[:, 2], -p[:, 1]], 1)), np.array(box.faces)


@pytest.mark.parametrize("lying", ["z", "y"])
def test_an_own_mesh_stands_upright_and_turns_its_broad_side_to_the_viewer(tmp_path, lying):
    params = written(tmp_path, *tower(lying))
    state = timeline(params).states()[0]
    assert state.subject.up == lying
    p, eye = state.subject.p, np.array([*EYE[:2], 0.0]) / np.hypot(*EYE[:2])
    assert np.ptp(p[:, 2]) == pytest.approx(2.0)
    assert np.ptp(p @ eye) == pytest.approx(2 / 3)  # the thin side is along the line of sight
    assert np.ptp(p @ np.cross(eye, [0, 0, 1])) == pytest.approx(4 / 3)
    upside = timeline(dataclasses.replace(params, up="x")).states()[0].subject.p
    assert np.ptp(upside[:, 2]) == pytest.approx(4 / 3)


def test_minus_y_stands_it_on_its_head(tmp_path):
    params = written(tmp_path, *tower("y"))
    one, two = (timeline(dataclasses.replace(params, up=up)).states()[0].subject for up in ("y", "-y"))
    np.testing.assert_allclose(two.p[:, 2], -one.p[:, 2], atol=1e-9)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            "OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 1 0 3\n3 0 1 4\n",
            "bad.off: .*more than two faces",
        ),
        (  # a Moebius strip of five triangles
            "OFF\n5 5 0\n1 0 0\n0.3 1 0.3\n-0.8 0.6 -0.3\n-0.8 -0.6 0.3\n0.3 -1 -0.3\n"
            "3 0 1 2\n3 1 2 3\n3 2 3 4\n3 3 4 0\n3 4 0 1\n",
            "bad.off: .*which side is outside",
        ),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n", "bad.off: .*no area"),
        ("OFF\n3 1 0\n0 0 0\n0 0 0\n0 0 0\n3 0 1 2\n", "bad.off: .*empty"),
        ("OFF\n3 0 0\n0 0 0\n1 0 0\n2 0 0\n", "bad.off"),
        ("nonsense", "bad.off"),
    ],
)
def test_meshes_without_curvature_are_refused_in_one_line(tmp_path, text, words):
    (tmp_path / "bad.off").write_text(text)
    run = Timeline(lesson, Params(mesh=tmp_path / "bad.off")).complete()
    assert run.failure is None
    with pytest.raises(InputError, match=words):
        run.states()


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(InputError, match="no such file"):
        Timeline(lesson, Params(mesh=tmp_path / "gone.off")).states()


# what is drawn --------------------------------------------------------------------------------------------------------


def test_the_mesh_is_the_same_arrays_whatever_vertex_is_picked():
    one, two = (part(Mesh, scene(Params(vertex=v), "gaussian"), "surface") for v in (10, 200))
    assert one.p is two.p
    assert one.faces is two.faces


def test_colour_scales_are_fixed_and_symmetric():
    for params in (Params(), preset("double"), preset("coarse"), preset("noise")):
        for stage, high in (("gaussian", 5.0), ("mean", 2.5), ("defect", 0.2)):
            field = surface_field(params, stage)
            assert (field.low, field.high, field.map) == (-high, high, "diverging")
            assert field.unit


def test_the_flat_ring_keeps_lengths_and_angles_and_shows_the_defect():
    for vertex in (-1, 30):  # a gap outside, an overlap inside
        now = at(Params(vertex=vertex), "defect").now
        drawn = ring.flattened(now)
        fan, gap = part(Mesh, drawn, "flat ring"), part(Segments, drawn, "gap")
        spokes = np.linalg.norm(fan.p[1:] - fan.p[0], axis=1)
        real = np.linalg.norm(now.p[now.ring] - now.p[now.vertex], axis=1)
        np.testing.assert_allclose(spokes[:-1], real, rtol=0.02)
        n = now.normals[now.vertex]
        flat = fan.p[1:] - fan.p[0]
        flat -= (flat @ n)[:, None] * n
        flat /= np.linalg.norm(flat, axis=1, keepdims=True)
        turns = np.arccos(np.einsum("nx,nx->n", flat[1:], flat[:-1]))
        np.testing.assert_allclose(turns, now.angles, atol=1e-6)
        ends = gap.ends[[0, -1], [0, 1]] - fan.p[0]
        ends -= (ends @ n)[:, None] * n
        cosine = ends[0] @ ends[1] / np.prod(np.linalg.norm(ends, axis=1))
        assert np.arccos(np.clip(cosine, -1, 1)) == pytest.approx(abs(now.defects[now.vertex]), rel=1e-3)


@pytest.mark.parametrize("jitter", [0.0, 0.25])
def test_the_drawn_cell_has_the_mixed_area(jitter):
    for vertex in range(0, 300, 23):
        now = at(Params(vertex=vertex, jitter=jitter), "gaussian").now
        cell = part(Mesh, ring.cell(now), "cell")
        a, b, c = cell.p[cell.faces].swapaxes(0, 1)
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
        assert area == pytest.approx(now.areas[vertex], rel=1e-6)


def test_the_pushes_add_up_to_the_drawn_normal():
    now = at(Params(jitter=0.2), "normal").now
    drawn = ring.pushes(now, 0.06)
    chain, total = part(Segments, drawn, "pushes"), part(Segments, drawn, "mean normal")
    assert len(chain.ends) == len(now.ring)
    np.testing.assert_allclose(chain.ends[-1, 1], total.ends[0, 1], atol=1e-9)


def test_osculating_circles_have_their_radius_and_touch_the_vertex():
    now = at(Params(), "principal").now
    for name, k in (("k₁", now.k1), ("k₂", now.k2)):
        circle = part(Segments, ring.circles(now), f"circle {name}")
        centre = now.p[now.vertex] - now.normals[now.vertex] / k[now.vertex]
        np.testing.assert_allclose(
            np.linalg.norm(circle.ends[:, 0] - centre, axis=1), 1 / abs(k[now.vertex]), rtol=1e-9
        )
        near = np.linalg.norm(circle.ends.reshape(-1, 3) - now.p[now.vertex], axis=1)
        assert near.min() < 1e-9


def test_the_patch_passes_the_vertices_of_its_fit():
    state = at(Params(surface="saddle", vertices=900), "quadric")
    drawn = ring.patch(state)
    patch, fitted = part(Mesh, drawn, "patch"), part(Points, drawn, "fitted")
    assert state.now.quadrics is not None
    assert len(fitted.p) == state.now.quadrics.neighbours[state.now.vertex] == len(two_rings(state))
    gaps = np.linalg.norm(fitted.p[:, None] - patch.p[None], axis=2).min(axis=1)
    away = np.linalg.norm(fitted.p - state.now.p[state.now.vertex], axis=1)
    assert gaps[away < 0.8 * away.max()].max() < ring.edge_length(state.now) / 4


def test_the_table_grows_and_ends_with_all_estimates():
    tables = [step.scene.get("vertex table") for step in timeline(Params()).known()]
    assert tables[0] is None
    lengths = [len(table.rows) for table in tables[1:] if isinstance(table, Table)]
    assert lengths == sorted(lengths)
    assert lengths[0] == 1
    assert lengths[-1] == 11


def test_every_step_draws_on_own_meshes_and_on_the_border(tmp_path):
    trimesh.creation.icosphere(1).export(tmp_path / "ball.obj")
    timeline(Params(mesh=tmp_path / "ball.obj"))
    for surface in ("plane", "saddle", "cylinder", "catenoid"):
        state = timeline(Params(surface=surface, vertex=0)).states()[0]
        assert state.on_border
    trimesh.creation.box().export(tmp_path / "box.obj")
    box = timeline(Params(mesh=tmp_path / "box.obj"))  # eight vertices
    assert box[-1].state.now.total == pytest.approx(4 * np.pi)


def test_no_claim_about_a_line_or_an_explanation_is_left_without_its_words():
    """A sentence that changes must not lose its judge in `tests.verdicts` unseen."""
    said = {preset.name: f"{preset.title}. {preset.line}" for preset in lesson.presets}
    why = {question.name: question.why(timeline(question.params).states()) for question in lesson.questions}
    for texts, judged in ((said, judge.LINES), (why, judge.WHYS)):
        for name, claims in judged.items():
            assert all(re.search(claim.words, texts[name]) for claim in claims), texts[name]
