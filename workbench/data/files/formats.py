"""Points of ply, pcd, obj and text files, in the dialects that people's scanners write.

Functions take the whole file as bytes, and its name for the one line of an `InputError`.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from workbench.apart import allowance
from workbench.errors import InputError

BLOCK = 10**6  # signs of a text that are split into lines at a time

_PLY_TYPES = {
    "char": "i1",
    "int8": "i1",
    "uchar": "u1",
    "uint8": "u1",
    "short": "i2",
    "int16": "i2",
    "ushort": "u2",
    "uint16": "u2",
    "int": "i4",
    "int32": "i4",
    "uint": "u4",
    "uint32": "u4",
    "float": "f4",
    "float32": "f4",
    "double": "f8",
    "float64": "f8",
}


@dataclass
class _PlyElement:
    name: str
    count: int
    fields: list[tuple[str, str]]
    has_lists: bool = False


def ply_points(content: bytes, name: str) -> Float[np.ndarray, "n 3"]:
    """Return the vertices of a ply file, ascii or binary of either byte order.

    Raises:
        InputError: If it is no ply file, is cut short, has no x, y, z, or holds a mesh.
    """
    end = re.search(rb"end_header[ \t]*(\r\n|\n|\r)", content)
    if not content.startswith(b"ply") or end is None:
        raise InputError(f"{name}: not a ply file (no ply header)")
    kind, elements = _ply_header(content[: end.start()].decode("ascii", "replace"), name)
    vertices = next((e for e in elements if e.name == "vertex"), None)
    if vertices is None or not {"x", "y", "z"} <= {field for field, _ in vertices.fields}:
        raise InputError(f"{name}: the ply file has no vertices with x, y and z")
    faces = next((e.count for e in elements if e.name in ("face", "tristrips")), 0)
    if faces:
        raise mesh_error(name, vertices.count, faces)
    if vertices is not elements[0] or vertices.has_lists:
        raise InputError(
            f"{name}: the vertices of this ply file are not its first element, or hold lists; not"
            " read"
        )
    not_too_many(vertices.count, name)
    body = content[end.end() :]
    if kind == "ascii":
        columns = [field for field, _ in vertices.fields]
        return _first_rows(body, vertices.count, [columns.index(axis) for axis in "xyz"], name=name)
    order = "<" if kind == "binary_little_endian" else ">"
    table = _table(body, [(f, order + t) for f, t in vertices.fields], vertices.count, name=name)
    return np.column_stack([table[axis] for axis in "xyz"]).astype(float)


def _ply_header(header: str, name: str) -> tuple[str, list[_PlyElement]]:
    kind = ""
    elements = []
    for line in header.splitlines():
        match line.split():
            case ["format", kind, _]:
                pass
            case ["element", element, count] if count.isdigit():
                elements.append(_PlyElement(element, int(count), []))
            case ["property", "list", *_] if elements:
                elements[-1].has_lists = True
            case ["property", type_name, field] if elements and type_name in _PLY_TYPES:
                elements[-1].fields.append((field, _PLY_TYPES[type_name]))
            case ["property", *_] | ["element", *_]:
                raise InputError(f"{name}: ply header line not understood: {line.strip()[:60]}")
    if kind not in ("ascii", "binary_little_endian", "binary_big_endian"):
        raise InputError(f"{name}: ply format {kind or 'missing'}; ascii and binary are read")
    return kind, elements


def pcd_points(content: bytes, name: str) -> Float[np.ndarray, "n 3"]:
    """Return the points of a pcd file (ascii, binary, compressed), NaN where nothing was seen.

    Raises:
        InputError: If it is no pcd file, is cut short, or has no x, y, z.
    """
    header_end = re.search(rb"^DATA[ \t]+(\w+)[ \t]*\r?\n", content, re.MULTILINE)
    if header_end is None:
        raise InputError(f"{name}: not a pcd file (no DATA line)")
    lines = content[: header_end.start()].decode("ascii", "replace").splitlines()
    header = {words[0]: words[1:] for words in map(str.split, lines) if words}
    try:
        fields = header["FIELDS"]
        n = int(header["POINTS"][0])
        sizes, kinds = header["SIZE"], header["TYPE"]
        counts = [int(c) for c in header.get("COUNT", ["1"] * len(fields))]
        types = [
            {"F": "<f", "I": "<i", "U": "<u"}[k] + s for k, s in zip(kinds, sizes, strict=True)
        ]
        columns = list(zip(fields, types, counts, strict=True))
        if n < 0 or min(counts) < 1 or any(np.dtype(t).itemsize not in (1, 2, 4, 8) for t in types):
            raise ValueError
    except (KeyError, ValueError, IndexError, TypeError):
        raise InputError(f"{name}: the pcd header is incomplete") from None
    if not {"x", "y", "z"} <= set(fields):
        raise InputError(f"{name}: the pcd file has no fields x, y and z, but {' '.join(fields)}")
    not_too_many(n, name)
    body = content[header_end.end() :]
    kind = header_end[1].decode("ascii", "replace")
    if kind == "ascii":
        starts = dict(zip(fields, np.cumsum([0, *counts[:-1]]), strict=True))
        return _first_rows(body, n, [int(starts[axis]) for axis in "xyz"], name=name)
    if kind == "binary":
        table = _table(
            body, [(f"{f}{i}", t, (c,)) for i, (f, t, c) in enumerate(columns)], n, name=name
        )
        return np.column_stack(
            [table[f"{axis}{fields.index(axis)}"][:, 0] for axis in "xyz"]
        ).astype(float)
    if kind == "binary_compressed":
        return _compressed_columns(body, columns, n, name=name)
    raise InputError(f"{name}: pcd data {kind!r}; ascii, binary and binary_compressed are read")


def _compressed_columns(
    body: bytes, columns: list[tuple[str, str, int]], n: int, *, name: str
) -> np.ndarray:
    """Return x, y, z of a compressed pcd body, which stores one field after the other."""
    if len(body) < 8:
        raise InputError(f"{name}: the file is cut short")
    packed, unpacked = (int(size) for size in np.frombuffer(body, "<u4", 2))
    not_too_large(unpacked, name)
    if unpacked != n * sum(np.dtype(t).itemsize * c for _, t, c in columns):
        raise InputError(f"{name}: the compressed size does not fit {n:,} points")
    plain = _unpack_lzf(body[8 : 8 + packed], unpacked, name)
    start = 0
    values = {}
    for field, kind, count in columns:
        values[field] = (
            np.frombuffer(plain, kind, n * count, start).astype(float).reshape(n, count)[:, 0]
        )
        start += n * count * np.dtype(kind).itemsize
    return np.column_stack([values[axis] for axis in "xyz"])


def _unpack_lzf(packed: bytes, size: int, name: str) -> bytes:
    """Undo LZF: up to 32 plain bytes, and copies of 3 to 264 from at most 8192 back."""
    out = bytearray()
    i = 0
    try:
        while i < len(packed):
            control = packed[i]
            i += 1
            if control < 32:
                out += packed[i : i + control + 1]
                i += control + 1
                continue
            length = control >> 5
            if length == 7:
                length += packed[i]
                i += 1
            distance = ((control & 31) << 8) + packed[i] + 1
            i += 1
            length += 2
            start = len(out) - distance
            if start < 0:
                raise IndexError
            piece = out[start : start + length]
            out += (piece * (length // len(piece) + 1))[:length]  # a copy may run into itself
            if len(out) > size:
                raise IndexError
    except IndexError:
        raise InputError(f"{name}: the compressed points are damaged") from None
    _need_all(len(out), size, name)
    return bytes(out)


def obj_points(content: bytes, name: str) -> Float[np.ndarray, "n 3"]:
    """Return the vertices of an obj file that has no faces.

    Raises:
        InputError: If it holds a mesh, or a vertex line is not three numbers.
    """
    points = [np.empty((0, 3))]
    faces = 0
    for lines in _blocks(text_of(content, name)):
        rows = [line[2:] for line in lines if line.startswith(("v ", "v\t"))]
        faces += sum(line.startswith(("f ", "f\t")) for line in lines)
        if rows:
            points.append(_numbers(rows, None, [0, 1, 2], name=name))
            not_too_many(sum(map(len, points)), name)
    if faces:
        raise mesh_error(name, sum(map(len, points)), faces)
    return np.concatenate(points)


def text_points(content: bytes, name: str) -> Float[np.ndarray, "n 3"]:
    """Return the points of a text table, one row each.

    Columns are separated by commas, semicolons (then numbers may have decimal commas), tabs or
    spaces. A header names x, y and z (units may follow); without one the first three columns count.
    Empty lines, those that start with # or //, and a first line with the number of points are
    skipped.

    Raises:
        InputError: If the file is no text, or its columns are not understood; names the line.
    """
    text = text_of(content, name)
    not_too_many(text.count("\n"), name, "lines")
    points = [np.empty((0, 3))]
    separator = ""
    columns = None
    for lines in _blocks(text):
        rows = [row for row in lines if row.strip() and not row.lstrip().startswith(("#", "//"))]
        if rows and columns is None and rows[0].strip().isdigit():
            rows = rows[1:]
        if rows and columns is None:
            separator = _separator(rows[0])
            columns, titles = _columns(rows[0], separator, name)
            rows = rows[titles:]
        if rows and columns is not None:
            plain = [row.replace(",", ".") for row in rows] if separator == ";" else rows
            points.append(_numbers(plain, separator, columns, name=name))
    return np.concatenate(points)


def _separator(row: str) -> str | None:
    """Return what stands between the columns of a row; None where it is tabs or spaces."""
    if ";" in row:
        return ";"
    return "," if "," in row else None


def _columns(row: str, separator: str | None, name: str) -> tuple[list[int], int]:
    """Return which columns are x, y and z by the first row, and how many rows are titles."""
    if separator == ";":
        row = row.replace(",", ".")
    first = [word.strip().strip("\"'") for word in row.split(separator)]
    if not is_number(first[0]) or not all(is_number(word) for word in first[:3]):
        letters = [re.split(r"[^a-z]", word.lower())[0] for word in first]
        if not all(axis in letters for axis in "xyz"):
            raise InputError(f"{name}: no columns x, y, z in its first line: {row.strip()[:60]!r}")
        return [letters.index(axis) for axis in "xyz"], 1
    if len(first) < 3:
        raise InputError(
            f"{name}: {len(first)} column{'s'[: len(first) > 1]} where x, y and z are wanted"
        )
    return [0, 1, 2], 0


def text_of(content: bytes, name: str) -> str:
    """Return a file as text, lines ending as here: UTF-8, or UTF-16 with its mark.

    Raises:
        InputError: If it is neither.
    """
    try:
        text = content.decode(
            "utf-16" if content[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig"
        )
    except UnicodeDecodeError:
        text = "\0"
    if "\0" in text:
        raise InputError(f"{name}: not a text file (UTF-8 or UTF-16)")
    return text.replace("\r\n", "\n").replace("\r", "\n") if "\r" in text else text


def _blocks(text: str) -> Iterator[list[str]]:
    """Yield the lines of a text, some at a time: all of them take many times its memory."""
    start = 0
    while start < len(text):
        end = text.find("\n", start + BLOCK) + 1 or len(text)
        yield text[start:end].splitlines()
        start = end


def _first_rows(body: bytes, n: int, columns: list[int], *, name: str) -> np.ndarray:
    """Read columns of the first n lines of a body of text."""
    points = [np.empty((0, 3))]
    missing = n
    for lines in _blocks(body.decode("ascii", "replace")):
        rows = lines[:missing]
        if not rows:
            break
        points.append(_numbers(rows, None, columns, name=name))
        missing -= len(rows)
    _need_all(n - missing, n, name)
    return np.concatenate(points)


def not_too_many(n: int, name: str, noun: str = "points") -> None:
    """Raise InputError where there are more points than may be read."""
    most = allowance().points
    if n > most:
        raise InputError(
            f"{name}: {n:,} {noun}; at most {most:,} are read{allowance().more}; thin the cloud"
        )


def not_too_large(size: int, name: str) -> None:
    """Raise InputError where a file unpacks to more bytes than it may."""
    most = allowance().unpacked
    if size > most:
        raise InputError(
            f"{name}: over {most // 10**6} MB unpacked; that is too large{allowance().more}"
        )


def mesh_error(name: str, vertices: int, faces: int) -> InputError:
    """Return the refusal of a mesh where a cloud is wanted."""
    return InputError(
        f"{name}: a mesh ({vertices:,} vertices, {faces:,} faces) where a point cloud is wanted;"
        " save its vertices alone, as xyz or ply without faces"
    )


def _numbers(
    rows: list[str], separator: str | None, columns: list[int], *, name: str
) -> np.ndarray:
    """Read columns of a table of text; the first row that does not fit is named."""
    try:
        return np.loadtxt(rows, delimiter=separator, usecols=columns, ndmin=2, comments=None)
    except (ValueError, IndexError):
        for row in rows:
            words = row.split(separator)
            if len(words) <= max(columns) or not all(is_number(words[c]) for c in columns):
                raise InputError(
                    f"{name}: x, y, z are not three numbers in the row {row.strip()[:60]!r}"
                ) from None
        raise InputError(f"{name}: the table of points is not understood") from None


def is_number(word: str) -> bool:
    """Whether a word of a file can be read as a number."""
    try:
        float(word)
    except ValueError:
        return False
    return True


def words_of(line: str) -> list[str]:
    """Return the words of a line: between commas, semicolons, tabs or spaces."""
    return line.replace(",", " ").replace(";", " ").split()


def _table(body: bytes, fields: list, n: int, *, name: str) -> np.ndarray:
    record = np.dtype(fields)
    _need_all(len(body) // record.itemsize, n, name)
    return np.frombuffer(body, record, n)


def _need_all(count: int, promised: int, name: str) -> None:
    if count < promised:
        raise InputError(
            f"{name}: the file is cut short ({count:,} of {promised:,} promised by its header)"
        )
