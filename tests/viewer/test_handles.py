import numpy as np
import pytest
import viser

from tests.fake import Params
from tests.viewer.browser_scene import Windows
from workbench.viewer.handles import Handles


@pytest.mark.parametrize("at_once", [True, False])
def test_handles_that_are_made_anew_leave_no_pose_behind(monkeypatch, at_once):
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    try:
        windows = Windows(server, monkeypatch)
        handles = Handles(server.scene, Params, lambda **values: None)
        handles.show(Params(place=(1.0, 2.0, 0.5)))
        if not at_once:
            assert len(windows.send().seen("/gizmo/")) == 1
        handles.close()
        handles = Handles(server.scene, Params, lambda **values: None)
        handles.show(Params(place=(0.0, 0.0, 0.0)))
        (handle,) = windows.send().seen("/gizmo/").values()
        np.testing.assert_array_equal(handle["pose"], [])
        handles.close()
        assert windows.send().seen("/gizmo/") == {}
    finally:
        server.stop()
