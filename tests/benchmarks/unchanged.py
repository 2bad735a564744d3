"""Whether a change of the code leaves alone what people get: sites, recordings and grades of a
commit beside those of the working tree.

    python -m tests.benchmarks.unchanged COMMIT                    # all lessons and exercises
    python -m tests.benchmarks.unchanged COMMIT --lesson icp --solutions 2

Each of the two publishes the course with its own code, and grades the same solutions. Every file is
held against the other: its words, then its numbers. The arrays of a run's scenes and the columns of
a recording count as numbers. Two numbers are apart by their difference in the larger of 1 and
themselves. What a page shows of the code is left out: that changed. Exits with 1 where something
differs by more than `--bound`.
"""

import argparse
import base64
import csv
import json
import math
import os
import re
import subprocess
import sys
import tempfile
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import zstandard

from tests.wire.reading import Reader
from workbench.exercise.finding import exercises
from workbench.machinery.memory import keep_freed
from workbench.recording.canonical import tidied

ROOT = Path(__file__).resolve().parents[2]
SOLUTIONS = ROOT / "tests" / "exercise" / "solutions"
NUMBER = re.compile(r"[-−]?\d+(?:[.,]\d+)*(?:e[-+]?\d+)?")
REPLAY = re.compile(r'replay\(("(?:[^"\\]|\\.)*"), (.*)\);\n?', re.DOTALL)
OF_THE_CODE = ("code", "sources", "digest")
"""What a run's data, its steps and a report say of the code."""
MANIFEST = ".published.json"
"""The file of a site with digests of the code."""
SEED = 7
"""What hidden checks are drawn from."""


def main() -> int:
    """Make both, compare them, print a line per lesson and one for the grades."""
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.unchanged")
    parser.add_argument("commit", help="what is compared with, as git names it")
    parser.add_argument("--lesson", nargs="+", default=[], metavar="NAME", help="all by default")
    parser.add_argument(
        "--solutions", type=int, default=4, metavar="N", help="graded of each exercise, at most"
    )
    parser.add_argument("--bound", type=float, default=1e-6, help="how far apart is equal")
    given = parser.parse_args()
    keep_freed()
    with tempfile.TemporaryDirectory(prefix="workbench-unchanged-") as folder:
        work = Path(folder)
        before = checked_out(given.commit, work / "before")
        handed = work / "handed"
        hand_in(handed, given.lesson, given.solutions)
        made = {"before": before, "now": ROOT}
        for name, tree in made.items():
            publish(tree, work / "site" / name, given.lesson)
            grade(tree, handed, work / "grades" / name)
        results = compared(work / "site" / "before", work / "site" / "now")
        results["grades"] = compared_grades(work / "grades" / "before", work / "grades" / "now")
        return told(results, given.bound)


def checked_out(commit: str, folder: Path) -> Path:
    """Return a folder with the files of a commit."""
    folder.mkdir(parents=True)
    packed = subprocess.run(
        ["git", "archive", "--format=tar", commit], cwd=ROOT, stdout=subprocess.PIPE, check=True
    )
    subprocess.run(["tar", "-x"], cwd=folder, input=packed.stdout, check=True)
    return folder


