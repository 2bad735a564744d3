import itertools

import numpy as np
import pytest
import trimesh

from workbench.data.shapes.solids import sharp_edges, solid


@pytest.mark.parametrize(
    ("shape", "volume", "lines"),
    [("box", 0.42, 12), ("L block", 0.5 * 0.49, 18), ("house", None, 19)],
)
def test_solids_are_closed_and_stand_on_the_ground(shape, volume, lines):
    s = solid(shape)
    mesh = trimesh.Trimesh(s.p, s.faces, process=False)
    assert mesh.is_watertight
    assert s.p[:, 2].min() == 0.0
    assert len(s.lines) == lines
    if volume is not None:
        assert mesh.volume == pytest.approx(volume)
    if shape == "house":
        assert mesh.is_convex


def test_no_mirror_and_no_turn_maps_the_house_to_itself():
    p = solid("house").p - solid("house").p.mean(axis=0)
    # Distances from the middle tell which vertices could be mapped to which; here no two are alike.
    distances = np.linalg.norm(p[:, None] - p[None], axis=2)
    signatures = np.sort(distances, axis=1)
    apart = [
        np.abs(signatures[i] - signatures[j]).max()
        for i, j in itertools.combinations(range(len(p)), 2)
    ]
    assert min(apart) > 0.01


@pytest.mark.parametrize(
    ("shape", "normal", "offset"), [("box", [1.0, 0, 0], 0.0), ("L block", [0, 0, 1.0], 0.25)]
)
def test_the_others_are_their_own_mirror_image(shape, normal, offset):
    p = solid(shape).p
    n = np.array(normal)
    mirrored = p - 2.0 * (p @ n - offset)[:, None] * n
    assert {tuple(row) for row in mirrored.round(9) + 0.0} == {
        tuple(row) for row in p.round(9) + 0.0
    }


def test_a_flat_patch_has_only_its_border():
    p = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    assert len(sharp_edges(p, np.array([[0, 1, 2], [0, 2, 3]]))) == 4
