"""Runs a command: `python -m workbench`, or `workbench` where it is installed."""

import sys

from workbench.cli import main

if __name__ == "__main__":
    sys.exit(main())
