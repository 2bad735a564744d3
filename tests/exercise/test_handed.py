"""What a class hands in, and how a teacher finds it again: files of many kinds, names that clash,
people who are absent.
"""

import csv
import io
import json
import os
from dataclasses import replace
from pathlib import Path

import pytest

from tests.exercise.centroid import EXERCISE
from workbench.errors import InputError
from workbench.exercise import classroom, finding, reports
from workbench.exercise.marking import Asked
from workbench.exercise.sandbox import best
from workbench.exercise.submission import content
from workbench.exercise.submissions import handed_in

RIGHT = "def centroid(p):\n    return p.mean(axis=0)\n"
WRONG = "def centroid(p):\n    return p.sum(axis=0)\n"
OTHER = replace(EXERCISE, name="middle")

pytestmark = pytest.mark.skipif(
    not best().holds, reason=f"nothing shuts submissions in here: {best().why}"
)


@pytest.fixture(autouse=True)
def two_exercises(monkeypatch):
    monkeypatch.setattr(finding, "exercises", lambda: {"centroid": EXERCISE, "middle": OTHER})


def graded(folder: Path, files: dict[str, str | bytes], **how) -> dict[str, dict]:
    for name, text in files.items():
        path = folder / "in" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
    results = classroom.grade_class(folder / "in", folder / "out", **how)
    return {result["student"]: result for result in results}


def rows(folder: Path, name: str = "class.csv") -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO((folder / "out" / name).read_text())))


def points(result: dict) -> dict[str, float]:
    return {report["exercise"]: report["points"] for report in result["reports"]}


NOTEBOOK = {
    "cells": [
        {"cell_type": "markdown", "source": ["# mine"]},
        {
            "cell_type": "code",
            "source": ["%matplotlib inline\n", "import numpy as np\n", "EPS = 1e-9"],
        },
        {"cell_type": "code", "source": "def centroid(p):\n    return p.sum(axis=0)\n"},
        {"cell_type": "code", "source": "points = np.load('mine.npy')\nprint(points)"},
        {
            "cell_type": "code",
            "source": "def centroid(p):\n    return np.asarray(p).mean(axis=0) + 0 * EPS\n",
        },
    ]
}
RIGHTS = {
    "prints": "def centroid(p):\n    print('x' * 100_000, p)\n    return p.mean(axis=0)\n",
    "prints for ever": (
        "def centroid(p):\n    for i in range(3000): print(i, 'y' * 1000)\n    return"
        " p.mean(axis=0)\n"
    ),
    "with a BOM": b"\xef\xbb\xbf" + RIGHT.encode(),
    "in latin 1": (
        "# -*- coding: latin-1 -*-\n# Schwerpunkt für\n".encode("latin-1") + RIGHT.encode()
    ),
    "for Windows": RIGHT.replace("\n", "\r\n"),
    "a lambda": "centroid = lambda p: p.mean(axis=0)\n",
    "inside if": (
        "import sys\nif sys.version_info > (3,):\n    def centroid(p):\n        return"
        " p.mean(axis=0)\n"
    ),
    "inside try": (
        "try:\n    def centroid(p):\n        return p.mean(axis=0)\nexcept ImportError: pass\n"
    ),
    "a main part": RIGHT + "if __name__ == '__main__':\n    raise SystemExit\n",
    "writes its notes": (
        "def centroid(p):\n    try: open('notes', 'w').write('x')\n    except OSError: pass\n   "
        " return p.mean(0)\n"
    ),
    "a partial": "import functools, numpy as np\ncentroid = functools.partial(np.mean, axis=0)\n",
    "a class of arrays": (
        "import numpy as np\ndef centroid(p):\n    return np.matrix(p).mean(axis=0).A1\n"
    ),
}


