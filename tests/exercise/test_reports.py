"""What machines and people read of a report, down to the last word."""

import json
import xml.etree.ElementTree as ET
from dataclasses import replace

import pytest

from tests.exercise.centroid import EXERCISE, centroid
from workbench.errors import InputError
from workbench.exercise import reports
from workbench.exercise.grading import Outcome, Report, grade_function
from workbench.exercise.model import fail, full
from workbench.exercise.sandbox import Wall

HALF = grade_function(lambda p: p.mean(axis=0) + 1e-4, EXERCISE, file="my.py", seed=3)
SUM = replace(
    grade_function(lambda p: p.sum(axis=0), EXERCISE, file="a|b.py"),
    printed="one\n\n\x1b[2Jtwo\n" + "x" * 999 + "\n4\n5\n6\n7\n",
    wall=Wall("none", "nothing here"),
)
REFUSED = Report(
    EXERCISE,
    "my.py",
    tuple(Outcome(check, fail("It uses scipy."), "forbidden") for check in EXERCISE.checks),
)
LOST = reports.ungraded("b\nad.py", EXERCISE, "b.py, line 1:\nno Python")


def test_a_terminal_shows_each_check_with_its_points():
    first, *checks, last = reports.terminal(HALF).splitlines()
    assert first == "centroid · my.py"
    assert checks[0] == "  ◐ partial   1/2  The centroid of random points is right"
    assert checks[1].startswith(" " * 18 + "centroid off by")
    assert checks[2] == "  ✓ pass      1/1  The input is not modified"
    assert last == "  public 1/2 · hidden 1/1 · 3 of 4 points · seed 3"
    assert len(checks) == 6


def test_what_was_printed_and_what_was_no_wall_are_told():
    lines = reports.terminal(SUM).splitlines()
    at = lines.index("  Your code printed:")
    assert lines[at - 1] == "  → You returned the sum: divide by the number of points."
    assert lines[at + 1 : at + 7] == [
        "    one",
        "    \\x1b[2Jtwo",
        "    " + "x" * 160,
        "    4",
        "    5",
        "    ...",
    ]
    assert lines[at + 7] == f"  {reports.UNSAFE}"
    assert reports.shown("1\n2\n3\n4\n5\n") == ["1", "2", "3", "4", "5"]
    safe = reports.terminal(replace(SUM, wall=Wall("landlock"), printed="\n"))
    assert reports.UNSAFE not in safe
    assert "printed" not in safe


def test_one_sentence_for_all_checks_is_read_once():
    text = reports.terminal(REFUSED)
    assert text.count("It uses scipy.") == 1
    assert len(text.splitlines()) == 1 + 3 + 1 + 1
    assert reports.markdown([REFUSED]).count("It uses scipy.") == 1
    (test,) = reports.gradescope([REFUSED])["tests"]
    assert (test["score"], test["max_score"], test["status"]) == (0, 4, "failed")
    assert test["output"] == "It uses scipy."
    once = replace(REFUSED, mistake=EXERCISE.mistakes[0])
    assert reports.gradescope([once])["tests"][0]["output"].splitlines() == [
        "It uses scipy.",
        EXERCISE.mistakes[0].sentence,
    ]
    right = tuple(Outcome(check, full("Right.")) for check in EXERCISE.checks)
    (test,) = reports.gradescope([replace(REFUSED, outcomes=right)], factors={EXERCISE.name: 2.5})[
        "tests"
    ]
    assert (test["score"], test["max_score"], test["status"]) == (10, 10, "passed")


def test_a_result_names_the_version_that_its_schema_describes():
    schema = json.loads(reports.SCHEMA.read_text(encoding="utf-8"))
    assert schema["properties"]["schema"]["const"] == reports.SCHEMA_VERSION


def test_a_result_is_plain_data():
    data = json.loads(json.dumps(reports.as_dict(SUM)))
    assert [check["result"] for check in data["checks"]] == ["fail", "pass", "fail"]
    assert [check["public"] for check in data["checks"]] == [True, True, False]
    assert (data["points"], data["possible"], data["sandbox"]) == (1, 4, "none")
    assert data["mistake"] == {
        "name": "total",
        "sentence": "You returned the sum: divide by the number of points.",
        "checks": ["is_the_mean", "moves_along"],
    }
    assert reports.as_dict(HALF)["mistake"] is None
    assert reports.as_dict(HALF)["sandbox"] is None
    some = reports.as_dict(grade_function(centroid, EXERCISE, hidden=False))
    assert some["not_run"] == ["moves_along"]


