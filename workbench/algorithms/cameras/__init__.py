"""Cameras from what they saw.

- `calibration`: K, lens and poses from pictures of a flat board.
- `camera_search`: a camera's pose from three points and a fourth, from a plane, and downhill.
"""
