"""What honest functions use of Python, numpy and scipy. This file is handed in as it stands: `work`
does one of them.

scipy is imported where it is used: loading a file is to take less than its limit on a busy machine.
"""

import asyncio  # noqa: F401  (it loads; its loops need sockets)
import contextlib
import ctypes
import datetime
import inspect
import json
import mmap
import multiprocessing  # noqa: F401  (it loads; it starts nothing)
import os
import pathlib
import platform
import queue
import random
import resource
import secrets
import shutil
import signal
import sqlite3
import subprocess  # noqa: F401  (it loads; it starts nothing)
import sys
import tempfile
import threading
import time
import uuid
from concurrent.futures import ThreadPoolExecutor

import numpy as np


def linear_algebra():
    from scipy import linalg

    A = np.random.default_rng(0).normal(size=(300, 300))
    np.linalg.svd(A)
    np.linalg.eigh(A + A.T)
    np.linalg.lstsq(A, A[0], rcond=None)
    linalg.expm(A[:50, :50])
    linalg.schur(A[:50, :50])
    np.testing.assert_allclose(A @ np.linalg.solve(A, A[0]), A[0], atol=1e-6)


def large_arrays():
    from scipy import fft, ndimage

    assert np.ones((3000, 3000)).sum() == 9e6
    assert np.sort(np.arange(10**6)[::-1])[0] == 0
    assert fft.fft2(np.ones((300, 300)), workers=2)[0, 0] == 9e4
    ndimage.gaussian_filter(np.ones((300, 300)), 2)


def sparse_matrices():
    from scipy import sparse
    from scipy.sparse import csgraph
    from scipy.sparse import linalg as sparse_linalg

    S = sparse.random(400, 400, 0.01, random_state=1) + 10 * sparse.eye(400)
    sparse_linalg.eigsh(S @ S.T, k=3)
    csgraph.dijkstra(S.tocsr(), indices=[0])
    solved = np.asarray(sparse_linalg.spsolve(S.tocsc(), np.ones(400)))
    np.testing.assert_allclose(S.toarray() @ solved, np.ones(400))


def trees_and_hulls():
    from scipy import spatial

    p = np.random.default_rng(0).normal(size=(2000, 3))
    tree = spatial.cKDTree(p)
    assert np.sum(tree.query(p, workers=3)[0]) == 0
    assert np.sum(tree.query(p, workers=-1)[0]) == 0
    spatial.Delaunay(p[:99])
    spatial.ConvexHull(p)
    spatial.transform.Rotation.random(3, random_state=0)


def minimising():
    from scipy import integrate, interpolate, optimize, stats

    for method in ("Nelder-Mead", "L-BFGS-B", "SLSQP", "trust-constr"):
        optimize.minimize(lambda x: (x**2).sum(), np.ones(3), method=method)
    optimize.linear_sum_assignment(np.eye(9))
    optimize.linprog([1, 1], A_ub=[[-1, -1]], b_ub=[-1])
    np.testing.assert_allclose(
        optimize.least_squares(lambda x: x - 1, np.zeros(3), loss="huber").x, 1.0
    )
    integrate.quad(np.sin, 0, 1)
    interpolate.CubicSpline(range(9), range(9))
    stats.norm.fit(np.arange(9.0))


def threads():
    event = threading.Event()
    threading.Timer(0.01, event.set).start()
    assert event.wait(5)
    with contextlib.suppress(queue.Empty):
        queue.Queue().get(timeout=0.01)
    with ThreadPoolExecutor(4) as pool:
        assert len(list(pool.map(np.linalg.svd, [np.eye(200)] * 9))) == 9


def clocks_and_chance():
    time.sleep(0.01)
    time.process_time()
    time.thread_time()
    datetime.datetime.now().astimezone()
    random.seed()
    np.random.default_rng()
    uuid.uuid4()
    secrets.token_hex()


def a_time_limit_of_its_own():
    def late(*_):
        raise TimeoutError

    signal.signal(signal.SIGALRM, late)
    signal.setitimer(signal.ITIMER_REAL, 0.05)
    try:
        time.sleep(5)
    except TimeoutError:
        return
    raise AssertionError


def reading_files():
    assert os.listdir(os.path.dirname(json.__file__))
    assert not pathlib.Path("none").exists()
    assert inspect.getsource(json)
    assert sys.stdin.read() == ""
    for device, count in (("null", 0), ("zero", 4), ("urandom", 4), ("random", 4)):
        with open(f"/dev/{device}", "rb", buffering=0) as file:
            assert len(file.read(4)) == count


def asking_about_itself():
    assert os.cpu_count()
    assert not sys.stdin.isatty()
    assert not sys.stdout.isatty()
    os.getcwd()
    os.times()
    platform.platform()
    resource.getrusage(resource.RUSAGE_SELF)
    resource.getrlimit(resource.RLIMIT_AS)


def functions_for_c():
    assert ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_int)(lambda n: n + 1)(1) == 2
    mmap.mmap(-1, 4096).close()
    assert sqlite3.connect(":memory:").execute("select 1").fetchone() == (1,)


def files_of_its_own():
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "a.npy")
        np.save(name, np.eye(9))
        np.savetxt(f"{name}.txt", np.eye(9))
        np.memmap(name, mode="r+").flush()
        shutil.copyfile(name, f"{name}2")
        os.rename(f"{name}2", f"{name}3")
        os.mkdir(f"{name}d")
        shutil.rmtree(f"{name}d")
        with tempfile.TemporaryFile() as file:
            file.write(b"x")
            file.truncate(0)
        assert np.array_equal(np.loadtxt(f"{name}.txt"), np.load(f"{name}3", mmap_mode="r"))


WORK = (
    linear_algebra,
    large_arrays,
    sparse_matrices,
    trees_and_hulls,
    minimising,
    threads,
    clocks_and_chance,
    a_time_limit_of_its_own,
    reading_files,
    asking_about_itself,
    functions_for_c,
)
NAMES = tuple(function.__name__ for function in WORK)


def work(name: str) -> str:
    """Do the work of that name, and say that it is done."""
    globals()[name]()
    return "done"
