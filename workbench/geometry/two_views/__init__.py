"""Two pictures of one scene: how they are related, and what follows for depth.

- `epipolar`: the fundamental matrix, its estimates and its distances.
- `essential`: the motion between two calibrated cameras, up to its length.
- `homography`: two images of a plane: the homography, its estimates and distances.
- `triangulation`: where the rays of two cameras meet, and how uncertain that is.
- `rectification`: turns two cameras until rows of their pictures correspond.
"""
