"""What a hand-in uses that its exercise forbids, because it solves the task in one call.

It is a rule for students, read off what they wrote: nothing of it is run. It is no wall; those are
in `sandbox`.
"""

from workbench.exercise.model import Exercise
from workbench.exercise.submission import Statement, Submission


def forbidden_use(given: Submission, exercise: Exercise) -> str:
    """Return one line that says what a file uses though its exercise forbids it, or nothing.

    What only functions use that the exercise's own does not call does not count.
    """
    forbid = exercise.contract.forbid
    if not forbid:
        return ""
    files = [(given.file, _counting(given.parts, exercise.name))]
    files += [(f"{name}.py", list(parts)) for name, parts in given.extra_files.items()]
    for file, parts in files:
        for path, line in (use for part in parts for use in part.uses):
            module = next(
                (banned for banned in forbid if f"{path}.".startswith(f"{banned}.")), None
            )
            if module is not None:
                where = (
                    f"{file}, line {line}: uses {module}, which is forbidden for {exercise.name}"
                )
                return f"{where}, since it solves the task: write it yourself."
    return ""


def _counting(parts: tuple[Statement, ...], name: str) -> list[Statement]:
    """Return the statements without functions that `name` does not reach, and their own needs."""
    ours = _reached([k for k, part in enumerate(parts) if part.runs or name in part.binds], parts)
    others = [k for k, part in enumerate(parts) if part.defines and k not in ours]
    left = _reached(others, parts) - ours
    return [part for k, part in enumerate(parts) if k not in left]


def _reached(begin: list[int], parts: tuple[Statement, ...]) -> set[int]:
    """Return the indices of statements, and of all that bind the names which they read."""
    places: dict[str, list[int]] = {}
    for k, part in enumerate(parts):
        for name in part.binds:
            places.setdefault(name, []).append(k)
    reached, waiting = set(begin), list(begin)
    while waiting:
        for name in parts[waiting.pop()].reads:
            new = [k for k in places.pop(name, ()) if k not in reached]
            reached.update(new)
            waiting += new
    return reached
