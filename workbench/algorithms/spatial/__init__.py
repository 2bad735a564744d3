"""Trees over space.

- `kd_tree`: A k-d tree: points cut in halves at the median, along the longest side of their box,
  and the nearest one found in it.
- `octree`: an octree of a solid: only cells that the surface may cross are cut in eight.
"""
