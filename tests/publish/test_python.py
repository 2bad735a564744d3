"""Where the pages of a site get Python from: a folder that somebody else made, or an address."""

import hashlib
import io
import json
import zipfile
from pathlib import Path

import pytest

from workbench.errors import InputError
from workbench.publish import python

PACKED = {
    "numpy": {"numpy/core.py": b"x = 1\n", "numpy/tests/test_a.py": b"1", "numpy/a.pyi": b"2"},
    "scipy": {"scipy/linalg.py": b"y = 2\n", "scipy/linalg/tests/test_b.py": b"3"},
    "openblas": {"openblas/libopenblas.so": b"\0asm"},
}


def packed(files: dict[str, bytes]) -> bytes:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return file.getvalue()


@pytest.fixture
def release(tmp_path) -> Path:
    """A folder as a Pyodide release has it, with little in its files."""
    for name in (*python.START[:-1], python.COMPILED[1]):
        (tmp_path / name).write_bytes(name.encode())
    packages = {
        name: {
            "file_name": f"{name}-2.1.zip",
            "version": "2.1.0",
            "depends": ["openblas"] if name == "scipy" else [],
            "sha256": "0",
        }
        for name in (*PACKED, "unwanted")
    }
    for name, files in PACKED.items():
        (tmp_path / f"{name}-2.1.zip").write_bytes(packed(files))
    write_lock(tmp_path, {"info": {"version": "0.99.1"}, "packages": packages})
    return tmp_path


def write_lock(folder: Path, lock: object) -> None:
    (folder / python.LOCK).write_text(json.dumps(lock))


def read_lock(folder: Path) -> dict:
    return json.loads((folder / python.LOCK).read_text())


def test_a_release_gives_what_a_page_needs_trimmed_and_named_by_its_version(release):
    interpreter = python.python_from(str(release))
    assert interpreter.address == "python/0.99.1/"
    assert {*interpreter.files} == {
        *python.START,
        python.COMPILED[1],
        *(f"{name}-2.1.zip" for name in PACKED),
        "LICENSES.txt",
    }
    lock = json.loads(interpreter.files[python.LOCK])
    assert {*lock["packages"]} == {*PACKED}
    for package in lock["packages"].values():
        content = interpreter.files[package["file_name"]]
        assert package["sha256"] == hashlib.sha256(content).hexdigest()
    with zipfile.ZipFile(io.BytesIO(interpreter.files["numpy-2.1.zip"])) as archive:
        assert archive.namelist() == ["numpy/core.py"]
        assert archive.read("numpy/core.py") == b"x = 1\n"
    assert b"0.99.1" in interpreter.files["LICENSES.txt"]
    assert interpreter == python.python_from(str(release)), "the same folder gives the same bytes"


def test_the_real_release_is_taken(pyodide):
    interpreter = python.python_from(str(pyodide))
    assert 20_000_000 < sum(map(len, interpreter.files.values())) < 32_000_000
    assert "pyodide.asm.js" in interpreter.files


@pytest.mark.parametrize(
    "name", [*python.START, python.COMPILED[1], "numpy-2.1.zip", "openblas-2.1.zip"]
)
def test_a_release_that_lacks_a_file_is_refused_with_its_name(release, name):
    (release / name).unlink()
    with pytest.raises(InputError, match="is not there") as told:
        python.python_from(str(release))
    assert "pyodide.asm" in str(told.value) if "asm." in name else name in str(told.value)


@pytest.mark.parametrize(
    "change",
    [
        {"file_name": "../../etc/passwd"},
        {"file_name": "a/b.whl"},
        {"file_name": ".hidden"},
        {"file_name": 7},
        {"version": "new"},
        {"version": None},
        {"depends": [7]},
        {"depends": ["../x"]},
        {"depends": None},
        {"version": "1.26.4"},
    ],
)
def test_a_lock_file_that_names_what_it_should_not_is_refused(release, change):
    lock = read_lock(release)
    lock["packages"]["numpy"] |= change
    write_lock(release, lock)
    with pytest.raises(InputError, match=r"names no .* that can be used|is too old"):
        python.python_from(str(release))


@pytest.mark.parametrize(
    "text",
    [
        "",
        "{",
        "[]",
        "{}",
        '{"info": 3}',
        '{"info": {"version": "../.."}, "packages": {}}',
        "[" * 99999,
    ],
)
def test_what_is_no_lock_file_is_refused(release, text):
    (release / python.LOCK).write_text(text)
    with pytest.raises(InputError, match="not that of a Pyodide release"):
        python.python_from(str(release))


def test_a_package_that_is_none_or_too_large_is_refused(release, monkeypatch):
    (release / "numpy-2.1.zip").write_bytes(b"PK no archive")
    with pytest.raises(InputError, match=r"numpy-2\.1\.zip is no package"):
        python.python_from(str(release))
    (release / "numpy-2.1.zip").write_bytes(packed({"numpy/a.pyi": b"", "numpy/b": bytes(9000)}))
    monkeypatch.setattr(python, "LARGEST", 2000)
    with pytest.raises(InputError, match=r"numpy-2\.1\.zip (unpacks to too much|is larger)"):
        python.python_from(str(release))
    monkeypatch.setattr(python, "LARGEST", 10)
    with pytest.raises(InputError, match="is larger than"):
        python.python_from(str(release))
    monkeypatch.undo()
    monkeypatch.setattr(python, "LARGEST_OF_ALL", 10)
    with pytest.raises(InputError, match="more than a page may load"):
        python.python_from(str(release))


def test_an_address_is_taken_and_ends_with_a_slash():
    assert python.python_from("https://example.org/pyodide/v1") == python.Python(
        "https://example.org/pyodide/v1/", {}
    )


@pytest.mark.parametrize(
    "place",
    [
        "nowhere",
        "ftp://example.org/",
        "https://",
        "https://a b/",
        "https://user@example.org/",
        "https://example.org/?a=b",
        "https://example.org/'; script-src *",
        "javascript://example.org/",
        "https://[::1/",
    ],
)
def test_a_place_that_is_none_is_refused(place):
    with pytest.raises(InputError, match="--python"):
        python.python_from(place)
