"""Every claim of the curvature lesson in numbers: stages, presets, questions, page and slots."""

import dataclasses

import numpy as np
import pytest
import trimesh

from lessons.curvature import balls
from lessons.curvature.captions import caption
from lessons.curvature.inputs import Input
from lessons.curvature.lesson import lesson
from lessons.curvature.presets import DEFECT, GAUSSIAN, MEAN, PRINCIPAL, TOTAL, UNFOLDING
from lessons.curvature.state import at_stage
from tests.lessons.curvature_runs import (
    STAGES,
    at,
    preset,
    scene,
    study_in,
    surface_field,
    timeline,
)
from workbench.certain import as_a
from workbench.data.shapes.surfaces import Surface
from workbench.geometry.meshes import curvature
from workbench.geometry.meshes.laplacian import mixed_areas
from workbench.geometry.points.normals import surface_variation
from workbench.run.timeline import Timeline
from workbench.scene import caption_of


def test_stages_come_in_the_order_of_the_page():
    stages = [state.stage for state in timeline(Input()).states()]
    assert [stage for stage in stages if stage != "unfolding"] == STAGES
    assert stages[2:DEFECT] == ["unfolding"] * len(UNFOLDING)
    assert [stages[step] for step in (DEFECT, GAUSSIAN, MEAN, PRINCIPAL, TOTAL)] == [
        "defect",
        "gaussian",
        "mean",
        "principal",
        "total",
    ]
    assert stages[lesson.first_step] == "gaussian"


# presets ------------------------------------------------------------------------------------------


def test_cylinder_has_no_gaussian_curvature_and_h_one():
    measured = at(preset("cylinder"), "mean").now
    inside = at(preset("cylinder"), "mean").subject.inside
    np.testing.assert_allclose(measured.K[inside], 0, atol=1e-9)
    np.testing.assert_allclose(measured.H[inside], 1 / (2 * 0.5), rtol=2e-3)


def test_catenoid_has_no_mean_curvature_and_negative_k():
    state = at(preset("catenoid"), "principal")
    inside = state.subject.inside
    assert np.abs(state.now.H[inside]).max() < 0.02
    assert (state.now.K[inside] < 0).all()
    np.testing.assert_allclose(state.now.k1[inside], -state.now.k2[inside], atol=0.04)


def test_twice_as_large_leaves_a_quarter_a_half_and_what_has_no_unit():
    original, two = (at(params, "quadric") for params in (Input(), preset("double")))
    np.testing.assert_allclose(two.now.K, original.now.K / 4, atol=1e-9)
    np.testing.assert_allclose(two.now.H, original.now.H / 2, atol=1e-9)
    np.testing.assert_allclose(two.now.defects, original.now.defects, atol=1e-12)
    assert original.now.vertex == two.now.vertex
    bends = [surface_variation(state.subject.p[state.two_rings]) for state in (original, two)]
    assert bends[1] == pytest.approx(bends[0], rel=1e-9)


def test_inside_out_turns_h_and_principal_curvatures_but_not_k():
    original, two = (at(params, "principal") for params in (Input(), preset("inside-out")))
    np.testing.assert_allclose(two.now.K, original.now.K, atol=1e-9)
    np.testing.assert_allclose(two.now.H, -original.now.H, atol=1e-9)
    np.testing.assert_allclose(two.now.k1, -original.now.k2, atol=1e-7)
    assert original.now.vertex == two.now.vertex
    assert two.errors["H"] == pytest.approx(original.errors["H"])


def test_a_defect_taken_for_k_is_far_too_small_and_smaller_on_finer_meshes():
    wrong = at(preset("no-area"), "gaussian")
    v = wrong.now.vertex
    assert wrong.true("gaussian") / wrong.now.K[v] > 50
    finer = at(dataclasses.replace(preset("no-area"), vertices=6000), "gaussian")
    outside = [np.percentile(state.now.K, 90) for state in (wrong, finer)]
    assert outside[0] / outside[1] == pytest.approx(4, rel=0.15)
    for stage in ("gaussian", "finer"):
        assert caption(at(preset("no-area"), stage)).tone == "wrong"
        assert caption_of(scene(preset("no-area"), stage)).tone == "info"  # it is meant to be


def test_the_forgotten_half_doubles_h_and_tears_k1_and_k2_apart():
    measured = at(preset("no-half"), "principal").now
    np.testing.assert_allclose(measured.H, 2, rtol=1e-3)
    np.testing.assert_allclose(measured.H**2 - measured.K, 3, rtol=0.05)
    assert (measured.k1 - measured.k2).min() > 3
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
    border_caption = caption(at(preset("border-2pi"), "total"))
    assert border_caption.tone == "wrong"
    assert f"each of the {border} border vertices" in border_caption.text
    right = at(dataclasses.replace(preset("border-2pi"), mistake="none"), "total")
    assert right.now.total == pytest.approx(2 * np.pi, abs=1e-9)


def test_coarse_and_fine():
    assert 0.08 < at(preset("coarse"), "gaussian").errors["K"] < 0.13
    assert at(preset("fine"), "gaussian").errors["K"] < 0.002
    study = study_in(at(preset("fine"), "finer"))
    # Errors fall with the square of the edges, that is in proportion to the number of vertices.
    assert study.K[0] / study.K[-1] == pytest.approx(study.counts[-1] / study.counts[0], rel=0.15)


