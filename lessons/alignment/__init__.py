"""The lesson on the frame that a cloud carries, and on the frame that pairs give."""
