"""Pairs of points, and the motion that fits them best."""