def test_noise_is_amplified_and_more_so_on_finer_meshes():
    params = preset("noise")
    assert params.noise == 0.003
    assert at(params, "gaussian").errors["K"] > 1.0
    study = study_in(at(params, "finer"))
    assert (np.diff(study.K) > 0).all()
    assert study.K[-1] > 5 * study.K[0]
    assert "Finer is worse" in caption_of(scene(params, "finer")).text


def test_irregular_meshes_do_not_help_formulas_but_fits():
    state = at(preset("irregular"), "finer")
    study = study_in(state)
    np.testing.assert_allclose(
        (np.linalg.norm(state.subject.p[:, :2], axis=1) - 1) ** 2 + state.subject.p[:, 2] ** 2,
        0.16,
        rtol=1e-9,
    )
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
    assert state.errors["K"] > 1.0
    assert state.now.total / np.pi == pytest.approx(sum_over_pi, abs=1e-9)
    assert caption_of(scene(preset(name), "total")).tone == "good"


# questions ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "answer"),
    [
        ("seven", 2),
        ("inside", 1),
        ("which-rolled", 0),
        ("which-double", 2),
        ("which-sides", 1),
        ("which-finer", 2),
        ("which-sum", 4),
    ],
)
def test_answers(name, answer):
    question = next(question for question in lesson.questions if question.name == name)
    assert question.answer(timeline(question.params).states()) == pytest.approx(answer, abs=1e-6)


def test_answers_are_read_off_the_run():
    asked = {question.name: question for question in lesson.questions}
    assert asked["which-rolled"].answer(timeline(Input(surface="sphere", size=0.5)).states()) == 2
    assert asked["which-sum"].answer(timeline(Input()).states()) == 0
    assert asked["which-finer"].answer(timeline(Input()).states()) == 0


# the page -----------------------------------------------------------------------------------------


def test_numbers_of_the_page():
    gaussian = at(Input(), "gaussian").now
    assert np.degrees(gaussian.defects[gaussian.vertex]) == pytest.approx(3.2, abs=0.05)
    assert gaussian.K[gaussian.vertex] == pytest.approx(1.17, abs=0.005)
    assert at(Input(), "gaussian").true("gaussian") == pytest.approx(1.16, abs=0.005)
    inner = np.linalg.norm(gaussian.p[:, :2], axis=1) < 0.85
    assert (gaussian.defects[inner] < 0).all()
    principal = at(Input(), "principal").now
    assert 1 / principal.k1[principal.vertex] == pytest.approx(0.4, rel=0.02)
    along_ring = np.cross([0, 0, 1], principal.p[principal.vertex])
    assert (
        abs(principal.along_k2[principal.vertex] @ along_ring) / np.linalg.norm(along_ring) > 0.99
    )
    assert at(Input(), "quadric").errors["K by fit"] > 10 * at(Input(), "quadric").errors["K"]


def test_the_fit_stays_level_with_its_vertex():
    state = at(preset("irregular"), "quadric")
    assert state.errors["K by fit"] < 0.04
    assert state.errors["H by fit"] < 0.04
    assert state.errors["K"] > 0.08


# slots --------------------------------------------------------------------------------------------


def states_with(params=None, **slots):
    return Timeline(lesson, params or Input(), slots).states()


def test_slots_drive_the_run():
    states = states_with(angle_defects=lambda p, faces: np.full(len(p), 0.5))
    assert at_stage(states, "total").now.total == pytest.approx(0.5 * len(states[0].now.p))
    states = states_with(gaussian_curvature=lambda p, faces: np.full(len(p), -2.0))
    assert (at_stage(states, "principal").now.k2 < 0).all()
    assert at_stage(states, "gaussian").errors["K"] > 1.0
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
    assert at_stage(states, "gaussian").errors["K"] == pytest.approx(
        at(preset("border"), "gaussian").errors["K"]
    )


def test_the_balls_gaps_shrink_with_their_cells_and_k_settles_on_one():
    done = [as_a(balls.Held, state) for state in timeline(Input(stage="balls")).states()]
    subject = balls.setup(Input(stage="balls"))
    last = done[-1]
    for k, (surface, v) in enumerate(zip(subject.surfaces, subject.vertices, strict=True)):
        total = np.radians(gap_of_all(surface))
        assert total.sum() == pytest.approx(4 * np.pi)  # Gauss and Bonnet, whatever the mesh
        assert last.gaps[k] == pytest.approx(gap_of_all(surface)[v])
        assert np.radians(last.gaps[k]) / last.areas[k] == pytest.approx(last.K[k])
    counts = np.array([len(ball.p) for ball in subject.surfaces])
    slope = np.polyfit(np.log(counts), np.log(last.errors), 1)[0]
    assert slope == pytest.approx(-1.0, abs=0.05)  # second order in the edges
    assert abs(last.K[-1] - 1.0) < 1e-3


def gap_of_all(surface: Surface) -> np.ndarray:
    """Return the gap at every vertex, degrees, from trimesh's angles."""
    mesh = trimesh.Trimesh(surface.p, surface.faces, process=False)
    return 360.0 - np.degrees(np.asarray(mesh.face_angles_sparse.sum(axis=1)).ravel())
