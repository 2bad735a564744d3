"""A scene as plain nodes that any page can draw: of which kind, with which properties, where.

A node is made once, the same for all who ask, and lives as long as the primitive that it shows.
Equal content has an equal key, so that a page is sent it once.
"""

import functools
import hashlib
import json
import threading
import weakref
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from workbench.lesson import View
from workbench.scene import Label, Scene, Spatial, in_space
from workbench.wire.primitives import AT_ORIGIN, NAME, Pose, add, place_of, pose_of
from workbench.wire.stage import add_stage, axis_names
from workbench.wire.writer import Heard, Said, Writer

SCENE = "/scene/"
"""What the names of all that belongs to a step begin with; the rest is the stage."""
MOST_STAGES = 256
"""Stages that are kept: own scans bring views of their own."""


class Content:
    """The bytes of an array, of which there is one for all equal ones."""

    __slots__ = ("__weakref__", "data", "key")

    def __init__(self, key: str, data: bytes):
        self.key, self.data = key, data


@dataclass(frozen=True, eq=False)
class NodeKind:
    """What is drawn, wherever it stands.

    Attributes:
        key: Of equal content, equal keys.
        text: As JSON: viser's type of node, its properties, and how opaque it is; an array is
            `{"$": key, "as": dtype}`.
        arrays: Those that belong to it.
    """

    key: str
    text: str
    arrays: tuple[Content, ...] = field(repr=False)


Node = tuple[NodeKind, Pose]


@dataclass(frozen=True)
class StageNodes:
    """What stands where a scene will be: nodes by name, and what a client is told besides."""

    nodes: Mapping[str, Node]
    light: tuple[Said, ...]


class Hearing(Protocol):
    """Hears what viser would say of a scene.

    Attributes:
        at_first: What is said of every scene.
    """

    at_first: Heard

    def heard(self, add: Callable[[Any], Any]) -> Heard:
        """Return what is said when something is added to a scene."""
        ...


