"""What a student's process needs of this machine: interpreter, libraries, numpy, scipy."""

import functools
import importlib.util
import os
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

CHILD_FILES = Path(__file__).resolve().parents[1] / "child"
ALLOWED = ("numpy", "scipy")
"""The packages that a student's function may import, beside Python's own library."""
SYSTEM = ("/lib", "/lib64", "/usr/lib", "/usr/lib64")
FILES = ("/etc/ld.so.cache",)
DEVICES = ("/dev/null", "/dev/zero", "/dev/urandom", "/dev/random")
OTHERS = ("site-packages", "dist-packages")
"""Folders of installed packages: nothing in them is in a student's sight but what is allowed."""


@dataclass(frozen=True, kw_only=True)
class Python:
    """What is bound for a student's process.

    Attributes:
        executable: The interpreter itself, outside of any virtual environment.
        trees: Folders to read.
        links: Links that stand for some of these folders, and where they lead.
        masked: Folders in the trees of which nothing is seen.
        packages: The folders of what may be imported, and of wheels' libraries.
    """

    executable: str
    trees: tuple[str, ...]
    links: tuple[tuple[str, str], ...]
    masked: tuple[str, ...]
    packages: tuple[str, ...]

    @property
    def places(self) -> dict[str, str]:
        """Where each allowed package is: the folder that holds its folder."""
        return {
            os.path.basename(path): os.path.dirname(path)
            for path in self.packages
            if not path.endswith(".libs")
        }

    def listed(self) -> Iterator[str]:
        """Yield what the trees hold without what is masked: for Landlock, which can only add."""
        yield from (self.executable, str(CHILD_FILES), *FILES, *DEVICES, *self.packages)
        for tree in self.trees:
            yield from _without(tree, self.masked)


@functools.cache
def here() -> Python:
    """Return what this interpreter needs."""
    executable = os.path.realpath(getattr(sys, "_base_executable", sys.executable))
    links = tuple((os.readlink(path), path) for path in SYSTEM if os.path.islink(path))
    linked = [path for _, path in links]
    wanted = [
        os.path.dirname(os.path.realpath(os.__file__)),
        *(_libraries(path) for path in SYSTEM if path not in linked),
    ]
    for prefix in {sys.base_prefix, sys.base_exec_prefix} - {"/usr"}:
        wanted += [os.path.join(prefix, name) for name in ("lib", "lib64")]
    trees = sorted({path for path in wanted if os.path.isdir(path)})
    trees = [
        path for path in trees if not any(_inside(path, other) for other in trees if other != path)
    ]
    masked = [path for path in ours() if any(_inside(path, tree) for tree in trees)]
    for tree in trees:
        masked += [
            str(path)
            for name in OTHERS
            for depth in ("*", ".")
            for path in Path(tree).glob(f"{depth}/{name}")
        ]
    packages = [
        path for name in ALLOWED for folder in _folder(name) for path in _with_libraries(folder)
    ]
    return Python(
        executable=executable,
        trees=tuple(trees),
        links=links,
        masked=tuple(sorted(set(masked))),
        packages=tuple(packages),
    )


def ours() -> list[str]:
    """Return the folders that hold our solutions and checks."""
    return [str(CHILD_FILES.parents[1]), *_folder("lessons")]


def _libraries(folder: str) -> str:
    """Return where a system's folder has shared libraries; on Debian one folder of many."""
    narrower = os.path.join(folder, getattr(sys.implementation, "_multiarch", ""))
    return narrower if os.path.isdir(narrower) else folder


def _inside(path: str, tree: str) -> bool:
    return os.path.commonpath((path, tree)) == tree


def _folder(package: str) -> list[str]:
    spec = importlib.util.find_spec(package)
    return list(spec.submodule_search_locations or ()) if spec is not None else []


def _with_libraries(folder: str) -> list[str]:
    return [path for path in (folder, f"{folder}.libs") if os.path.isdir(path)]


def _without(tree: str, masked: tuple[str, ...]) -> Iterator[str]:
    if tree in masked:
        return
    if not any(_inside(path, tree) for path in masked):
        yield tree
        return
    with os.scandir(tree) as entries:
        for entry in entries:
            if entry.is_dir(follow_symlinks=False):
                yield from _without(entry.path, masked)
            elif not entry.is_symlink():
                yield entry.path
