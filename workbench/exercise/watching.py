"""Follows a student's file while it is edited: the lesson it drives, and what its public checks say."""

import os
from pathlib import Path

from workbench.errors import InputError
from workbench.exercise.beside import beside
from workbench.exercise.grading import grade_function
from workbench.exercise.model import Exercise
from workbench.exercise.reports import terminal
from workbench.exercise.sandbox import Student
from workbench.exercise.starter import exercises_in
from workbench.lesson import Lesson


class Watched:
    """A student's file beside a lesson.

    Args:
        lesson: The lesson whose run it drives.
        path: The file; it defines the function of one of the lesson's exercises.

    Raises:
        InputError: If the file cannot be used, or holds no function of this lesson.
    """

    def __init__(self, lesson: Lesson, path: Path):
        self.original, self.path = lesson, path
        found = [exercise for exercise in exercises_in(path) if exercise in lesson.exercises]
        if not found:
            names = ", ".join(exercise.name for exercise in lesson.exercises) or "none"
            raise InputError(f"{path}: defines no function that lesson {lesson.name} can take; it takes: {names}")
        self.exercise: Exercise = found[0]
        self._stamp = self._stamp_now()
        self._student = self._new()
        self.lesson = beside(lesson, self.exercise, self._student)

    def changed(self) -> bool:
        """Load the file again if it was saved since; tell whether it was."""
        stamp = self._stamp_now()
        if stamp is None or stamp == self._stamp:
            return False
        self._stamp = stamp
        old = self._student
        self._student = self._new()
        self.lesson = beside(self.original, self.exercise, self._student)
        old.close()
        return True

    def report(self) -> str:
        """Run the public checks on the file as it is now and return the report, or the line that says why not."""
        try:
            with self._new() as student:
                student.start()
                return terminal(grade_function(student, self.exercise, hidden=False, file=self.path.name))
        except InputError as error:
            return str(error)

    def close(self) -> None:
        """End the child process."""
        self._student.close()

    def _new(self) -> Student:
        return Student(self.path, self.exercise.name, seconds=self.exercise.seconds)

    def _stamp_now(self) -> tuple[int, int] | None:
        try:
            found = os.stat(self.path)
        except OSError:  # an editor may be replacing it right now
            return None
        return found.st_mtime_ns, found.st_size
