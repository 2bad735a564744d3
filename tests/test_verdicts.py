"""No caption, preset line or explanation judges a run other than the truth does.

WORKBENCH_AUDIT=whole takes all steps at 20 seeds, in a process of its own where no array's shape is
checked, which takes half an hour of processor time: before a release, and for a lesson whose words
or runs change (`python -m tests.verdicts --whole NAME`).
"""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.runs import finished
from tests.verdicts.__main__ import audit
from workbench.lesson import catalog

ROOT = Path(__file__).resolve().parents[1]
WHOLE = os.environ.get("WORKBENCH_AUDIT") == "whole"


@pytest.mark.parametrize("name", catalog())
def test_what_a_lesson_says_is_true(name):
    if WHOLE:
        words = [sys.executable, "-m", "tests.verdicts", "--whole", name]
        done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr
        return
    ran = audit(catalog()[name], whole=False, run=lambda params: finished(name, params).states())
    findings = list(ran)
    assert not findings, "\n".join(findings)


def test_every_lesson_has_a_judge():
    folder = Path(__file__).parent / "verdicts"
    modules = {file.stem for file in folder.glob("[!_]*.py")}
    packages = {file.parent.name for file in folder.glob("*/__init__.py")}
    assert modules | packages == set(catalog())
