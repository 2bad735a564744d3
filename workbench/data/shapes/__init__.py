"""Made shapes and scans of them: clouds, meshes, solids.

- `clouds`: seeded synthetic clouds for registration: one shape with no symmetry, one with, one
  that slides, and scans of them.
- `rabbit`: A rabbit of blended ellipsoids, the course's shape without any symmetry: its field,
  points on it, and a mesh of it.
- `surfaces`: triangle meshes of surfaces whose curvature is known in closed form, regular or
  jittered.
- `solids`: small closed solids whose left and right, front and back can be told apart. Metres, +Z
  up, foot at z = 0.
- `lidar`: A seeded lidar pair: rings of a spinning scanner on a street with houses, cars and
  poles, from two places.
"""
