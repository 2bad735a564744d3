"""Windows around pixels, as pictures."""

import numpy as np

from workbench.data.windows import framed, side_by_side

FRAME = (204, 121, 167)


def windows(left, right, uv):
    return side_by_side(left, right, uv, d=4, window=5, frame=FRAME)


def test_the_windows_are_the_pixels_of_both_pictures():
    rng = np.random.default_rng(0)
    left, right = rng.integers(0, 256, (2, 20, 30, 3)).astype(np.uint8)
    image = windows(left, right, (15, 10))
    assert image.shape == (9, 9 + 2 + 9, 3)
    # already as bright as can be
    assert np.abs(image[2:7, 2:7] - 1.0 * left[8:13, 13:18]).max() <= 6
    assert np.abs(image[2:7, 13:18] - 1.0 * right[8:13, 9:14]).max() <= 6
    assert (image[1, 1:8] == FRAME).all()
    dim = windows(left // 4, right // 4, (15, 10))
    assert np.abs(dim[2:7, 2:7] - 1.0 * image[2:7, 2:7]).max() <= 12
    outside = windows(left, right, (1, 10))[:, 11:]
    assert (outside[:, 0] == 128).all()
    assert (outside[2:7, 2:7] == 128).all()


def test_a_frame_that_is_outside_changes_nothing():
    picture = np.zeros((20, 30, 3), np.uint8)
    assert np.array_equal(framed(picture, (-50, 5), 3, frame=FRAME), picture)
