"""Own files that somebody else made: each is read in bounds or refused in one line, and nothing in
it is run or followed.
"""

import gzip
import inspect
import io
import json
import os
import pickle
import struct
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from workbench.apart import COMMAND, allowing
from workbench.data.files import read_cloud, read_image, read_mesh, read_pose
from workbench.data.files.edge_lists import read_edges
from workbench.data.files.intrinsics import read_intrinsics
from workbench.data.files.matches import read_matches
from workbench.data.flat_points import read_flat_or_cloud
from workbench.data.pictures import names_in, pictures_of
from workbench.data.places import read_places
from workbench.data.views.corners import read_corners
from workbench.data.views.sightings import read_sightings
from workbench.errors import InputError

READERS: dict[str, Callable] = {"cloud": read_cloud, "matches": read_matches}


class Runs:
    """An object that leaves a trace where it is unpickled."""

    def __init__(self, trace: Path):
        self.trace = trace

    def __reduce__(self):
        return Path.touch, (self.trace,)


def refused(read: Callable, path: Path, message: str) -> None:
    with pytest.raises(InputError, match=message) as caught:
        read(path)
    assert str(caught.value).isprintable()


TEXTS = (
    "",
    "\n\n",
    ",,\n",
    ";;\n,,\n",
    "# nothing\n",
    "x y z u v\n",
    "a,b\n;\n",
    "1\n",
    "1 2 3 4 5 6 7 8 9 10 11\n",
    "nan nan nan nan nan\n" * 9,
    "1e999 2 3 4 5\n" * 9,
    ",,\n1 2\n,,\n",
    "view\n",
    "\x00\x00\x00\n",
    "1,2;3\t4 5\n" * 3,
)
TEXT_READERS: dict[str, Callable] = {
    "cloud": read_cloud,
    "corners": read_corners,
    "edges": lambda path: read_edges(path, 100),
    "flat points": read_flat_or_cloud,
    "intrinsics": read_intrinsics,
    "matches": read_matches,
    "places": read_places,
    "sightings": read_sightings,
}


@pytest.mark.parametrize("reader", TEXT_READERS)
def test_text_that_is_no_table_is_refused_in_one_line(tmp_path, reader):
    for k, text in enumerate(TEXTS):
        path = tmp_path / f"own{k}.csv"
        path.write_text(text, encoding="utf-8")
        message = path.name
        try:
            TEXT_READERS[reader](path)
        except InputError as error:
            message = str(error)
        assert message.isprintable(), text
        assert path.name in message, text


@pytest.mark.parametrize("reader", READERS)
def test_nothing_is_unpickled(tmp_path, reader):
    trace = tmp_path / "was-run"
    objects = np.array([Runs(trace)], dtype=object)
    np.savez(tmp_path / "a.npz", p=objects, matches=objects)
    np.save(tmp_path / "a.npy", objects)
    (tmp_path / "b.npz").write_bytes(pickle.dumps(Runs(trace)))
    for name in ("a.npz", "b.npz") if reader == "matches" else ("a.npz", "a.npy", "b.npz"):
        refused(READERS[reader], tmp_path / name, "not readable as arrays of numpy")
    if reader == "cloud":
        refused(read_pose, tmp_path / "a.npy", "not readable as arrays of numpy")
    assert not trace.exists()


@pytest.mark.parametrize("reader", READERS)
def test_a_small_file_does_not_unpack_to_a_large_one(tmp_path, reader):
    np.savez_compressed(tmp_path / "bomb.npz", matches=np.zeros((1000, 4)), p=np.zeros((1000, 3)))
    assert len(read_matches(tmp_path / "bomb.npz").p) == 1000
    with allowing(replace(COMMAND, unpacked=50_000)):
        refused(READERS[reader], tmp_path / "bomb.npz", "MB unpacked; that is too large")


def test_a_compressed_cloud_does_not_unpack_to_a_large_one(tmp_path):
    head = (
        b"FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nPOINTS 100\nDATA binary_compressed\n"
    )
    (tmp_path / "a.pcd").write_bytes(
        head + struct.pack("<II", 6, 1200) + b"\x00\x00\xe0\xff\x00\x00"
    )
    with allowing(replace(COMMAND, unpacked=1000)):
        refused(read_cloud, tmp_path / "a.pcd", "MB unpacked; that is too large")


def test_a_header_that_promises_more_than_there_is_takes_no_memory(tmp_path):
    stream = io.BytesIO()
    np.lib.format.write_array_header_1_0(
        stream, {"descr": "<f8", "fortran_order": False, "shape": (10**13, 3)}
    )
    (tmp_path / "a.npy").write_bytes(stream.getvalue())
    refused(read_cloud, tmp_path / "a.npy", "not readable as arrays of numpy")
    head = "ply\nformat binary_little_endian 1.0\nelement vertex 99999999999\n"
    head += "property float x\nproperty float y\nproperty float z\nend_header\n"
    (tmp_path / "a.ply").write_bytes(head.encode() + bytes(120))
    refused(read_cloud, tmp_path / "a.ply", "99,999,999,999 points; at most")


def damaged(npz: bytes, how: str) -> bytes:
    changed = bytearray(npz)
    central = npz.index(b"PK\x01\x02")
    if how == "data":
        changed[120:160] = b"\xff" * 40
    elif how == "compression":
        changed[8:10] = changed[central + 10 : central + 12] = struct.pack("<H", 97)
    else:
        changed[6] |= 1
        changed[central + 8] |= 1
    return bytes(changed)


