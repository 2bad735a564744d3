"""Files that people bring: every dialect that is read, and one clear line for every one that is
not.
"""

import gzip
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from workbench.apart import COMMAND, allowing, told
from workbench.data.files import read_cloud, read_image, read_mesh, read_pose
from workbench.data.files.formats import _unpack_lzf
from workbench.errors import InputError

P = np.array([[0.0, 1.0, 2.0], [3.5, -4.25, 5.0], [6.0, 7.0, -8.125], [0.5, 0.25, 1e-3]])


def refused(path, *words, read=read_cloud, **options) -> str:
    with pytest.raises(InputError) as caught:
        read(path, **options)
    line = str(caught.value)
    assert "\n" not in line
    assert path.name in line
    assert len(line) < 300
    for word in words:
        assert word in line, line
    return line


@pytest.fixture
def write(tmp_path):
    def write(name: str, content: str | bytes):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    return write


def rows(separator: str, p: np.ndarray = P, form: str = "{:.8g}") -> str:
    return "\n".join(separator.join(form.format(x) for x in row) for row in p) + "\n"


TEXTS = {
    "spaces.xyz": rows(" "),
    "tabs.txt": rows("\t"),
    "commas.csv": rows(","),
    "commas and spaces.csv": rows(" , "),
    "semicolons.csv": rows(";"),
    "decimal commas.csv": rows(";").replace(".", ","),
    "exponents.xyz": rows("   ", form="{:+.9e}"),
    "header.csv": "x,y,z\n" + rows(","),
    "capitals with units.csv": '"X [m]";"Y [m]";"Z [m]"\n' + rows(";"),
    "spaced header.txt": "x y z\n" + rows(" "),
    "other order.csv": "t,z,intensity,y,x\n"
    + rows(",", np.column_stack([P[:, 0], P[:, 2], P[:, 0], P[:, 1], P[:, 0]])),
    "words beside.csv": "name,x,y,z\n" + "".join(f"tree,{a},{b},{c}\n" for a, b, c in P),
    "more columns.xyz": rows(" ", np.hstack([P, P])),
    "comments.txt": "# a cloud\n// by hand\n\n" + rows(" ") + "\n\n",
    "windows.csv": ("x,y,z\n" + rows(",")).replace("\n", "\r\n"),
    "byte order mark.csv": "\ufeffx,y,z\n" + rows(","),
    "counted.pts": "4\n" + rows(" "),
    "no ending newline.xyz": rows(" ").rstrip("\n"),
    "vertices.obj": "# points\no cloud\n"
    + "".join(f"v {a} {b} {c} 0.5 0.5 0.5\n" for a, b, c in P),
}


@pytest.mark.parametrize("name", TEXTS)
def test_text_in_every_dialect(write, name):
    np.testing.assert_allclose(read_cloud(write(name, TEXTS[name])), P, rtol=1e-7)


def ply(kind: str, faces: int = 0, extra: bool = True, *, p: np.ndarray = P) -> bytes:
    header = f"ply\nformat {kind} 1.0\ncomment ours\nelement vertex {len(p)}\n"
    header += (
        "property uchar red\n" * extra + "property float x\nproperty double y\nproperty float32 z\n"
    )
    header += f"element face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    if kind == "ascii":
        body = "".join(f"{'7 ' * extra}{a} {b} {c}\n" for a, b, c in p).encode()
    else:
        order = "<" if kind == "binary_little_endian" else ">"
        fields = [("red", "u1")] * extra + [
            ("x", order + "f4"),
            ("y", order + "f8"),
            ("z", order + "f4"),
        ]
        table = np.zeros(len(p), fields)
        for i, axis in enumerate("xyz"):
            table[axis] = p[:, i]
        body = table.tobytes()
    return header.encode() + body


