"""Lines, circles, cylinders, curves, the globe: shapes of few numbers, and fits of them.

- `lines_planes`: lines in the plane and planes in space: from the fewest points, from many, and
  how far points are from them.
- `circles_spheres`: circles in the plane and spheres in space: from the fewest points, from many,
  and how far points are from them.
- `cylinders`: cylinders in space: how far points are from them, and how these distances change
  with the five numbers that matter.
- `algebraic_fits`: circles in closed form: the algebraic fits of Kåsa, Pratt, Taubin and Al-
  Sharadqah and Chernov, for many sets at once.
- `bezier`: bezier patches: points on them by Bernstein polynomials or by de Casteljau's repeated
  halving, polynomial or rational.
- `curvilinear`: points of space in cylindrical and spherical coordinates, and back, with what a
  cell of them holds.
- `globe`: places on a globe by latitude and longitude: distances, ways and means on a sphere, and
  latitudes of a flattened one.
- `projective`: points and lines of the plane in homogeneous coordinates: where lines meet, which
  line joins points, what maps keep.
"""
