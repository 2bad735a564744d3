"""The curvature lesson."""
