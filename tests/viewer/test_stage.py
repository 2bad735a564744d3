import numpy as np
import pytest

from workbench.lesson import catalog
from workbench.viewer.stage import BACK, RAISED, narrow_view


@pytest.mark.parametrize("name", list(catalog()))
def test_a_narrow_screen_sees_the_target_above_the_sheet(name):
    view = catalog()[name].view
    eye, target = narrow_view(view)
    forward = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(forward, view.up)
    right /= np.linalg.norm(right)
    p = np.array(view.target) - eye
    height = np.tan(np.radians(view.fov_degrees) / 2)
    assert p @ right / (p @ forward) == pytest.approx(0, abs=1e-9)
    assert p @ np.cross(right, forward) / (p @ forward) == pytest.approx(RAISED * height)
    assert p @ forward == pytest.approx(BACK * np.linalg.norm(np.array(view.eye) - view.target))
