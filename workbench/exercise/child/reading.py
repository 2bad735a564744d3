"""Reads what was handed in, in a process with limits: `python -I -S -B reading.py`, never imported.

Nothing of a hand-in is run here. But to read one costs what its author wants it to cost: a name of
400,000 parts keeps Python's parser busy for minutes. Requests and replies are lines of JSON. It
imports nothing of ours.
"""

import ast
import base64
import io
import json
import re
import sys
import tokenize
from collections.abc import Iterator
from typing import Any

SECONDS = 3
"""Processor time that one file may take, in whole seconds, as the kernel counts it."""
MEGABYTES = 512
MOST_IMPORTS = 200
MARK = re.compile(r"^[^\w\n]{0,20}Exercise (\w{1,100}), lesson \w", re.MULTILINE)
"""The first line of a starter: it says which exercise a file is handed in for."""
NOT_PARSED = (SyntaxError, ValueError, RecursionError)
"""What Python's parser says of what is no Python: also of NUL bytes, and of what is nested too
deep. What takes too much memory ends this process.
"""


class UnreadableError(Exception):
    """What was handed in is no text or no notebook; one line."""


def main() -> None:
    """Answer requests until there are no more."""
    import resource  # a browser, which reads in place, has none

    resource.setrlimit(resource.RLIMIT_AS, (MEGABYTES << 20, MEGABYTES << 20))
    for line in sys.stdin.buffer:
        used = resource.getrusage(resource.RUSAGE_SELF)
        most = int(used.ru_utime + used.ru_stime) + SECONDS
        resource.setrlimit(resource.RLIMIT_CPU, (most, resource.RLIM_INFINITY))
        request = json.loads(line)
        try:
            reply = read(request["file"], base64.b64decode(request["content"]))
        except UnreadableError as error:
            reply = {"unreadable": str(error)}
        sys.stdout.buffer.write(json.dumps(reply).encode() + b"\n")
        sys.stdout.buffer.flush()


def read(file: str, content: bytes) -> dict[str, Any]:
    """Return what is in a file: text, what it is for, defines and imports, or why it is no Python.

    Raises:
        UnreadableError: If it is no text, or a notebook that is none.
    """
    source = (
        of_notebook(file, content) if file.lower().endswith(".ipynb") else decoded(file, content)
    )
    facts: dict[str, Any] = {"source": source, "said": list(dict.fromkeys(MARK.findall(source)))}
    try:
        tree = ast.parse(source)
    except SyntaxError as error:
        return facts | {"broken": f"{file}, line {error.lineno}: {error.msg}"[:500]}
    except NOT_PARSED:
        return facts | {"broken": f"{file}: not a Python file"}
    imports = dict.fromkeys(name for name in imported(tree) if name.isidentifier())
    return facts | {
        "defines": sorted(set(names(tree.body))),
        "imports": list(imports)[:MOST_IMPORTS],
        "parts": list(parts(tree)),
    }


def decoded(file: str, content: bytes) -> str:
    """Return a text in the encoding that it declares, UTF-8 where it declares none.

    Raises:
        UnreadableError: If it is not in that encoding, or there is no such.
    """
    try:
        encoding, _ = tokenize.detect_encoding(io.BytesIO(content).readline)
        return io.TextIOWrapper(io.BytesIO(content), encoding).read()
    except (SyntaxError, LookupError, ValueError) as error:
        reason = str(error)
        if isinstance(error, UnicodeDecodeError) or re.search("utf-8|missing encoding", reason):
            reason = "not UTF-8"  # as Python says it depends on the line and on the version
        raise UnreadableError(
            f"{file}: cannot be read as text ({reason}): save it as UTF-8"
        ) from None


