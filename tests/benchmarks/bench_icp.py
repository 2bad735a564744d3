"""Compares alignment, normals and ICP with open3d, small_gicp, scipy and trimesh, where they are
installed.

    python -m tests.benchmarks.bench_icp

Times are the best of a few runs, ours and the peer's in turn, so that a ratio is of one run on one
machine.
"""

import importlib
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import scipy

from workbench.algorithms.registration.icp import Gate, icp, matcher
from workbench.data.shapes.clouds import pair
from workbench.geometry.motions import exp_so3, motion, rotation_angle
from workbench.geometry.motions.alignment import align_rigid, point_to_plane_step
from workbench.geometry.points.nearest import tree_for_many
from workbench.geometry.points.normals import point_normals

Register = Callable[..., np.ndarray]
"""register(gate, T_target_source, stop below, most=iterations) -> T_target_source"""

FIRST, SECOND = 0.2, 0.02  # gates of the libraries, metres: first coarse, then tight
ITERATIONS = 10


def optional(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError:
        return None


open3d, small_gicp, trimesh = optional("open3d"), optional("small_gicp"), optional("trimesh")


def best(*tasks: Callable[[], Any] | None, repeat: int = 5) -> list[float]:
    """Return the shortest time of each task in milliseconds, the tasks taking turns; NaN for one
    that is not there.
    """
    times = np.full((repeat, len(tasks)), np.nan)
    for row in times:
        for i, task in enumerate(tasks):
            if task is not None:
                start = time.perf_counter()
                task()
                row[i] = 1e3 * (time.perf_counter() - start)
    return [float(column.min()) for column in times.T]


def line(task: str, ours: float, peers: dict[str, float], *, floor: str = "") -> None:
    times = {name: t for name, t in peers.items() if np.isfinite(t)}
    peer = min(times, key=lambda name: times[name]) if times else ""
    others = ", ".join(f"{name} {t:.1f}" for name, t in times.items()) or "none installed"
    ratio = f"{ours / times[peer]:.2f}" if times else "-"
    print(f"{task:<44} {ours:8.1f}   {others:<44} {ratio:>6}   {floor}")


def scans(n: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    T = motion(exp_so3(np.radians([3.0, -4.0, 10.0])), np.array([0.03, -0.02, 0.01]))
    made = pair("rabbit", n, T, rng=np.random.default_rng(1), overlap=0.8)
    return made.p_target, made.p_source, T


def degrees_off(T: np.ndarray, T_true: np.ndarray) -> float:
    return float(np.degrees(rotation_angle(T[:3, :3] @ T_true[:3, :3].T)))


def bench_alignment() -> None:
    rng = np.random.default_rng(0)
    p = rng.standard_normal((100_000, 3))
    q = p @ exp_so3(np.array([0.1, 0.2, 0.3])).T + [1.0, 2.0, 3.0]
    weights = None

    def with_scipy() -> None:
        scipy.spatial.transform.Rotation.align_vectors(
            q - q.mean(0), p - p.mean(0), weights=weights
        )

    estimate = None
    if open3d is not None:
        pairs = open3d.utility.Vector2iVector(
            np.repeat(np.arange(len(p), dtype=np.int32)[:, None], 2, axis=1)
        )
        clouds = [open3d.geometry.PointCloud(open3d.utility.Vector3dVector(x)) for x in (p, q)]
        method = open3d.pipelines.registration.TransformationEstimationPointToPoint()
        estimate = lambda: method.compute_transformation(*clouds, pairs)  # noqa: E731
    by_trimesh = trimesh and (
        lambda: trimesh.registration.procrustes(p, q, reflection=False, scale=False)
    )
    ours, *peers = best(lambda: align_rigid(q, p), estimate, with_scipy, by_trimesh)
    line(
        "align_rigid, 100,000 pairs",
        ours,
        dict(zip(("open3d", "scipy", "trimesh"), peers, strict=True)),
        floor="3.1, ratio 0.45",
    )


def bench_normals() -> None:
    p, _, _ = scans(100_000)
    by_open3d = by_gicp = None
    if open3d is not None:
        cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(p))
        by_open3d = lambda: cloud.estimate_normals(open3d.geometry.KDTreeSearchParamKNN(16))  # noqa: E731
    if small_gicp is not None:
        points = small_gicp.PointCloud(p)
        by_gicp = lambda: small_gicp.estimate_normals(points, num_neighbors=16, num_threads=2)  # noqa: E731

    def search() -> None:
        tree = tree_for_many(p)
        tree.query(p[tree.indices], k=16, workers=-1)

    ours, bare, *peers = best(
        lambda: point_normals(p),
        search,
        by_open3d,
        by_gicp,
        repeat=3,
    )
    line(
        "normals, 100,000 points, k = 16",
        ours,
        dict(zip(("open3d", "small_gicp"), peers, strict=True)),
        floor=floor_of(bare, peers),
    )
    print("    floor: scipy's tree and search of the 16 nearest alone, beside peers' whole")


def bench_icp(n: int, floor_whole: str) -> None:
    p_target, p_source, T_true = scans(n)
    n_target = point_normals(p_target)

    def fixed_iterations() -> None:
        for _ in icp(
            p_target,
            p_source,
            n_target=n_target,
            gate=Gate(FIRST),
            max_iterations=ITERATIONS,
            tolerance=1e-300,
        ):
            pass

    def whole() -> np.ndarray:
        *_, end = icp(p_target, p_source, n_target=n_target, gate=Gate(medians=3.0), tolerance=1e-6)
        return end.T_target_source

    o3_icp = open3d and with_open3d(p_target, p_source, n_target)
    gicp = small_gicp and with_small_gicp(p_target, p_source)
    start = np.eye(4)
    o3_fixed = o3_icp and (lambda: o3_icp(FIRST, start, 0.0, most=ITERATIONS))
    gicp_fixed = gicp and (lambda: gicp(FIRST, start, 0.0, most=ITERATIONS))
    o3_whole = o3_icp and (lambda: through_both_gates(o3_icp, start, 1e-6))
    gicp_whole = gicp and (lambda: through_both_gates(gicp, start, 1e-5))

    names = ("open3d", "small_gicp")
    ours, *peers = (t / ITERATIONS for t in best(fixed_iterations, o3_fixed, gicp_fixed, repeat=3))
    line(f"point-to-plane, an iteration, {n:,}", ours, dict(zip(names, peers, strict=True)))
    ours, *peers = best(whole, o3_whole, gicp_whole, repeat=3)
    line(
        f"point-to-plane, to its stop, {n:,}",
        ours,
        dict(zip(names, peers, strict=True)),
        floor=floor_whole,
    )
    errors = {"ours, d < 3 medians": whole(), "start": start}
    if o3_icp and o3_whole:
        errors |= {
            "open3d, one gate": o3_icp(FIRST, start, 1e-6, most=50),
            "open3d, two gates": o3_whole(),
        }
    if gicp_whole:
        errors |= {"small_gicp, two gates": gicp_whole()}
    print(
        "    final error, degrees: "
        + ", ".join(f"{k} {degrees_off(T, T_true):.4f}" for k, T in errors.items())
    )


def floor_of(bare: float, peers: list[float]) -> str:
    """Return what ratio to the best peer the bare calls reach; nothing where no peer is there."""
    times = [t for t in peers if np.isfinite(t)]
    return f"{bare / min(times):.2f}" if times else ""


def with_open3d(p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray) -> Register:
    """Return open3d's point-to-plane ICP on these clouds; its tree is built in every call, there is
    no way around it.
    """
    registration = open3d.pipelines.registration
    source, target = (
        open3d.geometry.PointCloud(open3d.utility.Vector3dVector(p)) for p in (p_source, p_target)
    )
    target.normals = open3d.utility.Vector3dVector(n_target)
    plane = registration.TransformationEstimationPointToPlane()

    def register(gate: float, T_target_source: np.ndarray, stop: float, *, most: int) -> np.ndarray:
        criteria = registration.ICPConvergenceCriteria(stop, stop, most)
        return registration.registration_icp(
            source, target, gate, T_target_source, plane, criteria
        ).transformation

    return register


def with_small_gicp(p_target: np.ndarray, p_source: np.ndarray) -> Register:
    """Return small_gicp's point-to-plane ICP on these clouds, tree and normals made beforehand."""
    clouds = [small_gicp.PointCloud(p) for p in (p_target, p_source)]
    for cloud in clouds:
        small_gicp.estimate_normals_covariances(cloud, num_neighbors=16)
    tree = small_gicp.KdTree(clouds[0], num_threads=2)

    def register(gate: float, T_target_source: np.ndarray, stop: float, *, most: int) -> np.ndarray:
        result = small_gicp.align(
            *clouds,
            tree,
            T_target_source,
            registration_type="PLANE_ICP",
            max_correspondence_distance=gate,
            num_threads=2,
            max_iterations=most,
            rotation_epsilon=stop,
            translation_epsilon=stop,
        )
        return result.T_target_source

    return register


def through_both_gates(register: Register, start: np.ndarray, coarse: float) -> np.ndarray:
    """Return where a library ends that is begun with a wide gate, and goes on with a tight one."""
    return register(SECOND, register(FIRST, start, coarse, most=50), 1e-6, most=50)


def profile(n: int) -> None:
    """Print where an iteration's processor time goes (all threads), in the quickest of a few
    runs.
    """
    p_target, p_source, _ = scans(n)
    n_target = point_normals(p_target)
    runs = [profiled_run(p_target, p_source, n_target) for _ in range(8)]
    total, query, step, iterations = min(runs)
    trees = best(lambda: matcher(p_target, p_source))[0]
    print(
        f"an iteration at {n:,} points, 80 % overlap: {total / iterations:.1f} ms of processor"
        " time ="
    )
    for name, spent in (
        ("nearest-neighbour query", query),
        ("linear step", step),
        ("all else", total - query - step),
    ):
        print(f"    {name:<26} {spent / iterations:6.1f} ms  {100 * spent / total:3.0f} %")
    print(f"    once per run, both trees   {trees:6.1f} ms\n")


def profiled_run(
    p_target: np.ndarray, p_source: np.ndarray, n_target: np.ndarray
) -> tuple[float, float, float, int]:
    """Return milliseconds of processor time in all, in the query and in the linear step, and the
    number of iterations.
    """
    spent = {"match": 0.0, "step": 0.0}

    def timed(name: str, function: Callable) -> Callable:
        def call(*args: Any) -> Any:
            start = time.process_time()
            result = function(*args)
            spent[name] += 1e3 * (time.process_time() - start)
            return result

        return call

    match = timed("match", matcher(p_target, p_source))
    iterations = 0
    start = time.process_time()
    for state in icp(
        p_target,
        p_source,
        n_target=n_target,
        gate=Gate(medians=3.0),
        max_iterations=8,
        match=match,
        step=timed("step", point_to_plane_step),
    ):
        iterations = state.iteration
    return 1e3 * (time.process_time() - start), spent["match"], spent["step"], iterations


def main() -> None:
    profile(20_000)
    print(f"{'task (ms)':<44} {'ours':>8}   {'peers':<44} {'ratio':>6}   floor")
    bench_alignment()
    bench_normals()
    bench_icp(20_000, "148-164, ratio 1.1-1.2, 0.012 degrees")
    bench_icp(100_000, "1587-1770, ratio 1.3-1.5, 0.0034 degrees")


if __name__ == "__main__":
    main()
