"""Writes what a student starts from: signature, contract, two examples, a sample solution."""

import inspect
import textwrap
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from workbench.errors import InputError
from workbench.exercise.model import Exercise
from workbench.exercise.sandbox.budget import CALLS
from workbench.exercise.sandbox.function import MEGABYTES
from workbench.exercise.sandbox.isolation import OUTPUT_BYTES
from workbench.exercise.sandbox.python import ALLOWED
from workbench.lesson import catalog
from workbench.machinery.atomic import write_atomic
from workbench.run.loading import word_for


def starter(exercise: Exercise, megabytes: int = MEGABYTES) -> str:
    """Return the text of a starter file; one call may take `megabytes` where it is graded."""
    function = exercise.reference
    signature = inspect.signature(function)
    arguments = ", ".join(_argument(parameter) for parameter in signature.parameters.values())
    returned = _plain(signature.return_annotation)
    shapes = list(_shapes(signature))
    doc = inspect.cleandoc(function.__doc__ or "")
    if shapes:
        doc += "\n\nShapes:\n" + "\n".join(f"    {line}" for line in shapes)
    if exercise.contract.examples:
        doc += "\n\nExamples:\n" + "\n".join(
            f"    {call}\n        gives {result}" for call, result in exercise.contract.examples
        )
    indented = textwrap.indent(doc, "    ").lstrip()
    _, watching, judging = commands(exercise)
    return f'''"""Exercise {exercise.name}, lesson {exercise.lesson}.

{textwrap.fill(exercise.task, 100)}

Watch it live:  {watching}
Have it judged: {judging}

{textwrap.fill(allowed(exercise, megabytes), 100)}
"""

import numpy as np


def {exercise.name}({arguments}) -> {returned}:
    """{indented}
    """
    raise NotImplementedError
'''


def sample(exercise: Exercise) -> str:
    """Return the text of a file that earns full marks: the first alternative, in numpy alone.

    Raises:
        InputError: If the exercise has no alternative.
    """
    if not exercise.alternatives:
        raise InputError(
            f"exercise {exercise.name} has no @alternative, which would be the sample solution"
        )
    function = exercise.alternatives[0]
    source = inspect.getsource(function).removeprefix("@alternative\n")
    return f'''"""Exercise {exercise.name}, lesson {exercise.lesson}.

A sample that earns full marks, for the teacher: do not hand it out.
"""

import numpy as np


{source}

{exercise.name} = {function.__name__}
'''


def allowed(exercise: Exercise, megabytes: int = MEGABYTES) -> str:
    """Return what a student's function may use, in sentences."""
    room = f"{megabytes} MB" if megabytes % 1024 else f"{megabytes >> 10} GB"
    seconds, forbid = exercise.contract.seconds, exercise.contract.forbid
    but = (
        f" It may not use {' or '.join(forbid)}, which solves the task: who does earns nothing."
        if forbid
        else ""
    )
    return (
        f"It may use Python's own library, {' and '.join(ALLOWED)}, and modules that lie beside"
        f" this file.{but} One call may take {seconds:g} s and {room}, all calls together"
        f" {CALLS * seconds:g} s. It may print: the first {OUTPUT_BYTES >> 10} KB are kept. It"
        " reaches no network, no other program and no file that is not its own. The first line"
        " above says what this file is handed in for: leave it there."
    )


def commands(exercise: Exercise) -> tuple[str, str, str]:
    """Return what a student types to get the starter, to watch the function, to have it judged."""
    lesson = word_for(exercise.lesson, exercise.reference.__module__)
    given = "" if lesson == exercise.lesson and lesson in catalog() else f" --lesson {lesson}"
    file = exercise.file
    return (
        f"workbench exercise {exercise.name}{given}",
        f"workbench show {lesson} --with {file}",
        f"workbench check {file}{given}",
    )


def write_starter(exercise: Exercise, folder: Path, *, force: bool = False) -> Path:
    """Write the starter file of an exercise into a folder and return its path.

    Raises:
        InputError: If the file is there already, or cannot be written.
    """
    path = folder / exercise.file
    if path.exists() and not force:
        raise InputError(f"{path} is there already: move it away, or start over with --force")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        write_atomic(path, starter(exercise).encode())
    except OSError as error:
        raise InputError(f"{path}: {error.strerror or 'cannot be written'}") from None
    return path


def _argument(parameter: inspect.Parameter) -> str:
    text = f"{parameter.name}: {_plain(parameter.annotation)}"
    return text if parameter.default is parameter.empty else f"{text} = {parameter.default!r}"


def _plain(annotation: Any) -> str:
    """Return an annotation that needs no import but numpy."""
    if annotation in (inspect.Parameter.empty, inspect.Signature.empty):
        return "np.ndarray"
    if annotation is np.ndarray or hasattr(annotation, "dim_str"):
        return "np.ndarray"
    text = annotation.__name__ if isinstance(annotation, type) else str(annotation)
    return "tuple" if text.startswith("tuple") else text.replace("numpy.", "np.")


def _shapes(signature: inspect.Signature) -> Iterator[str]:
    named = [(parameter.name, parameter.annotation) for parameter in signature.parameters.values()]
    for name, annotation in [*named, ("returned", signature.return_annotation)]:
        dimensions = getattr(annotation, "dim_str", None)
        if dimensions is not None:
            kind = annotation.__name__.split("[")[0].lower()
            yield (
                f"{name}:"
                f" ({', '.join(dimensions.split())}{',' if len(dimensions.split()) == 1 else ''})"
                f" {kind}"
            )
