"""The docstrings of geometry and algorithms are contracts: what is returned, what goes in, what is
raised, whence it is.
"""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PARTS = [ROOT / "workbench" / part for part in ("geometry", "algorithms")]
FOUND = sorted(path for part in PARTS for path in part.rglob("[!_]*.py"))
# an old name has no text of its own
MODULES = [path for path in FOUND if "import *" not in path.read_text(encoding="utf-8")]

VERBS = ("Return", "Yield", "Raise", "Write")  # what a function can do for its caller

NO_PAPER = {
    "algorithms.robust.models": "a table of functions that name their sources themselves",
    "geometry.upright": "a drawing stood up in space, found in no paper",
    "geometry.polylines": "points in a row, found in no paper",
    "geometry.meshes.repair": "bookkeeping on faces, found in no paper",
}


def name_of(path: Path) -> str:
    return ".".join(path.relative_to(ROOT / "workbench").with_suffix("").parts)


def public(body: list[ast.stmt]) -> list[ast.FunctionDef]:
    return [
        node for node in body if isinstance(node, ast.FunctionDef) and not node.name.startswith("_")
    ]


def functions() -> dict[str, ast.FunctionDef]:
    """All public functions of both packages, and public methods, by name."""
    by_name = {}
    for path in MODULES:
        body = ast.parse(path.read_text(encoding="utf-8")).body
        by_name |= {f"{name_of(path)}.{node.name}": node for node in public(body)}
        for owner in body:
            if isinstance(owner, ast.ClassDef) and not owner.name.startswith("_"):
                by_name |= {
                    f"{name_of(path)}.{owner.name}.{node.name}": node for node in public(owner.body)
                }
    return by_name


FUNCTIONS = functions()


def text_of(node: ast.FunctionDef) -> str:
    text = ast.get_docstring(node)
    assert text, "has no docstring"
    return text


def arguments(node: ast.FunctionDef) -> list[str]:
    """What a caller hands in, in order."""
    named = [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs]
    return [argument.arg for argument in named if argument.arg not in ("self", "cls")]


def section(text: str, heading: str) -> str:
    """The indented lines below a heading of a docstring; empty where it has none."""
    match = re.search(rf"^{heading}:\n((?: +.*\n?|\n(?= ))+)", text, re.MULTILINE)
    return match[1] if match else ""


def raised(node: ast.FunctionDef) -> set[str]:
    """The errors that a function raises in its own body."""
    thrown = [part.exc for part in ast.walk(node) if isinstance(part, ast.Raise) and part.exc]
    return {
        part.func.id
        for part in thrown
        if isinstance(part, ast.Call) and isinstance(part.func, ast.Name)
    }


@pytest.mark.parametrize("name", FUNCTIONS)
def test_the_first_line_says_what_is_done_or_returned(name):
    node = FUNCTIONS[name]
    text = text_of(node)
    first = text.split("\n\n")[0]
    assert first.endswith((".", ":")), f"{name}: the first line is no sentence: {first}"
    if any(isinstance(mark, ast.Name) and mark.id == "property" for mark in node.decorator_list):
        return  # a property is named like what it is
    assert first.split()[0] in VERBS, f"{name}: begin with one of {VERBS}, not: {first}"


@pytest.mark.parametrize("name", FUNCTIONS)
def test_arguments_that_are_explained_are_those_of_the_signature(name):
    node = FUNCTIONS[name]
    listed = re.findall(r"^    (\w[\w, ]*): ", section(text_of(node), "Args"), re.MULTILINE)
    explained = [word.strip() for line in listed for word in line.split(",")]
    in_order = [argument for argument in arguments(node) if argument in explained]
    assert explained == in_order, f"{name}: Args of the docstring against the signature"


@pytest.mark.parametrize("name", [name for name in FUNCTIONS if raised(FUNCTIONS[name])])
def test_errors_are_announced(name):
    node = FUNCTIONS[name]
    for error in raised(node):
        assert f"{error}:" in section(text_of(node), "Raises"), (
            f"{name} raises {error} and does not say so"
        )


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_a_module_names_its_source(path):
    cited = re.search(r"^ *References?: \S", path.read_text(encoding="utf-8"), re.MULTILINE)
    assert bool(cited) != (name_of(path) in NO_PAPER), (
        f"{name_of(path)}: a Reference, or a reason in NO_PAPER"
    )


@pytest.mark.parametrize("name", FUNCTIONS)
def test_everything_that_goes_in_and_comes_out_has_a_type(name):
    node = FUNCTIONS[name]
    named = [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs, node.args.vararg]
    bare = [
        part.arg
        for part in named
        if part and part.annotation is None and part.arg not in ("self", "cls")
    ]
    assert not bare, f"{name}: no type for {bare}"
    assert node.returns is not None, f"{name}: no type for what it returns"
