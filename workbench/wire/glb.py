"""A mesh with a colour at each vertex as a binary glTF file.

Reference: Khronos, glTF 2.0 specification, 3.6 (accessors), 3.7 (meshes), 4.4 (GLB).
"""

import json
import struct
from typing import Any

import numpy as np
from jaxtyping import Float32, Int, UInt8

_UINT32 = 5125
_FLOAT32 = 5126
_UINT8 = 5121
# without a material a GLB is all metal, and shows its surroundings instead of its colours
_MATT = {"pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 1.0}}


def glb_of(
    p: Float32[np.ndarray, "v 3"],
    faces: Int[np.ndarray, "f 3"],
    colors: UInt8[np.ndarray, "v 4"],
) -> bytes:
    """Return triangles as the bytes of a GLB file: matt, seen from both sides.

    Colours are linear light, as the format takes them; positions are metres.
    """
    parts = [np.asarray(faces, "<u4"), np.asarray(p, "<f4"), colors]
    views: list[dict[str, int]] = []
    at = 0
    for part in parts:
        views.append({"buffer": 0, "byteOffset": at, "byteLength": part.nbytes})
        at += part.nbytes
    primitive = {"attributes": {"POSITION": 1, "COLOR_0": 2}, "indices": 0, "mode": 4}
    head = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [primitive | {"material": 0}]}],
        "materials": [_MATT | {"doubleSided": True}],
        "buffers": [{"byteLength": at}],
        "bufferViews": views,
        "accessors": [
            _accessor(0, _UINT32, faces.size, type="SCALAR"),
            _accessor(1, _FLOAT32, len(p), type="VEC3", **_reach(parts[1])),
            _accessor(2, _UINT8, len(p), type="VEC4", normalized=True),
        ],
    }
    text = json.dumps(head, separators=(",", ":")).encode()
    body = b"".join(part.tobytes() for part in parts)  # whole 4 bytes: all its numbers are rows
    chunks = _chunk(b"JSON", text + b" " * (-len(text) % 4)) + _chunk(b"BIN\0", body)
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def _reach(p: np.ndarray) -> dict[str, list[float]]:
    return {"min": p.min(axis=0).tolist(), "max": p.max(axis=0).tolist()}


def _accessor(view: int, component: int, count: int, **more: Any) -> dict[str, Any]:
    return {"bufferView": view, "componentType": component, "count": count, **more}


def _chunk(kind: bytes, content: bytes) -> bytes:
    return struct.pack("<I4s", len(content), kind) + content
