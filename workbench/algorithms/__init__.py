"""Methods with steps: every one is a generator of frozen states."""
