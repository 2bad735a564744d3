"""What is found again: keypoints, their descriptors in pictures and clouds, and matches.

- `keypoints`: places that can be found again: corners of pictures, and salient points of clouds.
- `sift`: SIFT's keypoints of a picture, by scikit-image: places with a size and a direction of
  their own, described along it.
- `fpfh`: fast point feature histograms: how the normals around a point turn, as 33 numbers that
  no rigid motion changes.
- `shape_context`: shape contexts: how the rest of an outline lies around each of its points, in
  log-polar bins.
- `matching`: which descriptors belong together: the nearest, and which of these a filter keeps.
"""
