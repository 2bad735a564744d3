"""Writes the folder that a new lesson begins with: a whole lesson that runs, holds its promises,
and is there to be changed.

It is copied from the files of `template/`, a lesson like any other but for its name.
"""

import keyword
import shutil
from pathlib import Path

from workbench.errors import InputError
from workbench.lesson import catalog

TEMPLATE = Path(__file__).with_name("template")
NAME = '"NAME"'
"""What stands for the lesson's name in the template's lesson.py."""
TITLE = "The weighted mean"
"""The title of the template's lesson."""


def new_lesson(name: str, into: Path = Path()) -> list[Path]:
    """Write the folder of a new lesson and return its files.

    Args:
        name: The lesson's name, and its folder's.
        into: Where the folder is made.

    Raises:
        InputError: If the name is none, or taken, something has the folder's name, or it cannot be
            written.
    """
    if not (
        name.isidentifier()
        and name.isascii()
        and name == name.lower()
        and not keyword.iskeyword(name)
    ):
        raise InputError(
            f"{name!r} is no name for a lesson: small letters, digits and _, such as plane_sweep"
        )
    if name in catalog():
        raise InputError(f"a lesson {name!r} is there already: `workbench list` shows all")
    folder = into / name
    try:
        folder.mkdir(parents=True)
        copied = shutil.copytree(
            TEMPLATE, folder, ignore=shutil.ignore_patterns("__*"), dirs_exist_ok=True
        )
        lesson = Path(copied) / "lesson.py"
        lesson.write_text(
            lesson.read_text(encoding="utf-8").replace(NAME, f'"{name}"'), encoding="utf-8"
        )
    except FileExistsError:
        raise InputError(f"{folder} is there already: nothing was written") from None
    except OSError as error:
        raise InputError(f"{folder}: {error.strerror or 'cannot be written'}") from None
    return sorted(path for path in folder.rglob("*") if path.is_file())
