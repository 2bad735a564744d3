"""Clouds of points: normals, samples, and how far two of them are apart.

- `normals`: normals of a point cloud: the direction of least spread of each point's neighbours.
- `sampling`: points and lines drawn by chance, and what can be counted with them: volumes by
  hits, areas by crossings.
- `shape_distances`: distances between two clouds that match each point to the nearest of the
  other cloud, each by its full name.
- `metrics`: distances between points of a space, among them some that are no metrics; the scatter
  that Mahalanobis' is made of; rms.
"""
