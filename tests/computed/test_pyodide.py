"""The core in Pyodide: every lesson's default run tells what it tells here, and solutions get the
verdicts that they get here; `python -m tests.computed` compares all presets and all solutions.
"""

from pathlib import Path

import pytest

from tests.computed.compared import differences, lines_of, make_archive, verdict
from tests.computed.judged import judged
from tests.computed.known import DIFFERENT, OTHERWISE_JUDGED
from tests.computed.solutions import tasks_of
from tests.computed.summarised import summary
from workbench.computed.runner import open_lesson
from workbench.lesson import catalog, find

SAMPLED = ("icp", "graphs", "distances")
"""Lessons whose solutions are judged: matrices, whole numbers, and shortest ways."""


@pytest.fixture(scope="module")
def core(tmp_path_factory) -> Path:
    tasks = [task for name in SAMPLED for task in list(tasks_of(find(name)))[::4]]
    return make_archive(tmp_path_factory.mktemp("computed") / "core.zip", tasks)


def test_default_runs_tell_there_what_they_tell_here(pyodide, core):
    names = list(catalog())
    by_pyodide = {
        entry["run"]: entry for entry in lines_of(pyodide, core, "summarised.py", words=names)
    }
    assert list(by_pyodide) == [f"{name} default" for name in names]
    differing = {
        name: differences(summary(open_lesson(name), "default"), by_pyodide[f"{name} default"])
        for name in names
        if f"{name} default" not in DIFFERENT
    }
    assert {name: lines for name, lines in differing.items() if lines} == {}


def test_solutions_get_there_the_verdicts_that_they_get_here(pyodide, core):
    texts = {task[:3]: task[3] for name in SAMPLED for task in tasks_of(find(name))}
    judgements = list(lines_of(pyodide, core, "judged.py"))
    assert len(judgements) > 30
    assert {solution.partition("_")[0] for _, _, solution, _ in judgements} == {"right", "wrong"}
    for lesson, exercise, solution, by_pyodide in judgements:
        here = judged(lesson, exercise, texts[lesson, exercise, solution])
        if f"{exercise} {solution}" not in OTHERWISE_JUDGED:
            assert verdict(by_pyodide) == verdict(here), (exercise, solution)
