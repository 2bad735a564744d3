"""What is mended of viser changes nothing that it sends, and its loop is woken only by itself."""

import asyncio
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import viser
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation
from viser import _assignable_props_api, _scene_handles
from viser.infra import _async_message_buffer

from tests.loops import run_apart
from workbench.viewer.mended import LoopEvent, mend_viser, wxyz_of

TURN = st.floats(-np.pi, np.pi)


@given(st.tuples(TURN, TURN, TURN))
def test_a_quaternion_is_that_of_its_rotation(turn):
    R = Rotation.from_rotvec(turn).as_matrix()
    q = np.array(wxyz_of(R))
    assert np.isclose(np.linalg.norm(q), 1.0, atol=1e-12)
    np.testing.assert_allclose(Rotation.from_quat(q, scalar_first=True).as_matrix(), R, atol=1e-12)


@pytest.mark.parametrize("diagonal", [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)])
def test_half_turns_have_one_too(diagonal):
    assert sorted(np.abs(wxyz_of(np.diag(np.array(diagonal, float))))) == [0.0, 0.0, 0.0, 1.0]


SEND = """
import sys
import numpy as np, viser
from workbench import scene
if sys.argv[1] == "mended":
    from workbench.viewer.mended import mend_viser
    mend_viser()
server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
said = []
server.scene._queue_scene_message = said.append
for wxyz, position in [((1.0, 0, 0, 0), (0.0, 0, 0)), ((0.0, 1, 0, 0), (1.0, 2, 3))]:
    for _ in range(2):
        handle = server.scene.add_point_cloud("/a", np.ones((2, 3)), (1, 2, 3), wxyz=wxyz, position=position)
        handle.wxyz = np.array([1.0, 0, 0, 0])
        handle.position = (0.0, 0.0, 1.0)
        handle.position = np.array([0.0, 0.0, 1.0])
        handle.point_size = 0.5
        handle.points = np.zeros((3, 3))
        handle.colors = np.array([7, 8, 9], np.uint8)
for wrong in [(1.0, 0), "abcd", np.eye(2)]:
    try:
        handle.wxyz = wrong
    except Exception as error:
        said.append(type(error).__name__)
for message in said:
    print(repr(message), file=sys.stderr)
server.stop()
"""


def test_viser_sends_the_same():
    def sent(how: str) -> str:
        command = [sys.executable, "-c", SEND, how]
        root = Path(__file__).parents[2]
        return subprocess.run(command, cwd=root, capture_output=True, text=True, check=True).stderr

    assert sent("mended") == sent("plain") != ""


def test_only_its_own_loop_sets_an_event():
    async def waited() -> None:
        loop = asyncio.get_running_loop()
        event = LoopEvent(loop)
        waiting = [asyncio.create_task(event.wait()) for _ in range(3)]
        await asyncio.sleep(0)
        await asyncio.to_thread(event.set)
        assert not event.is_set()
        await asyncio.to_thread(loop.call_soon_threadsafe, event.set)
        async with asyncio.timeout(60):
            await asyncio.gather(*waiting)
        assert event.is_set()

    run_apart(waited())


def test_viser_is_built_as_expected():
    """Where this fails, viser has changed: see whether `mend_viser` is still needed."""
    mend_viser()
    assert isinstance(_assignable_props_api.AssignablePropsBase._prop_hints, property), viser.__version__
    buffer = _async_message_buffer.AsyncMessageBuffer(asyncio.new_event_loop(), True)
    buffer.event_loop.close()
    assert isinstance(buffer.message_event, LoopEvent), viser.__version__
    assert _scene_handles._set_pose_vector.__module__ == mend_viser.__module__, viser.__version__
