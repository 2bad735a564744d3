"""Clouds whose points come and go: all points of a run are said once, per step which are there.

A cloud that gains and loses points would be said again and again, 16 bytes a point. The union of
all steps, in the order in which its points come and go, takes no more than a few times one step;
which are there is a size per point, zero or not, that compresses to almost nothing.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import rerun as rr

from workbench.recording.spatial import Aspect, affine, pose
from workbench.scene import Points, Scene

WORTH = 0.5
"""A union is taken where it has at most this share of all points that would be said."""
MOST, MOST_SAID = 24_000, 1_200_000
"""A union of more points, or of which more would be said in all steps together, is thinned at
random, and each point drawn larger: a recording has to stay small.
"""


@dataclass(frozen=True, eq=False)
class Union:
    """All points of a cloud over a run.

    Attributes:
        p: Each of them, (u, 3) float32.
        colors: (u, 3) uint8.
        shown: Which are there, (u,) bool, by the identity of the primitive.
        swell: How many times larger than live each is drawn, since it stands for others too.
    """

    p: np.ndarray
    colors: np.ndarray
    shown: Mapping[int, np.ndarray]
    swell: float


def unions(scenes: Sequence[Scene]) -> dict[str, Union]:
    """Return the clouds of measured colours that are worth it, by path."""
    clouds: dict[str, dict[int, Points]] = {}
    for scene in scenes:
        for path, primitive in scene.items():
            if isinstance(primitive, Points) and isinstance(primitive.color, np.ndarray):
                clouds.setdefault(path, {})[id(primitive)] = primitive
    merged = {
        path: _union(list(group.values())) for path, group in clouds.items() if len(group) > 2
    }
    return {path: union for path, union in merged.items() if union is not None}


def _union(clouds: Sequence[Points]) -> Union | None:
    p = np.concatenate([affine(cloud).p.astype(np.float32) for cloud in clouds])
    colors = np.concatenate([np.asarray(cloud.color) for cloud in clouds])
    cloud_of = np.repeat(np.arange(len(clouds)), [len(cloud.p) for cloud in clouds])
    rows = np.column_stack([np.ascontiguousarray(p).view(np.uint32), colors]).astype(np.uint64)
    mixed = np.zeros(len(rows), np.uint64)
    for column in rows.T:
        mixed = (mixed ^ column) * np.uint64(0x9E3779B97F4A7C15)
        mixed ^= mixed >> np.uint64(29)
    keys, first, number = np.unique(mixed, return_index=True, return_inverse=True)
    # two points, one key
    if len(first) > WORTH * len(rows) or not np.array_equal(rows[first][number], rows):
        return None
    last = np.zeros(len(first), int)
    last[number] = cloud_of  # the last one counts
    kept = np.argsort(keys * np.uint64(0xD6E8FEB86659FD93))[: min(MOST, MOST_SAID // len(clouds))]
    kept = kept[np.lexsort((last[kept], cloud_of[first[kept]]))]
    present = np.zeros((len(clouds), len(first)), bool)
    present[cloud_of, number] = True
    shown = {id(cloud): present[i, kept] for i, cloud in enumerate(clouds)}
    return Union(p[first[kept]], colors[first[kept]], shown, float(np.sqrt(len(first) / len(kept))))


def gathered(cloud: Points, union: Union) -> Iterator[Aspect]:
    """Return the aspects of a cloud that is part of a union."""
    radii = np.where(union.shown[id(cloud)], cloud.radius * union.swell, 0.0).astype(np.float32)
    yield Aspect(
        rr.Points3D.from_fields,
        {"positions": union.p, "colors": union.colors, "show_labels": False},
    )
    yield Aspect(rr.Points3D.from_fields, {"radii": radii})
    yield pose(affine(cloud).T_world_object)
