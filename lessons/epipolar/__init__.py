"""Epipolar geometry: one point, one line; and from many points the motion between two cameras."""
