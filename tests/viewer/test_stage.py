import numpy as np
import pytest

from workbench.lesson import catalog
from workbench.viewer.stage import framed


@pytest.mark.parametrize("name", list(catalog()))
def test_a_framed_view_has_the_target_farther_away_and_higher_up(name):
    view = catalog()[name].view
    eye, target = framed(view, 1.8, 0.58)
    forward = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(forward, view.up)
    right /= np.linalg.norm(right)
    p = np.array(view.target) - eye
    height = np.tan(np.radians(view.fov_degrees) / 2)
    assert p @ right / (p @ forward) == pytest.approx(0, abs=1e-9)
    assert p @ np.cross(right, forward) / (p @ forward) == pytest.approx(0.58 * height)
    assert p @ forward == pytest.approx(1.8 * np.linalg.norm(np.array(view.eye) - view.target))
    np.testing.assert_allclose(framed(view, 1.0, 0.0), (view.eye, view.target), atol=1e-12)
