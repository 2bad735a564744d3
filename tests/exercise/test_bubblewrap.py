"""What bubblewrap is asked for where it can bound a folder's size, and where it is too old to."""

import subprocess
from types import SimpleNamespace

import pytest

from workbench.exercise.sandbox import bubblewrap, python


def no_program(*_, **__):
    raise FileNotFoundError("bwrap")


@pytest.mark.parametrize(
    ("run", "bounded"),
    [
        (lambda *_, **__: SimpleNamespace(stdout=b"    --size BYTES\n    --tmpfs DEST"), True),
        (lambda *_, **__: SimpleNamespace(stdout=b"    --tmpfs DEST"), False),
        (no_program, False),
    ],
)
def test_a_student_s_folder_is_bounded_or_nobody_writes_to_it(monkeypatch, run, bounded):
    monkeypatch.setattr(subprocess, "run", run)
    # what was found of this machine's stays
    monkeypatch.setattr(bubblewrap, "_knows_sizes", bubblewrap._knows_sizes.__wrapped__)
    command = bubblewrap.arguments(python.here())
    assert command[-4:-2] == ["--chdir", bubblewrap.FOLDER]
    assert ("--size" in command) is bounded
    if bounded:
        assert command[command.index("--size") + 1] == str(bubblewrap.FOLDER_BYTES)
    else:
        assert command[command.index("--dir") + 1] == bubblewrap.FOLDER
        assert command[command.index("--remount-ro") + 1] == "/"
