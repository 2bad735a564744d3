"""On surfaces: curvature, distances along them, area and volume.

- `curvature`: what each step of measuring curvature gives, at one vertex and at all.
- `heat_method`: geodesic distance by heat.
- `fast_marching`: a front on a square grid that accepts nodes in the order of their distance.
- `measures`: area and volume as sums over faces, or over the cells of ever finer grids.
- `monte_carlo`: volume, area and samples by chance.
"""
