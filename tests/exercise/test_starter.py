"""What a student starts from says all that is asked, and is never written over."""

from dataclasses import replace

import numpy as np
import pytest
from jaxtyping import Float

from tests.exercise.centroid import EXERCISE
from workbench.errors import InputError
from workbench.exercise.model import contract
from workbench.exercise.starter import allowed, sample, starter, write_starter

ROWS = Float[np.ndarray, "n 3"]
NUMBERS = Float[np.ndarray, "n"]


def weighed(p: ROWS, weights: NUMBERS, k: int = 3, *, n=None) -> tuple[float, int]:  # type: ignore
    """Weigh points.

    Twice.
    """


def told(function, **more) -> str:
    made = contract(slot="turn", **more)(function)
    return starter(replace(EXERCISE, contract=made)).partition("import numpy as np\n\n\n")[2]


SAID = '''\
def centroid(p: np.ndarray, weights: np.ndarray, k: int = 3, n: np.ndarray = None) -> tuple:
    """Weigh points.

    Twice.

    Shapes:
        p: (n, 3) float
        weights: (n,) float

    Examples:
        centroid(1)
            gives 2
        centroid(2)
            gives 4
    """
    raise NotImplementedError
'''


def test_a_signature_needs_numpy_alone_and_shapes_are_words():
    assert told(weighed, examples=(("centroid(1)", "2"), ("centroid(2)", "4"))) == SAID


def test_what_a_function_may_use_is_said_in_full():
    strict = replace(
        EXERCISE, contract=replace(EXERCISE.contract, seconds=0.5, forbid=("a.b", "c"))
    )
    text = allowed(strict, 1536)
    for part in (
        "Python's own library, numpy and scipy, and modules",
        " It may not use a.b or c, which solves the task: who does earns nothing. One call",
        "One call may take 0.5 s and 1536 MB, all calls together 10 s.",
        "the first 64 KB are kept",
    ):
        assert part in text
    assert "may not use" not in allowed(EXERCISE)
    assert "1 s and 2 GB, all calls together 20 s" in allowed(EXERCISE)


def test_a_starter_is_written_over_only_when_asked(tmp_path):
    path = write_starter(EXERCISE, tmp_path / "new" / "folder")
    assert path == tmp_path / "new" / "folder" / "my_centroid.py"
    path.write_text("mine")
    with pytest.raises(InputError, match=r"my_centroid\.py is there already: move it away"):
        write_starter(EXERCISE, path.parent)
    assert path.read_text() == "mine"
    write_starter(EXERCISE, path.parent, force=True)
    assert path.read_text() == starter(EXERCISE)
    assert write_starter(EXERCISE, tmp_path, force=True).exists()
    with pytest.raises(InputError, match=r"my_centroid\.py: "):
        write_starter(EXERCISE, path)


def test_a_sample_is_the_first_alternative_by_the_exercise_s_name():
    with pytest.raises(InputError, match="exercise centroid has no @alternative"):
        sample(EXERCISE)
    text = sample(replace(EXERCISE, alternatives=(weighed, told)))
    assert "def weighed(" in text
    assert text.endswith("\ncentroid = weighed\n")
