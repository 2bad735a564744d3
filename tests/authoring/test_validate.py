"""Validating survives whatever a lesson does: its code runs in another process, and how that ends
is one line.
"""

import re
import shutil
from pathlib import Path

import pytest

from tests.test_readme import example
from workbench.authoring.validate import validate
from workbench.cli import main

CIRCLE = Path(__file__).resolve().parents[1] / "authors" / "circle"
YIELD = "        yield State(k, p, circle)\n"


@pytest.fixture
def folder(tmp_path) -> Path:
    return Path(
        shutil.copytree(CIRCLE, tmp_path / "circle", ignore=shutil.ignore_patterns("__pycache__"))
    )


def test_a_lesson_that_holds(folder, capfd):
    assert main(["validate", str(folder)]) == 0
    output = capfd.readouterr()
    assert re.fullmatch(r"circle: holds \(\d{3} .*\n", output.out)
    assert output.err == ""


def test_the_smallest_lesson_is_told_what_it_lacks(tmp_path, capfd):
    (tmp_path / "my_lesson.py").write_text(example("Add a lesson in a few lines"), encoding="utf-8")
    assert main(["validate", str(tmp_path / "my_lesson.py")]) == 1
    out = capfd.readouterr().out.splitlines()
    assert all(line.startswith("lesson turn: it has ") for line in out)
    assert [line.split()[4] for line in out] == ["0", "no", "no"]  # presets, question, page


@pytest.mark.parametrize("word", ["no_such_lesson", "no/such/folder", "none.py"])
def test_what_is_not_there_is_no_finding(word, capfd):
    assert main(["validate", word]) == 2
    assert capfd.readouterr().err.startswith("workbench: ")


@pytest.mark.parametrize(
    ("file", "old", "new", "message"),
    [
        (
            "lesson.py",
            YIELD,
            "        while k == 3: pass\n" + YIELD,
            (
                "circle: circle/lesson.py, line 35: the code did not come back for 2 s, at: the"
                " default run, after step 2"
            ),
        ),
        (
            "draw.py",
            "import numpy as np\n",
            "import numpy as np\nwhile True: pass\n",
            "circle/draw.py, line 4: the code did not come back for 2 s, at: loading it",
        ),
        (
            "lesson.py",
            YIELD,
            YIELD + "        __import__('time').sleep(0.1)\n        circle = circle - step\n",
            "run takes over 2 s; it is at step ",
        ),
        (
            "lesson.py",
            YIELD,
            "        __import__('os')._exit(3)\n",
            "the process ended (exit code 3)",
        ),
        (
            "lesson.py",
            YIELD,
            "        raise SystemExit\n",
            "lesson circle: circle/lesson.py, line 35: SystemExit",
        ),
        (
            "lesson.py",
            YIELD,
            "        __import__('ctypes').string_at(0)\n",
            "circle/lesson.py, line 35: the process ended",
        ),
        ("lesson.py", YIELD, "        p = np.ones((1 << 40, 2))\n" + YIELD, "MemoryError"),
        (
            "state.py",
            "    k: int\n",
            "    k: int = 1 / 0\n",
            "circle/state.py, line 25: ZeroDivisionError",
        ),
        ("exercises/fit_circle.py", "CIRCLE =", "1 / 0\nCIRCLE =", "fit_circle.py, line"),
    ],
)
def test_what_takes_a_process_down_is_a_line_with_its_place(folder, file, old, *, new, message):
    text = (folder / file).read_text(encoding="utf-8")
    assert old in text
    (folder / file).write_text(text.replace(old, new), encoding="utf-8")
    told: list[str] = []
    report = validate(str(folder), told.append, seconds=2.0)
    assert told == list(report.wrong)
    assert [line for line in told if message in line], told
    assert all("Traceback" not in line for line in told)
