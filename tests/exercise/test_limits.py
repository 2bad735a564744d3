"""What the documentation says of limits is what holds."""

import re
from pathlib import Path

import pytest

from tests.exercise.written import POINTS
from workbench.exercise import classroom, failing, reading, reports, submission, submissions
from workbench.exercise.child import reading as child
from workbench.exercise.child import wire
from workbench.exercise.model import contract
from workbench.exercise.sandbox import SandboxedFunction, Wall, bubblewrap, budget, isolation, pipe
from workbench.exercise.sandbox import function as sandboxed
from workbench.exercise.submission import Submission

DOCS = Path(__file__).parents[2] / "docs"
MEGABYTE = 2**20


def documented() -> dict[str, str]:
    """Return the rows of the table of limits."""
    text = (DOCS / "exercises.md").read_text(encoding="utf-8")
    section = text.partition("### How much it may take")[2].partition("\n#")[0]
    rows = re.findall(r"^\| (.*?) \| (.*?) \|$", section, re.MULTILINE)
    return dict(rows[1:])  # without its head


def test_the_table_says_what_the_code_has():
    seconds = contract(slot="turn")(lambda p: p).seconds
    held = {
        "a file handed in": f"{submission.MOST_BYTES / MEGABYTE:g} MB",
        "modules beside it": f"{submission.MOST_MODULES}",
        "what one student hands in": f"{submissions.MOST_FILES} files,"
        f" {submissions.MOST_TOGETHER / MEGABYTE:g} MB",
        "reading a file as Python": f"{child.SECONDS} s of processor time, {child.MEGABYTES} MB,"
        f" {reading.MOST_SECONDS:g} s by the clock",
        "files of one student that take longer": f"{reading.MOST_LOST}, then no more are read",
        "loading a file": f"{sandboxed.LOAD_SECONDS:g} s",
        "starting Python and numpy": f"{isolation.START_SECONDS:g} s",
        "a call": f"{seconds:g} s, unless the contract says otherwise",
        "calls that are late or end their process": f"{budget.REFUSED_AFTER}, then none is made",
        "all calls of a function": f"{budget.CALLS} calls' time",
        "memory": f"{sandboxed.MEGABYTES} MB",
        "files that it writes, in bubblewrap": f"{bubblewrap.FOLDER_BYTES / MEGABYTE:g} MB",
        "what it prints": f"{isolation.OUTPUT_BYTES / 1024:g} kB are kept,"
        f" {reports.PRINTED_LINES} lines of {reports.PRINTED_SIGNS} signs shown",
        "a message to or from its process": f"{wire.MOST_BYTES / MEGABYTE:g} MB, of it"
        f" {wire.MOST_HEADER / MEGABYTE:g} MB that describe {wire.MOST_PARTS:,} parts",
        "waiting for a processor": f"{pipe.MOST_TIMES:g} times as long",
        "a student in a class": f"{classroom.LONGEST_SECONDS:g} s",
        "the run in which a wrong function goes wrong": f"{failing.SECONDS:g} s,"
        f" {failing.AFTER} steps beyond the first difference",
    }
    table = documented()
    assert {name: table[name] for name in held} == held
    assert table.keys() - held.keys() == {"open files", "a file that it writes"}, "tested below"


def test_a_process_has_the_limits_of_the_table():
    pytest.importorskip("resource")
    names = ("RLIMIT_NOFILE", "RLIMIT_FSIZE", "RLIMIT_AS", "RLIMIT_CORE", "RLIMIT_CPU")
    text = (
        "import resource\n\ndef centroid(p):\n"
        f"    return [float(resource.getrlimit(getattr(resource, name))[0]) for name in {names}]\n"
    )
    given = Submission("my.py", text, {})
    with SandboxedFunction(given, "centroid", seconds=2.0, wall=Wall("none")) as student:
        files, written, memory, core, processor = student(POINTS)
    table = documented()
    assert table["open files"] == f"{files:g}"
    assert table["a file that it writes"] == f"{written / MEGABYTE:g} MB"
    assert table["memory"] == f"{memory / MEGABYTE:g} MB"
    assert core == 0
    assert processor == 60 + 20 * 2
