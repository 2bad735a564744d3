"""What can be changed in a module's source, at which line, and which tests are that module's own.

Used by `mutation`. The changes are those of `tests.exercise.operators`, which knows the slips of
students, and those of programmers: a condition negated, a truth value turned round, a result or a
statement left out. Words (f-strings), annotations and decorators stay as they are.
"""

import ast
import functools
import textwrap
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from tests.exercise.operators import changes

ROOT = Path(__file__).resolve().parents[2]
SKIPPED_FIELDS = {"annotation", "returns", "decorator_list", "type_params"}
OPPOSITE: dict[type, type[ast.cmpop]] = {
    ast.Is: ast.IsNot,
    ast.IsNot: ast.Is,
    ast.In: ast.NotIn,
    ast.NotIn: ast.In,
}
COMMUTE = {"min", "max", "minimum", "maximum", "isclose", "hypot"}
SLOW_KINDS = ("browser", "benchmarks")


@dataclass(frozen=True, order=True)
class Mutant:
    """A module with one change.

    Attributes:
        module: The module's file, relative to the project.
        line: Where the changed statement begins.
        last: Where the changed place ends.
        function: The innermost function or class around it, or "module".
        operator: The kind of change.
        change: What stood there, and what stands there now.
        start: First byte of what is replaced.
        end: The byte after what is replaced.
        text: What is put there.
        nth: Which it is of those with the same words in the same function.
    """

    module: str
    line: int
    last: int
    function: str
    operator: str
    change: str
    start: int
    end: int
    text: str
    nth: int = 1

    @property
    def name(self) -> str:
        """Name the mutant by the module's stem, so that the name outlives a move of the module."""
        nth = f" ({self.nth})" if self.nth > 1 else ""
        return f"{Path(self.module).stem}.{self.function}: {self.operator}: {self.change}{nth}"

    def source(self, root: Path = ROOT) -> str:
        """Return the module's changed source."""
        data = (root / self.module).read_bytes()
        return (data[: self.start] + self.text.encode() + data[self.end :]).decode()


def mutants(path: Path, root: Path = ROOT) -> list[Mutant]:
    """Return all mutants of a module that can be parsed, in the order of the source."""
    data = path.read_bytes()
    starts = [0]
    for line in data.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    all_mutants = []
    for node, new, operator, function in _places(ast.parse(data)):
        start = starts[node.lineno - 1] + node.col_offset
        end = starts[node.end_lineno - 1] + node.end_col_offset
        text = _text(new, node.col_offset)
        old = " ".join(data[start:end].decode().split())
        if " ".join(text.split()).strip("()") == old.strip("()"):
            continue
        change = f"{_short(old)} → {_short(' '.join(text.split()))}"
        all_mutants.append(
            Mutant(
                module=path.relative_to(root).as_posix(),
                line=node.lineno,
                last=(node.end_lineno or node.lineno)
                if isinstance(node, ast.expr)
                else node.lineno,
                function=function,
                operator=operator,
                change=change,
                start=start,
                end=end,
                text=text,
            )
        )
    seen = Counter[str]()
    for k, mutant in enumerate(sorted(all_mutants)):
        seen[mutant.name] += 1
        all_mutants[k] = replace(mutant, nth=seen[mutant.name])
    return all_mutants


def parses(mutant: Mutant) -> bool:
    """Return whether the changed module is Python."""
    try:
        ast.parse(mutant.source())
    except SyntaxError:
        return False
    return True


def _places(tree: ast.Module) -> Iterator[tuple]:
    """Yield each node that has a place, what could stand there, the operator, the function."""
    waiting: list[tuple[ast.AST, str]] = [(tree, "module")]
    while waiting:
        parent, function = waiting.pop()
        for field, value in ast.iter_fields(parent):
            if field in SKIPPED_FIELDS or isinstance(parent, ast.JoinedStr):
                continue
            for node in value if isinstance(value, list) else [value]:
                if not isinstance(node, ast.AST) or _is_for_types(node):
                    continue
                named = isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef)
                waiting.append((node, node.name if named else function))
                if isinstance(node, ast.expr | ast.stmt):
                    for operator, new in _all_changes(parent, field, node):
                        yield node, new, operator, function


def _is_for_types(node: ast.AST) -> bool:
    """Whether nothing runs what stands here: what is imported for a checker of types alone."""
    return isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"


