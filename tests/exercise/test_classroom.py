import contextlib
import csv
import io
import json
import re
import sys
import types
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import pytest

from tests.exercise.batch import write_class
from tests.exercise.centroid import EXERCISE
from workbench.errors import InputError
from workbench.exercise import classroom, finding
from workbench.exercise.marking import Asked

POINTS = {"right": 4.0, "sum": 1.0, "hang": 0.0, "crash": 0.0}


@pytest.fixture(autouse=True)
def only_the_centroid(monkeypatch):
    quick = replace(EXERCISE, contract=replace(EXERCISE.contract, seconds=0.4))
    monkeypatch.setattr(finding, "exercises", lambda: {"centroid": quick})


def test_a_class_is_graded_whole_in_parallel_and_goes_on_where_it_stopped(tmp_path):
    kinds = write_class(tmp_path / "in", 20)
    seen: list[str] = []

    def stop_after_seven(name, done, of):
        seen.append(name)
        if len(seen) == 7:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        classroom.grade_class(tmp_path / "in", tmp_path / "out", progress=stop_after_seven)
    first = set(seen)
    seen.clear()
    results = classroom.grade_class(
        tmp_path / "in", tmp_path / "out", progress=lambda name, done, of: seen.append(name)
    )
    assert not first & set(seen)
    assert len(results) == 20
    for result in results:
        kind = kinds[result["student"]]
        if kind == "broken":
            assert "line 1" in result["error"]
        else:
            assert result["error"] is None
            assert sum(report["points"] for report in result["reports"]) == POINTS[kind], kind
            assert (result["reports"][0]["mistake"] or {}).get("name") == (
                "total" if kind == "sum" else None
            )
    rows = list(csv.DictReader(io.StringIO((tmp_path / "out" / "class.csv").read_text())))
    assert [row["student"] for row in rows] == sorted(kinds)
    matrix = list(csv.reader(io.StringIO((tmp_path / "out" / "matrix.csv").read_text())))
    assert matrix[-1][0] == "most frequent mistake"
    assert "total (6)" in matrix[-1]
    summary = (tmp_path / "out" / "summary.md").read_text()
    assert "18 graded, 8 with full marks, 2 could not be graded" in summary


def test_a_class_graded_twice_gives_equal_bytes(tmp_path):
    write_class(tmp_path / "in", 10)
    for out, jobs in (("one", 1), ("two", 3)):
        classroom.grade_class(tmp_path / "in", tmp_path / out, jobs=jobs)
    first, second = (
        {
            path.relative_to(tmp_path / out).as_posix(): path.read_bytes()
            for path in (tmp_path / out).rglob("*.*")
        }
        for out in ("one", "two")
    )
    assert len(first) == 13
    assert first == second


def test_a_file_that_changed_is_graded_again(tmp_path):
    write_class(tmp_path / "in", 1)
    classroom.grade_class(tmp_path / "in", tmp_path / "out")
    graded: list[str] = []
    classroom.grade_class(
        tmp_path / "in", tmp_path / "out", progress=lambda name, *_: graded.append(name)
    )
    assert graded == []
    (tmp_path / "in" / "student000.py").write_text("def centroid(p):\n    return p.sum(axis=0)\n")
    results = classroom.grade_class(
        tmp_path / "in", tmp_path / "out", progress=lambda name, *_: graded.append(name)
    )
    assert graded == ["student000"]
    assert results[0]["reports"][0]["points"] == 1.0


def test_folders_per_student_and_names_that_a_spreadsheet_would_run(tmp_path):
    for name in ("ada", "=cmd()"):
        (tmp_path / "in" / name).mkdir(parents=True)
        (tmp_path / "in" / name / "my_centroid.py").write_text(
            "def centroid(p):\n    return p.mean(axis=0)\n"
        )
    classroom.grade_class(tmp_path / "in", tmp_path / "out")
    rows = list(csv.reader(io.StringIO((tmp_path / "out" / "class.csv").read_text())))
    assert {row[0] for row in rows[1:]} == {"ada", "'=cmd()"}


@pytest.mark.parametrize("files", [[], ["notes.txt"]])
def test_a_folder_without_submissions_is_told(tmp_path, files):
    for name in files:
        (tmp_path / name).write_text("x")
    with pytest.raises(InputError, match=r"holds no \.py file"):
        classroom.grade_class(tmp_path, tmp_path / "out")
    with pytest.raises(InputError, match="no such folder"):
        classroom.grade_class(tmp_path / "nowhere", tmp_path / "out")


def test_a_result_that_was_half_written_is_graded_again(tmp_path):
    write_class(tmp_path / "in", 1)
    classroom.grade_class(tmp_path / "in", tmp_path / "out")
    kept = tmp_path / "out" / "students" / "student000.json"
    kept.write_text(kept.read_text()[:50])
    (result,) = classroom.grade_class(tmp_path / "in", tmp_path / "out")
    assert result["reports"][0]["points"] == 4.0
    assert json.loads(kept.read_text())["student"] == "student000"


