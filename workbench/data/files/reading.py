"""Files that people bring: clouds, meshes, voxels and images, read or refused in one line."""

import contextlib
import functools
import gzip
import io
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from jaxtyping import Float, Int, Shaped, UInt8

from workbench.apart import allowance, apart, note, told
from workbench.data.files.arrays import read_arrays
from workbench.data.files.formats import (
    is_number,
    mesh_error,
    not_too_large,
    not_too_many,
    obj_points,
    pcd_points,
    ply_points,
    text_of,
    text_points,
    words_of,
)
from workbench.errors import InputError

if TYPE_CHECKING:
    from PIL import Image


NO_VERTEX = "a face names a vertex that is not there"
IMAGES = ("PNG", "JPEG", "WEBP", "TIFF", "BMP", "GIF", "PPM")
"""What pictures are read from; Pillow would also hand a file to other programs (EPS to
Ghostscript).
"""

_TEXT = (".xyz", ".txt", ".csv", ".asc", ".pts", ".tsv", ".dat")
_MESHES = (".off", ".stl", ".glb", ".gltf", ".obj", ".ply")


def read_cloud(path: Path, fewest: int = 3) -> Float[np.ndarray, "n 3"]:
    """Return the points of a file, in its own unit and frame, read-only; kept for a second call.

    Formats: ply, pcd, obj, npy, npz (an array named p, points, xyz or vertices, or the only one)
    and text (see `text_points`), each also gzipped. A mesh is refused: its vertices are rarely the
    samples that a cloud is taken for. Points with NaN or infinity are left out; the first step
    tells how many.

    Raises:
        InputError: If the file is missing, too large, not understood, or has fewer than `fewest`
            points.
    """
    path = Path(path)
    changed = stamp(path)
    p = _cloud(path, *changed)
    if len(p) < fewest:
        raise InputError(f"{path.name}: {in_number(len(p), 'point')}; at least {fewest} are needed")
    return p


@apart
def read_mesh(path: Path) -> tuple[Float[np.ndarray, "v 3"], Int[np.ndarray, "f 3"]]:
    """Return vertices and triangles of a mesh file (off, obj, ply, stl, glb; also gzipped).

    Raises:
        InputError: If the file is missing, too large, not understood, has no faces, or holds NaN.
    """
    path = Path(path)
    stamp(path)
    content, kind = content_of(path)
    if kind not in _MESHES:
        raise InputError(
            f"{path.name}: {kind or 'a file without ending'} is no mesh format that is read (off,"
            " obj, ply, stl, glb)"
        )
    import trimesh

    try:
        loaded: Any = trimesh.load(io.BytesIO(content), file_type=kind[1:], process=False)
        mesh = _one_mesh(loaded, path.name) if isinstance(loaded, trimesh.Scene) else loaded
        p = np.array(mesh.vertices, float)
        faces = np.array(getattr(mesh, "faces", np.empty((0, 3))), np.intp)
    except InputError:
        raise
    except Exception as error:  # the readers of trimesh raise whatever they trip over
        why = (
            NO_VERTEX
            if isinstance(error, IndexError) or "face index" in str(error)
            else type(error).__name__
        )
        raise InputError(f"{path.name}: not readable as a {kind[1:]} mesh ({why})") from None
    if len(faces) == 0:
        raise InputError(
            f"{path.name}: {in_number(len(p), 'point')} without faces, where a mesh is wanted"
        )
    if not np.isfinite(p).all() or faces.min() < 0 or faces.max() >= len(p):
        raise InputError(f"{path.name}: a vertex is not finite, or {NO_VERTEX}")
    return p, faces


def lost_rows(path: Path) -> bool:
    """Tell whether a cloud has rows less than its file: they had no finite numbers."""
    return len(told(path)) > 0


def _one_mesh(scene: Any, name: str) -> Any:
    """Return all meshes of a scene as one; a small file may name the same mesh a million times."""
    sizes = {key: len(shape.vertices) for key, shape in scene.geometry.items()}
    n = sum(sizes[scene.graph[node][1]] for node in scene.graph.nodes_geometry)
    not_too_many(n, name, "vertices")
    return scene.to_mesh()