def test_right_ones_in_other_clothes_get_full_marks(tmp_path):
    files: dict[str, str | bytes] = {f"{name}.py": text for name, text in RIGHTS.items()}
    files |= {"notebook.ipynb": json.dumps(NOTEBOOK), "CAPITALS.PY": RIGHT}
    files |= {
        "in a folder/my_centroid.py": (
            "from helper import mean\ndef centroid(p):\n    return mean(p)\n"
        )
    }
    files |= {
        "in a folder/helper.py": "import other\ndef mean(p):\n    return other.total(p) / len(p)\n"
    }
    files |= {"in a folder/other.py": "def total(p):\n    return p.sum(axis=0)\n"}
    results = graded(tmp_path, files)
    lost = {name: result for name, result in results.items() if points(result) != {"centroid": 4.0}}
    assert not lost, lost
    assert len(results) == len(RIGHTS) + 3
    printed = results["prints for ever"]["reports"][0]["printed"]
    assert printed[0].startswith("0 yyy")
    assert printed[-1] == "..."


def test_a_helper_with_the_name_of_another_exercise_is_not_graded(tmp_path):
    helper = "def middle(p):\n    return 0\n" + RIGHT
    files: dict[str, str | bytes] = {
        "ada/my_centroid.py": helper,
        "bob/bob.py": '"""Exercise centroid, lesson fake.\n"""\n' + helper,
    }
    files |= {"eve/12_assignsubmission_my_centroid (1).py": helper}
    assert [points(result) for result in graded(tmp_path, files).values()] == [
        {"centroid": 4.0}
    ] * 3


def test_a_student_has_one_row_and_it_counts_out_of_all_that_was_handed_in(tmp_path):
    files: dict[str, str | bytes] = {
        "ada/week 1/my_centroid.py": RIGHT,
        "ada/week 2/my_middle.py": WRONG.replace("centroid", "middle"),
    }
    files |= {
        "bob/my_centroid.py": RIGHT,
        "bob/my_middle.py": "def middle(p:\n",
        "eve/my_centroid.py": "def centroid(p:\n",
    }
    results = graded(tmp_path, files)
    students = {row["student"]: row for row in rows(tmp_path)}
    assert students["ada"] | {"trouble": ""} == {
        "student": "ada",
        "points": "5",
        "possible": "8",
        "centroid": "4",
        "middle": "1",
        "handed in": "",
        "trouble": "",
    }
    assert students["eve"]["handed in"] == "fake 1 of 2"
    assert "- fake 1 of 2: 1 student\n" in (tmp_path / "out" / "summary.md").read_text()
    assert (students["bob"]["points"], students["bob"]["possible"], students["bob"]["middle"]) == (
        "4",
        "8",
        "0",
    )
    assert "my_middle.py, line 1" in students["bob"]["trouble"]
    assert (students["eve"]["points"], students["eve"]["possible"], students["eve"]["middle"]) == (
        "0",
        "4",
        "",
    )
    assert "'" not in students["eve"]["middle"]
    checks = {row["student"]: row for row in rows(tmp_path, "matrix.csv")}
    asked = [name for name in checks["eve"] if name.startswith("middle.")]
    assert asked
    # a check that nobody asked of her, and no 0
    assert {checks["eve"][name] for name in asked} == {""}
    assert "" not in {checks["ada"][name] for name in asked}
    jsonschema = pytest.importorskip("jsonschema")
    for place in (tmp_path / "out" / "students").iterdir():
        jsonschema.validate(json.loads(place.read_text()), json.loads(reports.SCHEMA.read_text()))
    assert len(results) == 3


def test_words_of_a_files_name_say_what_it_is_for(tmp_path):
    both = "def centroid(p):\n    return p.mean(axis=0)\ndef middle(p):\n    return p.sum(axis=0)\n"
    files: dict[str, str | bytes] = {
        "ada/hw3_Centroid (final).py": both,
        "bob/My_MIDDLE-2.py": both,
        "eve/middle_project.py": RIGHT,
        "kim/my_middle.py": RIGHT,
        "lea/my_Centroid.py": RIGHT.replace("centroid", "Centroid"),
        "max/work.py": both,
        "sue/12_centroid_and_middle.py": both,
    }
    results = graded(tmp_path, files)
    earned = {name: points(result) for name, result in results.items()}
    assert earned == {
        "ada": {"centroid": 4.0},
        "bob": {"middle": 1.0},
        "eve": {"centroid": 4.0},
        "kim": {},
        "lea": {},
        "max": {"centroid": 4.0, "middle": 1.0},
        "sue": {"centroid": 4.0, "middle": 1.0},
    }
    assert results["kim"]["error"] == "my_middle.py: is for middle and defines no such function"
    assert results["lea"]["error"].endswith(
        "defines no such function; it defines Centroid, which is another name"
    )


