"""Follows the files of a lesson while they are edited: every save is a new lesson, or says why it
is none.
"""

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from workbench import knobs
from workbench.errors import AuthorError, InputError
from workbench.lesson import Lesson
from workbench.run.loading import load, taken_by
from workbench.run.timeline import Timeline

FOLLOWED = (".py", ".md", ".svg", ".png", ".jpg", ".jpeg", ".webp")


class Edited:
    """A lesson that was given by its path.

    Args:
        path: Its file or folder. Of a folder all code, text and pictures are followed, of a file it
            and its page.
        lesson: The lesson as it is now.

    Attributes:
        lesson: The last one that could be loaded.
        trouble: Why the last save cannot be used, with file and line; None where it can.
    """

    def __init__(self, path: Path, lesson: Lesson):
        self.path, self.lesson = path, lesson
        self.trouble: InputError | None = None
        self._stamp = self._stamp_now()

    def changed(self) -> bool:
        """Load the lesson again if something was saved since, and tell whether; its code runs,
        which may take a while.

        A lesson whose default run has no first step counts as broken: the one before is kept.
        """
        stamp = self._stamp_now()
        if stamp == self._stamp:
            return False
        self._stamp = stamp
        try:
            lesson = load(self.path)
            other = taken_by(lesson)
            if other is not None:
                raise InputError(
                    f"{self.path}: its name {lesson.name!r} is taken by {other}; give it another"
                )
            first = Timeline(lesson, lesson.params())
            first.extend()
            if first.stopped is not None and not len(first):
                raise AuthorError(first.stopped, first.failure or "")
        except InputError as error:
            self.trouble = error
        except SystemExit:
            self.trouble = AuthorError(
                f"lesson {self.lesson.name}: {self.path}: its code ends the program"
            )
        else:
            self.lesson = lesson
            self.trouble = None
        return True

    def _stamp_now(self) -> dict[str, tuple[int, int]]:
        return dict(self._files())

    def _files(self) -> Iterator[tuple[str, tuple[int, int]]]:
        """Yield each file with what tells that it was saved; one that an editor is replacing right
        now is left out.
        """
        pages = [] if self.lesson.page is None else [str(self.lesson.page)]
        for file in [*pages, *(_in_folder(self.path) if self.path.is_dir() else [str(self.path)])]:
            try:
                stat = os.stat(file)
            except OSError:
                continue
            yield file, (stat.st_mtime_ns, stat.st_size)


def _in_folder(folder: Path) -> Iterator[str]:
    for place, folders, files in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith((".", "__"))]
        yield from (
            os.path.join(place, name)
            for name in files
            if name.endswith(FOLLOWED) and name[0] != "."
        )


def carried(params: Any, lesson: Lesson) -> Any:
    """Return the params of one version of a lesson as those of another.

    What is a field of both keeps its value, moved into its new range; what cannot be kept has its
    default.
    """
    before = {field.name: getattr(params, field.name) for field in knobs.fields_of(type(params))}
    kept = {}
    for field in knobs.fields_of(lesson.params):
        if field.name in before:
            try:
                kept[field.name] = field.clean(before[field.name], clamp=True)
            except InputError:  # another type or other choices
                continue
    try:
        return knobs.make(lesson.params, kept)
    except InputError:
        return lesson.params()
