"""Steps and runs as bytes: 4 bytes of length (little endian), a head as JSON, then arrays at
multiples of 8 bytes.

The head names what follows in `arrays`, as [key, bytes], and what it says anew in `kinds`. A node
is [name, key of its kind, pose]. A page keeps kinds and arrays, and is sent each of them once.
"""

import base64
import json
from collections.abc import Iterable, Mapping
from typing import Any

from workbench.lesson import View
from workbench.run.timeline import Timeline
from workbench.scene import Scene
from workbench.wire.nodes import MAKER, Content, Maker, Node, NodeKind
from workbench.wire.stage import camera_of

MOST_ON_A_PAGE = 96 * 2**20
"""Bytes of arrays after which a page is told to forget what it has."""
LEVEL = 12
"""Of compression, for files."""


def packed(head: Mapping[str, Any], kinds: Iterable[NodeKind], arrays: Iterable[Content]) -> bytes:
    """Return one message."""
    arrays = list(arrays)
    text = json.dumps(
        {**head, "arrays": [[array.key, len(array.data)] for array in arrays]},
        separators=(",", ":"),
        allow_nan=False,
    )
    listed = ",".join(f'"{kind.key}":{kind.text}' for kind in kinds)
    start = f'{text[:-1]},"kinds":{{{listed}}}}}'.encode()
    start += b" " * (-(4 + len(start)) % 8)
    parts = [len(start).to_bytes(4, "little"), start]
    for array in arrays:
        parts += [array.data, b"\0" * (-len(array.data) % 8)]
    return b"".join(parts)


def staged(view: View, maker: Maker = MAKER) -> dict[str, Any]:
    """Return what a page is told of a stage besides its nodes: how it is lit, and where it is seen
    from.
    """
    return {"light": list(maker.stage(view).light), "camera": camera_of(view)}


class PageWire:
    """What one page has been sent of scenes, and the bytes that it lacks of a step."""

    def __init__(self, maker: Maker = MAKER):
        self._maker = maker
        self.forget()

    def forget(self) -> None:
        """Take it that the page has nothing."""
        self._kinds: set[str] = set()
        self._arrays: set[str] = set()
        self._held = 0
        self._staged: Any = None

    def step(
        self, head: Mapping[str, Any], scene: Scene, view: View, *, stage: Any = None
    ) -> bytes:
        """Return what the page needs to show a scene.

        Args:
            head: What is said with it, as plain data.
            scene: What is shown.
            view: The stage that it is on.
            stage: What the camera belongs to besides, such as the lesson: it is put to the view
                again where that changes.
        """
        message = dict(head)
        if not self._kinds or self._held > MOST_ON_A_PAGE:
            self.forget()
            message["fresh"] = True
        nodes = self._maker.nodes(scene, view)
        kinds = {kind.key: kind for kind, _ in nodes.values() if kind.key not in self._kinds}
        arrays = {
            array.key: array
            for kind in kinds.values()
            for array in kind.arrays
            if array.key not in self._arrays
        }
        self._kinds |= kinds.keys()
        self._arrays |= arrays.keys()
        self._held += sum(len(array.data) for array in arrays.values())
        if (stage, view) != self._staged:
            message["stage"], self._staged = staged(view, self._maker), (stage, view)
        message["nodes"] = [[name, kind.key, pose] for name, (kind, pose) in nodes.items()]
        return packed(message, kinds.values(), arrays.values())


def run_bytes(timeline: Timeline, maker: Maker = MAKER) -> bytes:
    """Return the scenes of all known steps of a run as one message; a step names alone what is as
    in the one before.
    """
    view = timeline.lesson.view_of(timeline.params)
    kinds: dict[str, NodeKind] = {}
    arrays: dict[str, Content] = {}
    steps: list[list[Any]] = []
    before: dict[str, Node] = {}
    for step in timeline.known():
        nodes = maker.nodes(step.scene, view)
        for kind, _ in nodes.values():
            kinds[kind.key] = kind
            arrays |= {array.key: array for array in kind.arrays}
        steps.append([_listed(name, node, before.get(name)) for name, node in nodes.items()])
        before = nodes
    return packed({"stage": staged(view, maker), "steps": steps}, kinds.values(), arrays.values())


def _listed(name: str, node: Node, before: Node | None) -> Any:
    kind, pose = node
    is_same = before is not None and before[0].key == kind.key and before[1] == pose
    return name if is_same else [name, kind.key, pose]


def run_text(timeline: Timeline) -> str:
    """Return the scenes of a run as a page's script holds them: 8 bytes of length, then zstd, in
    base64.
    """
    import zstandard  # a browser, which computes steps one by one, has none

    content = run_bytes(timeline)
    small = zstandard.ZstdCompressor(level=LEVEL).compress(content)
    return base64.b64encode(len(content).to_bytes(8, "little") + small).decode()
