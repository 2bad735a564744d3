"""Runs everything that must hold: lint, format, types, tests. `python -m tests` from the project's root."""

import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
CHECKS = {
    "lint": ["ruff", "check", "."],
    "format": ["ruff", "format", "--check", "."],
    "types": ["pyright", "--pythonpath", sys.executable],
    "tests": ["pytest", "-q", *sys.argv[1:]],
}


def main() -> int:
    """Run all checks, each to its end, and say which failed."""
    failed = []
    for name, command in CHECKS.items():
        began = time.monotonic()
        print(f"== {name}: {' '.join(command)}", flush=True)
        if subprocess.run([sys.executable, "-m", *command], cwd=ROOT).returncode != 0:
            failed.append(name)
        print(f"== {name}: {'failed' if name in failed else 'good'} after {time.monotonic() - began:.0f} s", flush=True)
    print(f"failed: {', '.join(failed)}" if failed else "everything holds", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
