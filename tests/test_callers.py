"""Nothing public is left over: what nobody calls in the workbench or a lesson has an example of its
own, which is run.
"""

import ast
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FILES = [path for part in ("workbench", "lessons") for path in (ROOT / part).rglob("*.py")]
DEFINITION = ast.FunctionDef | ast.ClassDef


def uses(tree: ast.AST) -> Counter[str]:
    """How often each name is read, called or imported."""
    counts: Counter[str] = Counter()
    for node in ast.walk(tree):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
            counts[node.id] += 1
        elif isinstance(node, ast.Attribute):
            counts[node.attr] += 1
        elif isinstance(node, ast.ImportFrom):
            counts.update(alias.name for alias in node.names)
    return counts


def left_over(tree: ast.Module, used: Counter[str]) -> list[str]:
    """The functions, classes and constants of a module that are not among those used and that no
    example shows.
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
        if not used[name] and name not in exported and not name.startswith("__")
    ]


def test_what_is_defined_is_used_or_shown():
    trees = {path: ast.parse(path.read_text(encoding="utf-8")) for path in FILES}
    used: Counter[str] = Counter()
    for tree in trees.values():
        used.update(uses(tree))
    assert {
        str(path.relative_to(ROOT)): unused
        for path, tree in trees.items()
        if (unused := left_over(tree, used))
    } == {}