@pytest.mark.parametrize("kind", ["ascii", "binary_little_endian", "binary_big_endian"])
@pytest.mark.parametrize("extra", [False, True])
def test_ply_of_every_kind(write, kind, extra):
    np.testing.assert_allclose(read_cloud(write("a.ply", ply(kind, extra=extra))), P, rtol=1e-6)
    np.testing.assert_allclose(
        read_cloud(write("a.PLY", ply(kind).replace(b"\n", b"\r\n", 3))), P, rtol=1e-6
    )


def pcd(kind: str, p: np.ndarray = P) -> bytes:
    header = (
        "# .PCD v0.7\nVERSION 0.7\nFIELDS rgb x y z\nSIZE 4 4 4 8\nTYPE U F F F\nCOUNT 2 1 1 1\n"
        f"WIDTH {len(p)}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {len(p)}\nDATA {kind}\n"
    ).encode()
    if kind == "ascii":
        return header + "".join(f"1 2 {a} {b} {c}\n" for a, b, c in p).encode()
    columns = [
        np.zeros((len(p), 2), "<u4"),
        *(p[:, i].astype(t) for i, t in enumerate(("<f4", "<f4", "<f8"))),
    ]
    if kind == "binary":
        fields = [("rgb", "<u4", 2), ("x", "<f4"), ("y", "<f4"), ("z", "<f8")]
        table = np.zeros(len(p), fields)
        for name, column in zip(("rgb", "x", "y", "z"), columns, strict=True):
            table[name] = column
        return header + table.tobytes()
    plain = b"".join(column.tobytes() for column in columns)
    packed = b"".join(
        bytes([len(part) - 1]) + part
        for part in (plain[i : i + 32] for i in range(0, len(plain), 32))
    )
    return header + np.array([len(packed), len(plain)], "<u4").tobytes() + packed


@pytest.mark.parametrize("kind", ["ascii", "binary", "binary_compressed"])
def test_pcd_of_every_kind_without_what_the_scanner_did_not_see(write, kind):
    np.testing.assert_allclose(read_cloud(write("a.pcd", pcd(kind))), P, rtol=1e-6)
    holes = np.vstack([P, [[np.nan] * 3], P])
    np.testing.assert_allclose(
        read_cloud(write("b.pcd", pcd(kind, holes))), np.vstack([P, P]), rtol=1e-6
    )


HOLED = np.vstack([P, [[np.nan, 1.0, 2.0], [np.inf, 0.0, 0.0]], P])
HOLES: dict[str, str | bytes] = {
    "a.xyz": rows(" ", HOLED),
    "a.csv": "x,y,z\n" + rows(",", HOLED),
    "a.obj": "".join(f"v {row}\n" for row in rows(" ", HOLED).splitlines()),
    "a.ply": ply("ascii", p=HOLED),
    "b.ply": ply("binary_little_endian", p=HOLED),
    "a.pcd": pcd("ascii", HOLED),
}


@pytest.mark.parametrize("name", [*HOLES, "a.npy"])
def test_rows_without_numbers_are_left_out_and_counted_in_every_format(write, tmp_path, name):
    if name == "a.npy":
        np.save(tmp_path / name, HOLED)
    path = tmp_path / name if name == "a.npy" else write(name, HOLES[name])
    np.testing.assert_allclose(read_cloud(path), np.vstack([P, P]), rtol=1e-6)
    assert told(path) == (f"{name}: 2 of 10 points left out: NaN or infinite.",)


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-16-be", "utf-8-sig"])
def test_a_table_of_a_spreadsheet_in_utf_16(write, encoding):
    mark = {"utf-16-le": "\ufeff", "utf-16-be": "\ufeff"}.get(encoding, "")
    path = write("a.csv", (mark + "x,y,z\r\n" + rows(",").replace("\n", "\r\n")).encode(encoding))
    np.testing.assert_array_equal(read_cloud(path), P)


