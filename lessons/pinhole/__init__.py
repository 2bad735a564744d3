"""The pinhole camera: from a point in the world to a pixel, and back to a ray."""
