"""Reads what a page is sent of scenes, by what the format says alone."""

import json
import struct
from typing import Any

import numpy as np


class Reader:
    """What a page has, message by message; what it is sent twice, or refers to without having it,
    is an error.
    """

    def __init__(self) -> None:
        self.kinds: dict[str, Any] = {}
        self.arrays: dict[str, bytes] = {}

    def read(self, message: bytes) -> dict[str, Any]:
        """Return the head of a message, and keep what comes with it."""
        (length,) = struct.unpack_from("<I", message)
        head = json.loads(message[4 : 4 + length])
        if head.get("fresh"):
            self.kinds, self.arrays = {}, {}
        at = 4 + length
        for key, size in head["arrays"]:
            assert at % 8 == 0, "an array stands where a view of 8 bytes may begin"
            assert key not in self.arrays, "sent twice"
            self.arrays[key] = message[at : at + size]
            assert len(self.arrays[key]) == size
            at += size + -size % 8
        assert at == len(message)
        assert not self.kinds.keys() & head["kinds"].keys(), "sent twice"
        self.kinds |= head["kinds"]
        return head

    def nodes(self, listed: list[Any]) -> dict[str, dict[str, Any]]:
        """Return nodes by name, each with its type, its properties with arrays in them, and its
        pose.
        """
        return {name: self.node(key, pose) for name, key, pose in listed}

    def node(self, key: str, pose: list[float]) -> dict[str, Any]:
        """Return one node."""
        kind = self.kinds[key]
        props = {name: self._filled(value) for name, value in kind["props"].items()}
        return {**kind, "props": props, "pose": pose, "key": key}

    def _filled(self, value: Any) -> Any:
        if isinstance(value, list):
            return [self._filled(item) for item in value]
        if isinstance(value, dict):
            return np.frombuffer(self.arrays[value["$"]], value["as"])
        return value


def alike(a: Any, b: Any) -> bool:
    """Tell whether two read values are equal, arrays by content."""
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(alike(a[key], b[key]) for key in a)
    if isinstance(a, list) and isinstance(b, list):
        return len(a) == len(b) and all(map(alike, a, b))
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        return a.dtype == b.dtype and np.array_equal(a, b)
    return bool(a == b)
