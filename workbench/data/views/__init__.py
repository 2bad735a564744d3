"""Scenes before cameras, made or people's own, and where pixels of them are known.

- `boards`: A checkerboard before a camera with a lens: seeded poses, what goes wrong with a
  print, and the pixels of its corners.
- `corners`: corners of a board in people's own pictures: read or refused in one clear line, or
  found in the pictures themselves.
- `board_corners`: the corners of a checkerboard in a picture: saddles of brightness, joined to a
  grid square by square, then refined.
- `sightings`: known points and where a camera saw them: made ones, and those that people bring.
- `skyline`: A city in a valley with mountains behind it, seen from a hill: nothing in it is
  nearer than 180 m.
- `street`: A small street to look at with a camera: two rails to the horizon, sleepers, boxes,
  spheres and a house.
- `stereo`: rectified pairs of pictures: made ones whose every disparity is known, the Middlebury
  motorcycle, and people's own.
- `stereo_scenes`: small scenes of textured boards and balls, and the rays that see them: where
  every depth is known exactly.
- `two_views`: two pictures of one scene with matches between them: of a made one, where all is
  known, or from people's files.
"""