def test_copies_of_lzf_run_into_themselves():
    assert _unpack_lzf(b"\x02abc" + bytes([(5 - 2) << 5, 2]), 8, "a") == b"abcabcab"
    assert _unpack_lzf(b"\x00a" + bytes([7 << 5, 20, 0]), 30, "a") == b"a" * 30


@pytest.mark.parametrize(
    "packed", [b"\x05abc", bytes([3 << 5, 9]), b"\x00a" + bytes([7 << 5]), b"\x01ab"]
)
def test_damaged_lzf_is_refused(packed):
    with pytest.raises(InputError, match=r"damaged|cut short"):
        _unpack_lzf(packed, 40, "a.pcd")


def test_arrays(write, tmp_path):
    np.save(tmp_path / "a.npy", np.hstack([P, P]).astype(np.float32))
    np.testing.assert_allclose(read_cloud(tmp_path / "a.npy"), P, rtol=1e-6)
    np.savez(tmp_path / "b.npz", points=P, colors=np.zeros((4, 3)))
    np.testing.assert_array_equal(read_cloud(tmp_path / "b.npz"), P)
    np.savez(tmp_path / "c.npz", a=P)
    np.testing.assert_array_equal(read_cloud(tmp_path / "c.npz"), P)
    np.savez(tmp_path / "d.npz", a=P, b=P)
    refused(tmp_path / "d.npz", "a, b")
    np.save(tmp_path / "e.npy", P[0])
    refused(tmp_path / "e.npy", "(3,)", "(n, 3)")
    np.save(tmp_path / "f.npy", np.array([{"a": 1}]), allow_pickle=True)
    refused(tmp_path / "f.npy", "not readable")
    refused(write("g.npz", b"PK\x03\x04 no archive"), "not readable")
    refused(write("h.npy", b""), "empty")


def test_gzip_is_undone(write):
    np.testing.assert_allclose(read_cloud(write("a.ply.gz", gzip.compress(ply("ascii")))), P)
    refused(write("b.ply.gz", b"no gzip"), "not readable")
    refused(write("c.ply.gz", gzip.compress(ply("ascii"))[:-20]), "not readable")


def test_a_file_is_read_once_and_again_when_it_has_changed(write):
    path = write("a.xyz", rows(" "))
    first = read_cloud(path)
    assert read_cloud(path) is first
    assert not first.flags.writeable
    write("a.xyz", rows(" ", P[:3]))
    assert len(read_cloud(path)) == 3


