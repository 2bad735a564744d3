"""Pictures and films of runs as files: drawn from the same scenes as a page, without a browser."""
