"""Runs everything that must hold: lint, format, types, tests. `python -m tests` from the project's
root.

The types are checked while the tests run. Words behind `python -m tests` are pytest's. A few tests
that fail are run once more by themselves: on a machine that is busy with other work one may fail
for it. Which did is told at the end, and a test that is named there often has a defect of its own.
"""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

from workbench.machinery.memory import keep_freed

ROOT = Path(__file__).resolve().parents[1]
CHECKS = {
    "lint": ["ruff", "check", "."],
    "format": ["ruff", "format", "--check", "."],
    "types": ["pyright", "--pythonpath", sys.executable],
    "tests": ["pytest", "-q", *sys.argv[1:]],
}
ONCE_MORE = ["pytest", "-q", "-n0", "--last-failed", "--last-failed-no-failures=none"]
NOTED = ROOT / ".pytest_cache" / "v" / "cache" / "lastfailed"
SOME_FAILED = 1  # pytest's exit code
FEW = 10  # more that fail are no accident
KEEPS_BYTECODE = {"PYTHONDONTWRITEBYTECODE": ""}
"""A run starts some thousand processes: without it each compiles the workbench anew."""
COMPILED = ROOT / "tests" / "__pycache__"
COMPILING = ["pytest", "-qqq", "-n0", "--collect-only", "--no-summary", "--no-header"]
"""In a new clone, once for all workers: each would compile what pytest makes of the tests."""
BESIDE = ("types",)  # runs in what time the others leave; its output comes at the end
ROOMY = {"NODE_OPTIONS": "--max-semi-space-size=128"}
"""For what runs in Node: with so many megabytes for new things it collects garbage less often."""


def main() -> int:
    """Run all checks, each to its end, and say which failed."""
    os.environ |= KEEPS_BYTECODE
    keep_freed()
    began = time.monotonic()
    # a shell starts what runs in its background deaf to it
    signal.signal(signal.SIGINT, signal.default_int_handler)
    failed: list[str] = []
    unsteady: list[str] = []

    def ended(name: str, code: int) -> None:
        if code != 0:
            failed.append(name)
        print(
            f"== {name}: {'failed' if code else 'good'} after {time.monotonic() - began:.0f} s",
            flush=True,
        )

    NOTED.unlink(missing_ok=True)  # what failed in an earlier run
    beside = {name: started_beside(name) for name in BESIDE}
    try:
        for name, command in CHECKS.items():
            if name not in beside:
                if name == "tests" and not sys.argv[1:] and not any(COMPILED.glob("*-pytest-*")):
                    subprocess.run(
                        [sys.executable, "-m", *COMPILING], cwd=ROOT, stdout=subprocess.DEVNULL
                    )
                code = ran(name, command)
                if (
                    name == "tests"
                    and code == SOME_FAILED
                    and len(unsteady := last_failed()) <= FEW
                ):
                    code = ran("tests that failed, by themselves", ONCE_MORE)
                ended(name, code)
        for name, process in beside.items():
            print(f"== {name}: {' '.join(CHECKS[name])}", flush=True)
            print(process.communicate()[0], end="")
            ended(name, process.returncode)
    finally:
        for process in beside.values():
            process.kill()  # where the tests were interrupted
    if unsteady and "tests" not in failed:
        print("failed beside the others and held alone:", *unsteady, sep="\n  ")
    print(f"failed: {', '.join(failed)}" if failed else "everything holds", flush=True)
    return 1 if failed else 0


def ran(name: str, command: list[str]) -> int:
    """Run a check with its output in sight; return its exit code."""
    print(f"== {name}: {' '.join(command)}", flush=True)
    return subprocess.run([sys.executable, "-m", *command], cwd=ROOT).returncode


def last_failed() -> list[str]:
    """Return the tests that pytest noted as failed when it last ran."""
    return list(json.loads(NOTED.read_text())) if NOTED.is_file() else []


def started_beside(name: str) -> subprocess.Popen:
    """Start a check that gives way to the others, where the system knows such a thing."""
    yielding = getattr(os, "nice", None)
    return subprocess.Popen(
        [sys.executable, "-m", *CHECKS[name]],
        cwd=ROOT,
        env=ROOMY | os.environ,
        stdout=subprocess.PIPE,
        text=True,
        preexec_fn=(lambda: yielding(5)) if yielding else None,
    )


if __name__ == "__main__":
    sys.exit(main())