def test_what_fits_nothing_is_a_line(tmp_path):
    files: dict[str, str | bytes] = {
        "ada/my_centroid.py": RIGHT,
        "ada/my_centre.py": "def centre(p):\n    return p.mean(axis=0)\n",
        "ada/broken.py": "def f(:\n",
        "ada/photo.png": b"\x89PNG",
        "bob.zip": b"PK",
        "eve.zip": b"PK",
        "eve/my_centroid.py": RIGHT,
        "kim.py.txt": RIGHT,
    }
    results = graded(tmp_path, files)
    assert sorted(results) == ["ada", "bob", "eve", "kim"]
    assert results["ada"]["note"].split("; ") == [
        "not read, since neither .py nor .ipynb: photo.png",
        "broken.py, line 1: invalid syntax",
        "my_centre.py: defines none of the exercises' functions (centroid, middle)",
    ]
    assert results["ada"]["handed"] == ["fake 1 of 2"]
    assert "bob.zip: not read: unpack it" in results["bob"]["error"]
    assert "kim.py.txt: not read" in results["kim"]["error"]
    assert points(results["eve"]) == {"centroid": 4.0}


def test_who_is_asked_for_one_is_told_that_another_is_not_it(tmp_path):
    files: dict[str, str | bytes] = {
        "ada/my_middle.py": RIGHT + "def middle(p):\n    return 0\n",
        "bob.py": "def centre(p):\n    return 0\n",
    }
    results = graded(tmp_path, files, asked=Asked(only=("centroid",)))
    assert results["ada"]["reports"] == []  # its helper has the name, and is a helper
    assert results["ada"]["error"] == "my_middle.py: is for middle, which is not asked for"
    assert results["bob"]["error"] == "bob.py: defines no function centroid"


def test_hanging_crashing_and_wrong_are_told_apart(tmp_path):
    files: dict[str, str | bytes] = {
        "crash.py": "import os\ndef centroid(p):\n    os._exit(1)\n",
        "hang.py": "def centroid(p):\n    while True: pass\n",
        "raise.py": "def centroid(p):\n    raise KeyError('\\x1b[31mred\\x00')\n",
        "wrong.py": WRONG,
    }
    graded(tmp_path, files)
    first = {row["student"]: row["centroid.is_the_mean"] for row in rows(tmp_path, "matrix.csv")}
    assert [first[name] for name in ("crash", "hang", "raise", "wrong")] == [
        "crashes",
        "hangs",
        "raises",
        "0",
    ]
    assert (first["graded"], first["full marks"], first["mean share"]) == ("4", "0", "0")
    texts = "".join(path.read_text() for path in (tmp_path / "out").rglob("*.*") if path.is_file())
    assert "\x1b" not in texts
    assert "x1b[31mred" in texts


def test_what_is_no_file_of_theirs_is_one_line(tmp_path):
    folder = tmp_path / "in"
    folder.mkdir()
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere" / "x.py").write_text(RIGHT)
    os.mkfifo(folder / "pipe.py")
    (folder / "device.py").symlink_to("/dev/zero")
    (folder / "link.py").symlink_to(tmp_path / "elsewhere" / "x.py")
    (folder / "away").symlink_to(tmp_path / "elsewhere")
    (folder / "loop.py").symlink_to("loop.py")
    (folder / "of").mkdir()
    (folder / "of" / "ada.py").symlink_to(folder / "right.py")
    files: dict[str, str | bytes] = {
        "right.py": RIGHT,
        "large.py": "#" * 2_000_000,
        "nul.py": "x = '\0'",
        "deep.py": "x = " + "(" * 9000,
        "minus.py": "x = " + "-" * 200_000 + "1",
        "latin.py": "# für\n".encode("latin-1"),
        "cookie.py": "# coding: nothing-such\n",
        "empty.py": "",
        "book.ipynb": "{}",
        "spaces/notes.txt": "none",
    }
    results = graded(tmp_path, files)
    assert points(results.pop("right")) == {"centroid": 4.0}
    assert len(results) == 15
    for name, result in results.items():
        assert result["reports"] == [], name
        assert 10 < len(result["error"]) < 400, name
        assert "\n" not in result["error"]
    assert "leads out of the folder" in results["link"]["error"]
    assert "pipe" in results["pipe"]["error"]


