"""What is found again: keypoints, their descriptors in pictures and clouds, and matches.

- `keypoints`: corners of pictures, and salient points of clouds.
- `sift`: SIFT's keypoints of a picture, by scikit-image.
- `fpfh`: fast point feature histograms, which no rigid motion changes.
- `shape_context`: how the rest of an outline lies around each of its points.
- `matching`: which descriptors belong together, and which a filter keeps.
"""
