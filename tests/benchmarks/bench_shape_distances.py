"""Chamfer, earth mover's and Sinkhorn beside what is installed of small_gicp, pykdtree, open3d, POT
and scipy.

Run `python -m tests.benchmarks.bench_shape_distances [--large] [--only emd]`. A ratio below 1 means
ours is faster; the floor of Chamfer are scipy's trees and searches alone, that of Sinkhorn is the
ratio to the best peer that a prototype reached. Chamfer and
Sinkhorn: the least wall time of a few runs, and processor time over all threads, from which the
ratio is made, since it bears other work on the machine better. Run with OPENBLAS_NUM_THREADS=1 on a
busy machine: matrix products that wait for a second core count the waiting.

Earth mover's, the function that the lesson runs, at the lesson's largest size and beyond: a table
of sizes x clouds. All take turns on the same fresh clouds, each ratio is ours over the faster of
the others on the same clouds, by wall time and by the processor time of the busiest thread, and the
table shows medians over the seeds. Values must agree to 1e-9.
"""

import argparse
import functools
import importlib
import threading
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import scipy

from workbench.algorithms.transport import earth_movers
from workbench.algorithms.transport import exact as transport
from workbench.algorithms.transport.sinkhorn import sinkhorn
from workbench.geometry.points.shape_distances import chamfer

Task = Callable[[], float]


def peer(name: str):
    """Return an installed module or None."""
    try:
        return importlib.import_module(name)
    except ImportError:
        return None


