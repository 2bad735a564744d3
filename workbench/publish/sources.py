"""What a published run depends on: the source that runs, draws, records and renders it, its
lesson's page, and libraries.

Found by reading imports, not by importing: a change in one lesson, or in a module that its runs
never reach, renders no other lesson again.
"""

import ast
import functools
import hashlib
import sys
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

from workbench.lesson import Lesson

OURS = "workbench.publish.runs"
"""Where what we do with every run begins."""
UNUSED = "workbench.exercise"
"""What lessons import for people who do an exercise: no published run comes by."""
LIBRARIES = ("numpy", "scipy", "trimesh", "scikit-image", "pillow", "viser", "rerun-sdk")


def sources_digest(lesson: Lesson) -> str:
    """Return a digest of everything but the params that the files of a lesson's runs depend on."""
    digest = hashlib.sha256(" ".join(f"{name} {version(name)}" for name in LIBRARIES).encode())
    for file in sources_of(lesson):
        digest.update(f"\0{file.name}\0".encode() + hashlib.sha256(file.read_bytes()).digest())
    return digest.hexdigest()


def sources_of(lesson: Lesson) -> list[Path]:
    """Return the files that a lesson's runs depend on: of its folder, and of all that they and we
    import.
    """
    begin = {
        part.__module__ for part in (lesson.run, lesson.draw, lesson.params)
    } & sys.modules.keys()
    files = {Path(lesson.page)} if lesson.page else set()
    waiting = [*begin, OURS]
    for name in begin:
        folder = Path(getattr(sys.modules[name], "__file__", None) or "").parent
        if (folder / "lesson.py").is_file():  # the folder is the lesson, with its page and its data
            own = [
                file for file in folder.rglob("*") if file.suffix != ".pyc" and file.name[0] != "."
            ]
            parts = [
                file.relative_to(folder).with_suffix("").parts
                for file in own
                if file.suffix == ".py"
            ]
            files = files.union(own)
            waiting = waiting + [".".join((name.rpartition(".")[0], *path)) for path in parts]
    tops = {"workbench", *(name.partition(".")[0] for name in begin)}
    seen = set[str]()
    while waiting:
        name = waiting.pop()
        file = _file_of(name) if name not in seen and name.partition(".")[0] in tops else None
        seen.add(name)
        if file is not None and not name.startswith(UNUSED):
            files.add(file)
            waiting += [name.rpartition(".")[0], *_imported(file, name, file.read_bytes())]
    return sorted(file for file in files if file.is_file())


def _file_of(name: str) -> Path | None:
    """Return a module's file; None where the name is no module, such as that of a function."""
    top, *parts = name.split(".")
    spec = find_spec(top)
    folders = list(spec.submodule_search_locations or ()) if spec else []
    if spec is None or not parts:
        return Path(spec.origin) if spec and spec.has_location and spec.origin else None
    if not folders:
        return None
    place = Path(folders[0], *parts)
    return next(
        (file for file in (place.with_suffix(".py"), place / "__init__.py") if file.is_file()), None
    )


@functools.lru_cache(1000)
def _imported(file: Path, name: str, source: bytes) -> tuple[str, ...]:
    """Return all names that a file imports, in full."""
    package = name.split(".") if file.name == "__init__.py" else name.split(".")[:-1]
    names: list[str] = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else []
            module = ".".join([*base, *([node.module] if node.module else [])])
            names += [module, *(f"{module}.{alias.name}" for alias in node.names)]
    return tuple(names)