def test_a_result_that_another_version_wrote_is_graded_again(tmp_path):
    write_class(tmp_path / "in", 1)
    classroom.grade_class(tmp_path / "in", tmp_path / "out")
    kept = tmp_path / "out" / "students" / "student000.json"
    older = json.loads(kept.read_text()) | {"schema": 0, "reports": []}
    kept.write_text(json.dumps(older))
    (result,) = classroom.grade_class(tmp_path / "in", tmp_path / "out")
    assert result["reports"][0]["points"] == 4.0


@pytest.mark.parametrize(
    ("text", "code"), [("def centroid(p:", 2), ("def centroid(p): return 0 * p[0]", 1)]
)
def test_its_exit_code_says_whether_anybody_could_be_graded(tmp_path, text, code):
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "ada.py").write_text(f"import numpy as np\n{text}\n")
    tell = io.StringIO()
    asked = Asked(sandbox="none")
    ended = classroom.grade_folder(
        tmp_path / "in",
        tmp_path / "out",
        asked=asked,
        jobs=1,
        dask=None,
        tell=tell,
        result=tell,
    )
    assert ended == code


def test_where_results_cannot_be_written_that_is_told_before_anybody_is_graded(tmp_path):
    write_class(tmp_path / "in", 1)
    (tmp_path / "out").write_text("mine")

    def graded(name: str, finished: int, of: int | None) -> None:
        pytest.fail(f"{name} was graded")

    with pytest.raises(InputError, match=r"out: Not a directory$"):
        classroom.grade_class(tmp_path / "in", tmp_path / "out", progress=graded)
    assert (tmp_path / "out").read_text() == "mine"


def test_who_interrupts_is_told_how_far_it_came(tmp_path, monkeypatch):
    def interrupted(*places, progress, **how):
        progress("ada", 1, 3)
        raise KeyboardInterrupt

    monkeypatch.setattr(classroom, "grade_class", interrupted)
    tell = io.StringIO()
    result = io.StringIO()
    how = {"asked": Asked(sandbox="none"), "jobs": 1, "dask": None, "tell": tell, "result": result}
    assert classroom.grade_folder(tmp_path, tmp_path / "out", **how) == 130
    assert "Interrupted: 1 of 3 graded; the same command goes on" in tell.getvalue()
    assert result.getvalue() == ""
    tell.isatty = lambda: True
    assert classroom.grade_folder(tmp_path, tmp_path / "out", **how) == 130
    assert "1/3 ada" in tell.getvalue(), "a terminal shows how far it is"


def test_a_scheduler_that_is_not_there_is_told_in_one_line(monkeypatch):
    def nobody(address, timeout):
        raise TimeoutError(address)

    for package, message in (
        (None, "--dask needs the package `distributed`: pip install distributed"),
        (types.SimpleNamespace(Client=nobody), "--dask tcp://it: no scheduler answers there"),
    ):
        monkeypatch.setitem(sys.modules, "distributed", package)
        with pytest.raises(InputError) as told, contextlib.ExitStack() as stack:
            classroom._dask_executor("tcp://it", stack)
        assert str(told.value) == message


def test_a_class_is_graded_where_the_scheduler_says(monkeypatch):
    left = []

    class Client(contextlib.nullcontext):
        def __init__(self, address, timeout):
            super().__init__(self)

        def get_executor(self):
            return "its workers"

        def __exit__(self, *error):
            left.append(self)

    monkeypatch.setitem(sys.modules, "distributed", types.SimpleNamespace(Client=Client))
    with contextlib.ExitStack() as stack:
        assert classroom._dask_executor("tcp://it", stack) == "its workers"
        assert left == []
    assert len(left) == 1


def test_who_runs_elsewhere_is_graded_as_here(tmp_path):
    write_class(tmp_path / "in", 3)
    with ThreadPoolExecutor(1) as executor:
        elsewhere = classroom.grade_class(tmp_path / "in", tmp_path / "else", executor=executor)
    assert elsewhere == classroom.grade_class(tmp_path / "in", tmp_path / "here")


def test_a_result_s_file_is_named_by_signs_that_every_system_takes():
    names = ["ada", "a b", "a_b", "A_B", "é.-", "x" * 99, "../y", "z?", "z?" * 60]
    stems = classroom.stems(dict.fromkeys(names))
    assert [name for name in names if stems[name] == name] == ["ada", "é.-"]
    assert all(re.fullmatch(r"[\w.-]{1,89}", stem) for stem in stems.values())
    assert len(stems["x" * 99]) == 80 + 1 + 8
    assert len({stem.casefold() for stem in stems.values()}) == len(names)
    assert stems["z?"].startswith("z_-")
    assert classroom.stems({"a_b": None}) == {"a_b": "a_b"}
