"""Stands for jaxtyping in a browser, where nobody checks shapes: an array is annotated as an array.

jaxtyping itself takes half a second of processor time there, until the first picture.
"""

from typing import Any


class Array:
    """`Float[np.ndarray, "n 3"]` and its like."""

    def __class_getitem__(cls, item: tuple[type, str]) -> type:
        """Return the kind of array, without its shape."""
        return item[0]


def __getattr__(name: str) -> Any:
    if name.startswith("_"):
        raise AttributeError(name)
    return Array
