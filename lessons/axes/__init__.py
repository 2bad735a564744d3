"""The lesson on the frame that a cloud carries."""
