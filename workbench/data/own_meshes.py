"""A person's own mesh to measure on: read, mended where its shape stays, or refused."""

from pathlib import Path

from jaxtyping import Float, Int
from numpy import ndarray

from workbench.data.files import read_mesh
from workbench.data.framing import frame
from workbench.data.shapes.solids import Solid, outlined
from workbench.errors import InputError
from workbench.geometry.meshes import check_mesh, welded
from workbench.geometry.meshes.measures import surface_area
from workbench.geometry.meshes.repair import oriented, split_where_sheets_touch, without_repeats
from workbench.numerals import counted


def read_surface(
    path: Path, most: int
) -> tuple[Float[ndarray, "v 3"], Int[ndarray, "f 3"], tuple[str, ...]]:
    """Read a mesh and mend it where its shape stays: vertices, faces, and in words what was mended.

    It may have `most` vertices, and twice as many faces.

    Raises:
        InputError: If it is too large, or no surface whose curvature could be told; names the file.
    """
    p, faces = read_mesh(path)
    if len(faces) > 2 * most:
        raise InputError(
            f"{path.name}: {len(faces):,} faces; at most {2 * most:,} are measured, simplify it"
            " first"
        )
    p, welded_faces = welded(p, faces)
    once = without_repeats(welded_faces)
    agreeing = oriented(once)
    placed, faces = split_where_sheets_touch(p, agreeing)
    if len(placed) > most:
        raise InputError(
            f"{path.name}: {len(placed):,} vertices; at most {most:,} are measured, simplify it"
            " first"
        )
    try:
        check_mesh(placed, faces)
    except InputError as error:
        raise InputError(f"{path.name}: {error}") from None
    repeats = len(welded_faces) - len(once)
    turned = int((agreeing != once).any(axis=1).sum())
    split = len(placed) - len(p)
    done = (
        (repeats, f"{counted(repeats, 'face')} listed twice left out"),
        (turned, f"{counted(turned, 'face')} turned round to agree with the others"),
        (
            split,
            (
                f"{counted(split, 'vertex', 'vertices')} added where sheets only touch, one for"
                " each sheet"
            ),
        ),
    )
    return placed, faces, tuple(words for count, words in done if count)


def read_welded(
    path: Path, most: int, done: str
) -> tuple[Float[ndarray, "v 3"], Int[ndarray, "f 3"]]:
    """Read a mesh of at most `most` faces as it is, equal vertices made one.

    `done` says what is done with the faces, for a refusal: "measured".

    Raises:
        InputError: If it is too large, or has no area; names the file.
    """
    p, faces = read_mesh(path)
    if len(faces) > most:
        raise InputError(
            f"{path.name}: {len(faces):,} faces; at most {most:,} are {done}, simplify it first"
        )
    p, faces = welded(p, faces)
    if not surface_area(p, faces) > 0:
        raise InputError(f"{path.name}: its faces have no area")
    return p, faces


def read_solid(path: Path, most: int) -> Solid:
    """Read a mesh of at most `most` faces as a solid that stands on the origin, 1 m large, with
    its sharp edges.

    Raises:
        InputError: If it cannot be used, or is too large; names the file.
    """
    p, faces = read_mesh(path)
    if len(faces) > most:
        raise InputError(f"{path.name}: {len(faces):,} faces; this lesson takes up to {most:,}")
    return outlined(frame(p, 1.0).standing(p).shown(p), faces, angle=0.6)
