"""Loads a lesson by the path that a person names: a single file, or a folder with `lesson.py` in
it, anywhere.

A folder is a package under a name of its own, so that two folders of one name are two lessons, and
a lesson's files may import each other (`from .draw import draw`). Loaded again, it is another
package: what runs keeps the code it began with.
"""

import importlib
import itertools
import os
import sys
import traceback
from importlib.machinery import ModuleSpec, SourceFileLoader
from importlib.util import find_spec, module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

from workbench.errors import AuthorError, InputError
from workbench.lesson import Lesson, catalog, find, lesson_in
from workbench.machinery.authors import described

_numbers = itertools.count(1)


def load(path: Path) -> Lesson:
    """Run a Python file, or `lesson.py` of a folder, and return the `lesson` that it defines.

    The file is a program and may do anything: its path must come from the person, never out of a
    file or a link. A file named `lesson.py` stands for its folder.

    Args:
        path: The file or folder. Every call runs it anew; a folder that Python can import under a
            name, such as one of the course, is that package: its modules are replaced where they
            were imported before.

    Raises:
        InputError: If there is no such file or folder, or it defines no lesson.
        AuthorError: If it fails; names its file and line.
    """
    if path.is_dir():
        folder = path
    elif path.name == "lesson.py":
        folder = path.parent
    else:
        folder = None
    file = path if folder is None else folder / "lesson.py"
    if not file.is_file():
        missing = (
            "no such file or folder"
            if folder is None or folder != path
            else "a folder without a lesson.py"
        )
        raise InputError(f"{path}: {missing}")
    try:
        return lesson_in(_run_file(path) if folder is None else _run_folder(folder.resolve()))
    except AuthorError as error:
        raise AuthorError(f"{path}: {error}", error.trace) from error
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
    except (Exception, SystemExit) as error:
        raise AuthorError(
            f"{path}: {described(error, _Place(file.resolve()))}", traceback.format_exc()
        ) from error


def word_for(lesson: str, module: str) -> str:
    """Return what a person types to name a lesson: its name in the catalogue, else the name of its
    file or folder.

    Args:
        lesson: The lesson's name.
        module: The name of a module of the lesson: that of its Params, or of one of its exercises.
    """
    if module.startswith("lessons."):  # the course, all of which is in the catalogue
        return lesson
    package = module.partition(".exercises.")[0] + ".lesson" if ".exercises." in module else module
    file = getattr(sys.modules.get(package), "__file__", None)
    if lesson in catalog() or file is None:
        return lesson
    path = Path(file)
    return (
        path.parent.name if "." in package and path.with_name("lesson.py").is_file() else path.name
    )


def taken_by(lesson: Lesson) -> str | None:
    """Return which other lesson of the catalogue has the name of this one, with its file; None
    where none has.
    """
    other = catalog().get(lesson.name)
    files = [
        getattr(sys.modules.get(namesake.params.__module__), "__file__", None)
        for namesake in (other, lesson)
        if namesake
    ]
    if other is None or other is lesson or files[0] == files[1]:
        return None
    return f"lesson {other.name} ({files[0] or other.params.__module__})"


def lesson_given(word: str) -> Lesson:
    """Return the lesson that a person names on the command line: by its name, or by the path of its
    file or folder.

    For words that a person typed only, since the file is run; names out of files and links go to
    `find`.

    Raises:
        InputError: If there is no such lesson, the file cannot be used, or its lesson has the name
            of another.
    """
    if not is_path(word):
        return find(word)
    lesson = load(Path(word))
    other = taken_by(lesson)
    if other is not None:
        raise InputError(f"{word}: its name {lesson.name!r} is taken by {other}; give it another")
    return lesson


def is_path(word: str) -> bool:
    """Tell whether a word names a lesson by its path: a Python file, a folder, or what has a slash
    in it.
    """
    return word not in catalog() and (
        word.endswith(".py") or os.sep in word or "/" in word or Path(word).is_dir()
    )


class _Place(ModuleType):
    """Stands for a module that could not be made, to tell its file."""

    def __init__(self, file: Path):
        super().__init__(file.stem)
        self.__file__ = str(file)


class _Compiled(SourceFileLoader):
    """Compiles a file as it is now: bytecode that is kept tells two saves in one second apart by
    their length only.
    """

    def path_stats(self, path: str) -> dict[str, int]:  # type: ignore[override]
        """Let no bytecode be kept."""
        raise OSError(path)


class _Folders:
    """Finds the modules of loaded folders by the names of their packages; one of these stands among
    Python's finders.
    """

    def __init__(self) -> None:
        self.roots: dict[str, Path] = {}

    def find_spec(self, name: str, path: object = None, target: object = None) -> ModuleSpec | None:
        """Return the spec of a module of a loaded folder, None for all others."""
        root = next(
            (root for root in self.roots if name == root or name.startswith(f"{root}.")), None
        )
        if root is None:
            return None
        place = self.roots[root].joinpath(*name.removeprefix(root).split(".")[1:])
        for file in (place / "__init__.py", place.with_name(f"{place.name}.py")):
            if file.is_file() and (name != root or file.name == "__init__.py"):
                return spec_from_file_location(name, file, loader=_Compiled(name, str(file)))
        if not place.is_dir():
            return None
        spec = ModuleSpec(name, None, is_package=True)
        spec.submodule_search_locations = [str(place)]
        return spec


_folders = _Folders()


def _run_file(path: Path) -> ModuleType:
    name = f"lesson_{next(_numbers)}_{path.stem}"
    spec = spec_from_file_location(name, path, loader=_Compiled(name, str(path)))
    if spec is None or spec.loader is None:
        raise InputError("not a Python file")
    module = sys.modules[name] = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def _run_folder(folder: Path) -> ModuleType:
    package = _importable_as(folder) or f"lesson_{next(_numbers)}_{folder.name.replace('.', '_')}"
    if _folders not in sys.meta_path:
        sys.meta_path.insert(0, _folders)
    _folders.roots[package] = folder
    before = {
        name: module
        for name, module in sys.modules.items()
        if name == package or name.startswith(f"{package}.")
    }
    for name in before:
        del sys.modules[name]
    try:
        return importlib.import_module(f"{package}.lesson")
    except BaseException:
        for name in [name for name in sys.modules if name.startswith(f"{package}.")]:
            del sys.modules[name]
        sys.modules.update(before)
        raise


def _importable_as(folder: Path) -> str | None:
    """Return the name under which Python imports a folder, None where it does not, or finds another
    one.
    """
    parts = [folder.name]
    top = folder
    while (top := top.parent) and (top / "__init__.py").is_file():
        parts.insert(0, top.name)
    name = ".".join(parts)
    init = folder / "__init__.py"
    try:
        spec = find_spec(name) if init.is_file() else None
    except (ImportError, ValueError):
        return None
    return (
        name if spec is not None and spec.origin and Path(spec.origin).resolve() == init else None
    )
