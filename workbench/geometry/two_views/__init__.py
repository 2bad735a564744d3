"""Two pictures of one scene: how they are related, and what follows for depth.

- `epipolar`: relates two views of a rigid scene: the fundamental matrix, its estimates and its
  distances.
- `essential`: the motion between two calibrated cameras, held by the essential matrix up to the
  length of its translation.
- `homography`: relates two images of a plane: the homography, its estimates and its distances.
- `triangulation`: from two pixels to a point: where the rays of two cameras meet, or nearly do,
  and how uncertain that is.
- `rectification`: turns two cameras, where they stand, until rows of their pictures correspond:
  then matches are sought along rows.
"""
