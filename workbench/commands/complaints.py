"""Lines on stderr, for what is wrong."""

import sys

from workbench.errors import one_line


def complain(line: str) -> None:
    """Write one line to stderr, after the program's name."""
    sys.stderr.write(f"workbench: {one_line(line)}\n")
