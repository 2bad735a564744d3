"""Points that people bring in the plane: two columns of a text file."""

import functools
from pathlib import Path

import numpy as np
from jaxtyping import Float

from workbench.data.files import number_rows, read_cloud, stamp, word_rows
from workbench.data.formats import is_number
from workbench.errors import InputError

_TEXT = (".xyz", ".txt", ".csv", ".tsv", ".dat")


def read_flat_or_cloud(path: Path, fewest: int = 3) -> Float[np.ndarray, "n d"]:
    """Return places in the plane (n, 2) from a text file of two columns, and else a cloud (n, 3), as `read_cloud` does.

    Columns are separated by commas, semicolons, tabs or spaces; a header is passed over.

    Args:
        path: The file.
        fewest: How many points are needed.

    Raises:
        InputError: If it is not understood, or has fewer points.
    """
    return _read(path, fewest, stamp(path))


@functools.lru_cache(maxsize=4)
def _read(path: Path, fewest: int, _stamp: tuple[int, int]) -> np.ndarray:
    if path.suffix.lower() not in _TEXT:
        return read_cloud(path, fewest)
    if max((len(words) for _, words in word_rows(path, "points", _TEXT)), default=0) != 2:
        return read_cloud(path, fewest)
    rows = [words for _, words in number_rows(path, "points", _TEXT)]
    if not all(len(row) == 2 and all(is_number(word) for word in row) for row in rows):
        raise InputError(f"{path.name}: two numbers x y are wanted on each line")
    p = np.array(rows, float).reshape(-1, 2)
    if len(p) < fewest or not np.isfinite(p).all():
        raise InputError(f"{path.name}: at least {fewest} lines of two finite numbers x y are wanted")
    p.setflags(write=False)
    return p
