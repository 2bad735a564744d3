"""What a site has that its pages compute with: Python, and the archive of the core and lessons."""

import hashlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from workbench.computed import archive
from workbench.knobs import changed
from workbench.lesson import Lesson, course, is_of_course
from workbench.page.bundles import COMPUTING, STATIC, bare
from workbench.page.lessons import lesson_data
from workbench.publish.python import FOLDER, Python, python_from
from workbench.publish.runs import PAGE, runs_of

CORE = f"{FOLDER}/core.zip"


@dataclass(frozen=True)
class Computing:
    """What the pages of a site compute with.

    Args:
        python: Where they get Python from.
        files: All that the site has for it: name -> content.
        lessons: Names of those that the archive holds.
    """

    python: Python
    files: Mapping[str, bytes]
    lessons: frozenset[str]

    def page_data(self, lesson: Lesson) -> dict[str, Any] | None:
        """Return what a lesson's page must know; None of a lesson that is none of the course, which
        the archive does not hold.
        """
        if lesson.name not in self.lessons:
            return None
        core = self.files[CORE]
        address = self.python.address
        return {
            "from": address if "://" in address else f"../{address}",
            "core": f"../{CORE}?{hashlib.sha256(core).hexdigest()[:12]}",
            "sizes": {name: len(content) for name, content in self.python.files.items()},
            "bytes": len(core) + sum(map(len, self.python.files.values())),
            "knobs": lesson_data(lesson)["knobs"],
            "params": {run.name: changed(run.params) for run in runs_of(lesson)},
        }


def computing(place: str, lessons: Iterable[Lesson], others: Iterable[str]) -> Computing:
    """Return what a site computes with.

    Args:
        place: A folder with the files of a Pyodide release, or its address.
        lessons: What is published.
        others: Names of the lessons that the site has already, which compute as well.

    Raises:
        InputError: If the place cannot be used.
    """
    python = python_from(place)
    known = course()
    names = {lesson.name for lesson in lessons if is_of_course(lesson)}
    names |= set(others) & known.keys()
    files = {f"{python.address}{name}": content for name, content in python.files.items()}
    files[CORE] = archive.packed([known[name] for name in sorted(names)])
    *ours, editor = COMPUTING
    files |= {f"{PAGE}/{name}": bare(STATIC / name).encode() for name in ours}
    files[f"{PAGE}/{editor}"] = (STATIC / editor).read_bytes()
    return Computing(python, files, frozenset(names))
