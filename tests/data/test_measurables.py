"""Shapes of known size: their meshes come close, points inside them do too, and the lantern has
Schwarz's area.
"""

import numpy as np
import pytest

from lessons.measures.measurables import box, lantern, sphere, torus, two_spheres
from workbench.geometry.meshes import boundary_edges, check_mesh, face_normals
from workbench.geometry.meshes.measures import encloses, signed_volume, surface_area


@pytest.mark.parametrize("shape", [sphere(3), torus(3), box()])
def test_meshes_come_close_from_below(shape):
    check_mesh(shape.p, shape.faces)
    assert -0.02 < signed_volume(shape.p, shape.faces) / shape.volume - 1 < 1e-9
    assert -0.01 < surface_area(shape.p, shape.faces) / shape.area - 1 < 1e-9


@pytest.mark.parametrize("shape", [sphere(2), torus(2), box(), two_spheres(2)])
def test_points_inside_fill_the_volume_within_the_box(shape):
    u = (np.stack(np.meshgrid(*[np.arange(40)] * 3), axis=-1).reshape(-1, 3) + 0.5) / 40
    share = shape.inside(shape.low + (shape.high - shape.low) * u).mean()
    assert share * np.prod(shape.high - shape.low) == pytest.approx(shape.volume, rel=0.01)
    assert (shape.p >= shape.low - 1e-12).all()
    assert (shape.p <= shape.high + 1e-12).all()


def test_two_spheres_are_measured_as_their_union():
    two = two_spheres(4)
    assert encloses(two.faces)
    assert signed_volume(two.p, two.faces) == pytest.approx(8 / 3 * np.pi, rel=3e-3)
    assert two.volume == pytest.approx(7.0686, abs=1e-4)
    assert two.area == pytest.approx(6 * np.pi)


@pytest.mark.parametrize(("sectors", "rings"), [(4, 4), (5, 7), (8, 64), (11, 121)])
def test_the_lantern_has_the_area_that_schwarz_says(sectors, rings):
    made = lantern(sectors, rings)
    np.testing.assert_allclose(np.hypot(made.p[:, 0], made.p[:, 1]), 1)
    assert len(made.faces) == 2 * sectors * rings
    assert len(boundary_edges(made.faces)) == 2 * sectors
    check_mesh(made.p, made.faces)
    outward = (face_normals(made.p, made.faces) * made.p[made.faces].mean(axis=1) * [1, 1, 0]).sum(
        axis=1
    )
    assert (outward > 0).all()
    lean = 1 - np.cos(np.pi / sectors)
    area = 2 * sectors * rings * np.sin(np.pi / sectors) * np.hypot(1 / rings, lean)
    assert surface_area(made.p, made.faces) == pytest.approx(area)
