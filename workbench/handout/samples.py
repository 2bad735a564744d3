"""A file as a student would hand it in that earns everything: another right solution of ours, with all that it calls."""

import ast
import importlib
import importlib.util
import inspect
import sys
from dataclasses import dataclass, field
from pathlib import Path

from workbench.exercise.forbidden import forbidden_use
from workbench.exercise.model import Exercise, Function
from workbench.exercise.reading import Reader
from workbench.exercise.sandbox.python import ALLOWED
from workbench.exercise.starter import starter
from workbench.exercise.submission import submission

OURS = ("workbench", "lessons")


def right(exercise: Exercise) -> str:
    """Return the text of a file that solves an exercise and needs nothing but what a student may use.

    Raises:
        LookupError: If none of our solutions can be written without the workbench.
    """
    troubles = []
    for function in (*exercise.alternatives, exercise.reference):
        try:
            text = _head(exercise) + _written(function, exercise.name)
            if not _is_forbidden(text, exercise):
                return text
            troubles.append(f"{function.__name__} uses what the exercise forbids")
        except LookupError as error:
            troubles.append(str(error))
    raise LookupError(f"{exercise.name}: {'; '.join(troubles)}")


def _is_forbidden(text: str, exercise: Exercise) -> bool:
    with Reader() as reader:
        return forbidden_use(submission("sample.py", text.encode(), lambda name: None, reader), exercise) != ""


def empty(exercise: Exercise) -> str:
    """Return the text of a file that earns nothing: the starter as it is handed out."""
    return starter(exercise)


def _head(exercise: Exercise) -> str:
    return (
        f'"""Exercise {exercise.name}, lesson {exercise.lesson}.\n\nA sample that earns full marks, for the teacher: do not '
        'hand it out.\n"""\n\n'
    )


@dataclass
class _Written:
    """What is written so far: imports, and definitions by name in the order in which they are needed."""

    imports: dict[str, None] = field(default_factory=dict)
    defined: dict[str, str] = field(default_factory=dict)
    places: dict[str, str] = field(default_factory=dict)  # of each definition, the module it comes from

    def name_in(self, module: str, name: str) -> None:
        """Write a top-level name of one of our modules, and what it needs."""
        node = _definition(module, name)
        if node is None:
            raise LookupError(f"{name} is not found in {module}")
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            self._imported(node, name, module)
            return
        if self.places.setdefault(name, module) != module:
            raise LookupError(f"{name} is in {module} and in {self.places[name]}")
        if name in self.defined:
            return
        self.defined[name] = ""  # it may call itself
        node = self._plain(node, module)
        text = ast.unparse(ast.fix_missing_locations(node))
        del self.defined[name]
        self.defined[name] = text

    def _imported(self, node: ast.Import | ast.ImportFrom, name: str, module: str) -> None:
        alias = next(one for one in node.names if (one.asname or one.name.partition(".")[0]) == name)
        source = alias.name if isinstance(node, ast.Import) else node.module or ""
        top = source.partition(".")[0]
        if top in OURS and isinstance(node, ast.ImportFrom):
            whole = f"{source}.{alias.name}"
            if importlib.util.find_spec(whole) if _is_package(source) else None:
                raise LookupError(f"{name} in {module} is used as a module")
            if alias.name != name:
                raise LookupError(f"{alias.name} is renamed in {module}")
            self.name_in(source, alias.name)
        elif top in ALLOWED or top in sys.stdlib_module_names:
            kept = ast.Import([alias]) if isinstance(node, ast.Import) else ast.ImportFrom(source, [alias], 0)
            self.imports[ast.unparse(kept)] = None
        else:
            raise LookupError(f"{module} needs {source}")

    def _plain(self, node: ast.stmt, module: str) -> ast.stmt:
        """Return a definition without our decorators and annotations; write what it needs."""
        node = _Bare(module).visit(node)
        own = {part.arg for part in ast.walk(node) if isinstance(part, ast.arg)}
        if isinstance(node, ast.FunctionDef):
            own |= {p.id for p in ast.walk(node) if isinstance(p, ast.Name) and isinstance(p.ctx, ast.Store)}
        for part in ast.walk(node):
            if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Load) and part.id not in own:
                if _definition(module, part.id) is not None:
                    self.name_in(module, part.id)
            elif isinstance(part, ast.Call) and isinstance(part.func, ast.Name) and part.func.id in ("globals", "eval"):
                raise LookupError(f"{module} looks names up")
            for name, value in ast.iter_fields(part):
                self._through_modules(part, name, value)
        return node

    def _through_modules(self, parent: ast.AST, field_name: str, value: object) -> None:
        """Write what is taken from a module of ours, `alignment.align_rigid`, under its bare name."""
        if isinstance(value, list):
            for k, one in enumerate(value):
                if taken := _of_ours(one):
                    value[k] = self._bare(*taken)
        elif taken := _of_ours(value):
            setattr(parent, field_name, self._bare(*taken))

    def _bare(self, module: str, name: str) -> ast.Name:
        self.name_in(module, name)
        return ast.Name(name, ast.Load())


