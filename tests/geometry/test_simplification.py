"""Coarser and finer meshes: what stays the same when edges are halved, and how many vertices
clusters leave.
"""

import numpy as np
import pytest

from workbench.data.shapes import surfaces
from workbench.data.shapes.rabbit import rabbit_mesh
from workbench.geometry.meshes import euler_characteristic
from workbench.geometry.meshes.measures import encloses, signed_volume, surface_area
from workbench.geometry.meshes.simplification import clustered, halved


@pytest.mark.parametrize(
    "made",
    [surfaces.torus(60), surfaces.sphere(42), surfaces.cylinder(60)],
    ids=["torus", "sphere", "cylinder"],
)
def test_halved_edges_change_no_area_volume_or_topology(made):
    p, faces = halved(made.p, made.faces)
    assert len(faces) == 4 * len(made.faces)
    assert surface_area(p, faces) == pytest.approx(surface_area(made.p, made.faces))
    assert signed_volume(p, faces) == pytest.approx(signed_volume(made.p, made.faces))
    assert euler_characteristic(faces) == euler_characteristic(made.faces)
    assert encloses(faces) == encloses(made.faces)
    np.testing.assert_array_equal(p[: len(made.p)], made.p)


def test_clusters_stay_near_and_become_few():
    p, faces = rabbit_mesh(0.03)
    for spacing in (0.06, 0.12):
        q, fewer = clustered(p, faces, spacing)
        assert len(q) < len(p) * (0.03 / spacing) ** 2 * 2
        assert fewer.max() == len(q) - 1
        assert abs(signed_volume(q, fewer) / signed_volume(p, faces) - 1) < 0.2


def test_cells_smaller_than_every_edge_change_nothing():
    made = surfaces.sphere(162)
    q, faces = clustered(made.p, made.faces, 1e-6)
    assert (len(q), len(faces)) == (len(made.p), len(made.faces))
    assert surface_area(q, faces) == pytest.approx(surface_area(made.p, made.faces))
