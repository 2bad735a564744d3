"""Transforms: the same motion, many numbers."""
