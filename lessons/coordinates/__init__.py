"""Coordinates name points: where names fail, and what homogeneous ones buy."""
