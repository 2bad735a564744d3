"""How many small changes of our own code its tests notice.

    python -m tests.benchmarks.mutation workbench/geometry            # 100 mutants, by --seed
    python -m tests.benchmarks.mutation workbench/run workbench/knobs --mutants 50
    python -m tests.benchmarks.mutation workbench --again FILE        # what survived, by FILE
    python -m tests.benchmarks.mutation --named "framing.module: number: 0.01"

A mutant is a module with one change (`mutants`). It is killed when its own tests fail, or take far
longer than before. Of these, the tests run that come to the changed line, short ones first, up to a
bound of time; those of its layer's folder only where its own let it live. The project is copied, so
that child processes meet the mutant too and nobody's files change; which lines a child process
comes to is seen in the copy (`tracing`). Each mutant runs in a fork of a process that has imported
numpy, scipy and pytest. `equivalent.txt` names, with reasons, the mutants that nobody could tell
from the original; these do not count. Mutants are drawn by their names, so that an edit of one line
changes the draw of no other.
"""

import argparse
import hashlib
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import traceback
from collections import Counter
from dataclasses import asdict
from pathlib import Path
from typing import NoReturn

from workbench.machinery.threads import ONE_EACH

os.environ |= ONE_EACH  # before numpy is imported; forks inherit it

import pytest

from tests.benchmarks.mutants import ROOT, Mutant, mutants, own_tests, parses
from tests.benchmarks.tracing import Tracing

EQUIVALENT = Path(__file__).with_name("equivalent.txt")
IMPORTED = (
    "numpy",
    "scipy.spatial",
    "scipy.sparse",
    "scipy.sparse.linalg",
    "scipy.optimize",
    "scipy.stats",
    "scipy.ndimage",
    "hypothesis",
    "beartype",
    "jaxtyping",
)
TESTED_FOR = 40.0
"""Seconds, at most, that the tests of one mutant took without it: its own, then the others."""
BASELINE_FOR = 900.0
"""Seconds until a file of tests is given up."""


def main() -> int:
    """Draw mutants, test them, print what survived and the rates."""
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.mutation")
    parser.add_argument(
        "paths", nargs="*", type=Path, help="modules or folders of them, one sample for all of them"
    )
    parser.add_argument("--mutants", type=int, default=100, help="how many are drawn")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument(
        "--again", type=Path, metavar="FILE", help="test what survived in that file of results"
    )
    parser.add_argument("--named", nargs="+", metavar="NAME", help="test all whose name begins so")
    parser.add_argument(
        "--write",
        type=Path,
        metavar="FILE",
        help="a line of JSON per mutant; what it has is not redone",
    )
    given = parser.parse_args()
    drawn = _drawn(given)
    known = _read(given.write)
    results = {
        candidate.name: known[candidate.name] for candidate in drawn if candidate.name in known
    }
    with tempfile.TemporaryDirectory(prefix="mutation-") as name:
        house = House(Path(name))
        for mutant in drawn:
            if mutant.name not in results:
                results[mutant.name] = house.tested(mutant)
                print(
                    results[mutant.name]["fate"],
                    mutant.module,
                    mutant.line,
                    mutant.name,
                    flush=True,
                )
                if given.write:
                    with given.write.open("a", encoding="utf-8") as file:
                        file.write(json.dumps(results[mutant.name], ensure_ascii=False) + "\n")
    print(report(results))
    return 0


def _drawn(given: argparse.Namespace) -> list[Mutant]:
    files = [file for path in given.paths or [Path("workbench")] for file in _modules(ROOT / path)]
    everything = [
        mutant
        for file in sorted(files, key=lambda file: (file.stem, file))
        for mutant in mutants(file)
    ]
    if given.named:
        return [
            candidate
            for candidate in everything
            if candidate.name.startswith(tuple(given.named)) and parses(candidate)
        ]
    if given.again:
        survivors = {
            name for name, result in _read(given.again).items() if result["fate"] == "survived"
        }
        return [
            candidate
            for candidate in everything
            if candidate.name in survivors and parses(candidate)
        ]
    everything.sort(
        key=lambda candidate: hashlib.sha256(f"{given.seed} {candidate.name}".encode()).digest(),
    )
    taken = dict[str, Mutant]()
    for mutant in everything:
        if len(taken) == given.mutants:
            break
        if parses(mutant):
            taken.setdefault(mutant.name, mutant)
    return sorted(taken.values())