def workbench(tree: Path, *words: str) -> None:
    """Run a command of the workbench as a tree has it."""
    done = subprocess.run(
        [sys.executable, "-m", "workbench", *words],
        cwd=tree,
        env={**os.environ, "PYTHONPATH": str(tree)},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    if done.returncode not in (0, 1 if words[0] == "grade" else 0):
        raise SystemExit(f"{tree.name}: workbench {' '.join(words)}\n{done.stdout}")


def publish(tree: Path, out: Path, lessons: Iterable[str]) -> None:
    """Publish lessons, or the course."""
    out.parent.mkdir(exist_ok=True)
    workbench(tree, "publish", str(out), *(["--lesson", *lessons] if lessons else []))


def hand_in(folder: Path, lessons: Iterable[str], count: int) -> None:
    """Write solutions of every exercise, the first right ones and wrong ones, as students hand them
    in.
    """
    wanted = [
        exercise for exercise in exercises().values() if not lessons or exercise.lesson in lessons
    ]
    for exercise in wanted:
        path = SOLUTIONS / f"{exercise.name}.py"
        source = path.read_text(encoding="utf-8")
        names = re.findall(r"(?m)^(?:def|class) ((?:right|wrong)_\w+)", source)
        for name in [*names[: count // 2], *reversed(names[count // 2 :][-(count - count // 2) :])]:
            of_one = folder / exercise.name
            of_one.mkdir(parents=True, exist_ok=True)
            (of_one / f"{name}.py").write_text(
                f"{source}\n\n{exercise.name} = {name}\n", encoding="utf-8"
            )


def grade(tree: Path, handed: Path, out: Path) -> None:
    """Grade what was handed in, exercise by exercise."""
    for folder in sorted(handed.iterdir()):
        given = ["--only", folder.name, "--seed", str(SEED), "--out", str(out / folder.name)]
        workbench(tree, "grade", str(folder), *given)


def compared(before: Path, after: Path) -> dict[str, list[tuple[str, float]]]:
    """Return by lesson how far apart the files are that it has in two sites; infinite where one is
    missing or has other words.
    """
    names = {
        str(file.relative_to(site))
        for site in (before, after)
        for file in site.rglob("*")
        if file.is_file() and file.name != MANIFEST
    }
    by_lesson: dict[str, list[tuple[str, float]]] = defaultdict(list)
    for name in sorted(names):
        lesson = name.partition("/")[0] if name.count("/") else "the site"
        by_lesson[lesson].append((name, files_apart(before / name, after / name)))
    return by_lesson


def compared_grades(before: Path, after: Path) -> list[tuple[str, float]]:
    """Return how far apart the tables and reports are."""
    names = {
        str(file.relative_to(folder))
        for folder in (before, after)
        for file in folder.rglob("*")
        if file.suffix in (".csv", ".json")
    }
    return [(name, files_apart(before / name, after / name)) for name in sorted(names)]


def files_apart(before: Path, after: Path) -> float:
    """Return how far two files are apart; infinite where one is missing."""
    if not (before.is_file() and after.is_file()):
        return math.inf
    return apart(content(before), content(after))


def content(file: Path) -> Any:
    """Return what a file says, as plain data and arrays."""
    data = file.read_bytes()
    if file.suffix == ".rrd":
        return [(table.schema.names, table.to_pydict()) for table in map(bare, tidied(data))]
    if file.suffix == ".csv":
        return list(csv.reader(data.decode().splitlines()))
    if file.suffix == ".json":
        return without_code(json.loads(data))
    if file.suffix in (".js", ".html", ".svg", ".css", ".txt", ".xml"):
        text = data.decode()
        replay = REPLAY.fullmatch(text)
        return text if replay is None else run_content(json.loads(replay[2]))
    return data


def bare(table: pa.Table) -> pa.Table:
    """Return a recording's table without the numbers that rerun gives rows."""
    return table.select([name for name in table.schema.names if not name.startswith("rerun.")])


def run_content(data: dict[str, Any]) -> dict[str, Any]:
    """Return the data of a published run, its scenes as nodes and arrays."""
    told = {
        "steps": list(map(without_code, data["steps"])),
        "things": [None if is_code(thing) else thing for thing in data["things"]],
        "scene": list(scenes(data["scene"])),
    }
    return without_code(data) | told


def is_code(thing: Any) -> bool:
    """Whether a thing of a page is the source of what is run."""
    return isinstance(thing, dict) and str(thing.get("html", "")).startswith("<div data-line=")


def without_code(data: dict[str, Any]) -> dict[str, Any]:
    """Return data without what they say of the code."""
    return {name: value for name, value in data.items() if name not in OF_THE_CODE}


def scenes(text: str) -> Iterator[list[Any]]:
    """Yield the nodes of each step of a run by name, with type, properties and pose."""
    raw = base64.b64decode(text)
    size = int.from_bytes(raw[:8], "little")
    reader = Reader()
    head = reader.read(zstandard.ZstdDecompressor().decompress(raw[8:], max_output_size=size))
    nodes: dict[str, Any] = {}
    for step in head["steps"]:
        before = nodes
        nodes = {}
        for listed in step:
            if isinstance(listed, str):  # as in the step before
                nodes[listed] = before[listed]
            else:
                name, key, pose = listed
                nodes[name] = reader.node(key, pose) | {"key": None}
        yield list(nodes.items())


def apart(before: Any, after: Any) -> float:
    """Return how far two values are apart; infinite where they differ in more than numbers."""
    if isinstance(before, np.ndarray) and isinstance(after, np.ndarray):
        return arrays_apart(before, after)
    if isinstance(before, str) and isinstance(after, str):
        return 0.0 if before == after else texts_apart(before, after)
    if isinstance(before, Mapping) and isinstance(after, Mapping):
        if list(before) != list(after):
            return math.inf
        return max((apart(before[name], after[name]) for name in before), default=0.0)
    if isinstance(before, list | tuple) and isinstance(after, list | tuple):
        if len(before) != len(after):
            return math.inf
        return max(map(apart, before, after), default=0.0)
    if isinstance(before, int | float) and isinstance(after, int | float):
        return arrays_apart(np.array(float(before)), np.array(float(after)))
    return 0.0 if before == after else math.inf


def arrays_apart(before: np.ndarray, after: np.ndarray) -> float:
    """Return how far two arrays are apart; what is not finite must be the same."""
    if before.dtype != after.dtype or before.shape != after.shape:
        return math.inf
    if before.tobytes() == after.tobytes():
        return 0.0
    a = before.astype(float)
    b = after.astype(float)
    finite = np.isfinite(a) & np.isfinite(b)
    if not np.array_equal(a[~finite], b[~finite], equal_nan=True):
        return math.inf
    a, b = a[finite], b[finite]
    return float(np.max(np.abs(a - b) / np.maximum(1, np.abs(a)), initial=0))


def texts_apart(before: str, after: str) -> float:
    """Return how far the numbers of two texts are apart; infinite where the words differ."""
    if NUMBER.split(before) != NUMBER.split(after):
        return math.inf
    numbers = [
        np.array([number_of(word) for word in NUMBER.findall(text)]) for text in (before, after)
    ]
    return arrays_apart(*numbers)


def number_of(word: str) -> float:
    """Return what a written number is, its thousands parted by commas or not."""
    plain = word.replace("−", "-").replace(",", "")
    try:
        return float(plain)
    except ValueError:  # such as 1.2.3
        return float(plain.replace(".", ""))


def told(results: Mapping[str, list[tuple[str, float]]], bound: float) -> int:
    """Print what differs; return the exit code."""
    differing = 0
    for name, files in results.items():
        off = [value for _, value in files]
        equal = sum(value == 0 for value in off)
        near = [value for value in off if 0 < value <= bound]
        far = [(file, value) for file, value in files if value > bound]
        nearly = f", {len(near)} but for {max(near):.1g}" if near else ""
        print(f"{name}: {len(files)} files, {equal} equal{nearly}, {len(far)} differ", flush=True)
        for file, value in far[:10]:
            print(f"  {file}: {'other words' if math.isinf(value) else f'{value:.1g} apart'}")
        differing += len(far)
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())
