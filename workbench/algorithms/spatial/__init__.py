"""Trees over space.

- `kd_tree`: points cut in halves at the median, and the nearest one found in them.
- `octree`: a solid; only cells that the surface may cross are cut in eight.
"""
