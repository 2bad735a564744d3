"""The window of a camera is what its pixels see; a segment has the depth of its points, and of two
meshes in one plane the later is seen.
"""

import numpy as np
import pytest

from workbench.geometry.cameras import intrinsics
from workbench.geometry.cameras.distortion import NONE, Distortion
from workbench.geometry.cameras.raster import MeshItem, SegmentItem, _window, render


def test_without_a_lens_it_is_the_picture_s_rectangle():
    K = intrinsics(40.0, 31.5, 20.5, fy=30.0)
    low, high = _window(K, 64, 48, distortion=NONE)
    np.testing.assert_allclose(low, [(-0.5 - 31.5) / 40.0, (-0.5 - 20.5) / 30.0])
    np.testing.assert_allclose(high, [(63.5 - 31.5) / 40.0, (47.5 - 20.5) / 30.0])


def test_a_segment_is_as_far_away_as_its_points():
    K = intrinsics(50.0, 31.5, 23.5)
    ends = np.array([[-0.5, 0.0, 2.0], [1.0, 0.0, 4.0]])
    image = render(
        [SegmentItem(ends[None], np.array([[9, 9, 9]], np.uint8), 1)],
        np.eye(4),
        K,
        width=64,
        height=48,
    )
    v, u = np.nonzero(np.isfinite(image.depth))
    assert len(np.unique(u)) > 20
    x_over_z = (u - 31.5) / 50.0
    share = (-0.5 - 2.0 * x_over_z) / (2.0 * x_over_z - 1.5)  # where the ray meets the segment
    np.testing.assert_allclose(image.depth[v, u], 2.0 + 2.0 * share, rtol=0.03)


@pytest.mark.parametrize("lens", [NONE, Distortion(k1=-0.3, k2=0.05)])
@pytest.mark.parametrize("diagonal", [[[0, 1, 2], [0, 2, 3]], [[0, 1, 3], [1, 2, 3]]])
def test_of_two_meshes_in_one_plane_the_later_wins_however_they_are_cut(lens, diagonal):
    p = np.array([[-2.0, -1.5, 3], [2, -1.5, 3], [2, 1.5, 3], [-2, 1.5, 3]])
    K = np.array([[200.0, 0, 79.5], [0, 200, 59.5], [0, 0, 1]])
    items = [
        MeshItem(p, np.array(faces), np.full((2, 3), value, np.uint8))
        for faces, value in (([[0, 1, 2], [0, 2, 3]], 100), (diagonal, 200))
    ]
    assert (
        render(items, np.eye(4), K, width=160, height=120, distortion=lens).colors[..., 0] == 200
    ).all()
