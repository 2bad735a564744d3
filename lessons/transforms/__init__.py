"""Transforms: a matrix says where the axes go."""
