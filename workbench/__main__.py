"""Runs a command: `python -m workbench`, or `workbench` where it is installed."""

import contextlib
import sys


def main() -> int:
    """Carry out the command line and return the exit code."""
    if sys.argv[1:] == ["list"]:  # needs nothing of what the other commands import
        from workbench.listing import listed

        with contextlib.suppress(OSError):  # what cannot be written is told below
            sys.stdout.write(listed())
            sys.stdout.flush()
            return 0
    from workbench.cli import main as carry_out

    return carry_out()


if __name__ == "__main__":
    sys.exit(main())
