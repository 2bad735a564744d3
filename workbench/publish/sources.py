"""What a published run depends on: the source that runs, draws, records and renders it, its lesson's page, and libraries.

Found by reading imports, not by importing: a change in one lesson, or in a module that its runs never reach, renders no
other lesson again.
"""

import ast
import functools
import hashlib
import importlib
import sys
from collections.abc import Iterable, Iterator
from importlib.metadata import version
from pathlib import Path

from workbench.lesson import Lesson

OURS = ("workbench.publish.runs",)
"""Where what we do with every run begins."""
UNUSED = ("workbench.exercise",)
"""What lessons import for people who do an exercise: no published run comes by."""
LIBRARIES = ("numpy", "scipy", "trimesh", "scikit-image", "pillow", "viser", "rerun-sdk")


def sources_digest(lesson: Lesson) -> str:
    """Return a digest of everything but the params that the files of a lesson's runs depend on."""
    found = hashlib.sha256(" ".join(f"{name} {version(name)}" for name in LIBRARIES).encode())
    for file in sources_of(lesson):
        found.update(f"\0{file.name}\0{_digest(file)}".encode())
    return found.hexdigest()


def sources_of(lesson: Lesson) -> list[Path]:
    """Return the files that a lesson's runs depend on: of its folder, and of all that they and we import."""
    begin = {module for part in (lesson.run, lesson.draw, lesson.params) if (module := part.__module__) in sys.modules}
    tops = {name.partition(".")[0] for name in begin}
    lessons_own = {file for name in begin if (file := _file_of_loaded(name)) is not None}
    files = set(lessons_own)
    for file in lessons_own:
        if file.with_name("lesson.py").is_file():  # the folder is the lesson, with its page and its data
            files |= {other for other in file.parent.rglob("*") if other.suffix != ".pyc" and other.name[0] != "."}
    if lesson.page is not None:
        files.add(Path(lesson.page))
    names = {*begin, *OURS, *(_module_of(file, tops) for file in files if file.suffix == ".py")} - {""}
    files |= set(_reached(names, {"workbench", *tops}))
    return sorted(file for file in files if file.is_file())


def _reached(names: Iterable[str], tops: Iterable[str]) -> Iterator[Path]:
    """Return the files of modules, of their packages, and of all that those import from these top-level packages."""
    waiting, seen = list(names), set[str]()
    while waiting:
        name = waiting.pop()
        if name in seen or name.partition(".")[0] not in tops or name.startswith(UNUSED):
            continue
        seen.add(name)
        file = _file_of(name)
        if file is None:
            continue
        yield file
        waiting.append(name.rpartition(".")[0])
        waiting += _imported(file, name, _digest(file))


def _file_of(name: str) -> Path | None:
    """Return a module's file; None where the name is no module, such as that of a function."""
    if not name:
        return None
    top, *parts = name.split(".")
    loaded, folder = _file_of_loaded(top), _folder_of(top)
    if folder is None or not parts:
        return loaded
    place = folder.joinpath(*parts)
    return next((file for file in (place.with_suffix(".py"), place / "__init__.py") if file.is_file()), None)


def _file_of_loaded(name: str) -> Path | None:
    file = (sys.modules.get(name) or importlib.import_module(name)).__file__
    return None if file is None else Path(file)


def _folder_of(top: str) -> Path | None:
    """Return the folder of a package, also of one without a file of its own; None where it is a single file."""
    places = list(getattr(sys.modules.get(top) or importlib.import_module(top), "__path__", ()))
    return Path(places[0]) if places else None


def _module_of(file: Path, tops: Iterable[str]) -> str:
    """Return the name under which a file of one of these packages is imported, nothing where there is none."""
    for top in tops:
        folder = _folder_of(top)
        if folder is not None and file.is_relative_to(folder):
            parts = file.relative_to(folder).with_suffix("").parts
            return ".".join((top, *(part for part in parts if part != "__init__")))
    return ""


@functools.lru_cache(1000)
def _imported(file: Path, name: str, digest: str) -> tuple[str, ...]:
    """Return all names that a file imports, in full; the digest says which file that was."""
    package = name.split(".") if file.name == "__init__.py" else name.split(".")[:-1]
    found: list[str] = []
    for node in ast.walk(ast.parse(file.read_bytes())):
        if isinstance(node, ast.Import):
            found += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else []
            module = ".".join([*base, *([node.module] if node.module else [])])
            found += [module, *(f"{module}.{alias.name}" for alias in node.names)]
    return tuple(found)


def _digest(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()
