"""Fitting: walk down the sum of squares."""
