"""No caption, preset line or explanation judges a run other than the truth does.

The audit is `python -m tests.verdicts`, in a process of its own, where the lessons run at their own
speed: here every array's shape is checked at every call. WORKBENCH_AUDIT=whole takes all steps at
20 seeds, which takes half an hour of processor time: before a release, and for a lesson whose words
or runs change (`python -m tests.verdicts --whole NAME`).
"""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from workbench.lesson import catalog

ROOT = Path(__file__).resolve().parents[1]
WHOLE = ["--whole"] if os.environ.get("WORKBENCH_AUDIT") == "whole" else []


@pytest.mark.parametrize("name", catalog())
def test_what_a_lesson_says_is_true(name):
    words = [sys.executable, "-m", "tests.verdicts", *WHOLE, name]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_every_lesson_has_a_judge():
    judges = {file.stem for file in (Path(__file__).parent / "verdicts").glob("[!_]*.py")}
    assert judges == set(catalog())
