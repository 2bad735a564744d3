"""Every own-data knob of a lesson is handed a made file, and a bad one: a good one shows, a bad one
is told in one line.
"""

import io
import tempfile
import zipfile
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from workbench.authoring.promises import Found, Subject, promise
from workbench.knobs import paths_of, showing
from workbench.machinery.authors import at

Given = dict[str, str]
"""By own-data knob the name of the file that it is handed."""
SIZE = (640, 480)
BAD = "bad.zzz"


@promise
def own_files_are_read(subject: Subject) -> Found:
    """Every knob that takes a file shows one of some kind, and refuses a bad one in a line that
    names no flag.
    """
    fields = paths_of(subject.lesson.params)
    where = f"{subject.who}: {at(subject.lesson.run)}"
    with tempfile.TemporaryDirectory(prefix="workbench-made-") as folder:
        files = made_files(Path(folder)) if fields else {}
        taken = _taken(subject, files, fields)
        for field in fields:
            if field not in taken:
                yield (
                    f"{where}{field} took none of {len(files) - 1} made files:"
                    f" {', '.join(sorted(files))}"
                )
                continue
            message = _refusal(subject, files, taken[field] | {field: BAD})
            if message is None:
                yield (
                    f"{where}{field} = {BAD} shows the lesson all the same: it is not read; say"
                    " what it `needs`"
                )
            elif "--" in message or not message.isprintable():
                yield f"{where}{field} = {BAD}: {message!r}: name knobs by `called`, in one line"
            else:
                yield None


def _taken(subject: Subject, files: dict[str, Path], fields: list[str]) -> dict[str, Given]:
    """Return by knob with which files, its own among them, the lesson shows something."""
    taken: dict[str, Given] = {}
    bases: list[Given] = [{}]
    pending = list(fields)
    while pending:
        accepted = next(
            (
                given
                for given in _tried(bases, pending, files)
                if _refusal(subject, files, given) is None
            ),
            None,
        )
        if accepted is None:
            return taken
        new = [field for field in accepted if field in pending]
        taken |= dict.fromkeys(new, accepted)
        pending = [field for field in pending if field not in new]
        bases.append(accepted)
    return taken


def _tried(bases: list[Given], pending: list[str], files: dict[str, Path]) -> Iterator[Given]:
    """Yield what may be handed over: one file more than what was taken, or the same for two knobs
    that go together.
    """
    kinds = [name for name in files if name != BAD]
    for base in bases:
        yield from (base | {field: kind} for field in pending for kind in kinds)
    for i, field in enumerate(pending):
        yield from ({field: kind, other: kind} for other in pending[i + 1 :] for kind in kinds)


def _refusal(subject: Subject, files: dict[str, Path], given: Given) -> str | None:
    """Return why the lesson does not even show its first step with these files, None where it
    does.
    """
    params: Any = replace(
        subject.lesson.params(), **{field: files[kind] for field, kind in given.items()}
    )
    timeline = subject.fresh(showing(params, given), f"with own files {given}", steps=1)
    return None if len(timeline) else timeline.stopped or "it shows nothing"


