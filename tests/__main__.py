"""Runs everything that must hold: lint, format, types, tests. `python -m tests` from the project's root.

The types are checked while the tests run. Words behind `python -m tests` are pytest's.
"""

import os
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
BESIDE = ("types",)  # runs in what time the others leave; its output comes at the end


def main() -> int:
    """Run all checks, each to its end, and say which failed."""
    began = time.monotonic()
    failed: list[str] = []

    def ended(name: str, code: int) -> None:
        if code != 0:
            failed.append(name)
        print(f"== {name}: {'failed' if code else 'good'} after {time.monotonic() - began:.0f} s", flush=True)

    beside = {name: started_beside(name) for name in BESIDE}
    try:
        for name, command in CHECKS.items():
            if name not in beside:
                print(f"== {name}: {' '.join(command)}", flush=True)
                ended(name, subprocess.run([sys.executable, "-m", *command], cwd=ROOT).returncode)
        for name, process in beside.items():
            print(f"== {name}: {' '.join(CHECKS[name])}", flush=True)
            print(process.communicate()[0], end="")
            ended(name, process.returncode)
    finally:
        for process in beside.values():
            process.kill()  # where the tests were interrupted
    print(f"failed: {', '.join(failed)}" if failed else "everything holds", flush=True)
    return 1 if failed else 0


def started_beside(name: str) -> subprocess.Popen:
    """Start a check that gives way to the others, where the system knows such a thing."""
    yielding = getattr(os, "nice", None)
    return subprocess.Popen(
        [sys.executable, "-m", *CHECKS[name]],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        text=True,
        preexec_fn=(lambda: yielding(15)) if yielding else None,
    )


if __name__ == "__main__":
    sys.exit(main())
