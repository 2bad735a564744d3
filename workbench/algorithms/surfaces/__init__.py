"""On surfaces: curvature, distances along them, area and volume.

- `curvature`: curvature of a mesh, one quantity after the other: what each step measures, at one
  vertex and at all of them.
- `heat_method`: geodesic distance by heat: let it flow for a short time, keep only its direction,
  and find the function that rises so.
- `fast_marching`: fast marching on a square grid: a front that leaves the source and accepts
  nodes in the order of their distance.
- `measures`: area and volume as sums over the faces of a mesh, or over the cells of ever finer
  grids.
- `monte_carlo`: volume, area and samples by chance: points thrown into a box, lines through
  space, points on a surface.
"""
