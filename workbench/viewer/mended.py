"""What viser 1.1 does too dearly or not safely enough for a class: done once, in plain numbers, on its own event loop."""

import asyncio
import functools
import math
from collections.abc import Callable
from typing import Any, get_type_hints

import numpy as np
from viser import _assignable_props_api, _scene_handles
from viser.infra import _async_message_buffer

_hints = functools.cache(get_type_hints)


def mend_viser() -> None:
    """Let viser read the types of a kind of node once, compare equal poses without numpy, and wake its loop on its loop.

    What it sends is the same. A version of viser that is built otherwise is left as it is.
    """
    base, pose = getattr(_assignable_props_api, "AssignablePropsBase", None), "_set_pose_vector"
    if isinstance(getattr(base, "_prop_hints", None), functools.cached_property):
        base._prop_hints = property(lambda handle: _hints(type(handle._impl.props)))  # type: ignore[union-attr]
    before = getattr(_scene_handles, pose, None)
    if before is not None and before.__module__ == _scene_handles.__name__:
        setattr(_scene_handles, pose, _unless_equal(before))
    buffer = getattr(_async_message_buffer, "AsyncMessageBuffer", None)
    made = getattr(buffer, "__init__", None)
    if made is not None and "message_event" in getattr(buffer, "__dataclass_fields__", {}) and not _is_ours(made):
        buffer.__init__ = _with_event_of_its_loop(made)  # type: ignore[union-attr]


class LoopEvent(asyncio.Event):
    """An event that only its own loop sets.

    viser sets it from whatever thread sends something, and then once more from its loop. The first of the two breaks into
    the loop's list of those who wait ("deque mutated during iteration"), or keeps the second from waking anybody.
    """

    def __init__(self, loop: asyncio.AbstractEventLoop):
        super().__init__()
        self._owner = loop

    def set(self) -> None:
        """Set it, where that is safe; elsewhere nothing happens."""
        if asyncio._get_running_loop() is self._owner:
            super().set()


def _is_ours(function: Any) -> bool:
    return getattr(function, "__module__", "") == __name__


def _with_event_of_its_loop(made: Callable[..., None]) -> Callable[..., None]:
    def make(buffer: Any, *args: Any, **more: Any) -> None:
        made(buffer, *args, **more)
        buffer.message_event = LoopEvent(buffer.event_loop)

    return make


def _unless_equal(set_pose: Callable[..., None]) -> Callable[..., None]:
    def set_where_it_differs(current: np.ndarray, value: Any, *more: Any) -> None:
        given = value.tolist() if isinstance(value, np.ndarray) else list(value)
        if given != current.tolist():
            set_pose(current, value, *more)

    return set_where_it_differs


def wxyz_of(R: np.ndarray) -> tuple[float, float, float, float]:
    """Return the unit quaternion of a 3x3 rotation, its largest part positive.

    Reference: S. W. Shepperd, Quaternion from rotation matrix, J. Guidance and Control 1(3), 1978.
    """
    (a, b, c), (d, e, f), (g, h, i) = R.tolist()
    parts = (
        (1 + a + e + i, h - f, c - g, d - b),
        (h - f, 1 + a - e - i, b + d, c + g),
        (c - g, b + d, 1 - a + e - i, f + h),
        (d - b, c + g, f + h, 1 - a - e + i),
    )
    q = max(enumerate(parts), key=lambda part: part[1][part[0]])[1]
    length = math.hypot(*q)
    return q[0] / length, q[1] / length, q[2] / length, q[3] / length
