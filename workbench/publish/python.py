"""Python for pages that compute: the files of a Pyodide release that a site has beside it, or the
address of one.

The format of a release's lock file: https://pyodide.org/en/stable/development/abi.html.
"""

import hashlib
import io
import json
import re
import zipfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from workbench.errors import InputError

FOLDER = "python"
"""Of a site, where Python is."""
LOCK = "pyodide-lock.json"
START = ("pyodide.mjs", "pyodide.asm.wasm", "python_stdlib.zip", LOCK)
COMPILED = ("pyodide.asm.js", "pyodide.asm.mjs")
"""One of them: the second since Pyodide 314."""
PACKAGES = {"numpy": (2, 0), "scipy": (1, 14)}
"""What the core imports, and since which version."""
LARGEST, LARGEST_OF_ALL = 64 * 2**20, 160 * 2**20
_PLAIN = re.compile(r"[A-Za-z0-9_][A-Za-z0-9._-]{0,120}")
_UNUSED = (".pyi", ".pxd", ".pyx", ".h", ".a", ".c", ".f")
_NOTICES = """\
What is in this folder, and whose it is. All files are as they were released, but for tests, headers
and type stubs that are left out of the packages, and a list of packages that names these alone.

Pyodide {version}      MPL-2.0; its source: https://github.com/pyodide/pyodide, tag {version}
Python (pyodide.asm.*, python_stdlib.zip)      PSF-2.0; with Emscripten's runtime and musl, MIT
NumPy, SciPy, OpenBLAS      BSD-3-Clause; their licences are in their packages (dist-info)
"""


@dataclass(frozen=True)
class Python:
    """Where pages get Python from.

    Args:
        address: Of the folder with Pyodide's files, as the site's own folder names it; ends with /.
        files: What the site has beside it: name in `address` -> content; empty for an address
            elsewhere.
    """

    address: str
    files: Mapping[str, bytes]


def python_from(place: str) -> Python:
    """Return Python from a folder with the files of a Pyodide release, or from an address.

    Raises:
        InputError: If the folder lacks a file, has one that is too large or no Pyodide, or the
            address is none of a folder.
    """
    if re.match(r"[a-z]+://", place):
        return Python(_address(place), {})
    folder = Path(place)
    if not folder.is_dir():
        raise InputError(
            f"--python {place}: is no folder; wanted is that of a Pyodide release, or its address"
        )
    lock = _lock(folder)
    names = [
        *START[:-1],
        next((name for name in COMPILED if (folder / name).is_file()), COMPILED[0]),
    ]
    packages = {name: lock["packages"][name] for name in _wanted(folder, lock["packages"])}
    files = {name: _read(folder, name) for name in names}
    for package in packages.values():
        content = _without_unused(folder, package["file_name"], _read(folder, package["file_name"]))
        files[package["file_name"]] = content
        package["sha256"] = hashlib.sha256(content).hexdigest()
    size = sum(map(len, files.values()))
    if size > LARGEST_OF_ALL:
        raise InputError(f"--python {place}: {size / 2**20:.0f} MB are more than a page may load")
    version = lock["info"]["version"]
    files[LOCK] = json.dumps(lock | {"packages": packages}).encode()
    files["LICENSES.txt"] = _NOTICES.format(version=version).encode()
    return Python(f"{FOLDER}/{version}/", files)


def _address(place: str) -> str:
    try:
        parts = urlsplit(place)
        fine = parts.scheme in ("http", "https") and bool(parts.hostname) and not parts.username
    except ValueError:  # such as brackets that hold no address
        fine = False
    if not fine or not re.fullmatch(r"[\w:/.~%@-]+", place, re.ASCII):
        raise InputError(
            f"--python {place!r}: an address such as https://example.org/pyodide/v1/ is needed"
        )
    return f"{place.rstrip('/')}/"


def _lock(folder: Path) -> dict[str, Any]:
    """Return what the lock file says, held to what is used of it."""
    content = _read(folder, LOCK)
    lock: dict[str, Any] = {}
    try:
        lock = json.loads(content)
        version = lock["info"]["version"]
        packages = lock["packages"]
        fine = bool(_PLAIN.fullmatch(version)) and isinstance(packages, dict)
    except (ValueError, KeyError, TypeError, RecursionError):
        fine = False
    if not fine:
        raise InputError(f"--python {folder}: {LOCK} is not that of a Pyodide release")
    return lock


def _wanted(folder: Path, packages: Mapping[str, Any]) -> Iterator[str]:
    """Return the packages that the core needs, and those that they need."""
    todo = list(PACKAGES)
    done = set[str]()
    while todo:
        name = todo.pop(0)
        version = [0]
        depends = list[str]()
        if name in done:
            continue
        done.add(name)
        try:
            package = packages[name]
            file = package["file_name"]
            depends = list(package["depends"])
            version = [int(part) for part in package["version"].split(".")[:2]]
            fine = bool(_PLAIN.fullmatch(file)) and all(isinstance(need, str) for need in depends)
        except (KeyError, TypeError, ValueError, AttributeError):
            fine = False
        if not fine:
            raise InputError(f"--python {folder}: {LOCK} names no {name} that can be used")
        since = PACKAGES.get(name, (0,))
        if tuple(version) < since:
            raise InputError(
                f"--python {folder}: {name} {'.'.join(map(str, version))} is too old;"
                f" {'.'.join(map(str, since))} is needed"
            )
        yield name
        todo += depends


def _read(folder: Path, name: str) -> bytes:
    path = folder / name
    if not path.is_file():
        raise InputError(f"--python {folder}: {name} is not there")
    if path.stat().st_size > LARGEST:
        raise InputError(f"--python {folder}: {name} is larger than {LARGEST // 2**20} MB")
    return path.read_bytes()


def _without_unused(folder: Path, name: str, content: bytes) -> bytes:
    """Return a package without its tests, headers and type stubs; as it is, where it has none."""
    out = io.BytesIO()
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as old:
            kept = [info for info in old.infolist() if not _is_unused(info.filename)]
            if len(kept) == len(old.infolist()):
                return content
            if sum(info.file_size for info in kept) > 4 * LARGEST:
                raise InputError(f"--python {folder}: {name} unpacks to too much")
            with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as new:
                for info in kept:
                    new.writestr(
                        zipfile.ZipInfo(info.filename), old.read(info), zipfile.ZIP_DEFLATED
                    )
    except (zipfile.BadZipFile, NotImplementedError, RuntimeError):
        raise InputError(f"--python {folder}: {name} is no package") from None
    return out.getvalue()


def _is_unused(name: str) -> bool:
    return name.startswith(("numpy/", "scipy/")) and (name.endswith(_UNUSED) or "/tests/" in name)
