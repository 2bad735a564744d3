"""The grader as files: the headless part of the workbench, the lessons that are asked for, and what
pip cannot be asked.
"""

import importlib.metadata
import importlib.util
from collections.abc import Iterator
from pathlib import Path

from workbench.errors import InputError
from workbench.handout.assignment import Assignment
from workbench.lesson import catalog

NEEDED = ("numpy", "scipy")
"""What is installed where submissions are graded, in the versions of this machine."""
CARRIED = ("jaxtyping", "wadler_lindig")
"""Small packages of plain Python that come along."""
LICENCES = "page/static/third-parties.txt"
"""Of the workbench: its own licences and those of others, as one text."""
LEFT_OUT = ("viewer", "publish", "recording", "authoring", "page/static")
"""Of the workbench: the page and what serves, publishes and records it."""


def packages(assignment: Assignment) -> dict[str, bytes]:
    """Return the packages that grade an assignment, by their paths.

    Raises:
        InputError: If an exercise is of a lesson that is not one of the course's own.
    """
    ours, lessons = _folder("workbench"), _folder("lessons")
    files = {
        f"workbench/{name}": data for name, data in _files(ours) if not name.startswith(LEFT_OUT)
    }
    files |= {
        f"lessons/{name}": (lessons / name).read_bytes() for name in ("__init__.py", "py.typed")
    }
    for name in dict.fromkeys(exercise.lesson for exercise in assignment.exercises):
        folder = lessons / name
        if catalog()[name].params.__module__.split(".")[:2] != ["lessons", name]:
            raise InputError(
                f"lesson {name} is not one of the course's own: hand its exercises out by"
                " `exercise`"
            )
        files |= {f"lessons/{name}/{file}": data for file, data in _files(folder)}
    files["workbench/LICENSES.txt"] = (ours / LICENCES).read_bytes()
    for package in CARRIED:
        files |= {f"{package}/{name}": data for name, data in _files(_folder(package))}
        files |= dict(_told_of(package))
    return files


def static(name: str) -> bytes:
    """Return a script that comes along as it is."""
    return Path(__file__).with_name("static").joinpath(name).read_bytes()


def requirements() -> str:
    """Return what pip installs where submissions are graded."""
    return "".join(f"{name}=={importlib.metadata.version(name)}\n" for name in NEEDED)


def _files(folder: Path) -> Iterator[tuple[str, bytes]]:
    for path in sorted(folder.rglob("*")):
        if path.is_file() and path.suffix != ".pyc":
            yield path.relative_to(folder).as_posix(), path.read_bytes()


def _folder(package: str) -> Path:
    spec = importlib.util.find_spec(package)
    assert spec is not None
    assert spec.submodule_search_locations is not None
    return Path(next(iter(spec.submodule_search_locations)))


def _told_of(package: str) -> Iterator[tuple[str, bytes]]:
    """Yield what an installation says of a package: its version, which it asks for itself, and its
    licence.
    """
    for file in importlib.metadata.files(package) or ():
        if ".dist-info/" in str(file) and (
            file.name == "METADATA" or "LICENSE" in file.name.upper()
        ):
            yield file.as_posix(), Path(str(file.locate())).read_bytes()
