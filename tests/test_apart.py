"""A file that somebody made costs a page little: it is read elsewhere, within limits, or refused in
one line.
"""

import contextlib
import gzip
import io
import multiprocessing
import os
import struct
import subprocess
import sys
import time
import zlib
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import psutil
import pytest

from workbench import apart
from workbench.apart import COMMAND, PAGE, allowing, forgotten, handed_to_a_page
from workbench.data.files import read_cloud, read_image, read_mesh, read_voxels
from workbench.data.files.matches import read_matches
from workbench.errors import InputError

QUICK = 6.0
"""Seconds of processor, a reader's start included; how long a person waits:
tests/benchmarks/bench_uploads.py.
"""
MOST_MEMORY = 500 * 10**6


@apart.apart
def stands(path: Path, how: str) -> int:
    """Do what a bad reader may do."""
    if how == "busy":
        while True:
            pass
    if how == "greedy":
        return len(bytearray(10**10))
    if how == "dies":
        os._exit(1)
    if how == "chatty":
        os.write(1, b"out")
        os.write(2, b"err")
    if how == "wrong":
        raise IndexError("list index out of range")
    return os.getpid()


@pytest.fixture
def uploads(tmp_path) -> Iterator[Path]:
    handed_to_a_page(tmp_path)
    yield tmp_path
    forgotten(tmp_path)


@pytest.mark.parametrize(
    ("how", "message"),
    [
        ("busy", "takes too long"),
        ("greedy", "more memory than it may"),
        ("dies", "takes too long, or too much memory"),
        ("wrong", r"not readable \(IndexError\)"),
    ],
)
def test_what_goes_wrong_is_one_line_and_the_next_file_is_read(tmp_path, capfd, how, *, message):
    with allowing(replace(PAGE, seconds=1)), pytest.raises(InputError, match=f"a.xyz: .*{message}"):
        stands(tmp_path / "a.xyz", how)
    assert stands(tmp_path / "a.xyz", "well") != os.getpid()
    assert capfd.readouterr() == ("", "")


def test_what_a_reader_prints_reaches_nobody(tmp_path, capfd):
    assert stands(tmp_path / "a.xyz", "chatty")
    assert capfd.readouterr() == ("", "")


def test_a_copy_of_this_process_has_readers_of_its_own(tmp_path):
    ours = stands(tmp_path / "a", "well")
    with multiprocessing.get_context("fork").Pool(1) as pool:
        assert pool.apply(stands, (tmp_path / "a", "well")) != ours


def test_readers_end_with_whoever_asked(tmp_path):
    code = (
        "import os, sys; from tests.test_apart import stands; print(stands(sys.argv[1], 'well'),"
        " flush=True); {end}"
    )
    for end in ("", "os.kill(os.getpid(), 9)"):
        words = [sys.executable, "-W", "error", "-c", code.format(end=end), str(tmp_path)]
        done = subprocess.run(words, capture_output=True, text=True, cwd=Path(__file__).parents[1])
        assert done.stderr == ""
        until = time.monotonic() + 30
        while psutil.pid_exists(int(done.stdout)) and time.monotonic() < until:
            time.sleep(0.05)
        assert not psutil.pid_exists(int(done.stdout))


def zeros_png(side: int) -> bytes:
    """Return a picture of side x side black pixels, packed to a thousandth."""

    def chunk(kind: bytes, content: bytes) -> bytes:
        return (
            struct.pack(">I", len(content))
            + kind
            + content
            + struct.pack(">I", zlib.crc32(kind + content))
        )

    head = chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 0, 0, 0, 0))
    return (
        b"\x89PNG\r\n\x1a\n"
        + head
        + chunk(b"IDAT", zlib.compress(bytes((side + 1) * side)))
        + chunk(b"IEND", b"")
    )


def packed_rows(row: bytes, times: int) -> bytes:
    out = io.BytesIO()
    with gzip.open(out, "wb", 6) as stream:
        for _ in range(times // 10**6):
            stream.write(row * 10**6)
    return out.getvalue()


def packed_array(size: int) -> bytes:
    out = io.BytesIO()
    np.savez_compressed(out, p=np.zeros((size, 3)))
    return out.getvalue()


def empty_accessors(count: int) -> bytes:
    """Return a gltf scene that names many points and holds none of them."""
    scene = (
        '{"asset":{"version":"2.0"},"accessors":[{"componentType":5126,"count":%d,"type":"VEC3"}],"meshes":[{"primitives"'
        ':[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0}'
    )
    return (scene % count).encode()


LARGE = {
    "rows.xyz.gz": (lambda: packed_rows(b"0 0 0\n", 80_000_000), read_cloud),
    "rows.csv": (lambda: b"0 0 0\n" * (33 * 10**6 // 6), read_cloud),
    "few.xyz": (lambda: (b"1.25 2.5 3.75" + b" " * 987 + b"\n") * 33_000, read_cloud),
    "wide.xyz": (lambda: b"1 " * (33 * 10**6 // 2), read_cloud),
    "rows.txt": (lambda: b"1 2 3 4\n" * (33 * 10**6 // 8), read_matches),
    "rows.obj": (lambda: b"v 0 0 0\n" * (33 * 10**6 // 8), read_cloud),
    "faces.obj": (
        lambda: b"v 0 0 0\nv 1 0 0\nv 0 1 0\n" + b"f 1 2 3\n" * (33 * 10**6 // 8),
        read_mesh,
    ),
    "rows.off": (lambda: b"OFF\n5500000 0 0\n" + b"0 0 0\n" * 5_500_000, read_mesh),
    "rows.ply": (
        lambda: (
            b"ply\nformat ascii 1.0\nelement vertex 5000000\nproperty float x\nproperty float"
            b" y\nproperty float z\nend_header\n" + b"0 0 0\n" * 5_000_000
        ),
        read_cloud,
    ),
    "zeros.npz": (lambda: packed_array(20_000_000), read_cloud),
    "cubes.npz": (lambda: packed_array(20_000_000), read_voxels),
    "black.png": (lambda: zeros_png(7000), read_image),
    "huge.png": (lambda: zeros_png(20_000), read_image),
    "points.gltf": (lambda: empty_accessors(10**9), read_mesh),
}
"""By name a file that a page may be handed, and its reader."""


def spent() -> float:
    """Return seconds of processor of this process and of those that it started, ended or not."""
    times = [child.cpu_times() for child in psutil.Process().children()]
    return sum(os.times()[:4]) + sum(cpu.user + cpu.system for cpu in times)


@pytest.mark.parametrize("name", LARGE)
def test_a_file_that_is_made_to_cost_much_costs_little(uploads, name):
    make, read = LARGE[name]
    (uploads / name).write_bytes(make())
    assert (uploads / name).stat().st_size < 34 * 10**6
    held = psutil.Process().memory_info().rss
    began = spent()
    with contextlib.suppress(InputError):
        read(uploads / name)
    assert spent() - began < QUICK
    assert psutil.Process().memory_info().rss - held < MOST_MEMORY / 2
    children = [child.memory_info().rss for child in psutil.Process().children()]
    assert max(children, default=0) < MOST_MEMORY


def test_a_command_may_read_more_than_a_page(uploads):
    path = uploads / "many.xyz"
    path.write_bytes(b"1 2 3\n" * (PAGE.points + 1))
    with pytest.raises(
        InputError, match=r"at most 500,000 are read on a page; more is read where `workbench show`"
    ):
        read_cloud(path)
    forgotten(uploads)
    assert len(read_cloud(path)) == PAGE.points + 1
    assert COMMAND.points > PAGE.points