def _modules(path: Path) -> list[Path]:
    return (
        [path]
        if path.is_file()
        else [file for file in path.rglob("*.py") if file.name != "__init__.py"]
    )


def _read(path: Path | None) -> dict[str, dict]:
    if path is None or not path.exists():
        return {}
    return {
        result["name"]: result
        for result in map(json.loads, path.read_text(encoding="utf-8").splitlines())
    }


def equivalents() -> set[str]:
    """Return the names of the mutants that are equivalent."""
    if not EQUIVALENT.exists():
        return set()
    lines = EQUIVALENT.read_text(encoding="utf-8").splitlines()
    return {line for line in lines if line and not line.startswith("#")}


def report(results: dict[str, dict]) -> str:
    """Return how many died, by operator, and which survived."""
    same = equivalents()
    counted = {name: result for name, result in results.items() if name not in same}
    survived = [result for result in counted.values() if result["fate"] == "survived"]
    operators = Counter(result["operator"] for result in counted.values())
    ends = Counter(result["operator"] for result in survived)
    killed = len(counted) - len(survived)
    lines = [f"{killed} of {len(counted)} killed ({100 * killed / max(len(counted), 1):.0f} %)"]
    lines += [f"{len(results) - len(counted)} equivalent, not counted"]
    lines += [
        f"  {operator}: {count - ends[operator]} of {count}"
        for operator, count in sorted(operators.items())
    ]
    return "\n".join(
        [
            *lines,
            "survived:",
            *(f"  {result['module']}:{result['line']} {result['name']}" for result in survived),
        ]
    )


# running tests ------------------------------------------------------------------------------------


