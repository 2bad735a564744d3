"""Scenes before cameras, made or people's own, and where pixels of them are known.

- `boards`: a checkerboard before a camera: seeded poses, faulty prints, corners.
- `corners`: corners of a board in people's own pictures.
- `board_corners`: finds the corners of a checkerboard in a picture.
- `sightings`: known points and where a camera saw them.
- `skyline`: a city with mountains behind it, nothing nearer than 180 m.
- `street`: rails to the horizon, sleepers, boxes, spheres and a house.
- `stereo`: rectified pairs: made ones, the Middlebury motorcycle, and people's own.
- `stereo_scenes`: textured boards and balls whose every depth is known.
- `two_views`: two pictures of one scene with matches between them.
"""
