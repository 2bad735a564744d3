"""What a student handed in, read once, before anything of it runs: text, and the modules beside it that it imports."""

import ast
import io
import json
import os
import re
import stat
import tokenize
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from workbench.errors import InputError

MOST_BYTES = 1 << 20
MOST_MODULES = 20
SUFFIXES = (".py", ".ipynb")
MARK = re.compile(r"^\W*Exercise (\w+), lesson \w", re.MULTILINE)
"""The first line of a starter: it says which exercise a file is handed in for."""


@dataclass(frozen=True)
class Submission:
    """One file of a student, as it was when it was read.

    Attributes:
        file: How it is named to people.
        source: Its text; of a notebook, its definitions.
        modules: The modules beside it that it imports, text by name.
    """

    file: str
    source: str
    modules: dict[str, str] = field(default_factory=dict)

    def marked(self) -> list[str]:
        """Return the exercises that the file says it is for, by a starter's first line, or else by its name."""
        said = list(dict.fromkeys(MARK.findall(self.source)))
        named = re.search(r"my_(\w+?)(?:[ .(-].*)?\.\w+$", Path(self.file).name)
        return said or ([named[1]] if named else [Path(self.file).stem])

    def defined(self) -> set[str]:
        """Return the names that the file gives a value, without running it.

        Raises:
            InputError: If it is not Python; names the line.
        """
        try:
            tree = ast.parse(self.source)
        except SyntaxError as error:
            raise InputError(f"{self.file}, line {error.lineno}: {error.msg}") from None
        except (ValueError, RecursionError, MemoryError):  # NUL bytes; nested too deep
            raise InputError(f"{self.file}: not a Python file") from None
        return set(_names(tree.body))


def read_submission(path: Path) -> Submission:
    """Read a file of one's own, and what it imports from beside it.

    Raises:
        InputError: If it is no file, is too large, or is no text; one line.
    """

    def beside(name: str) -> bytes | None:
        found = path.with_name(name)
        return content(found) if os.path.lexists(found) else None

    return submission(path.name, content(path), beside)


def submission(file: str, data: bytes, beside: Callable[[str], bytes | None]) -> Submission:
    """Return what the bytes of a file are.

    Args:
        file: Its name; a notebook ends in .ipynb.
        data: What is in it.
        beside: Gives what is in a file beside it by its name, None where there is none.

    Raises:
        InputError: If they are no text; one line.
    """
    source = _of_notebook(file, data) if file.lower().endswith(".ipynb") else _decoded(file, data)
    modules: dict[str, str] = {}
    _imported(source, beside, modules)
    return Submission(file, source, modules)


def content(path: Path, root: Path | None = None) -> bytes:
    """Return what is in a file of bounded size, and never wait for a pipe or a device.

    Raises:
        InputError: As `read_submission`.
    """
    try:
        real = path.resolve(strict=True)
        if root is not None and not real.is_relative_to(root.resolve()):
            raise InputError(f"{path.name}: a link that leads out of the folder")
        held = os.open(real, os.O_RDONLY | os.O_CLOEXEC | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOCTTY", 0))
        with os.fdopen(held, "rb") as file:
            if not stat.S_ISREG(os.fstat(held).st_mode):
                raise InputError(f"{path.name}: no file, but a pipe, a device or a folder")
            data = file.read(MOST_BYTES + 1)
    except (OSError, RuntimeError) as error:  # a link that leads to itself is a RuntimeError
        raise InputError(f"{path}: cannot be read as text ({getattr(error, 'strerror', None) or error})") from None
    if len(data) > MOST_BYTES:
        raise InputError(f"{path.name}: more than {MOST_BYTES >> 20} MB")
    return data


def _decoded(file: str, data: bytes) -> str:
    try:
        encoding, _ = tokenize.detect_encoding(io.BytesIO(data).readline)
        return io.TextIOWrapper(io.BytesIO(data), encoding).read()
    except (SyntaxError, LookupError, UnicodeDecodeError) as error:
        said = "not UTF-8" if isinstance(error, UnicodeDecodeError) or "utf-8" in str(error) else str(error)
        raise InputError(f"{file}: cannot be read as text ({said}): save it as UTF-8") from None


def _imported(source: str, beside: Callable[[str], bytes | None], found: dict[str, str]) -> None:
    """Add the modules beside a text that it imports, and those that they import."""
    try:
        tree = ast.parse(source)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return  # whoever runs it says why not
    wanted = [alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names]
    wanted += [node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module]
    for name in dict.fromkeys(wanted):
        if name in found or len(found) >= MOST_MODULES or not name.isidentifier():
            continue
        data = beside(f"{name}.py")
        if data is not None:
            found[name] = _decoded(f"{name}.py", data)
            _imported(found[name], beside, found)


def _names(body: list[ast.stmt]) -> Iterator[str]:
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            yield node.name
        elif isinstance(node, (ast.Assign, ast.AnnAssign)):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            yield from (name.id for target in targets for name in ast.walk(target) if isinstance(name, ast.Name))
        elif isinstance(node, (ast.Import, ast.ImportFrom)):
            yield from (alias.asname or alias.name for alias in node.names)
        for inner in ("body", "orelse", "finalbody") if not isinstance(node, (ast.FunctionDef, ast.ClassDef)) else ():
            yield from _names(getattr(node, inner, []))
        for handler in getattr(node, "handlers", []):
            yield from _names(handler.body)


# notebooks ------------------------------------------------------------------------------------------------------------

DEFINING = (ast.Import, ast.ImportFrom, ast.FunctionDef, ast.ClassDef)
TAGS = {"exercise", "solution", "workbench"}
"""Where a cell has one of these tags, what it defines counts, wherever else it is defined too."""


def _of_notebook(file: str, data: bytes) -> str:
    """Return the imports, definitions and constants of the code cells, each in its line of all cells joined.

    What else is in the cells was written to be looked at. Of several definitions the last counts, a tagged one first.
    """
    try:
        cells = [cell for cell in json.loads(data.decode("utf-8-sig"))["cells"] if cell["cell_type"] == "code"]
        texts = ["".join(cell["source"]) for cell in cells]
        tagged = [bool(TAGS & set(cell.get("metadata", {}).get("tags", []))) for cell in cells]
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        raise InputError(f"{file}: not a notebook") from None
    ordered = [text for is_tagged in (False, True) for text, tag in zip(texts, tagged, strict=True) if tag is is_tagged]
    kept: list[str] = []
    for text in ordered:
        plain = "\n".join("" if line.lstrip().startswith(("%", "!", "?")) else line for line in text.splitlines())
        try:
            body = ast.parse(plain).body
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            kept += plain.splitlines() if text is ordered[-1] else [""] * len(plain.splitlines())
            continue
        lines = plain.splitlines()
        wanted = set()
        for node in body:
            if isinstance(node, DEFINING) or _is_constant(node):
                first = min([node.lineno, *(d.lineno for d in getattr(node, "decorator_list", []))])
                wanted |= set(range(first, (node.end_lineno or first) + 1))
        kept += [line if number in wanted else "" for number, line in enumerate(lines, 1)]
    return "\n".join(kept) + "\n"


def _is_constant(node: ast.stmt) -> bool:
    if not isinstance(node, (ast.Assign, ast.AnnAssign)) or node.value is None:
        return False
    calls = [call.func for call in ast.walk(node.value) if isinstance(call, ast.Call)]
    made = {"array", "eye", "zeros", "ones", "diag", "radians", "deg2rad", "sqrt", "finfo", "float64"}
    return all(isinstance(call, ast.Attribute) and call.attr in made for call in calls) or isinstance(
        node.value, ast.Lambda
    )
