"""Commands as a shell gives them, for the tests of commands: in this process, where a refusal is
one line, or in one of their own.
"""

import sys
from pathlib import Path

import pytest

from workbench.cli import main

ROOT = Path(__file__).resolve().parents[1]
HIDDEN = ("--port", "0", "--no-browser")


@pytest.fixture(autouse=True)
def nothing_is_served(monkeypatch) -> None:
    """Let a command that should not serve fail instead of waiting for ever; those in a process of
    their own do serve.
    """

    def enter(server):
        raise AssertionError(f"served at {server.address}")

    monkeypatch.setattr("workbench.recording.replay.ReplayServer.__enter__", enter)


def refused(capsys, *words: object) -> str:
    """Carry out a command that must fail, and return its one line."""
    assert main([str(word) for word in words]) == 2
    out, line = capsys.readouterr()
    assert out == ""
    assert line.startswith("workbench: ")
    assert line.count("\n") == 1
    assert line.endswith("\n")
    return line


def command(*words: str) -> list[str]:
    return [sys.executable, "-m", "workbench", *words]
