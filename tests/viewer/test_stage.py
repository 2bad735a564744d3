import numpy as np
import pytest
import viser

from workbench.lesson import View, catalog
from workbench.recording.layout import scene_view
from workbench.viewer.stage import add_floor, framed


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


DOWN = View(eye=(0.0, 0.0, 4.0))


@pytest.mark.parametrize(
    ("view", "right", "upwards"),
    [
        (DOWN, (1, 0, 0), (0, 1, 0)),
        (View(eye=(1.0, 2.0, -3.0), target=(1.0, 2.0, 0.0)), (-1, 0, 0), (0, 1, 0)),
        (View(eye=(0.0, 5.0, 0.0), up=(0.0, 1.0, 0.0)), (1, 0, 0), (0, 0, -1)),
        (View(eye=(0.0, 0.0, 4.0), up=(0.0, 1.0, 0.0)), (1, 0, 0), (0, 1, 0)),
        (View(eye=(0.0, 0.0, 4.0), up=(0.0, -1.0, 0.0)), (-1, 0, 0), (0, -1, 0)),
    ],
)
def test_a_view_along_its_up_is_one_picture_with_a_right_and_an_up(view, right, upwards):
    for back, raised in ((1.0, 0.0), (1.8, 0.58)):
        eye, target = framed(view, back, raised)
        assert np.isfinite([eye, target]).all()
        v_ahead = (target - eye) / np.linalg.norm(target - eye)
        v_right = np.cross(v_ahead, view.up) / np.linalg.norm(np.cross(v_ahead, view.up))
        np.testing.assert_allclose(v_right, right, atol=1e-6)
        np.testing.assert_allclose(np.cross(v_right, v_ahead), upwards, atol=5e-3)
    position = scene_view("", view, "").properties["EyeControls3D"].position.as_arrow_array().to_pylist()[0]
    v_ahead = np.array(view.target) - position
    assert np.linalg.norm(np.cross(v_ahead, view.up)) > 1e-3 * np.linalg.norm(v_ahead)


@pytest.mark.parametrize(
    "wrong", [{"eye": (0.0, 0.0, 0.0)}, {"up": (0.0, 0.0, 0.0)}, {"target": (np.nan, 0.0, 0.0)}, {"eye": (1.0, 2.0)}]
)
def test_a_view_from_nowhere_is_refused(wrong):
    with pytest.raises(ValueError, match="View"):
        View(**wrong)


@pytest.mark.parametrize("up", [(0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (-1.0, 0.0, 0.0)])
def test_the_camera_is_turned_and_the_scene_is_not(up):
    """The browser turns the scene at the end of a batch, after it has placed the camera by the turn before."""
    with_root: list[str] = []
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    try:
        queue = server.scene._websock_interface.queue_message
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(
                server.scene._websock_interface,
                "queue_message",
                lambda message: (with_root.append(type(message).__name__) if getattr(message, "name", 0) == "" else 0,
                                 queue(message)),
            )  # fmt: skip
            add_floor(server.scene, View(up=up))
    finally:
        server.stop()
    assert with_root == []