def imported(tree: ast.Module) -> Iterator[str]:
    """Yield the names of the modules that a text imports."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield node.module


def names(body: list[ast.stmt]) -> Iterator[str]:
    """Yield the names that statements give a value, without running them."""
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            yield node.name
            continue
        if isinstance(node, (ast.Assign, ast.AnnAssign)):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            yield from (
                name.id
                for target in targets
                for name in ast.walk(target)
                if isinstance(name, ast.Name)
            )
        elif isinstance(node, (ast.Import, ast.ImportFrom)):
            yield from (alias.asname or alias.name for alias in node.names)
        for inner in ("body", "orelse", "finalbody"):
            yield from names(getattr(node, inner, []))
        for handler in getattr(node, "handlers", []):
            yield from names(handler.body)


# what of other modules is used, and where ---------------------------------------------------------


DEFINITIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)


def parts(tree: ast.Module) -> Iterator[dict[str, Any]]:
    """Yield of each statement what it binds, which names it reads, and modules with lines.

    A module is told by its whole path, however it came by a shorter name: `import scipy as sp` and
    `sp.spatial.distance` use scipy.spatial.distance, and so do `from scipy import spatial`, and a
    text that is handed to `import_module`.
    """
    known = dict[str, str]()  # by the name in this file, the path that it stands for
    nodes = [
        node
        for node in ast.walk(tree)
        if isinstance(node, (ast.Import, ast.ImportFrom, ast.Assign))
    ]
    for node in sorted(nodes, key=lambda node: node.lineno):
        if isinstance(node, ast.Assign):
            path = path_of(node.value, known)
            known |= (
                {}
                if path is None
                else {target.id: path for target in node.targets if isinstance(target, ast.Name)}
            )
        else:
            known |= dict(bound(node))
    for statement in tree.body:
        defines = isinstance(statement, DEFINITIONS)
        imports = isinstance(statement, (ast.Import, ast.ImportFrom))
        read = {node.id for node in ast.walk(statement) if isinstance(node, ast.Name)}
        yield {
            "binds": sorted(set(names([statement]))),
            "reads": sorted(read),
            "defines": defines,
            "runs": not defines and not imports,
            "uses": [list(use) for use in dict.fromkeys(used(statement, known))],
        }


def bound(node: ast.Import | ast.ImportFrom) -> Iterator[tuple[str, str]]:
    """Yield the names that an import gives a value, each with the path that it stands for."""
    for alias in node.names:
        if isinstance(node, ast.ImportFrom):
            if node.module and not node.level:
                yield alias.asname or alias.name, f"{node.module}.{alias.name}"
        else:
            yield (
                alias.asname or alias.name.partition(".")[0],
                alias.name if alias.asname else alias.name.partition(".")[0],
            )


def used(statement: ast.stmt, known: dict[str, str]) -> Iterator[tuple[str, int]]:
    """Yield paths of modules, and of what is in them, that a statement uses, with lines."""
    for node in ast.walk(statement):
        if isinstance(node, ast.Import):
            yield from ((alias.name, node.lineno) for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield from ((f"{node.module}.{alias.name}", node.lineno) for alias in node.names)
        elif isinstance(node, (ast.Attribute, ast.Call, ast.Name)):
            path = path_of(node, known)
            if path is not None:
                yield path, node.lineno


def path_of(node: ast.expr, known: dict[str, str]) -> str | None:
    """Return the path of a module that an expression stands for: a name, an attribute, a call."""
    behind = list[str]()
    while isinstance(node, ast.Attribute):
        behind.append(node.attr)
        node = node.value
    start = None
    if isinstance(node, ast.Name):
        start = known.get(node.id)
    elif isinstance(node, ast.Call) and node.args:
        start = _called_for(node, known)
    return None if start is None else ".".join([start, *reversed(behind)])


def _called_for(call: ast.Call, known: dict[str, str]) -> str | None:
    name = path_of(call.func, known)
    text = text_of(call.args[-1])
    name = call.func.id if name is None and isinstance(call.func, ast.Name) else name
    if text is None:
        return None
    if name in ("importlib.import_module", "__import__") and len(call.args) == 1:
        return text
    path = path_of(call.args[0], known) if name == "getattr" and len(call.args) == 2 else None
    return None if path is None else f"{path}.{text}"


def text_of(node: ast.expr) -> str | None:
    """Return the text that an expression is, also put together of pieces; or None."""
    if isinstance(node, ast.Constant):
        return node.value if isinstance(node.value, str) else None
    pieces = list[str | None]()
    while isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        pieces.append(text_of(node.right) if isinstance(node.right, ast.Constant) else None)
        node = node.left
    if not isinstance(node, ast.Constant):
        return None
    pieces.append(text_of(node))
    return None if None in pieces else "".join(reversed([piece or "" for piece in pieces]))


# notebooks ----------------------------------------------------------------------------------------

DEFINING = (ast.Import, ast.ImportFrom, ast.FunctionDef, ast.ClassDef)
TAGS = {"exercise", "solution", "workbench"}
"""Where a cell has one of these tags, what it defines counts, wherever else it is defined too."""


def of_notebook(file: str, content: bytes) -> str:
    """Return imports, definitions and constants of code cells, each in its line of all.

    What else is in the cells was written to be looked at. Of several definitions the last counts, a
    tagged one first.

    Raises:
        UnreadableError: If it is no notebook.
    """
    try:
        cells = [
            cell
            for cell in json.loads(content.decode("utf-8-sig"))["cells"]
            if cell["cell_type"] == "code"
        ]
        texts = ["".join(cell["source"]) for cell in cells]
        tagged = [bool(TAGS & set(cell.get("metadata", {}).get("tags", []))) for cell in cells]
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        raise UnreadableError(f"{file}: not a notebook") from None
    ordered = [
        text
        for is_tagged in (False, True)
        for text, tag in zip(texts, tagged, strict=True)
        if tag is is_tagged
    ]
    kept: list[str] = []
    for text in ordered:
        lines = [
            "" if line.lstrip().startswith(("%", "!", "?")) else line for line in text.splitlines()
        ]
        try:
            body = ast.parse("\n".join(lines)).body
        except NOT_PARSED:
            kept += lines if text is ordered[-1] else [""] * len(lines)
            continue
        wanted = set[int]()
        for node in body:
            if isinstance(node, DEFINING) or is_constant(node):
                first = min([node.lineno, *(d.lineno for d in getattr(node, "decorator_list", []))])
                wanted |= set(range(first, (node.end_lineno or first) + 1))
        kept += [line if number in wanted else "" for number, line in enumerate(lines, 1)]
    return "\n".join(kept) + "\n"


def is_constant(node: ast.stmt) -> bool:
    """Whether a statement binds a name without running anything of the student's."""
    if not isinstance(node, (ast.Assign, ast.AnnAssign)) or node.value is None:
        return False
    calls = [call.func for call in ast.walk(node.value) if isinstance(call, ast.Call)]
    made = {
        "array",
        "eye",
        "zeros",
        "ones",
        "diag",
        "radians",
        "deg2rad",
        "sqrt",
        "finfo",
        "float64",
    }
    return all(
        isinstance(call, ast.Attribute) and call.attr in made for call in calls
    ) or isinstance(node.value, ast.Lambda)


if __name__ == "__main__":
    main()
