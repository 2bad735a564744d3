"""Runs all benchmarks and writes a page of what they print, with the machine: `python -m
tests.benchmarks --write FILE`.

    python -m tests.benchmarks                        # print the page
    python -m tests.benchmarks --only icp stereo      # some of them
    python -m tests.benchmarks --write docs/speed.md
    python -m tests.benchmarks --write docs/speed.md --only icp    # what else stands there stays

Each benchmark runs in a process of its own, one after the other. The page says of each when it ran
and how busy the machine was; it is written anew after each.
"""

import argparse
import ast
import datetime
import importlib.metadata
import os
import platform
import re
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from workbench.machinery.atomic import write_places

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

    @property
    def section(self) -> str:
        """What the page says of it, in Markdown."""
        text = "\n".join(line.rstrip() for line in self.said.splitlines())
        at = datetime.datetime.now(datetime.UTC).date()
        load = f"load before it {self.busy:.1f}{busyness(self.busy)}"
        took = f"Took {self.seconds:.0f} s on {at}; {load}."
        return f"{self.about}\n\n```text\n{text}\n```\n\n{took}\n"


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
    sections: dict[str, str] = {}
    if given.write is not None and given.write.exists():
        sections = sections_of(given.write.read_text(encoding="utf-8"))
    for name in given.only or names():
        print(f"{name} ...", file=sys.stderr, flush=True)
        sections[title(name)] = measured(name).section
        if given.write:
            write_places({given.write: page(sections).encode()})
    if not given.write:
        print(page(sections))
    return 0


def title(name: str) -> str:
    """Return the heading of a benchmark."""
    return name.replace("_", " ").capitalize()


def sections_of(text: str) -> dict[str, str]:
    """Return the sections of a page by their headings, those of benchmarks that are no more left
    out.
    """
    _, *rest = re.split(r"^## (.*)\n\n", text, flags=re.MULTILINE)
    known = {title(name) for name in names()}
    pairs = zip(rest[::2], rest[1::2], strict=True)
    return {head: f"{body.rstrip()}\n" for head, body in pairs if head in known}


def names() -> list[str]:
    """Return the names of the benchmarks."""
    return sorted(path.stem.removeprefix("bench_") for path in FOLDER.glob("bench_*.py"))


def measured(name: str) -> Ran:
    """Run one benchmark to its end."""
    module = f"tests.benchmarks.bench_{name}"
    source = (FOLDER / f"bench_{name}.py").read_text(encoding="utf-8")
    docstring = ast.get_docstring(ast.parse(source)) or ""
    about = " ".join(docstring.partition("\n\n")[0].split())
    busy = load()
    began = time.monotonic()
    try:
        done = subprocess.run(
            [sys.executable, "-m", module],
            cwd=ROOT,
            capture_output=True,
            text=True,
            timeout=LONGEST,
        )
        output = (
            done.stdout
            if done.returncode == 0
            else f"{done.stdout}failed: {(done.stderr.strip().splitlines() or ['killed'])[-1]}"
        )
    except subprocess.TimeoutExpired:
        output = f"given up after {LONGEST:.0f} s"
    return Ran(
        name=name,
        about=about,
        said=output.strip("\n"),
        seconds=time.monotonic() - began,
        busy=busy,
    )


def page(sections: dict[str, str]) -> str:
    """Return the page in Markdown."""
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
        (
            f"| machine | {processor()}, {os.cpu_count()} cores, {platform.system()}"
            f" {platform.machine()} |"
        ),
        f"| python | {platform.python_version()} |",
        f"| packages | {versions(OURS)} |",
        f"| peers, for the section written last | {versions(PEERS) or 'none installed'} |",
    ]
    for head in sorted(sections):
        lines += ["", f"## {head}", "", sections[head].rstrip()]
    return "\n".join(lines) + "\n"


def busyness(load: float) -> str:
    """Return what a load before a benchmark means for its times."""
    share = load / (os.cpu_count() or 1)
    return "" if share < 0.6 else " (busy: times are upper bounds, trust ratios only)"


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
    installed = []
    for package in packages:
        try:
            installed.append(f"{package} {importlib.metadata.version(package)}")
        except importlib.metadata.PackageNotFoundError:
            continue
    return ", ".join(installed)


if __name__ == "__main__":
    sys.exit(main())
