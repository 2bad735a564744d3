"""What the documents promise can be found."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
NAMED = re.findall(r"`(tests/[\w/]+\.py(?:::\w+)+)`", (ROOT / "docs" / "security.md").read_text(encoding="utf-8"))


def test_tests_are_named():
    assert len(NAMED) > 15
    assert len(set(NAMED)) == len(NAMED)


@pytest.mark.parametrize("named", NAMED)
def test_every_test_that_the_security_page_names_is_there(named):
    path, *names = named.split("::")
    inside: list[ast.stmt] = ast.parse((ROOT / path).read_text(encoding="utf-8")).body
    for name in names:
        found = [node for node in inside if isinstance(node, ast.FunctionDef | ast.ClassDef) and node.name == name]
        assert found, f"{path} has no {name}"
        inside = found[0].body
