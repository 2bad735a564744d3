"""Static pages: tutorials that play in any browser, without Python."""
