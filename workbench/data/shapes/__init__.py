"""Made shapes and scans of them. Metres, +Z up.

- `clouds`: seeded clouds for registration, and scans of them.
- `rabbit`: the course's shape without any symmetry.
- `surfaces`: meshes of surfaces whose curvature is known in closed form.
- `solids`: small closed solids whose left and right, front and back can be told apart.
- `lidar`: rings of a spinning scanner on a street, from two places.
"""
