"""Shapes as fields: voxels, and distances with a sign.

- `voxels`: solids as voxels: bits on a regular grid, how large they are, and the surface around
  them.
- `signed_distances`: how far a point is from a surface, negative inside: in closed form, or from
  the triangles of a closed mesh.
"""