@pytest.mark.parametrize("how", ["data", "compression", "encrypted"])
@pytest.mark.parametrize("reader", READERS)
def test_damage_is_one_line(tmp_path, reader, how):
    stream = io.BytesIO()
    np.savez_compressed(stream, p=np.random.default_rng(0).normal(size=(100, 3)))
    (tmp_path / "a.npz").write_bytes(damaged(stream.getvalue(), how))
    refused(READERS[reader], tmp_path / "a.npz", "not readable as arrays of numpy")


def test_damage_in_gzip_is_one_line(tmp_path):
    packed = bytearray(gzip.compress(b"".join(b"%d 2 3\n" % i for i in range(500))))
    packed[20:60] = b"\xff" * 40
    (tmp_path / "a.xyz.gz").write_bytes(packed)
    refused(read_cloud, tmp_path / "a.xyz.gz", "not readable")


def test_a_pose_of_words_is_one_line(tmp_path):
    np.save(tmp_path / "a.npy", np.array(["a"] * 16))
    refused(read_pose, tmp_path / "a.npy", "not a pose")


def test_no_file_is_handed_to_another_program(tmp_path, monkeypatch):
    """Pillow has Ghostscript draw what begins like EPS, whatever the file is called."""
    from PIL import EpsImagePlugin

    started = []
    monkeypatch.setattr(EpsImagePlugin, "has_ghostscript", lambda: True)
    monkeypatch.setattr(EpsImagePlugin, "gs_binary", "gs")
    monkeypatch.setattr("subprocess.check_call", lambda *words, **_: started.append(words))
    eps = b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 10 10\n%%EndComments\nshowpage\n"
    (tmp_path / "a.png").write_bytes(eps)
    refused(inspect.unwrap(read_image), tmp_path / "a.png", "not readable as an image")
    assert started == []


def test_an_image_s_size_is_judged_before_it_is_unpacked(tmp_path, monkeypatch):
    Image.new("1", (2000, 2000)).save(tmp_path / "a.png")
    monkeypatch.setattr(Image.Image, "convert", lambda *_: pytest.fail("unpacked"))
    with allowing(replace(COMMAND, pixels=10**6)):
        refused(
            inspect.unwrap(read_image), tmp_path / "a.png", "2000 x 2000 pixels; at most 1,000,000"
        )


def test_a_folder_of_pictures_leads_nowhere_else(tmp_path):
    home, other = tmp_path / "home", tmp_path / "other"
    (home / "below.jpg").mkdir(parents=True)
    other.mkdir()
    Image.new("L", (4, 3)).save(other / "secret.png")
    (home / "secret.png").symlink_to(other / "secret.png")
    (home / "zero.png").symlink_to("/dev/zero")
    os.mkfifo(home / "pipe.png")
    refused(names_in, home, "no pictures")
    Image.new("L", (4, 3)).save(home / "a.png")
    assert names_in(home) == ("a.png",)


def test_a_zip_of_pictures_writes_nothing_and_does_not_unpack_to_much(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    picture = io.BytesIO()
    Image.new("L", (4, 3)).save(picture, "PNG")
    with zipfile.ZipFile("p.zip", "w", zipfile.ZIP_DEFLATED) as packed:
        packed.writestr("../../escaped.png", picture.getvalue())
        packed.writestr("/etc/absolute.png", picture.getvalue())
        packed.writestr("__MACOSX/._a.png", b"a note of the system")
        packed.writestr("large.png", picture.getvalue() + bytes(10**6))
    path = Path("p.zip")
    assert set(names_in(path)) == {"../../escaped.png", "/etc/absolute.png", "large.png"}
    shown = pictures_of(path, names_in(path)).shown(0, 100)
    assert shown is not None
    assert shown.shape == (3, 4)
    assert [entry.name for entry in tmp_path.iterdir()] == ["p.zip"]
    with allowing(replace(COMMAND, unpacked=10**5)):
        refused(lambda path: pictures_of(path, ("large.png",)), path, "too large")
    Path("broken.zip").write_bytes(path.read_bytes()[:-30])
    refused(names_in, Path("broken.zip"), "not readable as a zip")
    content = bytearray(path.read_bytes())
    content[60:70] = bytes(10)
    Path("damaged.zip").write_bytes(content)
    refused(
        lambda path: pictures_of(path, names_in(path)),
        Path("damaged.zip"),
        "cannot be unpacked|not readable",
    )


def test_a_mesh_names_no_other_files(tmp_path):
    secret = tmp_path / "secret.bin"
    secret.write_bytes(np.eye(3, dtype="<f4").tobytes())
    scene = {
        "asset": {"version": "2.0"},
        "buffers": [{"uri": str(secret), "byteLength": 36}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
    }
    for uri in (str(secret), "secret.bin", f"file://{secret}"):
        scene["buffers"][0]["uri"] = uri
        (tmp_path / "a.gltf").write_text(json.dumps(scene))
        refused(read_mesh, tmp_path / "a.gltf", "not readable as a gltf mesh")


def test_a_mesh_that_is_named_many_times_is_counted_first(tmp_path):
    import trimesh

    scene = trimesh.Scene()
    scene.add_geometry(trimesh.creation.box(), geom_name="box")
    for i in range(20):
        scene.graph.update(frame_to=f"{i}", geometry="box", matrix=np.eye(4))
    (tmp_path / "a.glb").write_bytes(scene.export(file_type="glb"))
    assert len(read_mesh(tmp_path / "a.glb")[0]) >= 20 * 8
    with allowing(replace(COMMAND, points=100)):
        refused(read_mesh, tmp_path / "a.glb", "vertices; at most 100 are read")


def test_a_zip_that_is_no_npz_is_one_line(tmp_path):
    with zipfile.ZipFile(tmp_path / "a.npz", "w") as packed:
        packed.writestr("p", "hello")
    for read in READERS.values():
        refused(read, tmp_path / "a.npz", "where .* numbers are wanted")
