"""Values as plain bytes, for the pipe to a student's process: nothing is unpickled.

A message is 8 bytes of lengths (header, payload), a JSON header that describes the value, and the
payload: the raw bytes of all arrays, in order. Used by both processes, so it imports nothing of
ours.
"""

import json
import struct
from typing import Any

import numpy as np

MOST_BYTES = 64 * 2**20
MOST_HEADER = 4 * 2**20
MOST_PARTS = 100_000
_KINDS = "biuf"
_TYPES = {f"{order}{kind}{size}" for order in "<|" for kind in _KINDS for size in (1, 2, 4, 8)}


class WireError(ValueError):
    """A value that cannot cross the pipe, or bytes that are no message."""


def pack(message: dict[str, Any]) -> bytes:
    """Return the bytes of a message: a dict of None, bools, numbers, text, arrays, lists of these.

    Raises:
        WireError: If a value is of another kind; says which.
    """
    blobs: list[bytes] = []
    header = json.dumps(
        {key: _describe(value, blobs, 0) for key, value in message.items()}
    ).encode()
    payload = b"".join(blobs)
    if len(payload) > MOST_BYTES or len(header) > MOST_HEADER:
        raise WireError(
            f"{len(payload) >> 20} MB is more than the {MOST_BYTES >> 20} MB a result may have"
        )
    return struct.pack("<QQ", len(header), len(payload)) + header + payload


def lengths(start: bytes) -> tuple[int, int]:
    """Return the lengths of header and payload from the first 16 bytes.

    Raises:
        WireError: If they are out of bounds.
    """
    header, payload = struct.unpack("<QQ", start)
    if header > MOST_HEADER or payload > MOST_BYTES:
        raise WireError("the lengths are out of bounds")
    return header, payload


def unpack(header: bytes, payload: bytes) -> dict[str, Any]:
    """Return the message; arrays are plain ndarrays that own their memory.

    Raises:
        WireError: If the bytes are no message.
    """
    try:
        described = json.loads(header)
        if not isinstance(described, dict):
            raise WireError("not a message")
        reader = _Reader(memoryview(payload))
        return {str(key): reader.value(value, 0) for key, value in described.items()}
    except WireError:
        raise
    except (ValueError, TypeError, KeyError, OverflowError, RecursionError, MemoryError) as error:
        raise WireError(f"not a message: {type(error).__name__}") from None


def _describe(value: Any, blobs: list[bytes], depth: int) -> Any:
    if depth > 8 or len(blobs) > MOST_PARTS:
        raise WireError("the value has too many parts")
    kind = type(value)
    if value is None or kind is bool or kind is str:
        return {"v": value}
    if kind is int and abs(value) < 2**63:
        return {"v": value}
    if kind is float:
        return {"f": value.hex()}  # JSON has no NaN
    if isinstance(value, (np.ndarray, np.generic)):
        if value.nbytes > MOST_BYTES:
            raise WireError(
                f"{value.nbytes >> 20} MB is more than the {MOST_BYTES >> 20} MB a result may have"
            )
        array = np.array(value, copy=True, subok=False)  # a subclass leaves its own ideas behind
        if array.dtype == np.longdouble:
            array = array.astype(np.float64)
        if array.dtype.kind not in _KINDS or array.dtype.itemsize > 8:
            raise WireError(f"an array of {array.dtype} cannot be a result; use numbers")
        array = array.astype(array.dtype.newbyteorder("<"))
        blobs.append(array.tobytes())
        return {"a": array.dtype.str, "s": list(array.shape)}
    if isinstance(value, (list, tuple)):
        # a row of numbers is one part
        if value and {float, np.float64}.issuperset(map(type, value)):
            blobs.append(np.array(value, "<f8").tobytes())
            return {"n": len(value)}
        return {"l": [_describe(item, blobs, depth + 1) for item in value]}
    raise WireError(f"a {kind.__name__} cannot cross; return arrays and numbers")


class _Reader:
    def __init__(self, payload: memoryview):
        self._payload = payload
        self._at = 0
        self._parts = 0

    def value(self, described: Any, depth: int) -> Any:
        self._parts += 1
        if depth > 8 or self._parts > MOST_PARTS:
            raise WireError("not a message")
        if "v" in described:
            value = described["v"]
            if value is not None and not isinstance(value, (bool, int, str)):
                raise WireError("not a message")
            return value
        if "f" in described:
            return float.fromhex(described["f"])
        if "l" in described:
            return [self.value(item, depth + 1) for item in described["l"]]
        if "n" in described:
            return self._array("<f8", [described["n"]]).tolist()
        return self._array(described["a"], described["s"])

    def _array(self, of: Any, sizes: Any) -> np.ndarray:
        if of not in _TYPES:
            raise WireError("not a message")
        dtype = np.dtype(of)
        shape = tuple(int(n) for n in sizes)
        if any(n < 0 for n in shape) or len(shape) > 8:
            raise WireError("not a message")
        size = dtype.itemsize
        for n in shape:
            size *= n
        if self._at + size > len(self._payload):
            raise WireError("an array is longer than what came")
        data = bytes(self._payload[self._at : self._at + size])
        self._at += size
        return np.frombuffer(data, dtype).reshape(shape).copy()
