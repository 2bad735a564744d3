"""Intrinsics that people bring, read or refused in one clear line."""

from pathlib import Path

import numpy as np
from jaxtyping import Float

from workbench.apart import apart
from workbench.data.files.reading import word_rows
from workbench.errors import InputError

_KINDS = (".txt", ".csv", ".dat", "")


@apart
def read_intrinsics(path: Path) -> Float[np.ndarray, "3 3"]:
    """Return K from a text file: four numbers fx fy cx cy, or three rows of three.

    Raises:
        InputError: If it is neither, or no camera, as `checked_intrinsics` says.
    """
    words = [word for _, row in word_rows(path, "intrinsics", _KINDS) for word in row]
    try:
        numbers = np.array(words, float)
    except ValueError:
        raise InputError(
            f"{path.name}: K is numbers, four (fx fy cx cy) or three rows of three"
        ) from None
    if numbers.shape == (4,):
        fx, fy, cx, cy = numbers
        numbers = np.array([fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0])
    if numbers.shape != (9,) or not np.isfinite(numbers).all():
        raise InputError(
            f"{path.name}: {len(numbers)} numbers; K is four (fx fy cx cy) or three rows of three"
        )
    return checked_intrinsics(numbers.reshape(3, 3), f"{path.name}:")


def checked_intrinsics(K: Float[np.ndarray, "3 3"], where: str) -> Float[np.ndarray, "3 3"]:
    """Return K as it is; a refusal begins with `where` it stands.

    Raises:
        InputError: If a focal length is not positive, the last row not 0 0 1, or rows depend on x.
    """
    if not (K[0, 0] > 0 and K[1, 1] > 0 and K[2].tolist() == [0.0, 0.0, 1.0] and K[1, 0] == 0.0):
        raise InputError(
            f"{where} no K of a camera: fx and fy are positive, and the last row is 0 0 1"
        )
    return K
