"""What pyproject.toml asks for is what is imported, no more and no less, and the bounds are what
was tried.
"""

import ast
import importlib.metadata
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

from packaging.requirements import Requirement

ROOT = Path(__file__).resolve().parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
ASKED = [Requirement(line) for line in PROJECT["dependencies"]]
CI = (ROOT / ".github" / "workflows" / "ci.yml").read_text(encoding="utf-8")
RELEASE = (ROOT / ".github" / "workflows" / "release.yml").read_text(encoding="utf-8")
BESIDE = "workbench/exercise/child"
"""Files here are run in a student's process, where they import each other by their bare names."""


def imported() -> dict[str, Path]:
    """Return every top-level module that our packages import and do not hold themselves, with a
    file that does.
    """
    files = {}
    for file in sorted([*ROOT.glob("workbench/**/*.py"), *ROOT.glob("lessons/**/*.py")]):
        for node in ast.walk(ast.parse(file.read_bytes())):
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            if isinstance(node, ast.ImportFrom) and not node.level and node.module:
                names = [node.module]
            files |= {name.partition(".")[0]: file for name in names}
    ours = {"workbench", "lessons", *(path.stem for path in (ROOT / BESIDE).glob("*.py"))}
    return {
        name: file
        for name, file in files.items()
        if name not in sys.stdlib_module_names and name not in ours
    }


def plain(name: str) -> str:
    """Return a distribution's name as all spell it."""
    return re.sub(r"[-_.]+", "-", name).lower()


def test_what_is_imported_is_declared_and_what_is_declared_is_used():
    homes = importlib.metadata.packages_distributions()
    asked = {plain(requirement.name) for requirement in ASKED}
    needed = {name: {plain(home) for home in homes.get(name, ())} for name in imported()}
    needed.pop("distributed")  # for `--dask` alone, which says how to install it
    needed.pop("av")  # for .mp4 alone, likewise
    undeclared = {
        name: str(imported()[name]) for name, places in needed.items() if not places & asked
    }
    assert undeclared == {}
    by_name = {"ziamath", "websockets"}  # its font is read; uvicorn imports it, as it is told to
    assert asked - set().union(*needed.values()) - by_name == set()


def test_our_lower_bounds_are_none_that_what_we_ask_for_forbids():
    """msgspec>=0.18 was none: viser asks for 0.18.6."""
    ours = {plain(requirement.name): requirement.specifier for requirement in ASKED}
    for asked in ASKED:
        for line in importlib.metadata.requires(asked.name) or ():
            theirs = Requirement(line)
            if plain(theirs.name) not in ours or (
                theirs.marker and not theirs.marker.evaluate({"extra": ""})
            ):
                continue
            lowest = next(
                bound.version for bound in ours[plain(theirs.name)] if bound.operator == ">="
            )
            padded = [lowest, f"{lowest}.0", f"{lowest}.0.0"]
            assert any(theirs.specifier.contains(version) for version in padded), (
                f"{asked.name} needs {line}"
            )


def pythons() -> list[str]:
    """The versions of Python that we say it runs on."""
    return [
        line.rpartition(" ")[2]
        for line in PROJECT["classifiers"]
        if re.search(r"Python :: 3\.\d", line)
    ]


def test_every_python_that_is_named_is_tried_with_newest_and_the_oldest_with_oldest():
    named = pythons()
    oldest = PROJECT["requires-python"].removeprefix(">=")
    assert named[0] == oldest
    for python in named:
        assert f'python: "{python}", versions: newest' in CI
    assert f'python: "{oldest}", versions: oldest' in CI
    assert ".ci/wheel" in CI


def test_a_release_is_tried_on_every_python_before_it_is_given_away():
    jobs = RELEASE.split("\njobs:\n")[1]
    assert re.findall(r"^  (\w+):$", jobs, re.MULTILINE) == [
        "build",
        "stranger",
        "publish",
    ]
    assert "needs: build" in jobs
    assert "needs: stranger" in jobs
    for python in pythons():
        assert f'"{python}"' in jobs
        assert f'"{python}"' in CI.split("  wheel:")[1]


def test_a_release_needs_the_tag_of_its_version_and_a_date(tmp_path):
    shutil.copytree(ROOT / ".ci", tmp_path / ".ci")
    version = tmp_path / "workbench" / "machinery" / "version.py"
    version.parent.mkdir(parents=True)
    version.write_text('__version__ = "1.2.3"\n')
    (tmp_path / "CHANGELOG.md").write_text("## 1.2.3 (unreleased)\n")

    def released(*words: str) -> tuple[int, str]:
        done = subprocess.run(
            [tmp_path / ".ci" / "release", *words], capture_output=True, text=True, check=False
        )
        return done.returncode, done.stderr

    assert released() == (2, "usage: .ci/release TAG ADDRESS FOLDER\n")
    assert released("v1.2", "https://example.org", "dist") == (
        2,
        "the tag is v1.2 and the version 1.2.3\n",
    )
    assert released("v1.2.3", "https://example.org", "dist") == (
        2,
        "CHANGELOG.md has no date for 1.2.3\n",
    )
