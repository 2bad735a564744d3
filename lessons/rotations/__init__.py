"""Rotations: one turn, many names."""
