"""Values that may be missing, where the step at hand has them."""

from typing import TypeVar

T = TypeVar("T")


def sure(value: T | None) -> T:
    """Return a value that this step has."""
    assert value is not None
    return value


def as_a(kind: type[T], value: object) -> T:
    """Return a value that is of this kind in this step."""
    assert isinstance(value, kind)
    return value
