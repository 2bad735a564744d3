"""Tests that look at whole runs of a lesson go to one worker, where each run is made once."""

from pathlib import Path

import pytest

pytest.importorskip("xdist")

from tests.workers import GROUPS

ROOT = Path(__file__).resolve().parents[1]


def group(nodeid: str) -> str:
    return next((match[1] for pattern in GROUPS if (match := pattern.match(nodeid))), nodeid)


def looks_at_all(text: str) -> bool:
    return "from tests.runs import" in text and "catalog()" in text


def test_who_looks_at_runs_of_all_lessons_shares_a_lesson_s_worker():
    looking = [
        path.relative_to(ROOT).as_posix()
        for path in (ROOT / "tests").rglob("test_*.py")
        if path != Path(__file__) and looks_at_all(path.read_text(encoding="utf-8"))
    ]
    groups = {file: group(f"{file}::test_it[icp-more]") for file in looking}
    assert set(groups.values()) == {"icp"}, groups


@pytest.mark.parametrize("file", ["test_icp.py", "test_icp_own.py", "test_icp_flat.py"])
def test_all_tests_of_a_lesson_share_its_worker(file):
    assert group(f"tests/lessons/{file}::TestRings::test_it") == "icp"
