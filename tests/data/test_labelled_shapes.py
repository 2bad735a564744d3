"""Labelled clouds: each lies on its surface but for stretch and noise, from the lowest point to the
highest.
"""

import numpy as np
import pytest

from lessons.learning import labelled_shapes
from lessons.learning.labelled_shapes import NAMES, labelled_clouds

EVERY = np.repeat(np.arange(len(NAMES)), 20)


def test_clouds_are_listed_from_the_lowest_point_and_the_same_for_a_seed():
    clouds = labelled_clouds(EVERY, 16, "freely", rng=np.random.default_rng(0))
    assert clouds.shape == (100, 16, 3)
    assert np.all(np.diff(clouds[:, :, 2], axis=1) >= 0)
    np.testing.assert_array_equal(
        labelled_clouds(EVERY, 16, "freely", rng=np.random.default_rng(0)), clouds
    )


def test_points_lie_on_their_surfaces(monkeypatch):
    """Without noise and stretch every shape fulfils its equation, turned about z as it may be."""
    monkeypatch.setattr(labelled_shapes, "NOISE", 0.0)
    monkeypatch.setattr(labelled_shapes, "STRETCH", (1.0, 1.0))
    clouds = labelled_clouds(EVERY, 40, "about z", rng=np.random.default_rng(1))
    r = np.hypot(clouds[..., 0], clouds[..., 1])
    z = clouds[..., 2]
    sphere, box, cylinder, cone, torus = ((r[k == EVERY], z[k == EVERY]) for k in range(5))
    assert np.hypot(*sphere) == pytest.approx(1)
    assert box[0].max() <= 0.8 * np.sqrt(2) + 1e-9
    assert np.all((np.abs(cylinder[0] - 0.75) < 1e-9) | (np.abs(np.abs(cylinder[1]) - 0.9) < 1e-9))
    assert np.all(
        (np.abs(cone[0] - 0.9 * (0.8 - cone[1]) / 1.6) < 1e-9) | (np.abs(cone[1] + 0.8) < 1e-9)
    )
    assert np.hypot(torus[0] - 0.75, torus[1]) == pytest.approx(0.3)


def test_shapes_are_turned_about_z_or_freely():
    def heights(turned) -> np.ndarray:
        return np.ptp(
            labelled_clouds(np.full(60, 4), 200, turned, rng=np.random.default_rng(2))[:, :, 2],
            axis=1,
        )

    assert heights("about z").max() < 0.6 * 1.2 + 0.2
    assert heights("freely").max() > 1.5
