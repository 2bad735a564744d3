"""Cameras from what they saw: calibration, and the search for a pose.

- `calibration`: calibrates a camera from pictures of a flat board: a homography each, K and poses
  in closed form, then all together.
- `camera_search`: where was the camera, step by step: three points and a fourth, a plane's two
  answers, and Gauss-Newton downhill.
"""
