"""No hand-in stalls the grader: each is read, parsed and matched by a process that may take so much
time and memory.
"""

import ast
import json
import resource
import subprocess
import sys
import textwrap
import threading
import time

import pytest

from workbench.errors import InputError
from workbench.exercise.child import reading
from workbench.exercise.finding import exercises, exercises_in, said_for
from workbench.exercise.marking import Asked, chosen
from workbench.exercise.reading import MOST_LOST, Reader, _answer
from workbench.exercise.submission import read_submission
from workbench.exercise.submissions import HandIn

MEGABYTE = 1 << 20
RIGHT = "def match(p, q):\n    return 0\n"
PARTS = "import " + ".".join(["a"] * 400_000) + "\n"
NESTED = "(" * 90 + "1" + ")" * 90 + "\n"
STALLING = {
    "blank.py": "\n" * MEGABYTE,
    "blank and more.py": "\n" * (MEGABYTE - 100) + "x = 1\n",
    "a name of many parts.py": PARTS,
    "quotes.py": '"' * MEGABYTE,
    "signs.py": "- " * (MEGABYTE // 2),
    "brackets.py": NESTED * 5000,
    "a long sum.py": "x = " + "a+" * 500_000 + "a",
    "one line of names.py": "a=" * 500_000 + "1",
    "punycode.py": "# coding: punycode\n" + "x" * 500_000 + "-" + "a9" * 200_000,
    "cells.ipynb": json.dumps({"cells": [{"cell_type": "code", "source": "x"}] * 20_000}),
    "deep.ipynb": "[" * MEGABYTE,
    "parts.ipynb": json.dumps({"cells": [{"cell_type": "code", "source": PARTS}]}),
}


def spent() -> float:
    """Return the processor time of this process and of those that it started and that ended,
    seconds.
    """
    used = [
        resource.getrusage(processes)
        for processes in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    ]
    return sum(usage.ru_utime + usage.ru_stime for usage in used)


@pytest.fixture(autouse=True, scope="module")
def all_exercises_are_known():
    exercises()


@pytest.mark.parametrize("name", STALLING)
def test_no_file_keeps_the_grader_busy(tmp_path, name):
    path = tmp_path / name
    path.write_text(STALLING[name])
    began = spent()
    with pytest.raises(InputError) as told:
        exercises_in(path)
    assert spent() - began < 5.0
    assert 20 < len(str(told.value)) < 1500


def test_one_that_hangs_costs_the_others_nothing_and_many_cost_no_more_than_three():
    files = {"a.py": PARTS, "my_match.py": RIGHT, **{f"z{k}.py": PARTS for k in range(20)}}
    handed = HandIn("ada", {name: text.encode() for name, text in files.items()})
    began = spent()
    choice = chosen(handed, Asked())
    assert spent() - began < 5.0 * MOST_LOST
    assert [part.file for part in choice.graded] == ["my_match.py"]
    errors = [item["error"] for item in choice.troubles]
    assert errors[0] == "a.py: takes too long or too much memory to read as Python"
    assert (
        sum("not read, since 3 other files" in line for line in errors)
        == len(files) - 1 - MOST_LOST
    )


@pytest.mark.parametrize("head", ['"""', "# ", "\ufeff'''", "\n\n\n'''\n", "  # % "])
def test_a_mark_is_found_behind_what_an_editor_puts_before_it(tmp_path, head):
    path = tmp_path / "a.py"
    path.write_text(
        f"{head}Exercise match, lesson"
        f" icp.\n{head.strip()[-3:] if '#' not in head else ''}\n{RIGHT}"
    )
    assert [exercise.name for exercise in said_for(read_submission(path))] == ["match"]


def test_each_request_may_use_so_many_seconds_of_the_processor():
    """Of those whose process takes more than that in all, each is answered."""
    lines = """
    import time
    from workbench.exercise.child import reading

    def busy(file, content):
        end = time.process_time() + 0.8
        while time.process_time() < end:
            pass
        return {}

    reading.SECONDS, reading.read = 2, busy
    reading.main()
    """
    asked = json.dumps({"file": "a.py", "content": ""}) + "\n"
    process = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(lines)],
        input=3 * asked,
        text=True,
        capture_output=True,
        check=True,
    )
    assert process.stdout == "{}\n" * 3


