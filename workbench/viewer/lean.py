"""What viser does anew for every node of a scene, done once or in plain numbers: half of what a moved knob cost."""

import functools
import math
from collections.abc import Callable
from typing import Any, get_type_hints

import numpy as np
from viser import _assignable_props_api, _scene_handles

_hints = functools.cache(get_type_hints)


def make_lean() -> None:
    """Let viser read the types of a kind of node once, and compare equal poses without numpy; what it sends is the same.

    A version of viser that is built otherwise is left as it is.
    """
    base, pose = getattr(_assignable_props_api, "AssignablePropsBase", None), "_set_pose_vector"
    if isinstance(getattr(base, "_prop_hints", None), functools.cached_property):
        base._prop_hints = property(lambda handle: _hints(type(handle._impl.props)))  # type: ignore[union-attr]
    before = getattr(_scene_handles, pose, None)
    if before is not None and before.__module__ == _scene_handles.__name__:
        setattr(_scene_handles, pose, _unless_equal(before))


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
