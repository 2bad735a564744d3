"""What the browser makes of viser's messages: a model of viser 1.1.1's client, fed by viser's own message buffer.

The buffer is the one of a single client: a message gives way to a later one of the same kind for the same node that comes
before it was sent, a removal to the addition that follows it. The client keeps a node's pose and visibility when a node is
added under a name it knows (SceneTreeState.ts, `addSceneNode`; MessageHandler.tsx), and forgets them when it is removed.
"""

import contextlib
import math
import re
from collections.abc import Iterator
from dataclasses import fields
from typing import Any, cast

import numpy as np
import viser
import viser._messages as m
from viser.infra._async_message_buffer import AsyncMessageBuffer

Seen = dict[str, dict[str, Any]]


class Windows:
    """Takes the place of a server's connection: what its scene sends goes to browsers, and into a recording.

    Args:
        server: Whose scene is watched.
        monkeypatch: Undoes it.
        browsers: How many browsers there are, each with a buffer of its own.
    """

    def __init__(self, server: viser.ViserServer, monkeypatch: Any, browsers: int = 1):
        self.browsers = [Browser() for _ in range(browsers)]
        self.recorded: list[Any] = []
        self._buffers = [AsyncMessageBuffer(cast(Any, Loop()), persistent_messages=False) for _ in self.browsers]
        interface = server.scene._websock_interface
        monkeypatch.setattr(interface, "queue_message", self._push)
        monkeypatch.setattr(interface, "get_message_buffer", lambda: self)

    def _push(self, message: Any) -> None:
        self.recorded.append(message)
        for buffer in self._buffers:
            buffer.push(message)

    def remove_entity_state_from_buffer(self, entity_type: str, entity_id: str) -> None:
        """What viser asks of the buffer when a node replaces another."""
        for buffer in self._buffers:
            buffer.remove_entity_state_from_buffer(entity_type, entity_id)

    def sanctioned_dead_writes(self) -> Any:
        """What viser asks of the buffer when a node is removed."""
        return contextlib.nullcontext()

    def send(self, i: int = 0) -> "Browser":
        """Let a browser have what is waiting, as one batch; return it."""
        buffer = self._buffers[i]
        batch = [buffer.pop_message_locked(number) for number in sorted(buffer.message_from_id)]
        self.browsers[i].handle([message for message in batch if message is not None])
        return self.browsers[i]


class Loop:
    """An event loop on which nobody waits."""

    def call_soon_threadsafe(self, *_: Any) -> None:
        """Wake nobody."""


class Browser:
    """The scene tree of a browser."""

    def __init__(self) -> None:
        self.nodes: dict[str, dict[str, Any]] = {}
        self.poses: dict[str, dict[str, Any]] = {}

    def handle(self, batch: list[Any]) -> None:
        """Handle a batch: nodes come and go at once, properties and visibility wait for the batch's end."""
        parked: dict[str, list[dict[str, Any]]] = {}
        for message in batch:
            name = getattr(message, "name", "")
            if isinstance(message, m._CreateSceneNodeMessage):
                self._apply(name, parked.pop(name, []))
                self._add(name, message)
            elif isinstance(message, m.RemoveSceneNodeMessage):
                self._apply(name, parked.pop(name, []))
                for gone in [n for n in self.nodes if n == name or n.startswith(name + "/")]:
                    del self.nodes[gone]
                    self.poses.pop(gone, None)
            elif isinstance(message, m.SetOrientationMessage):
                self._pose(name)["wxyz"] = message.wxyz
            elif isinstance(message, m.SetPositionMessage):
                self._pose(name)["position"] = message.position
            elif isinstance(message, m.SetSceneNodeVisibilityMessage):
                parked.setdefault(name, []).append({"visible": message.visible})
            elif isinstance(message, m.SceneNodeUpdateMessage):
                parked.setdefault(name, []).append({"props": message.updates})
        for name, updates in parked.items():
            self._apply(name, updates)

    def hide_all(self) -> None:
        """Do what the player of a recording does before it plays from the start: hide nodes, keep them."""
        for name, node in self.nodes.items():
            self.poses[name] = {}
            if node["kind"] != "FrameMessage" or node["props"]["show_axes"]:
                node["visible"] = False

    def seen(self, below: str) -> Seen:
        """Return what is drawn below a name: every visible node's kind, properties and pose in the world."""
        return {
            re.sub("~[0-9]+", "", name): {
                "kind": node["kind"],
                **node["props"],
                "pose": self._placed(name, node["kind"]),
            }
            for name, node in self.nodes.items()
            if name.startswith(below) and self._visible(name)
        }

    def _add(self, name: str, message: Any) -> None:
        parent = name.rpartition("/")[0]
        if parent and parent not in self.nodes:
            self.nodes[parent] = {"kind": "FrameMessage", "props": {"show_axes": False}, "visible": True}
        before = self.nodes.get(name, {"visible": True})
        props = {field.name: getattr(message.props, field.name) for field in fields(message.props)}
        self.nodes[name] = {"kind": type(message).__name__, "props": props, "visible": before["visible"]}

    def _apply(self, name: str, updates: list[dict[str, Any]]) -> None:
        node = self.nodes.get(name)
        if node is None:
            return
        for update in updates:
            node["props"] = node["props"] | update.get("props", {})
            node["visible"] = update.get("visible", node["visible"])

    def _pose(self, name: str) -> dict[str, Any]:
        return self.poses.setdefault(name, {})

    def _visible(self, name: str) -> bool:
        parts = name.split("/")
        chain = ["/".join(parts[: i + 1]) for i in range(1, len(parts))]
        return all(self.nodes[part]["visible"] for part in chain)

    def _placed(self, name: str, kind: str) -> list[float]:
        """Return the poses from the root to a node, quaternion and position, without those that move nothing."""
        parts, placed = name.split("/"), []
        for i in range(1, len(parts)):
            pose = self.poses.get("/".join(parts[: i + 1]), {})
            turned = kind != "LabelMessage" or i < len(parts) - 1  # labels stand upright, whatever their pose
            wxyz = pose.get("wxyz", (1.0, 0.0, 0.0, 0.0)) if turned else (1.0, 0.0, 0.0, 0.0)
            moves = (*wxyz, *pose.get("position", (0.0, 0.0, 0.0)))
            placed += () if np.allclose(moves, (1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0), atol=1e-7) else moves
        return placed


def all_pairs(n: int) -> Iterator[int]:
    """Yield 0 to n - 1 so that each follows each other one at least once."""
    for i in range(n):
        for j in range(i + 1, n):
            yield from (i, j)
    yield 0


def difference(a: Seen, b: Seen) -> str:
    """Return what tells two browsers' scenes apart, nothing where they look the same."""
    if a.keys() != b.keys():
        return f"only one has {sorted(a.keys() ^ b.keys())}"
    for name, node in a.items():
        for key, value in node.items():
            if not _alike(key, value, b[name].get(key)):
                return f"{name}.{key} is {value}, not {b[name].get(key)}"
    return ""


def _alike(key: str, a: Any, b: Any) -> bool:
    if key == "pose":  # viser drops changes below 1e-5 of a pose
        return len(a) == len(b) and all(
            math.isclose(x, y, rel_tol=1e-4, abs_tol=1e-6) for x, y in zip(a, b, strict=True)
        )
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        if a.shape != b.shape and key == "colors":
            a, b = np.broadcast_arrays(a, b)
        return a.shape == b.shape and np.array_equal(a, b)
    return bool(a == b)
