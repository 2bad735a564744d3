"""Shapes as fields: voxels, and distances with a sign.

- `voxels`: bits on a regular grid, how large solids are, and the surface around them.
- `signed_distances`: distances to a surface, negative inside: closed forms and meshes.
"""
