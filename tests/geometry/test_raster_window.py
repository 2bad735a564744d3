"""The window of a camera is what its pixels see; a segment has the depth of its points."""

import numpy as np

from workbench.geometry.cameras import intrinsics
from workbench.geometry.cameras.distortion import NONE
from workbench.geometry.cameras.raster import SegmentItem, _window, render


def test_without_a_lens_it_is_the_picture_s_rectangle():
    K = intrinsics(40.0, 31.5, 20.5, fy=30.0)
    low, high = _window(K, 64, 48, NONE)
    np.testing.assert_allclose(low, [(-0.5 - 31.5) / 40.0, (-0.5 - 20.5) / 30.0])
    np.testing.assert_allclose(high, [(63.5 - 31.5) / 40.0, (47.5 - 20.5) / 30.0])


def test_a_segment_is_as_far_away_as_its_points():
    K = intrinsics(50.0, 31.5, 23.5)
    ends = np.array([[-0.5, 0.0, 2.0], [1.0, 0.0, 4.0]])
    image = render(
        [SegmentItem(ends[None], np.array([[9, 9, 9]], np.uint8), 1)], np.eye(4), K, 64, 48
    )
    v, u = np.nonzero(np.isfinite(image.depth))
    assert len(np.unique(u)) > 20
    x_over_z = (u - 31.5) / 50.0
    share = (-0.5 - 2.0 * x_over_z) / (2.0 * x_over_z - 1.5)  # where the ray meets the segment
    np.testing.assert_allclose(image.depth[v, u], 2.0 + 2.0 * share, rtol=0.03)
