"""Runs and verdicts in Pyodide beside those of this machine."""

import json
import math
import subprocess
import zipfile
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from tests.computed.solutions import Task
from workbench.computed import archive
from workbench.lesson import catalog

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
CLOSE = 1e-6
"""Of the larger of 1 and a value: how far curves are apart that count as equal."""


def make_archive(path: Path, tasks: Iterable[Task] = ()) -> Path:
    """Write the archive of all lessons; with tasks for `judged.py` also the hidden checks, which
    what is published never has.
    """
    path.write_bytes(archive.packed(catalog().values()))
    listed = list(tasks)
    if listed:
        with zipfile.ZipFile(path, "a") as core:
            core.writestr("tasks.json", json.dumps(listed))
            names = set(core.namelist())
            for file in ROOT.glob("lessons/*/exercises/**/*.py"):
                name = str(file.relative_to(ROOT))
                if name not in names:
                    core.write(file, name)
    return path


def lines_of(pyodide: Path, core: Path, script: str, *, words: Iterable[str] = ()) -> Iterator[Any]:
    """Yield what a script of this folder writes in Pyodide, a value of JSON in each line.

    Raises:
        RuntimeError: If it fails.
    """
    command = ["node", str(HERE / "pyodide.mjs"), str(pyodide), str(core), str(HERE / script)]
    with subprocess.Popen(
        [*command, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        for line in process.stdout:
            yield json.loads(line)
        trouble = process.stderr.read()
    if process.returncode:
        raise RuntimeError(trouble[-3000:])


def differences(here: Mapping[str, Any], by_pyodide: Mapping[str, Any]) -> list[str]:
    """Return where two summaries of a run differ: a line each."""
    if "error" in by_pyodide:
        return [by_pyodide["error"]]
    if by_pyodide["stopped"] != here["stopped"]:
        return [f"stopped: {by_pyodide['stopped']}"]
    mine, theirs = (
        list(zip(run["captions"], run["tones"], strict=True)) for run in (here, by_pyodide)
    )
    if len(mine) != len(theirs):
        return [f"{len(theirs)} steps, {len(mine)} here"]
    pairs = enumerate(zip(mine, theirs, strict=True))
    lines = [f"step {k}: {b[0]!r}, here {a[0]!r}" for k, (a, b) in pairs if a != b]
    if here["curves"].keys() != by_pyodide["curves"].keys():
        return [*lines, f"curves {list(by_pyodide['curves'])}"]
    for path, values in here["curves"].items():
        off = max(map(apart, values, by_pyodide["curves"][path]), default=0.0)
        lines += [f"{path}: {off:.1g} apart"] if off > CLOSE else []
    return lines


def apart(a: float | None, b: float | None) -> float:
    """Return how far two values of a curve are apart, in the larger of 1 and the first."""
    if a is None or b is None:
        return 0.0 if a is b else math.inf
    return abs(a - b) / max(1.0, abs(a))


def verdict(judgement: list[Any]) -> list[Any]:
    """Return of what `judged` found the marks alone: the mistake, and the share of each check."""
    return [entry if isinstance(entry, str | None) else entry[:2] for entry in judgement]
