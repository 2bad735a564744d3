"""Intrinsic Delaunay triangulations: edges flipped until no weight inside is negative.

The surface stays as it is. A flipped edge is the straight line across the two triangles beside it,
unfolded: it bends where the old edge was, so only its length is kept, and no point moves.
Reference: Fisher, Springborn, Schroeder and Bobenko, An algorithm for the construction of intrinsic
Delaunay triangulations with applications to digital geometry processing, Computing 81, 2007;
Bobenko and Springborn, A discrete Laplace-Beltrami operator for simplicial surfaces, 2007, which
shows that the flips come to an end.
"""

from dataclasses import replace
from math import acos, cos, sqrt

import numpy as np
from jaxtyping import Float, Int

from workbench.geometry.meshes.triangles import Corners, corners

Points = Float[np.ndarray, "v 3"]
Faces = Int[np.ndarray, "f 3"]
# how far the two angles may be above pi together, radians: so that rounding flips nothing for ever
STRAIGHT = 1e-9


def intrinsic_delaunay(p: Points, faces: Faces) -> Corners:
    """Return the corners of the intrinsic Delaunay triangulation, each triangle laid out flat.

    Angles opposite an edge inside are at most pi together; an edge of the border may keep a
    negative weight. Two vertices may be joined twice, and one with itself.
    """
    sides = _Sides(p, faces)
    waiting = sides.bent()
    while waiting:
        h = waiting.pop()
        if sides.bends(h):
            waiting.extend(sides.flip(h))
    return sides.measured(len(p))


class _Sides:
    """The sides of triangles, three each: start, next side of the triangle, other half (-1 on the
    border), length.
    """

    def __init__(self, p: np.ndarray, faces: np.ndarray) -> None:
        self.start = faces.ravel().tolist()
        self.next = np.arange(faces.size).reshape(-1, 3)[:, [1, 2, 0]].ravel().tolist()
        ends = np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2)
        place = {(a, b): h for h, (a, b) in enumerate(ends.tolist())}
        self.twin = [place.get((b, a), -1) for a, b in ends.tolist()]
        self.length = np.linalg.norm(p[ends[:, 1]] - p[ends[:, 0]], axis=1).tolist()

    def bent(self) -> list[int]:
        """Return the sides whose edges bend, all looked at together."""
        after = np.array(self.length).reshape(-1, 3)
        opposite, before = np.roll(after, -1, axis=1), np.roll(after, -2, axis=1)
        beside = 2 * after * before
        cosine = (after**2 + before**2 - opposite**2) / np.where(beside > 0, beside, 1.0)
        angle = np.where(beside > 0, np.arccos(np.clip(cosine, -1, 1)), 0.0)
        across = np.roll(angle, -2, axis=1).ravel()  # of each side the angle opposite it
        twin = np.array(self.twin)
        return np.flatnonzero((twin >= 0) & (across + across[twin] > np.pi + STRAIGHT)).tolist()

    def bends(self, h: int) -> bool:
        """Return whether the angles opposite a side's edge are more than pi together."""
        t = self.twin[h]
        after = self.next
        return (
            t >= 0
            and self._angle(after[after[h]]) + self._angle(after[after[t]]) > np.pi + STRAIGHT
        )

    def _angle(self, h: int) -> float:
        """Return the angle where a side begins, radians."""
        ahead = self.next[h]
        after = self.length[h]
        opposite = self.length[ahead]
        before = self.length[self.next[ahead]]
        if after * before == 0:
            return 0.0
        return acos(
            min(1.0, max(-1.0, (after**2 + before**2 - opposite**2) / (2 * after * before)))
        )

    def flip(self, h: int) -> tuple[int, ...]:
        """Put the other diagonal in an edge's place; return the sides round the two triangles.

        With the edge from a to b, c opposite it and d beyond: abc and bad become dca and cdb.
        """
        t = self.twin[h]
        after = self.next
        bc = after[h]
        ca = after[after[h]]
        ad = after[t]
        db = after[after[t]]
        long, wide = self.length[ca], self.length[ad]
        turn = self._angle(h) + self._angle(ad)
        diagonal = sqrt(max(long**2 + wide**2 - 2 * long * wide * cos(turn), 0.0))
        c, d = self.start[ca], self.start[db]
        # from where to where the four sides round the edge go
        moved = {ca: bc, ad: ca, db: ad, bc: db}
        old = {side: (self.start[side], self.length[side], self.twin[side]) for side in moved}
        for side, place in moved.items():
            self.start[place], self.length[place], other = old[side]
            self.twin[place] = moved.get(other, other)
            if other >= 0 and other not in moved:
                self.twin[other] = place
        self.start[h], self.start[t] = d, c
        self.length[h] = self.length[t] = diagonal
        return tuple(moved)

    def measured(self, count: int) -> Corners:
        """Return the corners of the triangles as they are now, each laid out flat."""
        ab, bc, ca = np.array(self.length).reshape(-1, 3).T
        x = np.divide(ab**2 + ca**2 - bc**2, 2 * ab, out=np.zeros_like(ab), where=ab > 0)
        y = np.sqrt(np.maximum(ca**2 - x**2, 0.0))
        flat = np.zeros((len(ab), 3, 3))
        flat[:, 1, 0] = ab
        flat[:, 2, 0] = x
        flat[:, 2, 1] = y
        laid_out = corners(flat.reshape(-1, 3), np.arange(3 * len(ab)).reshape(-1, 3))
        return replace(laid_out, vertices=np.array(self.start).reshape(-1, 3).T.copy(), count=count)
