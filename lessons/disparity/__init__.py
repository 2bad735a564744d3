"""Disparity: depth from two eyes."""
