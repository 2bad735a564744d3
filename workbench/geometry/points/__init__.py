"""Clouds of points: normals, samples, and how far two of them are apart.

- `normals`: normals by the least spread of each point's neighbours.
- `sampling`: points and lines drawn by chance, volumes by hits, areas by crossings.
- `shape_distances`: distances between two clouds by nearest points.
- `nearest`: a tree that finds nearest points, and what a cloud must be.
- `metrics`: distances between points, the scatter for Mahalanobis, rms.
"""
