"""Poses that people bring, read or refused in one line."""

import re
from pathlib import Path

import numpy as np
import scipy
from jaxtyping import Float

from workbench.apart import apart
from workbench.data.files.formats import text_of
from workbench.data.files.reading import content_of, in_number, load_array, stamp
from workbench.errors import InputError
from workbench.geometry.motions import inverse, motion

MOST_OF_POSES = 2 * 10**6  # bytes


@apart
def read_pose(
    path: Path, target: Path | None = None, source: Path | None = None
) -> Float[np.ndarray, "4 4"]:
    """Return the T_target_source that a file gives.

    The file is 16 numbers row by row (text or npy), or a list of poses by the name of a scan, each
    from the scan into one common frame: rows of 12 or 16 numbers, or a Stanford .conf (translation,
    then a quaternion x, y, z, w that is stored conjugated). A list needs `target`, the scan in
    whose frame the pose is, and `source`, the scan that it moves.

    Raises:
        InputError: If the file is missing, not understood, no pose, or a list without the two
            scans.
    """
    path = Path(path)
    stamp(path)
    content, kind = content_of(path)
    if kind == ".npy":
        T = load_array(content, path.name)
        if T.dtype.kind not in "fiu":
            raise InputError(f"{path.name}: not a pose; 4 x 4 numbers are wanted")
    else:
        if len(content) > MOST_OF_POSES:
            raise InputError(
                f"{path.name}: {len(content) / 1e6:,.0f} MB; a pose, or a list of them, has fewer"
            )
        text = text_of(content, path.name)
        poses = _listed_poses(text)
        if poses:
            return inverse(_pose_of(target, poses, path)) @ _pose_of(source, poses, path)
        words = [
            w
            for line in text.splitlines()
            if not line.lstrip().startswith("#")
            for w in re.split(r"[\s,;]+", line)
        ]
        try:
            T = np.array([float(word) for word in words if word])
        except ValueError:
            raise InputError(
                f"{path.name}: not a pose; a text file of 4 x 4 numbers is wanted"
            ) from None
    if T.size != 16:
        raise InputError(f"{path.name}: {in_number(T.size, 'number')}, where a pose is 4 x 4")
    return _checked_pose(T.reshape(4, 4).astype(float), path.name)


def _listed_poses(text: str) -> dict[str, np.ndarray]:
    poses = {}
    for line in text.splitlines():
        match re.split(r"[\s,;]+", line.strip()):
            case ["bmesh", scan, *words] if len(words) == 7:
                x, y, z, a, b, c, w = map(float, words)
                R = scipy.spatial.transform.Rotation.from_quat([-a, -b, -c, w]).as_matrix()
                poses[Path(scan).name] = motion(R, np.array([x, y, z]))
            case [scan, *words] if (
                len(words) in (12, 16) and re.search("[A-Za-z]", scan) and _all_numbers(words)
            ):
                poses[Path(scan).name] = np.vstack(
                    [np.array(words[:12], float).reshape(3, 4), [0.0, 0.0, 0.0, 1.0]]
                )
    return poses


def _pose_of(scan: Path | None, poses: dict[str, np.ndarray], path: Path) -> np.ndarray:
    if scan is None or Path(scan).name not in poses:
        name = "the scans" if scan is None else Path(scan).name
        raise InputError(f"{path.name}: lists poses of {', '.join(poses)}; none for {name}")
    return _checked_pose(poses[Path(scan).name], path.name)


def _checked_pose(T: np.ndarray, name: str) -> np.ndarray:
    R = T[:3, :3]
    rigid = (
        np.isfinite(T).all() and np.allclose(R @ R.T, np.eye(3), atol=1e-3) and np.linalg.det(R) > 0
    )
    if not rigid or not np.allclose(T[3], [0, 0, 0, 1], atol=1e-9):
        raise InputError(
            f"{name}: not a rigid pose (a rotation, a translation, and 0 0 0 1 as last row)"
        )
    return T


def _all_numbers(words: list[str]) -> bool:
    try:
        return all(np.isfinite(float(word)) for word in words)
    except ValueError:
        return False
