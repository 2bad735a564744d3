"""Right functions with one slip lose points: a sample of all mutants is graded, and none survives
but the accepted ones.
"""

import ast

import pytest

pytest.importorskip("resource")  # limits on memory and time are those of POSIX

from tests.exercise.mutants import accepted, limited, row
from tests.exercise.operators import mutants
from workbench.exercise.finding import exercises

SAMPLE = 5  # mutants of each exercise: some ten seconds of processor time for all


@pytest.mark.parametrize("name", exercises())
def test_no_wrong_mutant_earns_full_marks(name):
    tally = row(name, most=SAMPLE)
    assert not set(tally.alive) - accepted()
    assert tally.losing + tally.equal + len(tally.alive) == SAMPLE


def test_operators_make_the_slips_of_students():
    tree = ast.parse(
        "def f(a, b):\n    if a < 0:\n        raise ValueError\n    return a.T @ (b /"
        " np.linalg.norm(b, axis=1))"
    )
    function = tree.body[0]
    assert isinstance(function, ast.FunctionDef)
    changes = {mutant.change for mutant in mutants(function, arguments=True)}
    wanted = {
        "a.T → a",
        "a < 0 → a <= 0",
        "a < 0 → a < 0.1",
        "b / np.linalg.norm(b, axis=1) → b",
        "a = b",
        "a = _ones(a)",
        "if a < 0: raise ValueError → pass",
        "np.linalg.norm(b, axis=1) → np.linalg.norm(b)",
        "1 → 2",
        "1 → 0",
        "a.T @ (b / np.linalg.norm(b, axis=1)) → b / np.linalg.norm(b, axis=1) @ a.T",
        "a = _spoilt(a)",
        "a = _single(a); b = _single(b)",
    }
    assert not wanted - changes
    assert ast.unparse(function) == ast.unparse(tree.body[0]), "the function stays as it was"


def test_what_never_ends_is_stopped():
    def endless():
        while True:
            pass

    with pytest.raises(TimeoutError):
        limited(endless)()
