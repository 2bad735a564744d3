"""Runs a command: `python -m workbench`, or `workbench` where it is installed."""

import contextlib
import sys
import warnings
from typing import Any

from workbench.machinery.threads import one_each


def main() -> int:
    """Carry out the command line and return the exit code."""
    one_each()
    with warnings.catch_warnings():
        _tell_in_one_line()
        return _carry_out()


def _carry_out() -> int:
    if sys.argv[1:] == ["list"]:  # needs nothing of what the other commands import
        from workbench.run.listing import listed

        with contextlib.suppress(OSError):  # what cannot be written is told below
            sys.stdout.write(listed())
            sys.stdout.flush()
            return 0
    from workbench.cli import main as carry_out
    from workbench.machinery.memory import keep_freed

    keep_freed()
    return carry_out()


def _tell_in_one_line() -> None:
    """Let what is left out be told like everything else the commands tell, without Python's file
    and line.
    """
    from workbench.errors import LeftOutWarning

    otherwise = warnings.showwarning

    def show(message: Warning | str, category: type[Warning], *where: Any, **more: Any) -> None:
        if issubclass(category, LeftOutWarning):
            sys.stderr.write(f"workbench: {message}\n")
        else:
            otherwise(message, category, *where, **more)

    warnings.showwarning = show


if __name__ == "__main__":
    sys.exit(main())