class TestRefusals:
    @pytest.mark.parametrize("name", ["no.ply", "no.csv", "folder/no.xyz"])
    def test_missing(self, tmp_path, name):
        refused(tmp_path / name, "no such file")

    def test_a_folder(self, tmp_path):
        refused(tmp_path, "folder")

    @pytest.mark.parametrize("name", ["a.ply", "a.pcd", "a.obj", "a.xyz", "a.csv", "a.npz"])
    @pytest.mark.parametrize("content", [b"", b"\n \n"])
    def test_empty(self, write, name, content):
        refused(write(name, content), "empty")

    def test_only_a_header(self, write):
        refused(write("a.csv", "x,y,z\n"), "0 points", "at least 3")
        refused(write("a.obj", "# nothing\n"), "0 points")

    def test_one_point(self, write):
        refused(write("a.xyz", "1 2 3\n"), "1 point;", "at least 3")
        assert len(read_cloud(write("a.xyz", "1 2 3\n"), fewest=1)) == 1

    def test_a_pcd_of_nothing_but_nan(self, write):
        refused(write("a.pcd", pcd("binary", np.full((5, 3), np.nan))), "all 5 points are NaN")

    def test_a_mesh(self, write):
        refused(write("a.ply", ply("ascii", faces=2)), "mesh", "4 vertices, 2 faces", "point cloud")
        refused(
            write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "mesh", "3 vertices, 1 faces"
        )
        refused(write("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), "mesh")

    def test_wrong_columns(self, write):
        refused(write("a.csv", "1,2\n3,4\n5,6\n"), "2 columns")
        refused(write("a.csv", "lat,lon,height\n1,2,3\n"), "x, y, z", "lat,lon,height")
        refused(write("a.csv", "1,2,3\n4,5\n6,7,8\n"), "'4,5'")
        refused(write("a.xyz", "1 2 3\n4 five 6\n7 8 9\n"), "4 five 6")
        refused(write("a.csv", "1;2;3\n4;;6\n"), "4;;6")

    def test_what_is_no_text(self, write):
        refused(write("a.csv", bytes(range(256))), "not a text file")
        refused(write("a.xyz", b"1 2 3\n\x00\x00"), "not a text file")

    def test_what_is_no_cloud(self, write):
        refused(write("a.docx", b"PK"), ".docx", "ply, pcd")
        refused(write("a", b"1 2 3"), "no ending")

    def test_ply_that_is_cut_or_odd(self, write):
        refused(write("a.ply", ply("binary_little_endian")[:-9]), "cut short")
        refused(write("a.ply", b"\n".join(ply("ascii").splitlines()[:-2])), "cut short")
        refused(write("a.ply", b"no ply at all"), "not a ply file")
        refused(write("a.ply", ply("ascii").replace(b"ascii", b"text")), "format text")
        refused(
            write("a.ply", ply("ascii").replace(b"property float x", b"property float a")),
            "x, y and z",
        )
        refused(write("a.ply", ply("ascii").replace(b"uchar red", b"colour red")), "not understood")

    def test_pcd_that_is_cut_or_odd(self, write):
        for kind in ("ascii", "binary", "binary_compressed"):
            refused(write("a.pcd", pcd(kind)[:-50]), "a.pcd")
        refused(write("a.pcd", b"hello"), "not a pcd file")
        refused(write("a.pcd", pcd("ascii").replace(b"POINTS 4", b"POINTS -4")), "incomplete")
        refused(write("a.pcd", pcd("ascii").replace(b"DATA ascii", b"DATA zip")), "'zip'")
        refused(write("a.pcd", pcd("ascii").replace(b" x y", b" a b")), "no fields x, y and z")
        refused(write("a.pcd", pcd("binary").replace(b"SIZE 4", b"SIZE 3")), "incomplete")

    def test_too_large(self, write):
        with allowing(replace(COMMAND, unpacked=20)):
            refused(write("a.xyz", rows(" ")), "at most")
        with allowing(replace(COMMAND, unpacked=100)):
            refused(write("a.xyz.gz", gzip.compress(b"1 2 3\n" * 100, 9)), "unpacked")
        with allowing(replace(COMMAND, points=3)):
            refused(write("b.xyz", rows(" ")), "4 ", "at most 3")


class TestPose:
    T = np.array(
        [[0.0, -1.0, 0.0, 1.0], [1.0, 0.0, 0.0, 2.0], [0.0, 0.0, 1.0, 3.0], [0.0, 0.0, 0.0, 1.0]]
    )

    @pytest.mark.parametrize("separator", [" ", ",", " , ", ";", "\t"])
    def test_sixteen_numbers(self, write, tmp_path, separator):
        text = "# target from source\n" + rows(separator, self.T)
        np.testing.assert_array_equal(read_pose(write("a.txt", text)), self.T)
        np.testing.assert_array_equal(
            read_pose(write("a.txt", separator.join(f"{x}" for x in self.T.ravel()))), self.T
        )
        np.save(tmp_path / "a.npy", self.T)
        np.testing.assert_array_equal(read_pose(tmp_path / "a.npy"), self.T)

    def test_a_list_by_scan(self, write, tmp_path):
        text = "reading, gT00\n" + "".join(
            f"{name}, {', '.join(f'{x}' for x in T.ravel())}\n"
            for name, T in (("a.csv", np.eye(4)), ("b.csv", self.T))
        )
        path = write("list.csv", text)
        np.testing.assert_array_equal(
            read_pose(path, tmp_path / "a.csv", tmp_path / "b.csv"), self.T
        )
        np.testing.assert_allclose(
            read_pose(path, tmp_path / "b.csv", tmp_path / "a.csv"), np.linalg.inv(self.T)
        )
        refused(
            path,
            "a.csv, b.csv",
            "c.csv",
            read=read_pose,
            target=tmp_path / "a.csv",
            source=tmp_path / "c.csv",
        )

    def test_what_is_no_pose(self, write):
        refused(write("a.txt", "1 2 3"), "3 numbers", "4 x 4", read=read_pose)
        refused(write("a.txt", "hello"), "not a pose", read=read_pose)
        refused(write("a.txt", rows(" ", 2 * self.T)), "not a rigid pose", read=read_pose)
        refused(
            write("a.txt", rows(" ", self.T * [[1], [1], [-1], [1]])),
            "not a rigid pose",
            read=read_pose,
        )
        refused(
            write("a.txt", rows(" ", self.T).replace("3", "nan")),
            "not a rigid pose",
            read=read_pose,
        )
        refused(write("a.npy", b""), "not readable", read=read_pose)


class TestMeshAndImage:
    def test_meshes(self, write):
        off = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"
        p, faces = read_mesh(write("square.off", off))
        assert p.shape == (4, 3)
        assert faces.shape == (2, 3)
        refused(write("a.ply", ply("ascii")), "without faces", read=read_mesh)
        refused(write("a.off", "OFF\nnothing"), "not readable", read=read_mesh)
        refused(write("a.xyz", rows(" ")), ".xyz", read=read_mesh)

    def test_images(self, write, tmp_path):
        grey = np.arange(12, dtype=np.uint8).reshape(3, 4)
        Image.fromarray(grey).save(tmp_path / "grey.png")
        np.testing.assert_array_equal(read_image(tmp_path / "grey.png"), grey)
        Image.fromarray(np.dstack([grey] * 4)).save(tmp_path / "clear.png")
        assert read_image(tmp_path / "clear.png").shape == (3, 4, 3)
        Image.fromarray(np.zeros((2, 2), np.uint16)).save(tmp_path / "deep.png")
        refused(tmp_path / "deep.png", "8 bits", read=read_image)
        refused(write("a.png", b"no picture"), "not readable", read=read_image)
        refused(tmp_path / "no.png", "no such file", read=read_image)


class TestRealFiles:
    @pytest.mark.parametrize(
        ("name", "n"),
        [
            ("icp/bun000.ply", 40256),
            ("icp/car_cloud400.csv", 24989),
            ("icp/car_cloud401.csv", 25193),
            ("ransac/capture0001.pcd", 249647),
        ],
    )
    def test_clouds(self, shared_data, name, n):
        p = read_cloud(shared_data / name)
        assert p.shape == (n, 3)
        assert np.isfinite(p).all()

    def test_the_pose_of_the_bunny_brings_the_scans_together(self, shared_data):
        from scipy.spatial import KDTree

        from workbench.geometry.motions import apply

        folder = shared_data / "icp"
        target, source = folder / "bun000.ply", folder / "bun045.ply"
        T_target_source = read_pose(folder / "bun.conf", target, source)
        distances = KDTree(read_cloud(target)).query(apply(T_target_source, read_cloud(source)))[0]
        assert np.mean(distances < 0.001) == pytest.approx(0.91, abs=0.01)

    @pytest.mark.parametrize(
        "name", ["curvature/bunny.off", "shapes/bunny_npm.ply", "shapes/dragon_vrip_res4.ply.gz"]
    )
    def test_meshes_are_read_as_meshes_only(self, shared_data, name):
        p, faces = read_mesh(shared_data / name)
        assert faces.max() == len(p) - 1
        refused(shared_data / name, "mesh")