@apart
def read_voxels(path: Path) -> Shaped[np.ndarray, "x y z"]:
    """Return bits or labels (x, y, z) of an npy file or the only such array of an npz.

    Raises:
        InputError: If the file is missing, too large, not understood, or has not one such array.
    """
    path = Path(path)
    stamp(path)
    content, kind = content_of(path)
    if kind not in (".npy", ".npz"):
        raise InputError(f"{path.name}: {kind or 'no ending'}; voxels are read from npy and npz")
    arrays = read_arrays(content, path.name)
    volumes = [
        values
        for values in arrays.values()
        if values.ndim == 3 and values.dtype.kind in "biu" and values.size
    ]
    if len(volumes) != 1:
        count = "no array" if not volumes else f"{len(volumes)} arrays"
        raise InputError(
            f"{path.name}: {count} of three axes with bits or whole numbers; one is wanted"
        )
    return volumes[0]


@apart
def read_image(path: Path) -> UInt8[np.ndarray, "h w *channels"]:
    """Return an image as (h, w) grey or (h, w, 3) RGB, uint8; transparency is dropped.

    Raises:
        InputError: If the file is missing, too large, or no image of 8 bits a channel.
    """
    path = Path(path)
    stamp(path)
    with opened_image(path, path.name) as image:
        return plain_pixels(image)


def plain_pixels(image: "Image.Image") -> np.ndarray:
    """Return the pixels of an opened image, grey or RGB."""
    return np.array(image.convert("L" if image.mode in ("1", "L", "LA") else "RGB"))


@contextlib.contextmanager
def opened_image(source: Path | io.BytesIO, name: str) -> "Iterator[Image.Image]":
    """Give an image of Pillow's, its size and depth judged and nothing decoded yet.

    Raises:
        InputError: If it is no image of 8 bits a channel, or too large.
    """
    from PIL import Image

    try:
        with Image.open(source, formats=IMAGES) as image:
            most = allowance().pixels
            if image.width * image.height > most:
                size = f"{image.width} x {image.height} pixels"
                raise InputError(f"{name}: {size}; at most {most:,} are read{allowance().more}")
            if image.mode in ("I", "F", "I;16", "I;16B"):
                raise InputError(f"{name}: more than 8 bits a pixel; save it with 8 bits")
            yield image
    except InputError:
        raise
    except Image.DecompressionBombError:
        raise InputError(
            f"{name}: far too many pixels; at most {allowance().pixels:,} are read"
        ) from None
    except Exception as error:  # Pillow's decoders raise many kinds
        raise InputError(f"{name}: not readable as an image ({type(error).__name__})") from None


@functools.lru_cache(maxsize=8)
def _cloud(path: Path, _modified: int, _size: int) -> np.ndarray:
    p = _points(path)
    p.setflags(write=False)
    return p


@apart
def _points(path: Path) -> np.ndarray:
    content, kind = content_of(path)
    if not content.strip():
        raise InputError(f"{path.name}: the file is empty")
    if kind == ".ply":
        p = ply_points(content, path.name)
    elif kind == ".pcd":
        p = pcd_points(content, path.name)
    elif kind == ".obj":
        p = obj_points(content, path.name)
    elif kind in (".npy", ".npz"):
        p = _array_points(content, path.name)
    elif kind in _TEXT:
        p = text_points(content, path.name)
    elif kind in _MESHES:
        p, faces = read_mesh(path)
        raise mesh_error(path.name, len(p), len(faces))
    else:
        kinds = ", ".join(["ply", "pcd", "obj", "npy", "npz", *(ending[1:] for ending in _TEXT)])
        raise InputError(f"{path.name}: {kind or 'no ending'}; point clouds are read from {kinds}")
    not_too_many(len(p), path.name)
    return finite(p, path.name)


def finite(
    p: Float[np.ndarray, "n d"], name: str, one: str = "point", *, many: str = "points"
) -> Float[np.ndarray, "m d"]:
    """Return the rows without NaN and infinity; the first step tells how many are left out."""
    good = np.isfinite(p).all(axis=1)
    if len(p) and not good.any():
        raise InputError(f"{name}: all {len(p):,} {many} are NaN or infinite")
    if not good.all():
        bad = int((~good).sum())
        note(
            f"{name}: {bad:,} of {len(p):,} {one if len(p) == 1 else many} left out: NaN or"
            " infinite."
        )
    return p[good]


