"""Lines, circles, cylinders, curves, the globe: shapes of few numbers, and fits of them.

- `lines_planes`: lines and planes: from the fewest points, from many, distances to them.
- `circles_spheres`: circles and spheres: from the fewest points, from many, distances to them.
- `cylinders`: distances of points from cylinders, and their derivatives.
- `algebraic_fits`: circles in closed form, by Kåsa, Pratt, Taubin, and Hyper.
- `bezier`: Bezier patches, polynomial or rational.
- `curvilinear`: cylindrical and spherical coordinates, and what a cell of them holds.
- `globe`: places by latitude and longitude on a sphere or a flattened one.
- `projective`: points and lines of the plane in homogeneous coordinates.
"""