def test_gradescope_is_told_what_counts_how_much_and_who_may_see_it():
    results = reports.gradescope([HALF, SUM], [LOST], factors={"centroid": 2.5}, notes=["late"])
    scores = [(test["score"], test["max_score"], test["status"]) for test in results["tests"]]
    whole = [(2.5, 5.0, "failed"), (2.5, 2.5, "passed"), (2.5, 2.5, "passed")]
    assert scores[:3] == whole
    assert scores[3:] == [
        (0, 5.0, "failed"),
        (2.5, 2.5, "passed"),
        (0, 2.5, "failed"),
        (0, 10.0, "failed"),
    ]
    assert results["score"] == 10.0
    seen = [test["visibility"] for test in results["tests"]]
    assert seen == ["visible", "visible", "after_published"] * 2 + ["visible"]
    assert results["output"].splitlines()[:3] == [
        "b.py, line 1: no Python",
        "late",
        "centroid printed:",
    ]
    assert results["output"].endswith(reports.UNSAFE)
    plain = reports.gradescope([HALF], hidden="after_due_date")
    assert [test["max_score"] for test in plain["tests"]] == [2, 1, 1]
    assert plain["tests"][2]["visibility"] == "after_due_date"
    assert plain["output"] == ""
    nameless = reports.gradescope([], [reports.ungraded("", None, "no")])["tests"][0]
    assert (nameless["name"], nameless["max_score"]) == ("The file", 0)


def test_junit_has_a_suite_per_function_and_an_error_where_none_was_run():
    root = ET.fromstring(reports.junit([HALF, SUM], [LOST]))
    suites = [tuple(map(suite.get, ("name", "tests", "failures", "errors"))) for suite in root]
    assert suites == [
        ("centroid", "3", "1", "0"),
        ("centroid", "3", "2", "0"),
        ("centroid", "1", "0", "1"),
    ]
    cases = [case.find("failure") for case in root.iter("testcase")]
    assert [None if failure is None else failure.get("type") for failure in cases] == [
        "partial",
        None,
        None,
        "fail",
        None,
        "fail",
        None,
    ]
    assert root[1].findtext("system-err") == reports.UNSAFE
    assert root[0].find("system-err") is None
    error = root[2][0].find("error")
    assert error is not None
    assert error.attrib == {"message": "b.py, line 1: no Python", "type": "ungraded"}
    assert root[0][0].get("classname") == "my.py"


def test_a_job_s_page_is_markdown():
    lines = reports.markdown([SUM], [LOST]).splitlines()
    assert lines[:7] == [
        f"**{reports.UNSAFE}**",
        "",
        "### centroid: could not be graded",
        "",
        "> b.py, line 1: no Python",
        "",
        "### centroid: 1 of 4",
    ]
    assert lines[8:10] == ["| | check | points | found |", "|---|---|---|---|"]
    assert lines[11] == "| ✓ | The input is not modified | 1/1 | Unchanged. |"
    assert lines[-4:] == [
        "",
        "> You returned the sum: divide by the number of points.",
        "",
        "public 1/2 · hidden 0/1 · 1 of 4 points",
    ]
    odd = replace(HALF, outcomes=(replace(HALF.outcomes[0], verdict=fail("a|<b>`c")),))
    assert reports.markdown([odd]).splitlines()[4].endswith(" | 0/2 | a\\|&lt;b>\\`c |")


def test_xml_holds_no_sign_that_it_may_not():
    assert reports.printable("a\tb\nc\x00\x1f\ud800\udfff\ue000 é") == "a\tb\nc\ue000 é"


def test_a_place_that_cannot_be_written_is_named(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match=r"file/result\.json: File exists"):
        reports.write_files([HALF], tmp_path / "file")
    reports.write_files([HALF], tmp_path / "new" / "folder", [LOST])
    text = (tmp_path / "new" / "folder" / "result.json").read_text()
    assert '\n   "exercise": ' in text, "a person can read it, too"
    result = json.loads(text)
    assert [report["points"] for report in result["reports"]] == [3]
    assert result["ungraded"] == [LOST]
    assert LOST == {
        "file": "b ad.py",
        "exercise": "centroid",
        "points": 0,
        "possible": 4,
        "error": "b.py, line 1: no Python",
    }