class House:
    """A copy of the project in which modules are changed and tests run."""

    def __init__(self, folder: Path) -> None:
        self.root = folder / "project"
        listed = subprocess.run(
            ["git", "ls-files", "-co", "--exclude-standard"],
            cwd=ROOT,
            capture_output=True,
            text=True,
        )
        for name in listed.stdout.splitlines():
            if (ROOT / name).is_file():
                (self.root / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(ROOT / name, self.root / name)
        if (ROOT.parent / "shared").exists():
            (folder / "shared").symlink_to(ROOT.parent / "shared")
        os.environ |= {
            "PYTHONPATH": str(self.root),
            "HYPOTHESIS_STORAGE_DIRECTORY": str(folder / "examples"),
        }
        for name in IMPORTED:
            __import__(name)
        self.folder = folder
        self.runs = 0
        self.known = dict[str, list[dict]]()
        self.tracing = Tracing(self.root)

    def tested(self, mutant: Mutant) -> dict:
        """Return a mutant's fate: killed, survived, or too long."""
        began = time.monotonic()
        changed = set(range(mutant.line, mutant.last + 1))
        known: list[dict] = []
        ran: list[str] = []
        end: int | None = 0
        for files in own_tests(ROOT / mutant.module):
            known += [test for file in files for test in self.baseline(file)]
            reaching = [
                test for test in known if changed & set(test["lines"].get(mutant.module, []))
            ]
            chosen, seconds = _chosen([test for test in reaching if test["test"] not in ran])
            end = self.end_with(mutant, chosen, seconds)
            ran += chosen
            if end != 0:
                break
        covered = bool(ran)
        if not covered:
            ran, seconds = _chosen(known)
            end = self.end_with(mutant, ran, seconds)
        return asdict(mutant) | {
            "name": mutant.name,
            "fate": {0: "survived", None: "too long"}.get(end, "killed"),
            "covered": covered,
            "tests": len(ran),
            "took": round(time.monotonic() - began, 1),
        }

    def end_with(self, mutant: Mutant, tests: list[str], seconds: float) -> int | None:
        """Return how tests end, that took so long without it, with a mutant in its place."""
        if not tests:
            return 0
        path = self.root / mutant.module
        before = path.read_bytes()
        was = path.stat()
        path.write_text(mutant.source(), encoding="utf-8")
        self.runs += 1
        os.utime(path, (was.st_atime, was.st_mtime + 10 * self.runs))  # no older bytecode fits
        try:
            return self.run(tests, 60 + 5 * seconds)
        finally:
            path.write_bytes(before)
            os.utime(path, (was.st_atime, was.st_mtime))
            for file in path.parent.glob(f"__pycache__/{path.stem}.*"):
                file.unlink(missing_ok=True)

    def baseline(self, file: str) -> list[dict]:
        """Return the tests of a file that pass, with their seconds and our lines they come to."""
        if file not in self.known:
            lines = self.folder / f"{len(self.known)}.json"
            self.run([file], BASELINE_FOR, Lines(self.tracing, lines))
            tests = json.loads(lines.read_text()) if lines.exists() else []
            self.known[file] = [test for test in tests if test["passed"]]
            if not tests:
                print((self.folder / "said.txt").read_text()[-2000:], flush=True)
            print(f"# {file}: {len(self.known[file])} of {len(tests)} tests pass", flush=True)
        return self.known[file]

    def run(self, tests: list[str], seconds: float, *plugins: object) -> int | None:
        """Run tests in a fork; return pytest's exit code, or None where they took too long."""
        sys.stdout.flush()
        child = os.fork()
        if child == 0:
            self._child(tests, plugins)
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            ended, status = os.waitpid(child, os.WNOHANG)
            if ended:
                return os.waitstatus_to_exitcode(status)
            time.sleep(0.02)
        os.killpg(child, signal.SIGKILL)
        os.waitpid(child, 0)
        return None

    def _child(self, tests: list[str], plugins: tuple[object, ...]) -> NoReturn:
        code = 3
        try:
            os.setsid()
            os.chdir(self.root)
            sys.path[:0] = [str(self.root)]
            for name in [
                name
                for name in sys.modules
                if name.split(".")[0] in {"tests", "workbench", "lessons"}
            ]:
                del sys.modules[name]
            nothing = os.open(self.folder / "said.txt", os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
            os.dup2(nothing, 1)
            os.dup2(nothing, 2)
            options = [
                "-q",
                "-n0",
                "-W",
                "ignore::pytest.PytestAssertRewriteWarning",
                "-p",
                "no:cacheprovider",
                "--hypothesis-seed=0",
                *([] if plugins else ["-x"]),
            ]
            code = int(pytest.main([*options, *tests], plugins=list(plugins)))
        except BaseException:
            traceback.print_exc()
        finally:
            sys.stderr.flush()
            os._exit(code)


def _chosen(tests: list[dict]) -> tuple[list[str], float]:
    """Return tests and their seconds together: short ones first, the more the fewer of a kind."""
    ranked: list[tuple[float, float, str]] = []
    turn = Counter[str]()
    for entry in sorted(tests, key=lambda entry: entry["seconds"]):
        function = entry["test"].partition("[")[0]
        turn[function] += 1
        ranked.append((turn[function] * entry["seconds"], entry["seconds"], entry["test"]))
    chosen: list[str] = []
    together = 0.0
    for _, seconds, test in sorted(ranked):
        if together + seconds <= TESTED_FOR or not chosen:
            chosen.append(test)
            together += seconds
    return chosen, together


class Lines:
    """A plugin that notes to which lines of ours each test comes."""

    def __init__(self, tracing: Tracing, file: Path) -> None:
        self.tracing, self.file = tracing, file
        self.tests: dict[str, dict] = {}
        self.common: dict[str, set[int]] = {}

    def pytest_configure(self) -> None:
        self.tracing.begin()

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item, nextitem):
        for name, lines in self.tracing.taken().items():  # between tests: what imports come to
            self.common.setdefault(name, set()).update(lines)
        began = time.monotonic()
        self.tests[item.nodeid] = {"test": item.nodeid, "passed": True}
        result = yield
        seconds = time.monotonic() - began
        self.tests[item.nodeid] |= {"seconds": seconds, "lines": self.tracing.taken()}
        return result

    def pytest_runtest_logreport(self, report) -> None:
        if not report.passed:
            self.tests[report.nodeid]["passed"] = False

    def pytest_sessionfinish(self) -> None:
        sys.settrace(None)
        for test in self.tests.values():
            lines = test.get("lines", {})
            for part in (self.common, self.tracing.once):
                lines = {
                    name: lines.get(name, set()) | part.get(name, set()) for name in lines | part
                }
            test["lines"] = {name: sorted(numbers) for name, numbers in lines.items()}
        self.file.write_text(json.dumps(list(self.tests.values())))


if __name__ == "__main__":
    sys.exit(main())
