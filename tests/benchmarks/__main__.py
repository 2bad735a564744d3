"""Runs all benchmarks and writes a page of what they print, with the machine: `python -m
tests.benchmarks --write FILE`.

    python -m tests.benchmarks                        # print the page
    python -m tests.benchmarks --only icp stereo      # some of them
    python -m tests.benchmarks --write docs/speed.md

Each benchmark runs in a process of its own, one after the other. The page says how busy the machine
was.
"""

import argparse
import datetime
import importlib.metadata
import os
import platform
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

FOLDER = Path(__file__).parent
ROOT = FOLDER.parents[1]
OURS = ("numpy", "scipy", "viser", "rerun-sdk", "trimesh", "scikit-image")
PEERS = (
    "open3d",
    "small-gicp",
    "opencv-python-headless",
    "opencv-python",
    "libigl",
    "pyvista",
    "lapy",
    "pot",
    "pykdtree",
    "poselib",
    "pycolmap",
    "scikit-fmm",
    "potpourri3d",
    "geomdl",
    "circle-fit",
    "scikit-learn",
    "astropy",
    "pyproj",
)
LONGEST = 1800.0
"""Seconds until a benchmark is given up."""


@dataclass(frozen=True, kw_only=True)
class Ran:
    """One benchmark: its name, what it measures, what it printed, its seconds, and the load before
    it.
    """

    name: str
    about: str
    said: str
    seconds: float
    busy: float


def main() -> int:
    """Run the benchmarks and print or write the page."""
    parser = argparse.ArgumentParser(
        prog="python -m tests.benchmarks", description="Run all benchmarks, one after the other."
    )
    parser.add_argument(
        "--write", type=Path, metavar="FILE", help="write the page instead of printing it"
    )
    parser.add_argument(
        "--only", nargs="+", metavar="NAME", choices=names(), help="of " + ", ".join(names())
    )
    given = parser.parse_args()
    ran = []
    for name in given.only or names():
        print(f"{name} ...", file=sys.stderr, flush=True)
        ran.append(measured(name))
    text = page(ran)
    if given.write:
        given.write.write_text(text, encoding="utf-8")
    else:
        print(text)
    return 0


def names() -> list[str]:
    """Return the names of the benchmarks."""
    return sorted(path.stem.removeprefix("bench_") for path in FOLDER.glob("bench_*.py"))


def measured(name: str) -> Ran:
    """Run one benchmark to its end."""
    module = f"tests.benchmarks.bench_{name}"
    about = next(
        line
        for line in (FOLDER / f"bench_{name}.py").read_text(encoding="utf-8").splitlines()
        if line
    )
    busy, began = load(), time.monotonic()
    try:
        done = subprocess.run(
            [sys.executable, "-m", module],
            cwd=ROOT,
            capture_output=True,
            text=True,
            timeout=LONGEST,
        )
        said = (
            done.stdout
            if done.returncode == 0
            else f"{done.stdout}failed: {done.stderr.strip().splitlines()[-1]}"
        )
    except subprocess.TimeoutExpired:
        said = f"given up after {LONGEST:.0f} s"
    return Ran(
        name=name,
        about=about.strip('"'),
        said=said.strip("\n"),
        seconds=time.monotonic() - began,
        busy=busy,
    )


def page(ran: list[Ran]) -> str:
    """Return the page in Markdown."""
    at = datetime.datetime.now(datetime.UTC).date()
    lines = [
        "# Speed",
        "",
        (
            "Written by `python -m tests.benchmarks --write docs/speed.md`; do not edit. Compare"
            " ratios taken in one run:"
        ),
        (
            "absolute times change with the machine and with what else it does. Peers that are not"
            " installed are left out."
        ),
        (
            "A ratio is ours over the best peer, below 1 where ours is the faster; a floor is the"
            " ratio that a prototype in"
        ),
        (
            "numpy and scipy reached or, where a sentence beside it says so, the ratio of those"
            " calls that ours cannot"
        ),
        "spare, measured in the same run.",
        "",
        "| | |",
        "|---|---|",
        f"| measured | {at} |",
        (
            f"| machine | {processor()}, {os.cpu_count()} cores, {platform.system()}"
            f" {platform.machine()} |"
        ),
        f"| python | {platform.python_version()} |",
        f"| packages | {versions(OURS)} |",
        f"| peers | {versions(PEERS) or 'none installed'} |",
        f"| load of other work | {quiet(ran)} |",
    ]
    for one in ran:
        lines += ["", f"## {one.name.replace('_', ' ').capitalize()}", "", one.about]
        lines += ["", "```text", *(line.rstrip() for line in one.said.splitlines()), "```", ""]
        lines += [f"Took {one.seconds:.0f} s; load before it {one.busy:.1f}."]
    return "\n".join(lines) + "\n"


def quiet(ran: list[Ran]) -> str:
    """Return in words how busy the machine was before each benchmark began; those before count for
    a minute.
    """
    most = max(one.busy for one in ran)
    share = most / (os.cpu_count() or 1)
    word = "quiet" if share < 0.6 else "busy: times are upper bounds, trust ratios only"
    return (
        f"{ran[0].busy:.1f} before the first benchmark, {most:.1f} at most before a later one"
        f" ({word})"
    )


def load() -> float:
    """Return the mean number of processes that wanted a core during the last minute; NaN where that
    is not known.
    """
    return os.getloadavg()[0] if hasattr(os, "getloadavg") else float("nan")


def processor() -> str:
    """Return what the system calls its processor."""
    described = Path("/proc/cpuinfo")
    if described.exists():
        for line in described.read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or "unknown processor"


def versions(packages: tuple[str, ...]) -> str:
    """Return the versions of those that are installed."""
    found = []
    for package in packages:
        try:
            found.append(f"{package} {importlib.metadata.version(package)}")
        except importlib.metadata.PackageNotFoundError:
            continue
    return ", ".join(found)


if __name__ == "__main__":
    sys.exit(main())
