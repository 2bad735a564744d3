"""Registration: the motion between two clouds, and its parts.

- `icp`: iterative closest point: match every source point to its nearest target point, fit a
  motion, repeat.
- `procrustes`: the similarity that fits pairs best, in the steps in which its formula is written:
  centre, SVD, no mirror, scale.
- `jacobi`: jacobi's eigenvalue method: turn the frame in one coordinate plane after the other
  until nothing is left off the diagonal.
"""
