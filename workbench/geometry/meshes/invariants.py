"""What a map leaves as it was, measured on a mesh: lengths, angles, area, volume, parallels.

Nothing is concluded from the matrix: which measures survive is what tells a rigid motion from a
similarity, an affine or a projective map.
Reference: Hartley and Zisserman, Multiple View Geometry, 2nd ed., table 3.2.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from workbench.geometry.meshes.measures import signed_volume, surface_area
from workbench.geometry.meshes.triangles import boundary_edges, edges, face_angles

MOST_EDGES = 64  # compared with each other for being parallel


@dataclass(frozen=True, eq=False)
class Measures:
    """The measures of a mesh; volume is NaN if open, negative if inside out, `directions` unit."""

    lengths: Float[np.ndarray, "e"]
    angles: Float[np.ndarray, "f 3"]
    area: float
    volume: float
    directions: Float[np.ndarray, "d 3"]


@dataclass(frozen=True)
class Change:
    """One measure before and after.

    `amount` is 0 where nothing changed: the largest relative change of a length, area or volume, or
    the largest change of an angle, radians; for the orientation 1 means that it flipped. `factor`
    is what an area or volume was multiplied by, NaN for measures that are more than one number.
    """

    name: str
    amount: float
    unit: str = ""
    factor: float = float("nan")

    @property
    def kept(self) -> bool:
        """Whether it survived, up to rounding."""
        return self.amount < 1e-9


def measure(p: Float[np.ndarray, "v 3"], faces: Int[np.ndarray, "f 3"]) -> Measures:
    """Return the measures of a mesh whose faces are counter-clockwise seen from outside."""
    a, b = edges(faces).T
    v = p[b] - p[a]
    lengths = np.linalg.norm(v, axis=1)
    volume = signed_volume(p, faces) if len(boundary_edges(faces)) == 0 else np.nan
    few = slice(0, MOST_EDGES)
    directions = v[few] / np.where(lengths[few] > 0, lengths[few], 1.0)[:, None]
    return Measures(lengths, face_angles(p, faces), surface_area(p, faces), volume, directions)


def changes(before: Measures, after: Measures) -> tuple[Change, ...]:
    """Return what became of each measure; volume and orientation are left out for an open mesh."""
    angle = float(np.abs(after.angles - before.angles).max())
    stretch = np.abs(after.lengths - before.lengths) / np.where(
        before.lengths > 0, before.lengths, 1.0
    )
    per_measure = [
        Change("edge lengths", float(stretch.max())),
        Change("angles", angle, "rad"),
        Change("parallel edges", _spread(before.directions, after.directions), "rad"),
        _scaled("area", after.area / before.area),
    ]
    if np.isfinite(before.volume):
        per_measure.append(_scaled("volume", abs(after.volume / before.volume)))
        per_measure.append(
            Change("orientation", float(np.sign(before.volume) != np.sign(after.volume)))
        )
    return tuple(per_measure)


def _scaled(name: str, factor: float) -> Change:
    return Change(name, abs(factor - 1.0), factor=factor)


def _spread(before: np.ndarray, after: np.ndarray) -> float:
    """Return the largest angle between two edges that were parallel before."""
    i, j = np.triu_indices(len(before), 1)
    parallel = np.linalg.norm(np.cross(before[i], before[j]), axis=1) < 1e-9
    apart = np.linalg.norm(np.cross(after[i[parallel]], after[j[parallel]]), axis=1)
    return float(np.arcsin(np.clip(apart, 0.0, 1.0)).max(initial=0.0))
