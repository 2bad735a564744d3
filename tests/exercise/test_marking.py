"""Which of a student's files are graded for which exercise, and what is said of the others."""

from dataclasses import replace
from pathlib import Path

import pytest

import workbench
from tests.exercise.centroid import EXERCISE
from workbench.exercise import finding, marking
from workbench.exercise.marking import Asked, chosen, digest, grade_student, marked, not_handed_in
from workbench.exercise.sandbox import Wall
from workbench.exercise.submissions import HandIn

RIGHT = "def centroid(p):\n    return p.mean(axis=0)\n"
MIDDLE = RIGHT.replace("centroid", "middle")
NONE = "x = 1\n"


@pytest.fixture(autouse=True)
def two_exercises(monkeypatch):
    other = replace(EXERCISE, name="middle")
    monkeypatch.setattr(finding, "exercises", lambda: {"centroid": EXERCISE, "middle": other})


def found(files: dict[str, str], *only: str) -> dict[str, list]:
    """Return what is chosen of files, in words."""
    handed = HandIn("ada", {name: text.encode() for name, text in files.items()})
    got = chosen(handed, Asked(only=only))
    return {
        "graded": [(part.file, part.exercise.name) for part in got.graded],
        "troubles": [(item["file"], item["exercise"], item["error"]) for item in got.troubles],
        "notes": got.notes,
        "missing": [exercise.name for exercise in got.missing],
    }


def nothing(**but) -> dict[str, list]:
    return {"graded": [], "troubles": [], "notes": [], "missing": []} | but


SEVERAL = "centroid is in several files (a.py, b.py): leave one of them"


@pytest.mark.parametrize(
    ("files", "only", "wanted"),
    [
        ({"a.py": RIGHT + MIDDLE}, (), {"graded": [("a.py", "centroid"), ("a.py", "middle")]}),
        ({"a.py": RIGHT + MIDDLE}, ("middle",), {"graded": [("a.py", "middle")]}),
        ({"a.py": RIGHT, "b.py": RIGHT}, (), {"graded": [("a.py", "centroid")]}),
        (
            {"a.py": RIGHT, "b.py": RIGHT + NONE},
            (),
            {"troubles": [("a.py, b.py", "centroid", SEVERAL)]},
        ),
        (
            {"a.py": RIGHT + NONE, "my_centroid.py": RIGHT},
            (),
            {"graded": [("my_centroid.py", "centroid")]},
        ),
        (
            {"my_centroid.py": "import a\n" + RIGHT, "a.py": RIGHT + NONE},
            (),
            {"graded": [("my_centroid.py", "centroid")]},
        ),
        (
            {"a.py": "import my_middle\n" + RIGHT, "my_middle.py": MIDDLE, "b.py": "import a\n"},
            (),
            {
                "graded": [("my_middle.py", "middle")],
                "notes": ["b.py: defines none of the exercises' functions (centroid, middle)"],
                "missing": [],
            },
        ),
        (
            {"a.py": RIGHT, "b.py": NONE, "c.py": "def f(:\n"},
            (),
            {
                "graded": [("a.py", "centroid")],
                "notes": [
                    "b.py: defines none of the exercises' functions (centroid, middle)",
                    "c.py, line 1: invalid syntax",
                ],
            },
        ),
        (
            {f"{letter}.py": NONE for letter in "abcdefg"},
            ("centroid",),
            {
                "troubles": [("a.py", "centroid", "a.py: defines no function centroid")]
                + [(f"{k}.py", None, f"{k}.py: defines no function centroid") for k in "bcde"],
            },
        ),
        (
            {"a.py": NONE},
            ("centroid", "middle"),
            {
                "troubles": [("a.py", None, "a.py: defines no function centroid or middle")],
                "missing": ["centroid", "middle"],
            },
        ),
        (
            {"my_middle.py": MIDDLE, "a.py": RIGHT},
            ("centroid",),
            {
                "graded": [("a.py", "centroid")],
                "notes": ["my_middle.py: is for middle, which is not asked for"],
            },
        ),
        (
            {"m.py": MIDDLE, "a.py": RIGHT},
            ("centroid",),
            {
                "graded": [("a.py", "centroid")],
                "notes": ["m.py: defines no function centroid"],
            },
        ),
        (
            {"my_middle.py": "def middle(:\n", "a.py": RIGHT},
            (),
            {
                "graded": [("a.py", "centroid")],
                "troubles": [("my_middle.py", "middle", "my_middle.py, line 1: invalid syntax")],
            },
        ),
        (
            {"my_middle.py": "def middle(:\n", "a.py": RIGHT},
            ("centroid", "middle"),
            {
                "graded": [("a.py", "centroid")],
                "troubles": [("my_middle.py", "middle", "my_middle.py, line 1: invalid syntax")],
            },
        ),
        (
            {"a.py": RIGHT},
            ("centroid", "middle"),
            {"graded": [("a.py", "centroid")], "missing": ["middle"]},
        ),
        ({}, ("centroid",), {"missing": ["centroid"]}),
    ],
)
def test_each_file_is_graded_for_what_it_is_for(files, only, wanted):
    assert found(files, *only) == nothing(**wanted)


