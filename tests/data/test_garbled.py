"""Whatever is cut off or changed in a good file, what comes is a result or one line that names it;
nothing is printed.
"""

import gzip
import io
import warnings
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from PIL import Image

from lessons.features.turned_pictures import read_levels
from tests.data.test_files import P, pcd, ply, rows
from workbench.data.files import read_cloud, read_image, read_mesh, read_pose, read_voxels
from workbench.data.files.edge_lists import read_edges
from workbench.data.files.intrinsics import read_intrinsics
from workbench.data.files.matches import read_matches
from workbench.data.flat_points import read_flat_or_cloud, read_round
from workbench.data.own_meshes import read_surface, read_welded
from workbench.data.places import read_places
from workbench.data.views.corners import find_corners, read_corners
from workbench.data.views.sightings import read_sightings
from workbench.errors import InputError

TRIES = 25
"""Files made of each good one."""
BOX = trimesh.creation.icosphere(1)


def packed(**arrays) -> bytes:
    stream = io.BytesIO()
    np.savez_compressed(stream, **arrays)
    return stream.getvalue()


def array(values: np.ndarray) -> bytes:
    stream = io.BytesIO()
    np.save(stream, values)
    return stream.getvalue()


def picture(kind: str) -> bytes:
    stream = io.BytesIO()
    Image.fromarray((np.indices((90, 120)).sum(axis=0) % 251).astype("u1")).save(stream, kind)
    return stream.getvalue()


def zipped() -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in ("a.png", "b.png"):
            archive.writestr(name, picture("PNG"))
    return stream.getvalue()


def mesh(kind: str) -> bytes:
    made: Any = BOX.export(file_type=kind)
    return made.encode() if isinstance(made, str) else made


SEEN = np.random.default_rng(0).uniform(0, 400, (9, 2))
CLOUDS: dict[str, bytes] = {
    "a.xyz": rows(" ").encode(),
    "a.csv": ("x;y;z\n" + rows(";")).encode(),
    "b.csv": rows(",").encode("utf-16"),
    "a.xyz.gz": gzip.compress(rows(" ").encode()),
    "a.ply": ply("ascii"),
    "b.ply": ply("binary_little_endian"),
    "c.ply": ply("binary_big_endian"),
    "a.pcd": pcd("ascii"),
    "b.pcd": pcd("binary"),
    "c.pcd": pcd("binary_compressed"),
    "a.obj": "".join(f"v {row}\n" for row in rows(" ").splitlines()).encode(),
    "a.npy": array(P),
    "a.npz": packed(p=P),
}
MESHES = {f"mesh.{kind}": mesh(kind) for kind in ("off", "obj", "ply", "stl", "glb")}
PICTURES = {
    f"a.{kind}": picture(name)
    for kind, name in (
        ("png", "PNG"),
        ("jpg", "JPEG"),
        ("pgm", "PPM"),
        ("bmp", "BMP"),
        ("gif", "GIF"),
        ("tif", "TIFF"),
        ("webp", "WEBP"),
    )
}
BOARD = np.array([[x, y, 0.0] for y in range(3) for x in range(4)])
GOOD: list[tuple[Callable, str, bytes]] = [
    *((read_cloud, name, content) for name, content in CLOUDS.items()),
    *((read_mesh, name, content) for name, content in MESHES.items()),
    (lambda path: read_surface(path, 1000), "mesh.off", MESHES["mesh.off"]),
    (lambda path: read_welded(path, 1000, "fitted"), "mesh.stl", MESHES["mesh.stl"]),
    *((read_image, name, content) for name, content in PICTURES.items()),
    (read_levels, "a.png", PICTURES["a.png"]),
    (lambda path: find_corners(path, 4, 3), "a.zip", zipped()),
    (read_voxels, "voxels.npy", array(np.ones((4, 4, 4), bool))),
    (read_flat_or_cloud, "flat.txt", b"1 2\n3 4\n5 6\n7 9\n"),
    (
        lambda path: read_round(path, "circle", 100),
        "flat.csv",
        b"0,1\n1,0\n0,-1\n-1,0\n.7,.7\n.7,-.7\n",
    ),
    (read_pose, "pose.txt", b"0 -1 0 1\n1 0 0 2\n0 0 1 3\n0 0 0 1\n"),
    (read_pose, "pose.npy", array(np.eye(4))),
    (
        lambda path: read_pose(path, Path("a.ply"), Path("b.ply")),
        "poses.conf",
        b"bmesh a.ply 0 0 0 0 0 0 1\nbmesh b.ply 1 2 3 0.1 0.2 0.3 0.927\n",
    ),
    (
        read_matches,
        "matches.npz",
        packed(x1=SEEN, x2=SEEN + 1.5, K=np.diag([500.0, 500.0, 1.0]), F=np.eye(3)),
    ),
    (read_matches, "matches.txt", rows(" ", np.hstack([SEEN, SEEN + 1.5])).encode()),
    (read_sightings, "points.txt", rows(" ", np.hstack([SEEN, SEEN, SEEN[:, :1]])).encode()),
    (read_intrinsics, "K.txt", b"500 500 320 240\n"),
    (read_places, "places.csv", "lat,lon,name\n51.5,-0.1,Zürich\n35.6,139.7,Tokyo\n".encode()),
    (
        lambda path: read_edges(path, 100),
        "graph.csv",
        b"source,target,weight\na,b,1\nb,c,2.5\nc,a,1\n",
    ),
    (
        read_corners,
        "corners.npz",
        packed(
            object_points=BOARD,
            corners=np.stack([BOARD[:, :2] * 40 + 50, BOARD[:, :2] * 42 + 70]),
            size=[640, 480],
        ),
    ),
    (
        read_corners,
        "corners.txt",
        "".join(
            f"{view} {x:g} {y:g} {40 * x + 50:g} {40 * y + 60 + k:g}\n"
            for k, view in enumerate("ab")
            for x, y, _ in BOARD
        ).encode(),
    ),
]


