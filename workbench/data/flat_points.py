"""Points that people bring in the plane: two columns of text; and of something round."""

import functools
from pathlib import Path
from typing import Literal

import numpy as np
from jaxtyping import Float

from workbench.apart import apart
from workbench.data.files import finite, number_rows, read_cloud, stamp
from workbench.data.files.formats import is_number, text_of, words_of
from workbench.data.framing import box
from workbench.data.thinning import evenly
from workbench.errors import InputError
from workbench.geometry.shapes.algebraic_fits import fit_algebraic

# metres that points are long in the picture, where nothing round says how large they are
WIDTH = 2.0
LARGEST = 3.0  # times as large as the points a circle may be that they are shown by
LOOK = 100_000  # signs at the beginning of a file that tell how many columns it has
_TEXT = (".xyz", ".txt", ".csv", ".tsv", ".dat")


def read_flat_or_cloud(path: Path, fewest: int = 3) -> Float[np.ndarray, "n d"]:
    """Return places in the plane (n, 2) of a text file of two columns, else a cloud (n, 3).

    Columns are separated by commas, semicolons, tabs or spaces; a header is passed over.

    Raises:
        InputError: If it is not understood, or has fewer than `fewest` points.
    """
    return _read(path, fewest, stamp(path))


def read_round(
    path: Path, shape: Literal["circle", "sphere", "cylinder", "plane"], most: int
) -> tuple[Float[np.ndarray, "n d"], float]:
    """Return a shape's points about the origin, its radius about 1 m, and the file's unit per m.

    At most `most` points are used, evenly chosen. Of a cylinder or a plane, and of an arc so short
    that its circle is far larger, the box is about the origin, 2 m long.

    Raises:
        InputError: If the file is not understood, has other columns, or all points lie at one
            place; and where something round is wanted, if they lie on a line or a plane.
    """
    p = read_flat_or_cloud(path, fewest=6)
    p = p[evenly(len(p), most)]
    wanted = 2 if shape == "circle" else 3
    if wanted != p.shape[1]:
        raise InputError(f"{path.name} has {p.shape[1]} columns, and a {shape} needs {wanted}")
    size = np.ptp(p, axis=0).max()
    if not size > 0:
        raise InputError(f"{path.name}: all its points lie at one place")
    low, high = box(p)
    center = (low + high) / 2
    unit = size / WIDTH
    if shape != "plane" and np.linalg.matrix_rank(p - p.mean(axis=0), tol=1e-9 * size) < wanted:
        flat = "line" if wanted == 2 else "plane"
        raise InputError(
            f"{path.name}: the points lie on a {flat}, and nothing round fits them best"
        )
    fit = fit_algebraic(p) if shape in ("circle", "sphere") else None
    if fit is not None and fit[-1] < LARGEST * size:
        center = fit[:-1]
        unit = fit[-1]
    return (p - center) / unit, float(unit)


@functools.lru_cache(maxsize=4)
def _read(path: Path, fewest: int, _stamp: tuple[int, int]) -> np.ndarray:
    p = _flat(path, fewest) if path.suffix.lower() in _TEXT else None
    if p is None:
        return read_cloud(path, fewest)
    p.setflags(write=False)
    return p


@apart
def _flat(path: Path, fewest: int) -> np.ndarray | None:
    """Return the places in a text file of two columns, None where it has others."""
    stamp(path)
    text = text_of(path.read_bytes(), path.name)
    begin = text[: text.rfind("\n", 0, LOOK) + 1] if len(text) > LOOK else text
    if (
        max(
            (len(words_of(line)) for line in begin.splitlines() if line.lstrip()[:1] != "#"),
            default=0,
        )
        != 2
    ):
        return None
    rows = [words for _, words in number_rows(path, "points", _TEXT)]
    if not all(len(row) == 2 and all(is_number(word) for word in row) for row in rows):
        raise InputError(f"{path.name}: two numbers x y are wanted on each line")
    p = finite(np.array(rows, float).reshape(-1, 2), path.name)
    if len(p) < fewest:
        raise InputError(
            f"{path.name}: at least {fewest} lines of two finite numbers x y are wanted"
        )
    return p
