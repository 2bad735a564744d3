import numpy as np
import pytest
import viser

from tests.fake import Params, lesson
from tests.viewer.browser_scene import Windows
from workbench.viewer.knob_panel import KnobPanel


@pytest.mark.parametrize("at_once", [True, False])
def test_handles_go_with_their_panel_and_leave_no_pose_behind(monkeypatch, at_once):
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    try:
        windows = Windows(server, monkeypatch)
        panel = KnobPanel(server, lesson, lambda **values: None)  # type: ignore[arg-type]
        panel.show(Params(place=(1.0, 2.0, 0.5)))
        if not at_once:
            assert len(windows.send().seen("/gizmo/")) == 1
        panel.close()
        panel = KnobPanel(server, lesson, lambda **values: None)  # type: ignore[arg-type]
        panel.show(Params(place=(0.0, 0.0, 0.0)))
        (handle,) = windows.send().seen("/gizmo/").values()
        np.testing.assert_array_equal(handle["pose"], [])
        panel.close()
        assert windows.send().seen("/gizmo/") == {}
    finally:
        server.stop()