def test_who_does_not_answer_in_time_is_not_waited_for():
    silent = subprocess.Popen(
        [sys.executable, "-c", "import time; time.sleep(5)"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    )
    ended = threading.Timer(5.0, silent.kill)  # or who waits for it would wait for ever
    ended.start()
    with silent:
        with pytest.raises(TimeoutError):
            _answer(silent, b"", time.monotonic() + 0.1)
        silent.kill()
    ended.cancel()


def test_why_a_file_is_no_python_is_told_in_some_500_signs():
    assert len(reading.read("a" * 600 + ".py", b"(")["broken"]) == 500


def test_no_process_stays_behind():
    with Reader() as reader:
        reader.read("a.py", b"x = 1")
        process = reader._process
        assert process is not None
    assert process.poll() is not None


# what is found in a file --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("def f(p): ...\nclass A:\n    inner = 1", ["A", "f"]),
        ("a, (b, *c) = 1, (2, 3)\nd = e = 1", ["a", "b", "c", "d", "e"]),
        ("f: object = lambda p: p", ["f"]),
        ("import numpy as np\nimport os\nfrom math import sin as s, cos", ["cos", "np", "os", "s"]),
        ("if a:\n    b = 1\nelse:\n    c = 1", ["b", "c"]),
        ("try: a = 1\nexcept E: b = 1\nelse: c = 1\nfinally: d = 1", ["a", "b", "c", "d"]),
        ("f(1)", []),
    ],
)
def test_names_are_known_without_running_anything(text, names):
    assert reading.read("a.py", text.encode())["defines"] == names


@pytest.mark.parametrize(
    ("text", "runs"),
    [
        ("import os", False),
        ("from math import sin", False),
        ("def f(p): ...", False),
        ("class A: ...", False),
        ("x = 1", True),
        ("f(1)", True),
        ("if a:\n    import os", True),
    ],
)
def test_what_a_file_does_as_it_is_loaded_is_told_from_what_it_only_names(text, runs):
    assert [part["runs"] for part in reading.read("a.py", text.encode())["parts"]] == [runs]


@pytest.mark.parametrize(
    ("written", "text"),
    [
        ("'os'", "os"),
        ("'o' + 's'", "os"),
        ("'a' + 'b' + 'c'", "abc"),
        ("'a' + x + 'b'", None),
        ("'a' + 1", None),
        ("x + 'a'", None),
        ("1", None),
        ("x", None),
        ("'a' * 2", None),
    ],
)
def test_a_text_is_put_together_only_where_all_its_pieces_are_there(written, text):
    assert reading.text_of(ast.parse(written, mode="eval").body) == text


def test_imports_are_listed_once_and_no_more_than_some():
    text = "import a, b.c as d, a\nfrom e import f\nfrom . import g\n"
    assert reading.read("a.py", text.encode())["imports"] == ["a", "e"]
    many = "".join(f"import a{k}\n" for k in range(300))
    assert len(reading.read("a.py", many.encode())["imports"]) == 200


def notebook(*cells: str, **tags: list[str]) -> bytes:
    """Return a notebook of code cells; `tags` has those of a cell, `of2` of that with index 2."""
    made: list[dict] = [{"cell_type": "code", "source": cell} for cell in cells]
    for name, given in tags.items():
        made[int(name[2:])]["metadata"] = {"tags": given}
    return json.dumps({"cells": [{"cell_type": "markdown", "source": "def no("}, *made]}).encode()


def test_of_a_notebook_definitions_stay_in_their_lines():
    handed = notebook(
        "%matplotlib inline\nimport numpy as np",
        "for example:\nthis is\nno Python",
        "EPS = np.sqrt(2)\nP = np.load('x')\nQ = len([])\nf = lambda p: max(p)\nscale: float",
        "print(1)\n@cached\ndef g(p):\n    return p\ng(2)",
    )
    lines = reading.of_notebook("a.ipynb", handed).splitlines()
    kept = {k: line for k, line in enumerate(lines, 1) if line}
    assert kept == {
        2: "import numpy as np",
        6: "EPS = np.sqrt(2)",
        9: "f = lambda p: max(p)",
        12: "@cached",
        13: "def g(p):",
        14: "    return p",
    }


def test_a_last_cell_that_is_no_python_is_told_with_its_line():
    parsed = reading.read("A.IPYNB", notebook("def f(p):\n    return p", "x = 1\ndef f(:"))
    assert parsed["broken"] == "A.IPYNB, line 4: invalid syntax"


def test_a_tagged_cell_counts_wherever_else_it_is_defined():
    cells = ("def f(p):\n    return 1", "def f(p):\n    return 2", "def f(p):\n    return 3")
    for tagged, kept in (({}, 3), ({"of0": ["exercise"]}, 1), ({"of1": ["mine", "solution"]}, 2)):
        scope: dict = {}
        exec(reading.of_notebook("a.ipynb", notebook(*cells, **tagged)), scope)
        assert scope["f"](0) == kept
