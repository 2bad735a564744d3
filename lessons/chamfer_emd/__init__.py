"""When two shapes are close, by many numbers."""
