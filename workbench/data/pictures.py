"""A person's pictures of views, in a folder or a zip; each is decoded when it is shown."""

import functools
import io
import re
import zipfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING

import numpy as np
from jaxtyping import UInt8

from workbench.apart import apart
from workbench.data.files import opened_image, stamp
from workbench.data.files.formats import not_too_large
from workbench.errors import InputError

if TYPE_CHECKING:
    from PIL import Image

MOST_PICTURES = 500
ENDINGS = (".jpg", ".jpeg", ".png", ".webp", ".tif", ".tiff", ".bmp")
TURNED = 0x0112, (5, 6, 7, 8)
"""Where a camera writes how it was held, and what stands there where width and height change
places.
"""


@dataclass(frozen=True)
class Pictures:
    """Pictures of views, all of one size.

    Attributes:
        path: The folder or zip that they are in, or a picture itself.
        names: Of every view the name of its picture, or None.
        size: Width and height, upright as a camera says that it was held.
    """

    path: Path
    names: tuple[str | None, ...]
    size: tuple[int, int]

    def shown(self, view: int, most: int) -> UInt8[np.ndarray, "h w *channels"] | None:
        """Return the picture of a view, or None, its longer side at most `most` pixels.

        Raises:
            InputError: If it cannot be read any more.
        """
        name = self.names[view]
        return (
            None
            if name is None
            else _decoded(self.path, name, stamp_of(self.path, name), most=most)
        )


@apart
def grey_picture(path: Path, name: str) -> UInt8[np.ndarray, "h w"]:
    """Return a picture of a folder or zip by its name, in all its pixels, grey.

    Raises:
        InputError: If it cannot be read.
    """
    return _upright(path, name, kind="L")


def stamp_of(path: Path, name: str) -> tuple[int, int]:
    """Return when a picture, or what holds it, was changed, and its size.

    Raises:
        InputError: If it is gone.
    """
    return stamp(path / name if path.is_dir() else path)


def holds_many(path: Path) -> bool:
    """Tell whether a path is a folder or a zip, and no picture itself."""
    return path.is_dir() or path.suffix.lower() == ".zip"


@apart
def names_in(path: Path) -> tuple[str, ...]:
    """Return the names of the pictures in a folder or a zip, left2 before left10.

    In a folder only what lies there itself is taken, no link that leads out of it.

    Raises:
        InputError: If there is no such file, no picture, too many, or two of the same name.
    """
    if path.is_dir():
        home = path.resolve()
        names = [
            file.name
            for file in path.iterdir()
            if _is_picture(file.name) and file.is_file() and file.resolve().parent == home
        ]
    else:
        stamp(path)
        with _opened_zip(path) as packed:
            names = [
                member.filename for member in packed.infolist() if _is_picture(member.filename)
            ]
    if not 0 < len(names) <= MOST_PICTURES:
        raise InputError(
            f"{path.name or path}: {len(names) or 'no'} pictures in it; up to {MOST_PICTURES} jpg"
            " or png are taken"
        )
    stems = [_stem(name) for name in names]
    twice = next(
        (name for name, stem in zip(names, stems, strict=True) if stems.count(stem) > 1), None
    )
    if twice is not None:
        raise InputError(
            f"{path.name or path}: two pictures are called {PurePosixPath(twice).stem}"
        )
    return tuple(sorted(names, key=_counted))


@apart
def pictures_of(path: Path, names: tuple[str | None, ...]) -> Pictures:
    """Return pictures by their names, once all are seen to be pictures of one size.

    Raises:
        InputError: If one cannot be read, or has another size than the first.
    """
    sizes = {name: _size(path, name) for name in names if name is not None}
    first = next(iter(sizes))
    for name, size in sizes.items():
        if size != sizes[first]:
            raise InputError(
                f"{path.name or path}: {name} has {size[0]} x {size[1]} pixels, {first}"
                f" {sizes[first][0]} x {sizes[first][1]}: pictures of one camera have one size"
            )
    return Pictures(path, names, sizes[first])


def matched(path: Path, views: Sequence[str], count: int) -> tuple[str | None, ...]:
    """Return of every view its picture: the one of the view's name, or else all in order.

    `views` are what their pictures are called; empty where nobody said.

    Raises:
        InputError: If no name fits and there are not as many pictures as views, or as `names_in`
            does.
    """
    names = names_in(path)
    by_stem = {_stem(name): name for name in names}
    named = tuple(by_stem.get(_stem(view)) for view in views)
    if any(named):
        return named
    if len(names) != count:
        called = f", and none is called {views[0]}" if views else ""
        raise InputError(f"{path.name or path}: {len(names)} pictures for {count} views{called}")
    return names


def _is_picture(name: str) -> bool:
    return PurePosixPath(name).suffix.lower() in ENDINGS and not PurePosixPath(
        name
    ).name.startswith(".")


def _stem(name: str) -> str:
    last = PurePosixPath(name)
    return (last.stem if last.suffix.lower() in ENDINGS else last.name).casefold()


def _counted(name: str) -> list[tuple[int, str]]:
    """Return a key by which numbers in names count as numbers."""
    return [
        (int(part), "") if part.isdecimal() else (0, part)
        for part in re.split(r"([0-9]+)", name.casefold())
    ]


def _opened_zip(path: Path) -> zipfile.ZipFile:
    try:
        return zipfile.ZipFile(path)
    except Exception as error:  # what is damaged raises many kinds
        raise InputError(
            f"{path.name or path}: not readable as a zip ({type(error).__name__})"
        ) from None


def _source(path: Path, name: str) -> Path | io.BytesIO:
    """Return a file, or the bytes of a zip's member, never more than it said or may have."""
    if not holds_many(path):
        stamp(path)
        return path
    if path.is_dir():
        return path / name
    with _opened_zip(path) as packed:
        try:
            not_too_large(packed.getinfo(name).file_size, f"{path.name or path}: {name}")
            return io.BytesIO(packed.read(name))
        except InputError:
            raise
        except Exception as error:  # damaged, encrypted, packed in a way that is not known
            raise InputError(
                f"{path.name or path}: {name} cannot be unpacked ({type(error).__name__})"
            ) from None


def _size(path: Path, name: str) -> tuple[int, int]:
    with opened_image(_source(path, name), PurePosixPath(name).name) as image:
        w, h = image.size
        return (
            (h, w)
            if _is_of_a_camera(image) and image.getexif().get(TURNED[0]) in TURNED[1]
            else (w, h)
        )


def _is_of_a_camera(image: "Image.Image") -> bool:
    """Tell whether a camera may have written how it was held."""
    return image.format != "PNG"


@functools.lru_cache(maxsize=48)
def _decoded(path: Path, name: str, _stamp: tuple[int, int], *, most: int) -> np.ndarray:
    return _upright(path, name, most)


@apart
def _upright(
    path: Path, name: str, most: int | None = None, *, kind: str | None = None
) -> np.ndarray:
    from PIL import ImageOps

    with opened_image(_source(path, name), PurePosixPath(name).name) as image:
        kind = kind or ("L" if image.mode in ("1", "L", "LA") else "RGB")
        if most is not None:
            # a JPEG is decoded at half or quarter size where that is enough
            image.draft(kind, (most, most))
        upright = (ImageOps.exif_transpose(image) if _is_of_a_camera(image) else image).convert(
            kind
        )
        if most is not None and max(upright.size) > most:
            upright.thumbnail((most, most))
        return np.array(upright)
