"""The ruler: what is to become less, counted in the source. A ceiling may only fall."""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = ("workbench", "lessons", "tests")
MOST_LINES = 400
BY_STUDENTS = ("tests/exercise/solutions", "tests/exercise/strangers", "tests/authoring/old")
"""Written as students write, or as an earlier version wrote it."""


def form(node: ast.AST) -> str:
    """Return of what kinds an expression is made, whatever its names and numbers are."""
    if isinstance(node, ast.Constant):
        return type(node.value).__name__
    parts = [child for child in ast.iter_child_nodes(node) if not isinstance(child, ast.Load)]
    return f"{type(node).__name__}({', '.join(map(form, parts))})"


def several(node: ast.AST) -> bool:
    """Whether a statement gives several names values of several expressions: `a, b = f(), g()`."""
    if not isinstance(node, ast.Assign) or not isinstance(node.value, ast.Tuple):
        return False
    return any(isinstance(target, ast.Tuple) for target in node.targets)


def unlike(node: ast.AST) -> bool:
    """Whether such a statement's expressions are of unlike kinds: `a, b = f(), 2`."""
    if not isinstance(node, ast.Assign) or not isinstance(node.value, ast.Tuple):
        return False
    return several(node) and len(set(map(form, node.value.elts))) > 1


NAMELESS = {"now", "found", "one", "said", "what", "there", "who"}


def nameless(node: ast.AST) -> bool:
    """Whether a variable or a parameter has a name that says nothing of what it holds."""
    if isinstance(node, ast.arg):
        return node.arg in NAMELESS
    return isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store) and node.id in NAMELESS


def nested(node: ast.AST) -> bool:
    """Whether an inline `if` holds another one."""
    inner = ast.walk(node) if isinstance(node, ast.IfExp) else ()
    return any(isinstance(part, ast.IfExp) and part is not node for part in inner)


def counted(folder: str) -> dict[str, int]:
    """How often each of them stands in a folder, and how many files are too long."""
    rules = {
        "several": several,
        "unlike": unlike,
        "nested": nested,
        "nameless": nameless,
    }
    counts = dict.fromkeys((*rules, "long files"), 0)
    for path in (ROOT / folder).rglob("*.py"):
        if str(path.relative_to(ROOT)).startswith(BY_STUDENTS):
            continue
        text = path.read_text(encoding="utf-8")
        counts["long files"] += text.count("\n") > MOST_LINES
        for node in ast.walk(ast.parse(text)):
            for name, rule in rules.items():
                counts[name] += rule(node)
    return counts


CEILINGS: dict[str, dict[str, int]] = {
    "workbench": {
        "several": 321,
        "unlike": 7,
        "nested": 0,
        "nameless": 18,
        "long files": 0,
    },
    "lessons": {
        "several": 281,
        "unlike": 3,
        "nested": 1,
        "nameless": 18,
        "long files": 0,
    },
    "tests": {
        "several": 256,
        "unlike": 0,
        "nested": 0,
        "nameless": 4,
        "long files": 0,
    },
}


@pytest.mark.parametrize("folder", FOLDERS)
def test_what_the_ruler_counts_only_falls(folder):
    over = {name: n for name, n in counted(folder).items() if n > CEILINGS[folder][name]}
    assert over == {}, "more than before: the ceiling falls, and is never raised"


def test_the_ruler_sees_what_it_counts():
    assert several(ast.parse("a, b = f(), g()").body[0])
    assert not several(ast.parse("a, b = f()").body[0])
    assert unlike(ast.parse("a, b = f(), g").body[0])
    assert not unlike(ast.parse("a, b = f(x), g(y)").body[0])
    assert not unlike(ast.parse("a, b = 0.5, 1.5").body[0])
    assert not unlike(ast.parse("a, b = f()").body[0])
    assert any(map(nameless, ast.walk(ast.parse("found = f()"))))
    assert any(map(nameless, ast.walk(ast.parse("lambda who: 0"))))
    assert not any(map(nameless, ast.walk(ast.parse("f(found, who=1)"))))
    assert nested(ast.parse("a if b else c if d else e", mode="eval").body)
    assert not nested(ast.parse("a if b else c", mode="eval").body)
