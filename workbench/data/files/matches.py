"""Matches between two images that people bring, read or refused in one clear line."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from jaxtyping import Float

from workbench.apart import apart
from workbench.data.files.arrays import read_arrays
from workbench.data.files.formats import is_number
from workbench.data.files.intrinsics import checked_intrinsics
from workbench.data.files.reading import finite, stamp, word_rows
from workbench.errors import InputError
from workbench.geometry.motions import motion

_FIRST, _SECOND = ("x1", "uv1", "p1", "first"), ("x2", "uv2", "p2", "second")
_BOTH = ("matches", "p")
_QUALITY = ("quality", "score", "scores")


@dataclass(frozen=True, eq=False)
class Matches:
    """Matches of a file; what it does not have is None.

    Attributes:
        p: Rows (u, v, u', v'), pixels of the first image and of the second.
        quality: How much each is trusted, more is better.
        H: The true homography, first to second.
        F: The true fundamental matrix, `uv_second_h.T @ F @ uv_first_h = 0`.
        T_second_first: The true motion between the cameras; its length means nothing.
    """

    p: Float[np.ndarray, "n 4"]
    quality: Float[np.ndarray, " n"] | None
    H: Float[np.ndarray, "3 3"] | None
    F: Float[np.ndarray, "3 3"] | None
    K_first: Float[np.ndarray, "3 3"] | None = None
    K_second: Float[np.ndarray, "3 3"] | None = None
    T_second_first: Float[np.ndarray, "4 4"] | None = None


@apart
def read_matches(path: Path, fewest: int = 4) -> Matches:
    """Return the matches of a file.

    Formats: npz with arrays x1 and x2 (n, 2), or matches (n, 4), and optionally quality (n,), H, F,
    K or K1 and K2 (3, 3), R (or R_rel) and t (or t_rel) from the first camera to the second; or
    text lines u v u' v' and optionally a quality. Rows with NaN or infinity are left out, and
    counted.

    Raises:
        InputError: If the file is missing, too large, not understood, or has fewer than `fewest`
            matches.
    """
    path = Path(path)
    stamp(path)
    matches = _from_arrays(path) if path.suffix.lower() == ".npz" else _from_text(path)
    good = np.isfinite(matches.p).all(axis=1)
    p = finite(matches.p, path.name, "match", many="matches")
    matches = replace(
        matches, p=p, quality=None if matches.quality is None else matches.quality[good]
    )
    if len(matches.p) < fewest:
        raise InputError(f"{path.name}: {len(matches.p)} matches; at least {fewest} are needed")
    return matches


def _from_arrays(path: Path) -> Matches:
    arrays = read_arrays(path.read_bytes(), path.name)
    first, second, both = (_named(arrays, names) for names in (_FIRST, _SECOND, _BOTH))
    if first is not None and second is not None:
        p = (
            np.concatenate([_rows(path, first, 2), _rows(path, second, 2)], axis=1)
            if len(first) == len(second)
            else None
        )
        if p is None:
            raise InputError(
                f"{path.name}: {len(first)} pixels in the first image and {len(second)} in the"
                " second"
            )
    elif both is not None:
        p = _rows(path, both, 4)
    else:
        raise InputError(
            f"{path.name}: no arrays x1 and x2, nor matches, but {', '.join(arrays) or 'nothing'}"
        )
    quality = _named(arrays, _QUALITY)
    if quality is not None and (quality.shape != (len(p),) or quality.dtype.kind not in "fiu"):
        raise InputError(
            f"{path.name}: quality is {quality.dtype} {quality.shape}, where ({len(p)},) numbers"
            " are wanted"
        )
    K_first, K_second = (_camera(path, arrays, name) for name in ("K1", "K2"))
    return Matches(
        p=p,
        quality=None if quality is None else quality.astype(float),
        H=_scaled(_truth(path, arrays, ("H",))),
        F=_scaled(_truth(path, arrays, ("F",))),
        K_first=K_first,
        K_second=K_first if K_second is None else K_second,
        T_second_first=_motion(path, arrays),
    )


def _from_text(path: Path) -> Matches:
    kept = [words for _, words in word_rows(path, "matches", None)]
    if kept and not is_number(kept[0][0]):
        kept = kept[1:]  # a line of names
    widths = {len(words) for words in kept}
    if len(widths) != 1 or widths <= {0, 1, 2, 3}:
        raise InputError(
            f"{path.name}: not lines of four numbers u v u' v', with a quality as the fifth where"
            " known"
        )
    try:
        table = np.array(kept, dtype=float)
    except ValueError:
        raise InputError(
            f"{path.name}: not all of it are numbers; four or five a line are wanted"
        ) from None
    return Matches(
        table[:, :4].copy(), table[:, 4].copy() if table.shape[1] > 4 else None, None, None
    )


def _named(arrays: dict[str, np.ndarray], names: tuple[str, ...]) -> np.ndarray | None:
    return next((arrays[name] for name in names if name in arrays), None)


def _rows(path: Path, array: np.ndarray, columns: int) -> np.ndarray:
    if array.ndim != 2 or array.shape[1] != columns or array.dtype.kind not in "fiu":
        raise InputError(
            f"{path.name}: an array of {array.dtype} {array.shape}, where (n, {columns}) numbers"
            " are wanted"
        )
    return array.astype(float)


def _truth(
    path: Path,
    arrays: dict[str, np.ndarray],
    names: tuple[str, ...],
    *,
    shape: tuple[int, ...] = (3, 3),
) -> np.ndarray | None:
    matrix = _named(arrays, names)
    if matrix is None:
        return None
    if (
        matrix.shape != shape
        or matrix.dtype.kind not in "fiu"
        or not np.isfinite(matrix).all()
        or not matrix.any()
    ):
        wanted = (
            "3 x 3 matrix of finite numbers" if shape == (3, 3) else "vector of 3 finite numbers"
        )
        raise InputError(f"{path.name}: {names[0]} is no {wanted}")
    return matrix.astype(float)


def _scaled(matrix: np.ndarray | None) -> np.ndarray | None:
    return None if matrix is None else matrix / np.linalg.norm(matrix)


def _camera(path: Path, arrays: dict[str, np.ndarray], name: str) -> np.ndarray | None:
    K = _truth(path, arrays, (name, "K"))
    return None if K is None else checked_intrinsics(K, f"{path.name}: {name} is")


def _motion(path: Path, arrays: dict[str, np.ndarray]) -> np.ndarray | None:
    R = _truth(path, arrays, ("R", "R_rel"))
    t = _truth(path, arrays, ("t", "t_rel"), shape=(3,))
    if R is None or t is None:
        return None
    if np.abs(R @ R.T - np.eye(3)).max() > 1e-3 or np.linalg.det(R) < 0:
        raise InputError(f"{path.name}: R is no rotation")
    return motion(R, t)