def clouds(kind: str, n: int, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    p_a, p_b = rng.normal(size=(2, n, 3))
    if kind == "sphere":
        return (
            p / np.linalg.norm(p, axis=1, keepdims=True) * s for p, s in ((p_a, 1.0), (p_b, 1.2))
        )  # type: ignore
    if kind == "blob":
        return 0.1 * p_a + 1, rng.uniform(-1, 1, (n, 3))
    return p_a, p_b + 0.3


def chamfer_peers(p_a: np.ndarray, p_b: np.ndarray) -> dict[str, Task]:
    peers: dict[str, Task] = {}
    gicp, pykdtree, o3d = peer("small_gicp"), peer("pykdtree.kdtree"), peer("open3d")

    def squares(*distances) -> float:
        return sum(float(np.mean(np.asarray(d) ** 2)) for d in distances)

    if gicp:

        def small_gicp() -> float:
            trees = [gicp.KdTree(p, num_threads=2) for p in (p_a, p_b)]
            near = [
                t.batch_nearest_neighbor_search(p, num_threads=2)[1]
                for t, p in zip(trees, (p_b, p_a), strict=True)
            ]
            return float(np.mean(near[0]) + np.mean(near[1]))

        peers["small_gicp"] = small_gicp
    if pykdtree:
        peers["pykdtree"] = lambda: squares(
            pykdtree.KDTree(p_b).query(p_a)[0], pykdtree.KDTree(p_a).query(p_b)[0]
        )
    if o3d:

        def open3d() -> float:
            a, b = (o3d.geometry.PointCloud(o3d.utility.Vector3dVector(p)) for p in (p_a, p_b))
            return squares(a.compute_point_cloud_distance(b), b.compute_point_cloud_distance(a))

        peers["open3d"] = open3d
    peers["scipy KDTree"] = lambda: squares(
        scipy.spatial.KDTree(p_b).query(p_a)[0], scipy.spatial.KDTree(p_a).query(p_b)[0]
    )
    return peers


def emd_tasks(p_a: np.ndarray, p_b: np.ndarray) -> dict[str, Task]:
    ot = peer("ot")

    def assignment() -> float:
        D = scipy.spatial.distance.cdist(p_a, p_b)
        return float(D[scipy.optimize.linear_sum_assignment(D)].mean())

    def ours() -> float:
        transport._matched.cache_clear()  # the same clouds are measured several times
        return earth_movers(p_a, p_b)

    tasks: dict[str, Task] = {"ours": ours, "scipy": assignment}
    if ot:
        w = np.full(len(p_a), 1 / len(p_a))
        tasks["POT"] = lambda: float(
            ot.emd2(w, w, ot.dist(p_a, p_b, "euclidean"), numItermax=10**7)
        )
    return tasks


def compare_emd(sizes: Sequence[int], seeds: int = 5) -> None:
    """Print the table of earth mover's."""
    print(
        "EMD exact, medians: ours, scipy, POT in ms, then ours over the faster of the others on the"
        " same clouds"
    )
    print(
        f"{'points':>7s} {'clouds':7s} {'wall':>24s} {'busiest thread':>24s}   ratio: wall  thread"
    )
    for n in sizes:
        for kind in ("gauss", "sphere", "blob"):
            times = []
            for seed in range(seeds):
                tasks = emd_tasks(*clouds(kind, n, np.random.default_rng([seed, n])))
                runs = {name: timed(task) for name, task in tasks.items()}
                values = np.array([value for *_, value in runs.values()])
                assert np.ptp(values) <= 1e-9 * values[0], (
                    f"{kind}, {n} points, seed {seed}: {values}"
                )
                times.append([run[:2] for run in runs.values()])
            each = np.array(times)  # seeds x (ours, others) x (wall, thread)
            wall, thread = np.median(each, axis=0).T
            ratio = np.median(each[:, 0] / each[:, 1:].min(axis=1), axis=0)
            columns = "  ".join("".join(f"{ms:8.1f}" for ms in row) for row in (wall, thread))
            print(f"{n:7,d} {kind:7s} {columns}   {ratio[0]:10.2f} {ratio[1]:7.2f}", flush=True)


def timed(task: Task) -> tuple[float, float, float]:
    """Return the wall time of one run and the processor time of its busiest thread in ms, and the
    value.
    """
    wall = time.perf_counter()
    threads = thread_times()
    value = task()
    after = thread_times()
    busiest = max(ns - threads.get(thread, 0) for thread, ns in after.items())
    return 1e3 * (time.perf_counter() - wall), 1e-6 * busiest, value


def thread_times() -> dict[str, int]:
    """Return the processor time of each thread of this process in ns (of the others on Linux
    only).
    """
    others = Path("/proc/self/task").glob("*/schedstat")
    times = {schedstat.parent.name: int(schedstat.read_text().split()[0]) for schedstat in others}
    return times | {str(threading.get_native_id()): time.thread_time_ns()}


def sinkhorn_peers(cost: np.ndarray, regularisation: float) -> dict[str, Task]:
    ot = peer("ot")
    if not ot:
        return {}
    w = np.full(len(cost), 1 / len(cost))

    def pot() -> float:  # stops at a 2-norm, ours at a sum: the same plan to 1e-8
        return float(ot.sinkhorn2(w, w, cost, regularisation, numItermax=10_000, stopThr=1e-9))

    return {"POT sinkhorn": pot}


def least_times(task: Task, repeats: int) -> tuple[float, float, float]:
    """Return the least wall and processor times of a few runs in ms, and the value."""
    walls = []
    cpus = []
    value = float("nan")
    for _ in range(repeats):
        wall, cpu = time.perf_counter(), time.process_time()
        value = task()
        walls.append(1e3 * (time.perf_counter() - wall))
        cpus.append(1e3 * (time.process_time() - cpu))
    return min(walls), min(cpus), value


def compare(
    name: str, ours: Task, peers: dict[str, Task], *, floor: str | Task, repeats: int = 3
) -> None:
    """Print one block: ours, each peer, and the ratios; a floor that is a task is measured too."""
    wall, own, value = least_times(ours, repeats)
    print(f"{name:34s} {'ours':17s} wall {wall:8.1f} cpu {own:8.1f} ms   value {value:.9f}")
    quickest = np.inf
    for peer_name, task in peers.items():
        wall, theirs, its = least_times(task, repeats)
        quickest = min(quickest, theirs)
        off = "" if abs(its - value) <= 1e-6 * abs(value) else f"   VALUE OFF BY {its - value:+.2e}"
        print(
            f"{'':34s} {peer_name:17s} wall {wall:8.1f} cpu {theirs:8.1f} ms   ratio"
            f" {own / theirs:.2f}{off}",
            flush=True,
        )
    if callable(floor):
        _, bare, _ = least_times(floor, repeats)
        floor = f"{bare / quickest:.2f}: scipy's two trees and both searches alone"
    print(f"{'':34s} floor {floor}")


def bare_searches(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Build both trees as ours are, and search each cloud's nearest points in the order of its
    tree.
    """
    trees = [
        scipy.spatial.KDTree(p, leafsize=32, balanced_tree=False, compact_nodes=False)
        for p in (p_a, p_b)
    ]
    for p, own, other in zip((p_a, p_b), trees, trees[::-1], strict=True):
        other.query(p[own.indices], workers=-1)
    return float("nan")


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--large", action="store_true", help="5000 points as well; minutes")
    parser.add_argument("--only", choices=("emd",), help="earth mover's alone")
    asked = parser.parse_args()
    large = asked.large
    rng = np.random.default_rng(11)
    compare_emd((200, 500, 1000, 2000, 5000) if large else (200, 500, 1000, 2000))
    if asked.only:
        return
    for n in (10_000, 100_000):
        for kind in ("gauss", "sphere"):
            p_a, p_b = clouds(kind, n, rng)
            compare(
                f"Chamfer, {n:,} points, {kind}",
                lambda a=p_a, b=p_b: chamfer(a, b),
                chamfer_peers(p_a, p_b),
                floor=functools.partial(bare_searches, p_a, p_b),
            )
    for n in (1000, 5000) if large else (1000, 2000):
        cost = scipy.spatial.distance.cdist(*clouds("sphere", n, rng))
        regularisation = 0.05 * float(np.median(cost))
        compare(
            f"Sinkhorn, {n:,} points, sphere",
            lambda c=cost, r=regularisation: sinkhorn(c, r, tolerance=1e-8).cost(c),
            sinkhorn_peers(cost, regularisation),
            floor="0.65",
            repeats=2,
        )


if __name__ == "__main__":
    main()
