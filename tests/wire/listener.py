"""viser's scene API without a server: what it would send to a client is kept, to hold the writer to
it.
"""

import contextlib
import threading
from collections.abc import Callable
from typing import Any

import viser
from viser.infra._infra import WebsockMessageHandler

from workbench.wire.writer import Heard


class _Wire(WebsockMessageHandler):
    """What a SceneApi takes for its client, for the connection of that client, and for the server
    behind it.
    """

    client_id = ""

    def __init__(self) -> None:
        super().__init__()
        self.messages: list[Any] = []
        self._websock_connection = self._viser_server = self
        self._scene_lifecycle_lock = threading.RLock()

    def queue_message(self, message: Any) -> None:
        self.messages.append(message)

    def get_message_buffer(self) -> Any:
        return self

    def remove_entity_state_from_buffer(self, *_: Any) -> None: ...

    sanctioned_dead_writes = staticmethod(contextlib.nullcontext)


class Listener:
    """Hears what viser would send for what is added to a scene. For one thread."""

    def __init__(self) -> None:
        self._wire = _Wire()
        self._scene: Any = viser.SceneApi(self._wire, None, None)  # type: ignore[arg-type]
        self.at_first = self._taken()

    def heard(self, add: Callable[[viser.SceneApi], Any]) -> Heard:
        """Return what viser says when something is added to its scene: each message, and its
        arrays.
        """
        add(self._scene)
        return self._taken()

    def _taken(self) -> Heard:
        messages = self._wire.messages
        self._wire.messages = []
        self._scene._handle_from_node_name.clear()  # the next node of the same name is a new one
        self._scene._children_from_node_name.clear()
        taken = []
        for message in messages:
            arrays: list[memoryview] = []
            taken.append((message.as_serializable_dict(arrays), arrays))
        return taken