class Maker:
    """Makes nodes. One serves a process; any thread may ask.

    Args:
        hearing: Makes what hears the scene; one for each thread.
    """

    def __init__(self, hearing: Callable[[], Hearing] = Writer) -> None:
        self._hearing = hearing
        self._own = threading.local()  # nobody waits for a heavy scene of others
        self._lock = threading.Lock()
        self._made: weakref.WeakKeyDictionary[Spatial, dict[str, Node]] = (
            weakref.WeakKeyDictionary()
        )
        self._contents: weakref.WeakValueDictionary[str, Content] = weakref.WeakValueDictionary()
        self.stage = functools.lru_cache(MOST_STAGES)(self._stage)

    def held(self) -> int:
        """Return how many bytes the arrays hold of all nodes that are still there."""
        with self._lock:
            return sum(len(content.data) for content in self._contents.values())

    def nodes(self, scene: Scene, view: View) -> dict[str, Node]:
        """Return all nodes of a scene and of its stage, by name, in the order in which they are
        drawn.
        """
        nodes = dict(self.stage(view).nodes)
        for path, primitive in scene.items():
            if in_space(primitive):
                base = SCENE + path.replace("/", "·")  # without a parent: poses compose
                nodes |= {base + part: node for part, node in self._of(primitive).items()}  # type: ignore[arg-type]
        return nodes

    def _stage(self, view: View) -> StageNodes:
        """Return the stage of a view; `stage` does, and keeps those that were wanted last."""
        listener = self._listener()
        nodes, light = self._nodes(
            [*listener.at_first, *listener.heard(lambda scene: add_stage(scene, view))]
        )
        for name, place in axis_names(view):
            nodes[f"/axis/{name}"] = self._word(name, "small"), place_of(place, None)
        return StageNodes(nodes, tuple(light))

    def _listener(self) -> Hearing:
        if not hasattr(self._own, "listener"):
            self._own.listener = self._hearing()
        return self._own.listener

    def _of(self, primitive: Spatial) -> dict[str, Node]:
        """Return the nodes of a primitive, by what stands behind its own name."""
        with self._lock:
            made = self._made.get(primitive)
        if made is None:
            made = self._new(primitive)
            with self._lock:
                made = self._made.setdefault(primitive, made)
        return made

    def _new(self, primitive: Spatial) -> dict[str, Node]:
        if isinstance(primitive, Label):
            how = ("stays",) if primitive.stays else ()
            word = self._word(primitive.text, *how, fade=primitive.opacity)
            return {"": (word, place_of(primitive.p, primitive.T_world_object))}
        nodes, _ = self._nodes(
            self._listener().heard(lambda scene: add(scene, primitive)), fade=primitive.opacity
        )
        pose = pose_of(primitive)
        return {
            name[len(NAME) :]: (kind, pose if name == NAME else at)
            for name, (kind, at) in nodes.items()
        }

    def _word(self, text: str, *how: str, fade: float = 1.0) -> NodeKind:
        """Return a word, and how it is shown: `small`, or one that `stays`."""
        return self._kind("Label", {"text": text, **dict.fromkeys(how, True)}, [], fade=fade)

    def _nodes(self, heard: Heard, fade: float = 1.0) -> tuple[dict[str, Node], list[Said]]:
        """Return what was heard as nodes, and what was said of no node."""
        made: dict[str, tuple[Said, list[memoryview]]] = {}
        poses: dict[str, Pose] = {}
        hidden, others = set[str](), list[Said]()
        for message, arrays in heard:
            name = message.get("name")
            if name is None:
                others.append(message)
            elif "props" in message:
                made[name] = (message, arrays)
                poses[name] = AT_ORIGIN
            elif message["type"] == "SceneNodeUpdateMessage":
                made[name][0]["props"].update(message["updates"])
            elif message["type"] == "SetPositionMessage":
                poses[name] = place_of(np.asarray(message["position"]), None)
            elif message["type"] == "SetSceneNodeVisibilityMessage" and not message["visible"]:
                hidden.add(name)
        nodes = {
            name: (
                self._kind(
                    message["type"], message["props"], arrays, fade=fade, visible=name not in hidden
                ),
                poses[name],
            )
            for name, (message, arrays) in made.items()
        }
        return nodes, others

    def _kind(
        self,
        type_: str,
        props: Mapping[str, Any],
        arrays: list[memoryview],
        *,
        fade: float = 1.0,
        visible: bool = True,
    ) -> NodeKind:
        contents: list[Content] = []
        plain = {name: self._plain(value, arrays, contents) for name, value in props.items()}
        data: dict[str, Any] = {"type": type_, "props": plain}
        data |= {"fade": round(fade, 4)} if fade < 1 else {}
        data |= {} if visible else {"visible": False}
        text = json.dumps(data, separators=(",", ":"), allow_nan=False)
        return NodeKind(digest(text.encode()), text, tuple(contents))

    def _plain(self, value: Any, arrays: list[memoryview], contents: list[Content]) -> Any:
        """Return a value as JSON can say it, its bytes among the contents. No function in `_kind`:
        one that calls itself would hold them until garbage is collected.
        """
        if isinstance(value, dict) and "__binary_index" in value:
            contents.append(self._content(bytes(arrays[value["__binary_index"]])))
            return {"$": contents[-1].key, "as": value["dtype"]}
        if isinstance(value, bytes | memoryview):
            contents.append(self._content(bytes(value)))
            return {"$": contents[-1].key, "as": "|u1"}
        if isinstance(value, float | np.floating):
            return float(value) if np.isfinite(value) else None
        if isinstance(value, tuple | list):
            return [self._plain(item, arrays, contents) for item in value]
        return value

    def _content(self, content: bytes) -> Content:
        key = digest(content)
        with self._lock:
            kept = self._contents.get(key)
            if kept is None:
                kept = self._contents[key] = Content(key, content)
        return kept


def digest(content: bytes) -> str:
    """Return what stands for bytes: 96 bits of a hash."""
    return hashlib.blake2b(content, digest_size=12).hexdigest()


MAKER = Maker()
"""That of this process."""
