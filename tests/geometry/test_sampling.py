"""Points and lines by chance: even on surfaces and in cubes, scipy's Sobol, binomial errors,
Crofton.
"""

import numpy as np
import pytest
import scipy

from workbench.data.shapes.rabbit import rabbit_mesh
from workbench.data.shapes.solids import box
from workbench.geometry.meshes import face_areas
from workbench.geometry.meshes.measures import area_centroid, surface_area
from workbench.geometry.points.sampling import (
    ball_share,
    line_crossings,
    lines_through_ball,
    points_on_faces,
    sobol,
    unit_points,
    volume_by_chance,
)


def test_points_are_spread_over_faces_as_these_are_large():
    p, faces = box((4.0, 1.0, 0.3)).p, box((4.0, 1.0, 0.3)).faces
    u = np.random.default_rng(0).random((20_000, 3))
    q = points_on_faces(p, faces, u)
    top = np.isclose(q[:, 2], 0.3)
    assert top.mean() == pytest.approx(4 / surface_area(p, faces), abs=0.015)
    halves = np.histogram2d(q[top, 0], q[top, 1], bins=(8, 2))[0]
    assert scipy.stats.chisquare(halves.ravel()).pvalue > 0.01
    np.testing.assert_allclose(points_on_faces(p + 5, faces, u), q + 5, atol=1e-12)


def test_the_mean_of_points_is_the_middle_of_the_surface():
    p, faces = rabbit_mesh(0.05)
    q = points_on_faces(
        p, faces, unit_points(27_000, 3, "stratified", rng=np.random.default_rng(1))
    )
    assert np.linalg.norm(q.mean(axis=0) - area_centroid(p, faces)) < 0.005


def test_a_face_without_area_gets_no_point_and_the_ends_are_met():
    p = np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0]])
    faces = np.array([[0, 1, 2], [0, 1, 3], [1, 2, 0]])
    assert face_areas(p, faces).tolist() == [0, 0.5, 0]
    u = np.array([[a, b, c] for a in (0.0, 1.0) for b in (0.0, 1.0) for c in (0.0, 1.0)])
    q = points_on_faces(p, faces, u)
    np.testing.assert_allclose(q, np.tile([[0, 0, 0], [0, 0, 0], [1, 0, 0], [0, 1, 0]], (2, 1)))


def test_the_sequence_of_sobol_is_scipys():
    theirs = scipy.stats.qmc.Sobol(3, scramble=False, bits=32).random(512)
    np.testing.assert_array_equal(sobol(512, 3) / 2.0**32, theirs)
    with pytest.raises(ValueError, match="4 dimensions"):
        sobol(8, 4)


@pytest.mark.parametrize(("draw", "count"), [("stratified", 64), ("Sobol", 64)])
def test_one_point_lies_in_each_of_so_many_boxes(draw, count):
    u = unit_points(count, 3, draw, rng=np.random.default_rng(2))
    assert len(u) == count
    cuts = {"stratified": [(4, 4, 4)], "Sobol": [(64, 1, 1), (1, 64, 1), (1, 1, 64), (8, 8, 1)]}[
        draw
    ]
    for cut in cuts:  # Sobol: the first two coordinates are a (0, m, 2)-net
        assert len(np.unique(np.floor(np.array(cut) * u), axis=0)) == count
    assert u.min() >= 0
    assert u.max() < 1


def test_chance_has_the_binomial_error():
    right = 1.0
    rng = np.random.default_rng(4)
    box_volume = 4.0
    estimates = np.array(
        [volume_by_chance(rng.random(200) < right / box_volume, box_volume) for _ in range(2000)]
    )
    assert estimates[:, 0].mean() == pytest.approx(right, abs=0.02)
    assert estimates[:, 0].std() == pytest.approx(estimates[:, 1].mean(), rel=0.06)
    with pytest.raises(ValueError, match="no points"):
        volume_by_chance(np.zeros(0, bool), 1.0)


def test_the_ball_fills_less_and_less_of_its_cube():
    np.testing.assert_allclose(
        [ball_share(d) for d in (1, 2, 3, 4)], [1, np.pi / 4, np.pi / 6, np.pi**2 / 32]
    )
    assert ball_share(20) == pytest.approx(2.46e-8, rel=1e-2)


def test_lines_are_isotropic_and_tell_the_area():
    p, faces = rabbit_mesh(0.05)
    ends = lines_through_ball(4000, np.zeros(3), 1.0, rng=np.random.default_rng(5))
    np.testing.assert_allclose(np.linalg.norm(ends, axis=2), 1)
    line, places = line_crossings(p, faces, ends)
    counts = np.bincount(line, minlength=4000)
    assert (counts % 2 == 0).all()  # a closed mesh is left as often as it is entered
    area = 2 * np.pi * counts.mean()
    assert area == pytest.approx(
        surface_area(p, faces), abs=4 * 2 * np.pi * counts.std() / np.sqrt(4000)
    )
    o = ends[line, 0]
    d = ends[line, 1] - ends[line, 0]
    assert np.linalg.norm(np.cross(places - o, d), axis=1).max() < 1e-9


def test_lines_that_meet_nothing():
    p, faces = rabbit_mesh(0.05)
    assert len(line_crossings(p, faces, np.array([[[5.0, 5, 5], [6, 5, 5]]]))[0]) == 0
    assert len(line_crossings(p, faces, np.empty((0, 2, 3)))[0]) == 0
