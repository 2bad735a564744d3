"""Nothing public is left over: what nobody calls in the workbench or a lesson has an example of its
own, which is run.
"""

import ast
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FILES = [path for part in ("workbench", "lessons") for path in (ROOT / part).rglob("*.py")]
TREES = {path: ast.parse(path.read_text(encoding="utf-8")) for path in FILES}
DEFINITION = ast.FunctionDef | ast.ClassDef


def uses(tree: ast.AST) -> Counter[str]:
    """How often each name is read, called or imported."""
    found: Counter[str] = Counter()
    for node in ast.walk(tree):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
            found[node.id] += 1
        elif isinstance(node, ast.Attribute):
            found[node.attr] += 1
        elif isinstance(node, ast.ImportFrom):
            found.update(alias.name for alias in node.names)
    return found


USES = sum((uses(tree) for tree in TREES.values()), Counter())


def left_over(tree: ast.Module) -> list[str]:
    """The functions, classes and constants of a module that nobody uses and that no example
    shows.
    """
    names = [
        node.name
        for node in tree.body
        if isinstance(node, DEFINITION)
        and not node.decorator_list
        and ">>>" not in (ast.get_docstring(node) or "")
    ]
    for node in tree.body:
        targets = node.targets if isinstance(node, ast.Assign) else ()
        names += [target.id for target in targets if isinstance(target, ast.Name)]
    exported = {"lesson", "__all__", "SCHEMA"}  # the last is for programs that read reports
    return [
        name
        for name in names
        if not USES[name] and name not in exported and not name.startswith("__")
    ]


def test_what_is_defined_is_used_or_shown():
    assert {
        str(path.relative_to(ROOT)): found
        for path, tree in TREES.items()
        if (found := left_over(tree))
    } == {}
