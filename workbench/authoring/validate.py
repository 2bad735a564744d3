"""Holds a lesson and its exercises to what is promised of them, in a process of its own.

The lesson's code may raise, end its process, never come back or take all memory: that costs its own
process only, and is one more line, with the place where the code stood.
"""

import contextlib
import faulthandler
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from workbench.authoring import (  # noqa: F401 each adds to OF_LESSONS
    knob_promises,
    own_data,
    page_promises,
    story_promises,
    view_promises,
)
from workbench.authoring.exercise_promises import OF_EXERCISES
from workbench.authoring.promises import OF_LESSONS, SECONDS, Found, Subject
from workbench.errors import InputError, one_line
from workbench.exercise.finding import exercises_of
from workbench.lesson import catalog, find
from workbench.machinery.authors import described, is_ours, place
from workbench.machinery.docstrings import summary_of
from workbench.run.loading import is_path, lesson_given

MEGABYTES = 6144
_FRAME = re.compile(r'^  File "(.*)", line (\d+) in ', re.MULTILINE)


@dataclass(frozen=True)
class LessonReport:
    """What validating found: the lesson's name (or the word for it), how many things were looked
    at, and what is wrong.
    """

    name: str
    looked_at: int
    wrong: tuple[str, ...]


def look_at(subject: Subject) -> Found:
    """Yield what every promise finds of a lesson and of its exercises; a promise that cannot be
    looked at is a line too.
    """
    for promise in OF_LESSONS:
        yield from _guarded(lambda promise=promise: promise(subject), subject, summary_of(promise))
    try:
        exercises = exercises_of(subject.lesson)
    except (Exception, SystemExit) as error:
        yield f"{subject.who}, exercises: {described(error, subject.lesson.run)}"
        return
    for exercise in exercises:
        for promise in OF_EXERCISES:
            look = lambda promise=promise, exercise=exercise: promise(subject, exercise)  # noqa: E731
            yield from _guarded(look, subject, f"exercise {exercise.name}: {summary_of(promise)}")


def _guarded(look: Callable[[], Found], subject: Subject, summary: str) -> Found:
    try:
        yield from look()
    except (Exception, SystemExit) as error:
        yield (
            f"{subject.who}: {described(error, subject.lesson.run)} (while looking whether:"
            f" {summary.rstrip('.')})"
        )


def validate(word: str, told: Callable[[str], object], *, seconds: float = SECONDS) -> LessonReport:
    """Hold a lesson to its promises in another process.

    Args:
        word: The lesson as a person names it: its name, or the path of its file or folder.
        told: Is given each line that says what is wrong, as soon as it is known, each once.
        seconds: How long one run, and any call of the lesson's code, may take.

    Raises:
        InputError: If there is no such lesson or path.
    """
    if not is_path(word):
        find(word)
    elif not Path(word).exists():
        raise InputError(f"{word}: no such file or folder")
    name = word
    looked_at = 0
    wrong = list[str]()
    doing = "loading it"

    def tell(line: str) -> None:
        if line not in wrong:
            wrong.append(line)
            told(line)

    with tempfile.TemporaryFile("w+") as last_words:
        child = _started(word, seconds, last_words)
        ended = False
        with child, contextlib.closing(child.stdout or last_words) as messages:
            for line in messages:
                message = json.loads(line)
                name, doing = message.get("name", name), message.get("doing", doing)
                looked_at += "holds" in message
                ended = ended or "end" in message
                if message.get("holds"):
                    tell(one_line(message["holds"]))
        if not ended:
            last_words.seek(0)
            tell(
                one_line(
                    f"{name}: {_how_it_ended(last_words.read(), child.returncode, seconds)}, at:"
                    f" {doing}"
                )
            )
    return LessonReport(name, looked_at, tuple(wrong))


def _started(word: str, seconds: float, last_words: Any) -> subprocess.Popen:
    begin = (
        "import sys; from workbench.authoring.validate import main; main(sys.argv[1],"
        " float(sys.argv[2]))"
    )
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(path for path in sys.path if path)}
    return subprocess.Popen(
        [sys.executable, "-P", "-c", begin, word, str(seconds)],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=last_words,
        text=True,
        encoding="utf-8",
        env=environment,
    )


def _how_it_ended(text: str, code: int, seconds: float) -> str:
    """Say why the process ended before it was through, and where the lesson's code stood."""
    frames = [(file, int(line)) for file, line in _FRAME.findall(text)]
    stood = next((f"{place(file, line)}: " for file, line in frames if not is_ours(file)), "")
    if "Timeout (" in text:
        return f"{stood}the code did not come back for {seconds:g} s"
    reason = "MemoryError" if "MemoryError" in text else f"exit code {code}"
    return (
        f"{stood}the process ended ({reason}); does the code end it, crash a library, or take all"
        " memory?"
    )


# in the other process -----------------------------------------------------------------------------


def main(word: str, seconds: float) -> None:
    """Look at a lesson, and write what is found as lines of JSON to standard output."""
    out = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # what the lesson prints is nobody's message
    _limit_memory()
    alarm = 0.0

    def send(**message: Any) -> None:
        nonlocal alarm
        if time.monotonic() > alarm:  # a second is exact enough, and each arming starts a thread
            faulthandler.dump_traceback_later(seconds + 1, exit=True)
            alarm = time.monotonic() + 1
        out.write(json.dumps(message) + "\n")
        out.flush()

    faulthandler.enable()
    tuple(catalog())  # import them all: the time of that is not the lesson's
    send(doing="loading it")
    for problem in _looked_at(
        word, seconds, lambda doing: send(doing=doing), named=lambda name: send(name=name)
    ):
        send(holds=problem)
    send(end=True)
    out.close()
    os._exit(0)  # threads that a lesson left behind keep nobody waiting


def _looked_at(
    word: str, seconds: float, tell: Callable[[str], object], *, named: Callable[[str], object]
) -> Iterator[str | None]:
    try:
        lesson = lesson_given(word)
    except InputError as error:
        yield str(error)
        return
    named(lesson.name)
    yield from look_at(Subject(lesson, seconds=seconds, tell=tell))


def _limit_memory() -> None:
    with contextlib.suppress(ImportError, ValueError, OSError):
        import resource

        hard = resource.getrlimit(resource.RLIMIT_AS)[1]
        most = MEGABYTES << 20
        resource.setrlimit(
            resource.RLIMIT_AS, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard)
        )
