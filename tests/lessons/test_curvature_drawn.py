"""What the curvature lesson draws: the same numbers as a step holds, on built-in and own meshes."""

import numpy as np
import pytest
import trimesh

from lessons.curvature import ring, row
from lessons.curvature.inputs import Input
from lessons.curvature.lesson import lesson
from tests.lessons.curvature_runs import at, part, preset, scene, states, surface_field, timeline
from workbench.scene import Mesh, Points, Segments, Table


def test_the_mesh_is_the_same_arrays_whatever_vertex_is_picked():
    mesh, two = (part(Mesh, scene(Input(vertex=v), "gaussian"), "surface") for v in (10, 200))
    assert mesh.p is two.p
    assert mesh.faces is two.faces


def test_colour_scales_are_fixed_and_symmetric():
    for params in (Input(), preset("double"), preset("coarse"), preset("noise")):
        for stage, high in (("gaussian", 5.0), ("mean", 2.5), ("defect", 0.2)):
            field = surface_field(params, stage)
            assert (field.low, field.high, field.map) == (-high, high, "diverging")
            assert field.unit


def test_the_flat_ring_keeps_lengths_and_angles_and_shows_the_defect():
    for vertex in (-1, 30):  # a gap outside, an overlap inside
        measured = at(Input(vertex=vertex), "defect").now
        drawn = ring.flattened(measured)
        fan, gap = part(Mesh, drawn, "flat ring"), part(Segments, drawn, "gap")
        spokes = np.linalg.norm(fan.p[1:] - fan.p[0], axis=1)
        real = np.linalg.norm(measured.p[measured.ring] - measured.p[measured.vertex], axis=1)
        np.testing.assert_allclose(spokes[:-1], real, rtol=0.02)
        n = measured.normals[measured.vertex]
        flat = fan.p[1:] - fan.p[0]
        flat -= (flat @ n)[:, None] * n
        flat /= np.linalg.norm(flat, axis=1, keepdims=True)
        turns = np.arccos(np.einsum("nx,nx->n", flat[1:], flat[:-1]))
        np.testing.assert_allclose(turns, measured.angles, atol=1e-6)
        ends = gap.ends[[0, -1], [0, 1]] - fan.p[0]
        ends -= (ends @ n)[:, None] * n
        cosine = ends[0] @ ends[1] / np.prod(np.linalg.norm(ends, axis=1))
        assert np.arccos(np.clip(cosine, -1, 1)) == pytest.approx(
            abs(measured.defects[measured.vertex]), rel=1e-3
        )


def test_a_ring_unfolds_from_the_surface_and_bends_no_triangle():
    for vertex in (-1, 30):
        measured = at(Input(vertex=vertex), "defect").now
        folded = part(Mesh, ring.flattened(measured, 0.0), "flat ring").p
        lifted = folded[0] - measured.p[measured.vertex]
        np.testing.assert_allclose(folded[1:-1], measured.p[measured.ring] + lifted, atol=1e-12)
        np.testing.assert_allclose(folded[-1], folded[1], atol=1e-9)
        for share in (0.0, 0.3, 0.9):
            p = part(Mesh, ring.flattened(measured, share), "flat ring").p
            turned = np.concatenate([[0.0], np.cumsum(measured.angles)])
            n = measured.normals[measured.vertex]
            overlaps = measured.defects[measured.vertex] < 0
            spokes = (
                p[1:]
                - p[0]
                - 0.02 * overlaps * share * ring.edge_length(measured) * np.outer(turned, n)
            )
            along = spokes / np.linalg.norm(spokes, axis=1, keepdims=True)
            turns = np.arccos(np.einsum("nx,nx->n", along[1:], along[:-1]))
            np.testing.assert_allclose(turns, measured.angles, atol=1e-6)


@pytest.mark.parametrize("jitter", [0.0, 0.25])
def test_the_drawn_cell_has_the_mixed_area(jitter):
    for vertex in range(0, 300, 23):
        measured = at(Input(vertex=vertex, jitter=jitter), "gaussian").now
        cell = part(Mesh, ring.cell(measured), "cell")
        a, b, c = cell.p[cell.faces].swapaxes(0, 1)
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
        assert area == pytest.approx(measured.areas[vertex], rel=1e-6)


def test_the_pushes_add_up_to_the_drawn_normal():
    measured = at(Input(jitter=0.2), "normal").now
    drawn = ring.pushes(measured, 0.06)
    single, total = part(Segments, drawn, "pushes"), part(Segments, drawn, "mean normal")
    assert len(single.ends) == len(measured.ring)
    added = (single.ends[:, 1] - single.ends[:, 0]).sum(axis=0)
    np.testing.assert_allclose(added, total.ends[0, 1] - total.ends[0, 0], atol=1e-9)


def test_osculating_circles_have_their_radius_and_touch_the_vertex():
    measured = at(Input(), "principal").now
    for name, k in (("k₁", measured.k1), ("k₂", measured.k2)):
        circle = part(Segments, ring.circles(measured), f"circle {name}")
        centre = (
            measured.p[measured.vertex] - measured.normals[measured.vertex] / k[measured.vertex]
        )
        np.testing.assert_allclose(
            np.linalg.norm(circle.ends[:, 0] - centre, axis=1),
            1 / abs(k[measured.vertex]),
            rtol=1e-9,
        )
        if abs(k[measured.vertex]) * ring.FARTHEST > 1:
            drawn_at = part(Points, ring.circles(measured), f"centre {name}").p[0]
            np.testing.assert_allclose(drawn_at, centre, atol=1e-12)
        near = np.linalg.norm(circle.ends.reshape(-1, 3) - measured.p[measured.vertex], axis=1)
        assert near.min() < 1e-9


def test_the_patch_passes_the_vertices_of_its_fit():
    state = at(Input(surface="saddle", vertices=900), "quadric")
    drawn = ring.patch(state)
    patch, fitted = part(Mesh, drawn, "patch"), part(Points, drawn, "fitted")
    assert state.now.quadrics is not None
    assert len(fitted.p) == state.now.quadrics.neighbours[state.now.vertex] == len(state.two_rings)
    gaps = np.linalg.norm(fitted.p[:, None] - patch.p[None], axis=2).min(axis=1)
    away = np.linalg.norm(fitted.p - state.now.p[state.now.vertex], axis=1)
    assert gaps[away < 0.8 * away.max()].max() < ring.edge_length(state.now) / 4


def test_the_table_grows_and_ends_with_all_estimates():
    tables = [step.scene.get("vertex table") for step in timeline(Input()).known()]
    assert tables[0] is None
    lengths = [len(table.rows) for table in tables[1:] if isinstance(table, Table)]
    assert lengths == sorted(lengths)
    assert lengths[0] == 1
    assert lengths[-1] == 11


def test_every_step_draws_on_own_meshes_and_on_the_border(tmp_path):
    trimesh.creation.icosphere(1).export(tmp_path / "ball.obj")
    timeline(Input(mesh=tmp_path / "ball.obj"))
    for surface in ("plane", "saddle", "cylinder", "catenoid"):
        state = states(Input(surface=surface, vertex=0))[0]
        assert state.on_border
    trimesh.creation.box().export(tmp_path / "box.obj")
    box = timeline(Input(mesh=tmp_path / "box.obj"))  # eight vertices
    assert box[-1].state.now.total == pytest.approx(4 * np.pi)


def test_the_page_says_where_the_row_is_dark_and_yellow():
    low, high = (10.0**end for end in row.SCALE)
    assert lesson.page is not None
    assert f"dark up to {low:g} m⁻², yellow from {high:g} m⁻² on" in lesson.page.read_text("utf-8")