class _Ours(str):
    """Stands in an expression, as a constant, for a module of ours."""


def _of_ours(value: object) -> tuple[str, str] | None:
    """Return the module of ours and the name in it that an expression takes, if it is that."""
    if (
        isinstance(value, ast.Attribute)
        and isinstance(value.value, ast.Constant)
        and isinstance(value.value.value, _Ours)
    ):
        return str(value.value.value), value.attr
    return None


class _Bare(ast.NodeTransformer):
    """Takes annotations, docstrings and our own decorators away, and marks what is taken from modules of ours."""

    def __init__(self, module: str):
        self._module = module

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        node.returns, node.decorator_list = None, [one for one in node.decorator_list if not self._is_ours(one)]
        for argument in ast.walk(node.args):
            if isinstance(argument, ast.arg):
                argument.annotation = None
        if ast.get_docstring(node) is not None:
            node.body = node.body[1:] or [ast.Pass()]
        return self.generic_visit(node)

    def visit_AnnAssign(self, node: ast.AnnAssign) -> ast.AST:
        if node.value is None:
            raise LookupError(f"{self._module} declares fields")
        return self.generic_visit(ast.Assign([node.target], node.value))

    def visit_Attribute(self, node: ast.Attribute) -> ast.AST:
        whole = _module_named(self._module, node.value.id) if isinstance(node.value, ast.Name) else None
        if whole is None:
            return self.generic_visit(node)
        return ast.Attribute(ast.Constant(_Ours(whole)), node.attr, node.ctx)

    def _is_ours(self, decorator: ast.expr) -> bool:
        name = decorator.func if isinstance(decorator, ast.Call) else decorator
        return isinstance(name, ast.Name) and name.id in ("contract", "alternative")


def _written(function: Function, name: str) -> str:
    module, own = function.__module__, function.__name__
    written = _Written()
    written.name_in(module, own)
    body = "\n\n\n".join(written.defined.values())
    if own != name:
        if name in written.defined:
            raise LookupError(f"{own} calls {name}")
        body += f"\n\n\n{name} = {own}"
    return "\n".join(written.imports) + f"\n\n\n{body}\n"


def _tree(module: str) -> ast.Module:
    return ast.parse(Path(inspect.getfile(importlib.import_module(module))).read_text(encoding="utf-8"))


def _definition(module: str, name: str) -> ast.stmt | None:
    """Return the top-level statement of a module that gives a name its value."""
    found = None
    for node in _tree(module).body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and node.name == name:
            found = node
        elif isinstance(node, (ast.Assign, ast.AnnAssign)):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            if any(isinstance(part, ast.Name) and part.id == name for one in targets for part in ast.walk(one)):
                found = node
        elif isinstance(node, (ast.Import, ast.ImportFrom)) and any(
            (one.asname or one.name.partition(".")[0]) == name for one in node.names
        ):
            found = node
    return found


def _module_named(module: str, name: str) -> str | None:
    """Return the module of ours that a name stands for in a module, if it is one."""
    node = _definition(module, name)
    if not isinstance(node, ast.ImportFrom) or (node.module or "").partition(".")[0] not in OURS:
        return None
    alias = next(one for one in node.names if (one.asname or one.name) == name)
    whole = f"{node.module}.{alias.name}"
    return whole if _is_package(node.module or "") and importlib.util.find_spec(whole) is not None else None


def _is_package(name: str) -> bool:
    return importlib.util.find_spec(name).submodule_search_locations is not None  # type: ignore[union-attr]
