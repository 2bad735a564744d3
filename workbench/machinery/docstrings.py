"""What a docstring says first."""

import inspect


def summary_of(function: object) -> str:
    """Return the first paragraph of a docstring as one line; empty where there is none."""
    return " ".join((inspect.getdoc(function) or "").split("\n\n")[0].split())
