"""Follows a student's file while it is edited: the lesson it drives, what its checks say."""

import os
from pathlib import Path
from typing import Any

from workbench.errors import InputError
from workbench.exercise.driven import driven
from workbench.exercise.finding import exercises_in
from workbench.exercise.grading import Report, grade_function
from workbench.exercise.model import Exercise
from workbench.exercise.sandbox import SandboxedFunction
from workbench.lesson import Lesson, Preset

RUNNING = "The checks are running …"
GONE_AFTER = 4
"""After how many looks a file that is not there is gone: an editor may be replacing it."""


class WatchedFile:
    """A student's file beside a lesson, whose run it drives.

    Attributes:
        lesson: The lesson as the file drives it now.
        said: What the public checks found last, or one line that says why they found nothing.

    Raises:
        InputError: If the file cannot be used, or holds no function of this lesson.
    """

    def __init__(self, lesson: Lesson, path: Path):
        self.original, self.path = lesson, path
        self.exercise: Exercise = exercises_in(path, lesson)[0]
        self._stamp = self._stamp_now()
        self._missing = 0  # at how many looks in a row it was not there
        self._student = self._new()
        self.lesson = driven(lesson, self.exercise, self._student)
        self.said: Report | str = RUNNING

    @property
    def source(self) -> str:
        """The file's text as it drives the lesson."""
        return self._student.source

    def first_preset(self, params: Any) -> Preset | None:
        """Return the preset that calls the function, where the default run does not."""
        name = self.exercise.contract.preset
        return (
            None if name is None or params != self.original.params() else self.original.preset(name)
        )

    def printed(self) -> str:
        """Return the beginning of what the function printed in the runs that it drives."""
        return self._student.printed()

    def changed(self) -> bool:
        """Load the file again if it was saved since; tell whether it was.

        Where it cannot be loaded, or is gone, `said` says so, and the run before stays.
        """
        stamp = self._stamp_now()
        self._missing = self._missing + 1 if stamp is None else 0
        if stamp is None and self._missing == GONE_AFTER:
            self.said = f"{self.path.name} is gone: what is shown ran before. Save it there again."
            self._stamp = None
        if stamp is None or stamp == self._stamp:
            return False
        self._stamp, self.said = stamp, RUNNING
        old = self._student
        try:
            self._student = self._new()
        except InputError as error:
            self.said = str(error)
            return False
        self.lesson = driven(self.original, self.exercise, self._student)
        old.close()
        return True

    def follow(self, lesson: Lesson) -> None:
        """Drive another version of the lesson from now on.

        Raises:
            InputError: If the file holds no function of it; nothing has changed then.
        """
        self.exercise = exercises_in(self.path, lesson)[0]
        self.original, self.lesson = lesson, driven(lesson, self.exercise, self._student)
        self.said = RUNNING

    def check(self) -> None:
        """Run the public checks on the file as it is now; `said` is what they found then."""
        stamp = self._stamp
        outcome: Report | str
        try:
            with self._new() as student:
                outcome = grade_function(student, self.exercise, hidden=False, file=self.path.name)
        except InputError as error:
            outcome = str(error)
        if stamp == self._stamp:  # or else the file was saved meanwhile, and is checked again
            self.said = outcome

    def close(self) -> None:
        """End the child process."""
        self._student.close()

    def _new(self) -> SandboxedFunction:
        return SandboxedFunction(
            self.path, self.exercise.name, seconds=self.exercise.contract.seconds
        )

    def _stamp_now(self) -> tuple[int, int] | None:
        try:
            status = os.stat(self.path)
        except OSError:  # an editor may be replacing it right now
            return None
        return status.st_mtime_ns, status.st_size