@pytest.mark.parametrize("content", [b"x\n\n\xff", b"\xff"])  # Python says it in other words
def test_a_file_that_could_not_be_read_is_a_trouble(content):
    handed = HandIn("ada", {"a.py": content}, (("b.py", "b.py: a pipe"),))
    got = chosen(handed, Asked())
    assert [item["error"] for item in got.troubles] == [
        "b.py: a pipe",
        "a.py: cannot be read as text (not UTF-8): save it as UTF-8",
    ]


def test_a_kept_result_agrees_with_all_that_made_it():
    handed = HandIn("ada", {"a.py": b"x"})
    asked = Asked(only=("centroid",))
    others = [
        (replace(handed, student="bob"), asked),
        (replace(handed, note="late"), asked),
        (replace(handed, files={"a.py": b"y"}), asked),
        (replace(handed, files={"b.py": b"x"}), asked),
        (replace(handed, troubles=(("c.py", "no"),)), asked),
        (handed, replace(asked, only=("middle",))),
        (handed, replace(asked, sandbox="none")),
        (handed, replace(asked, seed=1)),
        (HandIn("\udcff", {}), asked),
    ]
    made = [digest(*pair) for pair in ((handed, asked), *others)]
    assert len(set(made)) == len(made)
    assert digest(replace(handed), replace(asked)) == made[0]


def test_a_grader_is_told_by_the_workbench_s_own_text(monkeypatch):
    read = []
    monkeypatch.setattr(marking, "_text", lambda folder: read.append(folder) or "its text")
    assert marking._grader.__wrapped__().startswith("its text ")
    assert read == [Path(workbench.__file__).parent]


def test_what_goes_wrong_with_one_student_is_a_line_of_the_result(monkeypatch):
    result = grade_student(HandIn("ada", {"a.py": RIGHT.encode()}), Asked(sandbox="glass"))
    assert result["error"].startswith("could not be graded: --sandbox glass: there are auto")

    def stumbles(handed, asked):
        raise KeyError("two\nlines")

    monkeypatch.setattr("workbench.exercise.marking.chosen", stumbles)
    result = grade_student(HandIn("ada", {"a.py": RIGHT.encode()}), Asked(sandbox="none"))
    assert result["error"] == "could not be graded: KeyError: 'two\\nlines'"
    assert (result["sandbox"], result["reports"], result["handed"]) == ("none", [], [])


def test_what_does_not_load_is_not_graded_and_what_is_missing_costs_its_points():
    handed = HandIn("ada", {"w/my_centroid.py": b"1 / 0\n" + RIGHT.encode()})
    (part,) = chosen(handed, Asked()).graded
    ungraded = marked(part, Wall("none"))
    assert isinstance(ungraded, dict)
    assert (ungraded["file"], ungraded["exercise"], ungraded["possible"]) == (
        "w/my_centroid.py",
        "centroid",
        4,
    )
    assert "ZeroDivisionError" in ungraded["error"]
    assert not_handed_in(EXERCISE)["error"] == "centroid: not handed in"
    asked = Asked(only=("centroid", "middle"), sandbox="none")
    result = grade_student(HandIn("ada", {}, (("", "nothing"),)), asked)
    assert [item["exercise"] for item in result["ungraded"]] == [None]
    result = grade_student(replace(handed, note="late"), asked)
    assert [item["exercise"] for item in result["ungraded"]] == ["centroid", "middle"]
    assert result["note"] == "late"