def _all_changes(parent: ast.AST, field: str, node: ast.AST) -> Iterator[tuple[str, ast.AST]]:
    for operator, new in changes(node):
        if "_ones_of" in ast.unparse(new):  # a helper that only exercises have
            continue
        if operator == "order" and isinstance(node, ast.Call) and _name(node.func) in COMMUTE:
            continue
        yield operator, new
    if field in {"test", "ifs"} and isinstance(node, ast.expr):
        yield "condition", ast.UnaryOp(ast.Not(), node)
    match node:
        case ast.Constant(bool() as value):
            yield "truth", ast.Constant(not value)
        case ast.Compare(left, [op], [right]) if type(op) in OPPOSITE:
            yield "condition", ast.Compare(left, [OPPOSITE[type(op)]()], [right])
        case ast.Compare(left, ops, comparators) if len(ops) > 1:
            yield "case", ast.Compare(left, ops[:-1], comparators[:-1])
            yield "case", ast.Compare(comparators[0], ops[1:], comparators[1:])
        case ast.Return(value) if value is not None and ast.unparse(value) != "None":
            yield "result", ast.Return(None)
        case (
            ast.Assign([ast.Attribute()], _)
            | ast.Raise()
            | ast.Delete()
            | ast.Expr(ast.YieldFrom())
        ):
            yield "statement", ast.Pass()
        case ast.AugAssign(target, ast.Add() | ast.Sub() as op, value):
            yield (
                "sign",
                ast.AugAssign(target, ast.Sub() if isinstance(op, ast.Add) else ast.Add(), value),
            )


def _name(node: ast.AST) -> str:
    return node.attr if isinstance(node, ast.Attribute) else getattr(node, "id", "")


def _text(new: ast.AST, indent: int) -> str:
    text = ast.unparse(ast.fix_missing_locations(new))
    if isinstance(new, ast.stmt):
        return textwrap.indent(text, " " * indent).lstrip()
    return (
        text if isinstance(new, ast.Constant | ast.Name | ast.Call | ast.Attribute) else f"({text})"
    )


def _short(text: str) -> str:
    return text if len(text) <= 60 else f"{text[:40]}…{text[-19:]}"


# the tests of a module ----------------------------------------------------------------------------


def own_tests(path: Path, root: Path = ROOT) -> list[list[str]]:
    """Return the files of tests that are a module's own, and the others of its layer's folder.

    Of those that import it: the one with its name, else those of the folder with the name of its
    layer, else all. Where none imports it: those with its name, else all of its layer's folder.
    """
    layer = path.relative_to(root).parts[1].removesuffix(".py")
    importing = [test for test in _test_files(root) if _imports(test, path, root)]
    beside = [test for test in importing if layer in test.relative_to(root).parts]
    named = [
        test for test in beside or importing if f"{test.stem}_".startswith(f"test_{path.stem}_")
    ]
    by_name = [
        test for test in _test_files(root) if f"{test.stem}_".startswith(f"test_{path.stem}_")
    ]
    folder = [test for test in _test_files(root) if layer in test.relative_to(root).parts]
    own = named or beside or importing or by_name or folder
    more = [test for test in folder if test not in own]
    return [[test.relative_to(root).as_posix() for test in tests] for tests in (own, more)]


@functools.cache
def _test_files(root: Path) -> list[Path]:
    files = sorted((root / "tests").rglob("test_*.py"))
    return [file for file in files if not set(SLOW_KINDS) & set(file.parts)]


@functools.cache
def _imported(test: Path) -> frozenset[tuple[str, str]]:
    """Return what a file imports: (module, name), the name being empty for `import module`."""
    imports = set()
    for node in ast.walk(ast.parse(test.read_bytes())):
        if isinstance(node, ast.Import):
            imports |= {(alias.name, "") for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            imports |= {(node.module, alias.name) for alias in node.names}
    return frozenset(imports)


def _imports(test: Path, path: Path, root: Path) -> bool:
    """Return whether a test imports a module, or one of its names from the package around it."""
    parts = path.relative_to(root).with_suffix("").parts
    module = ".".join(parts)
    package = ".".join(parts[:-1])
    return any(
        module in {source, f"{source}.{name}"}
        or (source == package and len(parts) > 3 and name in _defined(path))
        for source, name in _imported(test)
    )


@functools.cache
def _defined(path: Path) -> frozenset[str]:
    body = ast.parse(path.read_bytes()).body
    return frozenset(n.name for n in body if isinstance(n, ast.FunctionDef | ast.ClassDef))