def made_files(folder: Path) -> dict[str, Path]:
    """Write small good files of every kind that a lesson may read, and a bad one; return their
    paths by name.
    """
    rng = np.random.default_rng(0)
    p, faces = _ball()
    cloud = p[rng.integers(len(p), size=400)] * [1.0, 0.7, 0.5] + 0.02 * rng.standard_normal(
        (400, 3)
    )
    turn = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
    K = np.array([[800.0, 0.0, 320.0], [0.0, 800.0, 240.0], [0.0, 0.0, 1.0]])
    scene = rng.uniform([-1.0, -1.0, 4.0], [1.0, 1.0, 6.0], (40, 3))
    uv = _seen(scene, K)
    moved = _seen(np.add(scene, (0.4, 0.05, 0.1)), K)
    board = np.stack(np.meshgrid(np.arange(5.0), np.arange(4.0), [0.0]), axis=-1).reshape(-1, 3)
    flat = board - board.mean(axis=0)
    tilts = ((0.5, 0.0), (0.0, 0.5), (-0.4, 0.3))
    views = np.stack([_seen(np.add(_tilted(flat, *tilt), (0.0, 0.0, 9.0)), K) for tilt in tilts])
    coin = _disc()
    contents = {
        "cloud.xyz": _rows(cloud),
        "mesh.off": (
            b"OFF\n%d %d 0\n" % (len(p), len(faces))
            + _rows(p)
            + _rows(np.c_[np.full(len(faces), 3), faces])
        ),
        "places.csv": b"51.5,-0.1,one\n35.7,139.7,two\n-33.9,151.2,three\n",
        "edges.csv": b"a,b,1\nb,c,2\nc,a,1\nc,d,1\nd,e,1\ne,c,3\n",
        "circle.txt": _rows(np.c_[np.cos(turn), np.sin(turn)]),
        "photo.png": _png(coin),
        "matches.npz": _npz(x1=uv, x2=moved, K=K),
        "points.txt": _rows(np.c_[scene, uv]),
        "corners.npz": _npz(object_points=board, corners=views, size=np.array(SIZE)),
        "K.txt": _rows(K),
        "pose.txt": _rows(np.eye(4)),
        "voxels.npy": _npy(np.linalg.norm(np.indices((12, 12, 12)) - 5.5, axis=0) < 4),
        "photos.zip": _zip({f"{name}.png": _png(coin) for name in "abc"}),
        BAD: b"\0bad\xff",
    }
    for name, content in contents.items():
        (folder / name).write_bytes(content)
    return {name: folder / name for name in contents}


def _ball() -> tuple[np.ndarray, np.ndarray]:
    """Return an octahedron halved twice and blown up: a closed mesh, its faces counterclockwise
    from outside.
    """
    p = np.array([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], float)
    faces = np.array(
        [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]]
    )
    for _ in range(2):
        corners = p[faces]
        halves = (corners + np.roll(corners, -1, axis=1)) / 2
        a, b, c = corners.transpose(1, 0, 2)
        ab, bc, ca = halves.transpose(1, 0, 2)
        parts = np.stack([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]])
        p, name = np.unique(parts.transpose(0, 2, 1, 3).reshape(-1, 3), axis=0, return_inverse=True)
        faces = name.reshape(-1, 3)
        p = p / np.linalg.norm(p, axis=1, keepdims=True)
    return p, faces


def _seen(p_camera: np.ndarray, K: np.ndarray) -> np.ndarray:
    uv_h = p_camera @ K.T
    return uv_h[:, :2] / uv_h[:, 2:]


def _tilted(p: np.ndarray, a: float, b: float) -> np.ndarray:
    R_x = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
    R_y = np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
    return p @ (R_y @ R_x).T


def _disc() -> np.ndarray:
    """Return a photograph of something round and bright on a ground with some texture, (h, w)
    uint8.
    """
    v, u = np.mgrid[: SIZE[1], : SIZE[0]]
    ground = 40 + 25 * np.sin(u / 7) * np.cos(v / 5) + 15 * np.sin((u + 2 * v) / 23)
    return np.where(np.hypot(u - 337, v - 125) < 60, 220, ground).astype(np.uint8)


def _rows(table: np.ndarray) -> bytes:
    return "".join(
        " ".join(f"{x:.9g}" for x in row) + "\n" for row in np.asarray(table).tolist()
    ).encode()


def _png(image: np.ndarray) -> bytes:
    from PIL import Image

    file = io.BytesIO()
    Image.fromarray(image).save(file, "PNG")
    return file.getvalue()


def _npz(**arrays: Any) -> bytes:
    file = io.BytesIO()
    np.savez(file, **arrays)
    return file.getvalue()


def _npy(array: np.ndarray) -> bytes:
    file = io.BytesIO()
    np.save(file, array)
    return file.getvalue()


def _zip(files: dict[str, bytes]) -> bytes:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as packed:
        for name, content in files.items():
            packed.writestr(name, content)
    return file.getvalue()
