"""A handout as a plain folder, and a class counted by the weights of its assignment."""

import csv

import pytest

from workbench.cli import main
from workbench.exercise.finding import exercises
from workbench.machinery.licence import NOTICE


def test_a_folder_has_starters_samples_and_what_they_are_worth(tmp_path, capsys):
    out = tmp_path / "out"
    words = [
        "handout",
        "match",
        "--for",
        "folder",
        "--weight",
        "match=4",
        "--due",
        "2027-03-31",
        str(out),
    ]
    assert main(words) == 0
    assert {path.relative_to(out).as_posix() for path in out.rglob("*.*")} == {
        "README.md",
        "assignment.json",
        "student/TASK.md",
        "student/my_match.py",
        "teacher/full/my_match.py",
        "teacher/none/my_match.py",
    }
    assert "4 points" in (out / "README.md").read_text()
    assert NOTICE in (out / "README.md").read_text()
    assert "Due 2027-03-31 23:59" in (out / "student" / "TASK.md").read_text()
    assert main(["check", str(out / "teacher" / "full" / "my_match.py"), "--hidden"]) == 0
    assert "workbench grade" in capsys.readouterr().out


def test_a_class_is_counted_by_the_weights_of_its_assignment(tmp_path, capsys):
    """Points are out of all that is handed out; what is not asked for counts nothing, and is
    said.
    """
    out, came = tmp_path / "out", tmp_path / "came"
    assert (
        main(
            [
                "handout",
                "match",
                "invert_rigid",
                "--weight",
                "match=40",
                "--for",
                "folder",
                str(out),
            ]
        )
        == 0
    )
    handed = {"all": ["match", "invert_rigid"], "half": ["match"], "other": ["match"], "empty": []}
    for student, names in handed.items():
        (came / student).mkdir(parents=True)
        for name in names:
            (came / student / f"{name}.py").write_text(
                (out / "teacher" / "full" / f"my_{name}.py").read_text()
            )
    (came / "empty" / "match.py").write_text("def match(source, target):\n    return None\n")
    (came / "other" / "chamfer.py").write_text("def chamfer(a, b):\n    return 0.0\n")
    assert main(["grade", str(came), "--assignment", str(out / "assignment.json")]) == 1
    rows = {
        row["student"]: row
        for row in csv.DictReader((came / "graded" / "class.csv").read_text().splitlines())
    }
    worth = 40 + exercises()["invert_rigid"].points
    assert {name: (float(row["points"]), float(row["possible"])) for name, row in rows.items()} == {
        "all": (worth, worth),
        "half": (40, worth),
        "other": (40, worth),
        "empty": (0, worth),
    }
    assert list(rows["all"])[3:] == ["match", "invert_rigid", "trouble"]
    assert rows["half"]["invert_rigid"] == ""
    assert rows["other"]["trouble"] == "chamfer is not asked for"
    assert "1 with full marks" in capsys.readouterr().out


WEIGHTS = ('{"nothing": 1}', '{"match": NaN}', '{"match": "1"}', "[1]", "{}")
DATED = [
    f'{{"weights": {text}, "release": null, "due": null, "service": "folder", "sandbox": "auto"}}'
    for text in WEIGHTS
]


@pytest.mark.parametrize("text", ["", "[]", '{"weights": {"match": 1}}', *DATED])
def test_a_file_that_is_no_assignment_is_one_line(tmp_path, capsys, text):
    (tmp_path / "assignment.json").write_text(text)
    (tmp_path / "match.py").write_text("")
    assert main(["grade", str(tmp_path), "--assignment", str(tmp_path / "assignment.json")]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert not (tmp_path / "graded").exists()
