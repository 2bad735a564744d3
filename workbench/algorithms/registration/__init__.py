"""Registration: the motion between two clouds, and its parts.

- `icp`: iterative closest point.
- `procrustes`: the similarity that fits pairs best, in the steps of its formula.
- `jacobi`: Jacobi's eigenvalue method, one rotation after the other.
"""
