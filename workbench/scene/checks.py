"""What is asked of the values that make up a scene, each refusal in words that say what would
do.
"""

import numpy as np


def need(holds: bool, message: str) -> None:
    """Raise ValueError with the message where this does not hold."""
    if not holds:
        raise ValueError(message)


def what(value: object) -> str:
    """Return what a value is, for the end of such a message."""
    return f"{value!r:.40}" if isinstance(value, str) else f"of type {type(value).__name__}"


def check_array(name: str, value: object) -> None:
    """Refuse what is no array."""
    need(
        isinstance(value, np.ndarray),
        f"{name} is an array, not {what(value)}: np.asarray(...) makes one",
    )


def check_text(name: str, value: object) -> None:
    """Refuse what is no text."""
    need(isinstance(value, str), f'{name} is a text, not {what(value)}: f"{{...:.3f}}" makes one')


def check_finite(name: str, values: np.ndarray) -> None:
    """Refuse numbers that are not finite."""
    need(
        bool(np.isfinite(values).all()),
        f"{name} holds NaN or infinity: leave such rows out before drawing",
    )


def check_rows(name: str, rows: np.ndarray, columns: int) -> None:
    """Refuse what is not (n, columns) finite numbers."""
    check_array(name, rows)
    need(rows.ndim == 2 and rows.shape[1] == columns, f"{name} is (n, {columns}), not {rows.shape}")
    check_finite(name, rows)


def check_image(name: str, image: np.ndarray) -> None:
    """Refuse what is no image of grey or RGB bytes."""
    check_array(name, image)
    good = (
        image.dtype == np.uint8
        and (image.ndim == 2 or (image.ndim == 3 and image.shape[2] == 3))
        and image.size > 0
    )
    need(good, f"{name} is (h, w) or (h, w, 3) uint8, not {image.dtype} {image.shape}")
