"""Where a camera was that saw known points."""
