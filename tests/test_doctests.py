"""The examples in the docstrings of geometry and algorithms are run.

pytest's own `--doctest-modules` would find none of them: the checks of array shapes
(`tests/conftest.py`) wrap every function, and doctest passes over functions that come from another
module. Here the docstrings are read from the source and run in their module, shapes checked.
"""

import ast
import doctest
import importlib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
WITH_DOCSTRING = ast.FunctionDef | ast.ClassDef | ast.Module


def examples() -> list[tuple[str, str, str]]:
    """Every docstring with an example: module, name, text."""
    docstrings = []
    for part in ("geometry", "algorithms"):
        for path in sorted((ROOT / "workbench" / part).rglob("*.py")):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                text = ast.get_docstring(node) if isinstance(node, WITH_DOCSTRING) else None
                if text and ">>>" in text:
                    module = ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(
                        ".__init__"
                    )
                    docstrings.append((module, getattr(node, "name", path.stem), text))
    return docstrings


EXAMPLES = examples()


def failures(module: str, name: str, text: str) -> str:
    """What doctest has to say of a docstring's examples that fail; nothing where all hold."""
    names = dict(vars(importlib.import_module(module)))
    report: list[str] = []
    test = doctest.DocTestParser().get_doctest(text, names, f"{module}.{name}", None, None)
    doctest.DocTestRunner(verbose=False).run(test, out=report.append)
    return "".join(report)


def test_the_most_used_functions_have_examples():
    assert len(EXAMPLES) >= 20


@pytest.mark.parametrize(
    ("module", "name", "text"), EXAMPLES, ids=[f"{module}.{name}" for module, name, _ in EXAMPLES]
)
def test_an_example_gives_what_it_shows(module, name, text):
    report = failures(module, name, text)
    assert not report, report


def test_an_example_that_does_not_hold_is_found():
    assert "Expected:" in failures(
        "workbench.geometry.motions.rigid", "wrong", ">>> rotation_angle(np.eye(3))\n1.0\n"
    )