def _array_points(content: bytes, name: str) -> np.ndarray:
    p = np.asarray(load_array(content, name))
    if p.ndim != 2 or p.shape[1] < 3 or p.dtype.kind not in "fiu":
        raise InputError(
            f"{name}: an array of {p.dtype} {p.shape}, where (n, 3) numbers are wanted"
        )
    return p[:, :3].astype(float)


def load_array(content: bytes, name: str) -> np.ndarray:
    """Return the array of an npy file, or the one of an npz file that holds points.

    Raises:
        InputError: If there is none, or it cannot be read.
    """
    arrays = read_arrays(content, name)
    names = [n for n in ("p", "points", "xyz", "vertices") if n in arrays] or list(arrays)[
        : len(arrays) == 1
    ]
    if not names:
        raise InputError(
            f"{name}: no array named p, points, xyz or vertices, but {', '.join(arrays)}"
        )
    return arrays[names[0]]


def content_of(path: Path) -> tuple[bytes, str]:
    """Return the bytes of a file, gzip undone, and its ending in lower case."""
    kind = path.suffix.lower()
    try:
        if kind != ".gz":
            return path.read_bytes(), kind
        with gzip.open(path) as stream:
            content = stream.read(allowance().unpacked + 1)
    except (OSError, EOFError, zlib.error) as error:
        raise InputError(f"{path.name}: not readable ({error.__class__.__name__})") from None
    not_too_large(len(content), path.name)
    return content, Path(path.stem).suffix.lower()


def text_rows(
    path: Path, what: str, kinds: tuple[str, ...] | None, *, comments: str = "#"
) -> list[tuple[int, str]]:
    """Return the lines of a text file with their numbers from 1, without empty ones and comments.

    Args:
        what: What is read from it, for a refusal.
        kinds: The endings that its name may have, in lower case; None takes any.
        comments: The signs that begin a comment.

    Raises:
        InputError: If it is no file, too large, of another kind, or no text.
    """
    stamp(path)
    if kinds is not None and path.suffix.lower() not in kinds:
        raise InputError(f"{path.name}: {what} are read from text files ({', '.join(kinds)})")
    text = text_of(content_of(path)[0], path.name)
    most = allowance().lines
    count = text.count("\n")
    if count > most:
        raise InputError(
            f"{path.name}: {count:,} lines; {what} are read from at most {most:,}{allowance().more}"
        )
    return [
        (i, line)
        for i, line in enumerate(text.splitlines(), 1)
        if line.strip() and line.lstrip()[0] not in comments
    ]


def word_rows(path: Path, what: str, kinds: tuple[str, ...] | None) -> list[tuple[int, list[str]]]:
    """Return the words of each line of a text file with its number, as `text_rows` does.

    Raises:
        InputError: As `text_rows`.
    """
    return [(i, words) for i, line in text_rows(path, what, kinds) if (words := words_of(line))]


def number_rows(path: Path, what: str, kinds: tuple[str, ...]) -> list[tuple[int, list[str]]]:
    """Return what `word_rows` does, without a first line that begins with no number."""
    rows = word_rows(path, what, kinds)
    return rows[bool(rows) and not is_number(rows[0][1][0]) :]


def stamp(path: Path) -> tuple[int, int]:
    """Return when a file was changed and its size: as long as they stay, readings are kept.

    Raises:
        InputError: If it is no file, or too large.
    """
    try:
        stat = path.stat()
    except OSError:
        raise InputError(f"{path}: no such file") from None
    if not path.is_file():
        raise InputError(f"{path}: a folder, not a file")
    most = allowance().unpacked
    if stat.st_size > most:
        raise InputError(
            f"{path.name}: {stat.st_size / 1e6:,.0f} MB; at most {most // 10**6} MB are read"
        )
    return stat.st_mtime_ns, stat.st_size


def in_number(n: int, word: str) -> str:
    """Return a number of things: `1 point`, `12 points`."""
    return f"{n:,} {word}" if n == 1 else f"{n:,} {word}s"
