from dataclasses import dataclass
from types import SimpleNamespace
from typing import Annotated

import numpy as np
import pytest
import viser

from tests.fake import Params
from tests.viewer.browser_scene import Windows
from workbench.knobs import Gizmo, Knob
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


@dataclass(frozen=True)
class Flat:
    place: Annotated[tuple[float, float], Knob("Where", -2, 2, unit="m", by=Gizmo())] = (0.5, 0.0)


def test_two_floats_are_a_place_in_the_plane_z_0():
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    changed: list[dict] = []
    try:
        handles = Handles(server.scene, Flat, lambda **values: changed.append(values))
        handles.show(Flat(place=(1.0, -0.5)))
        (handle,) = handles._handles.values()
        np.testing.assert_array_equal(handle.position, [1.0, -0.5, 0.0])
        assert handle.active_axes == (True, True, False)
        handle.position = (0.25, 0.75, 0.0)
        (moved,) = handle._impl_aux.update_cb
        with pytest.raises(StopIteration):  # it waits for nothing; a test before may have left a loop running
            moved(SimpleNamespace(client=1, phase="end", target=handle)).send(None)
        assert changed == [{"place": [0.25, 0.75]}]
        handles.close()
    finally:
        server.stop()