def test_a_file_is_read_where_the_system_knows_no_such_flags(tmp_path, monkeypatch):
    for flag in ("O_NONBLOCK", "O_NOCTTY"):
        monkeypatch.delattr(os, flag, raising=False)
    (tmp_path / "ada.py").write_text(RIGHT)
    assert content(tmp_path / "ada.py") == RIGHT.encode()


def test_names_never_share_a_file(tmp_path):
    files: dict[str, str | bytes] = dict.fromkeys(
        ("a_b.py", "a b.py", "A_B.py", "a?b.py", "\x1b[31m.py", "=1+1.py"), RIGHT
    )
    results = graded(tmp_path, files)
    assert len(list((tmp_path / "out" / "students").iterdir())) == len(results) == 6
    assert {row["student"] for row in rows(tmp_path)} >= {"a_b", "'=1+1", "\\x1b[31m"}


def test_two_things_of_one_name_are_named_and_not_guessed_at(tmp_path):
    files: dict[str, str | bytes] = {
        "ada.py": RIGHT,
        "ada/my_centroid.py": WRONG,
        "bob/my_centroid.py": RIGHT,
    }
    files |= {"bob/old/my_centroid.py": WRONG}
    results = graded(tmp_path, files)
    assert "two things here are named ada" in results["ada"]["error"]
    assert "several files (my_centroid.py, old/my_centroid.py)" in results["bob"]["error"]


@pytest.mark.parametrize(
    "text",
    ["name;group\nAda;1\nNobody;2\n", "Ada\nNobody\n", "\ufeffgroup\tStudent\n1\tAda\n2\tNobody\n"],
)
def test_who_handed_in_nothing_has_a_row(tmp_path, text):
    (tmp_path / "roster.csv").write_text(text)
    files: dict[str, str | bytes] = {"ada.py": RIGHT, "mallory.py": RIGHT, "empty/readme.txt": "x"}
    graded(tmp_path, files, roster=tmp_path / "roster.csv")
    unread = "not read, since neither .py nor .ipynb: readme.txt"
    told = [(row["student"], row["points"], row["trouble"]) for row in rows(tmp_path)]
    assert told == [
        ("ada", "4", ""),
        ("Nobody", "0", "handed in nothing"),
        (
            "empty",
            "0",
            f"the folder holds no .py file and no notebook; {unread}; not in the roster",
        ),
        ("mallory", "4", "not in the roster"),
    ]


def test_a_class_is_read_before_anything_runs(tmp_path):
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "ada.py").write_text(RIGHT)
    hand_ins = handed_in(tmp_path / "in")
    (tmp_path / "in" / "ada.py").write_text(WRONG)
    assert hand_ins["ada"].files == {"ada.py": RIGHT.encode()}


def test_what_changed_is_graded_again(tmp_path, monkeypatch):
    seen: list[str] = []

    def again(**how):
        seen.clear()
        graded(tmp_path, {"ada.py": RIGHT}, progress=lambda name, *_: seen.append(name), **how)
        return list(seen)

    assert again() == ["ada"]
    assert again() == []
    assert again(asked=Asked(only=("centroid",))) == ["ada"]
    assert again(asked=Asked(only=("centroid",))) == []
    monkeypatch.setattr("sys.version", "4.0")
    from workbench.exercise import marking

    marking._grader.cache_clear()
    assert again(asked=Asked(only=("centroid",))) == ["ada"]
    monkeypatch.undo()
    marking._grader.cache_clear()


def test_a_place_that_cannot_be_written_is_named(tmp_path):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "class.csv").mkdir()
    with pytest.raises(InputError, match=r"class\.csv"):
        graded(tmp_path, {"ada.py": RIGHT})