def garbled(content: bytes, rng: np.random.Generator) -> bytes:
    """Return a file cut off, with some bytes changed, left out or repeated, or with numbers that
    mean harm.
    """
    changed = bytearray(content)
    at = int(rng.integers(len(changed)))
    match int(rng.integers(6)):
        case 0:
            return bytes(changed[:at])
        case 1:
            for place in rng.integers(0, len(changed), 3).tolist():
                changed[place] = int(rng.integers(256))
        case 2:
            del changed[at : at + int(rng.integers(1, 40))]
        case 3:
            changed[at:at] = changed[at : at + 50] * 3
        case 4:
            digits = [i for i, byte in enumerate(changed) if byte in b"0123456789"]
            if digits:
                place = digits[int(rng.integers(len(digits)))]
                harm = (b"-9", b"99999999999", b"1e400", b"nan", b"\xff", b"")
                changed[place : place + 1] = harm[int(rng.integers(len(harm)))]
        case _:
            changed[at : at + 8] = b"\xff" * 8
    return bytes(changed)


@pytest.mark.parametrize(
    "case", range(len(GOOD)), ids=[f"{name}-{k}" for k, (_, name, _) in enumerate(GOOD)]
)
def test_a_garbled_file_is_a_result_or_one_line(tmp_path, capfd, case):
    read, name, content = GOOD[case]
    path = tmp_path / name
    path.write_bytes(content)
    if read is not GOOD[0][0] and name != "a.zip":
        read(path)  # it is good
    rng = np.random.default_rng(case)
    for _ in range(TRIES):
        path.write_bytes(garbled(content, rng))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            try:
                read(path)
            except InputError as error:
                message = str(error)
                assert path.name in message
                assert message.isprintable()
                assert len(message) < 400
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "names a vertex that is not there"),
        ("a.obj", b"v 0 0 0\nf 1 -7 2\nv 1 0 0\n", "names a vertex that is not there"),
        (
            "a.off",
            b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n",
            "names a vertex that is not there",
        ),
    ],
)
def test_a_face_that_names_no_vertex_is_told_so(tmp_path, name, content, *, message):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(InputError, match=message):
        read_mesh(tmp_path / name)
