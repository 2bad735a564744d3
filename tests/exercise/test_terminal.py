"""What a terminal is sent of a submission: words, and no sign that it would obey."""

import subprocess
from pathlib import Path

import pytest

from tests.exercise.centroid import EXERCISE
from workbench.cli import main
from workbench.exercise import failing, finding
from workbench.exercise.sandbox import best
from workbench.viewer.terminal import tell_terminal

SIGNS = "\x1b[2J\x1b]0;mine\x07\x9b31m\x08\x00\u202e"
IN_CODE = repr(SIGNS)[1:-1]
FILES = {
    "raises": f"def centroid(p):\n    raise ValueError('{IN_CODE}seen')\n",
    "prints": (
        f"print('{IN_CODE}seen')\ndef centroid(p):\n    print('{IN_CODE}seen\\rover')\n    return"
        " p.sum(axis=0)\n"
    ),
    "returns": f"def centroid(p):\n    return '{IN_CODE}seen'\n",
    "is of a class": f"def centroid(p):\n    return type('{IN_CODE[-6:]}seen', (), {{}})()\n",
    "raises its own": (
        f"def centroid(p):\n    raise type('{IN_CODE[:4]}seen', (Exception,), {{}})('{IN_CODE}')\n"
    ),
    "while it is read": f"raise KeyError('{IN_CODE}seen')\ndef centroid(p):\n    return p\n",
    "no Python": f"def centroid(p:\n'{SIGNS[:-2]}seen'\n",
    "in a comment": f"def centroid(p):\n    return 0\n# {SIGNS}seen",
}
QUOTED = ("raises", "raises its own", "prints", "while it is read")
"""Those of which what they say is told."""

pytestmark = pytest.mark.skipif(
    not best().holds, reason=f"nothing shuts submissions in here: {best().why}"
)


@pytest.fixture
def told_by(monkeypatch, capfd):
    """Carries out a command, and returns all that the terminal was sent: lines of signs that can be
    seen.
    """
    monkeypatch.setattr(finding, "exercises", lambda: {"centroid": EXERCISE})
    monkeypatch.setattr(failing, "record_failing", lambda _, file, lesson: file.with_suffix(".rrd"))

    def carry_out(*words: object) -> str:
        assert main([str(word) for word in words]) in (0, 1, 2)
        text = "".join(capfd.readouterr())
        assert [sign for sign in text if not sign.isprintable() and sign != "\n"] == []
        return text

    return carry_out


def write(folder: Path, kind: str, name: str) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_text(FILES[kind], encoding="utf-8", newline="")
    return folder / name


@pytest.mark.parametrize("kind", FILES)
def test_a_check_sends_nothing_that_a_terminal_obeys(tmp_path, told_by, kind):
    text = told_by("check", write(tmp_path, kind, "my_centroid.py"))
    assert "centroid" in text
    assert ("\\x1b[2J" in text) == (kind in QUOTED)


def test_names_of_files_and_folders_are_written_out_too(tmp_path, told_by):
    odd = SIGNS.replace("\x00", "'\\")
    text = told_by("check", write(tmp_path / odd, "returns", f"{odd}.py"))
    command = text.partition("goes wrong: ")[2].splitlines()[0]
    printed = subprocess.run(
        ["bash", "-c", f"printf %s {command.removeprefix('workbench replay ')}"],
        stdout=subprocess.PIPE,
        check=True,
    ).stdout
    assert printed.decode() == str(tmp_path / odd / f"{odd}.rrd"), (
        "and a shell reads the name that it was"
    )
    assert "\\x1b[2J" in told_by("check", tmp_path / f"{odd}.py")


def test_what_a_server_tells_whoever_started_it_is_written_out_too(capsys):
    try:
        raise ValueError(f"{SIGNS}seen")
    except ValueError as error:
        tell_terminal(error)
    printed = capsys.readouterr().err
    assert "\n  File " in printed
    assert "\\x1b[2J" in printed
    assert [sign for sign in printed if not sign.isprintable() and sign != "\n"] == []


def test_grading_a_class_sends_nothing_that_a_terminal_obeys(tmp_path, told_by):
    for kind in FILES:
        write(tmp_path / "in", kind, f"{SIGNS[:4]}{kind}.py")
    text = told_by("grade", tmp_path / "in")
    assert "seen" in (tmp_path / "in" / "graded" / "summary.md").read_text(encoding="utf-8")
    assert text
