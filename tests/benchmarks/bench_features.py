"""Features: descriptors, keypoints, corners and registration from any start, beside Open3D and
OpenCV where installed.

    python -m tests.benchmarks.bench_features

The least CPU time of some rounds, taking turns, one thread each. FPFH takes all neighbours within
the radius on both sides: Open3D's usual limit of 100 is quicker for it, and gives other
descriptors; shown too. Its ISS is another detector (it takes the spread about the neighbours'
mean). The bunny scans are used where ../shared/data is beside the
project.
"""

# ruff: noqa: E402

import argparse
import functools
import os
import tempfile

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import scipy

from lessons.features.lesson import run
from lessons.features.state import Params, Scanned
from lessons.features.turned_pictures import motorcycle_levels
from tests.benchmarks.bench_icp import line, optional
from workbench.data.files import read_cloud, read_pose
from workbench.data.shapes.rabbit import rabbit
from workbench.data.thinning import voxel_means
from workbench.geometry.features.fpfh import fpfh
from workbench.geometry.features.keypoints import DERIVE, GATHER, harris_response, iss_keypoints
from workbench.geometry.features.matching import mutual_matches
from workbench.geometry.motions import apply, exp_so3, inverse, motion
from workbench.geometry.points.normals import point_normals

SCANS = Path(__file__).resolve().parents[3] / "shared" / "data" / "icp"
RADIUS = 0.15
STARTS = 20
open3d, cv2 = optional("open3d"), optional("cv2")


def main() -> None:
    """Print one line per task, then what registration from any start comes to."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=5)
    rounds = parser.parse_args().rounds
    print(f"{'task (ms)':<44} {'ours':>8}   {'peers':<44} {'ratio':>6}   floor")
    clouds = [
        (f"rabbit, {n:,} points", rabbit(n, np.random.default_rng(0)), RADIUS) for n in (2000, 3000)
    ]
    if SCANS.exists():
        bunny = voxel_means(read_cloud(SCANS / "bun000.ply"), 0.005)
        clouds.append((f"bunny, {len(bunny):,} points", bunny, 0.025))
    for name, p, radius in clouds:
        described(name, rounds, p, radius=radius)
    p = clouds[-1][1]
    keypoints(rounds, p, clouds[-1][2])
    features = fpfh(p, point_normals(p), clouds[-1][2])
    compared(
        "mutual matches of these with themselves",
        rounds,
        lambda: mutual_matches(features, features[::-1], 0.9),
        peers={},
    )
    left, _, _ = motorcycle_levels()
    compared(
        f"corner response, {left.shape[1]} x {left.shape[0]} pixels",
        rounds,
        lambda: harris_response(left),
        peers={"cv2": lambda: cv2.cornerHarris(left.astype(np.float32), 3, 3, 0.04)} if cv2 else {},
        bare=functools.partial(bare_filters, left),
    )
    print(
        "    floor: scipy's four Gaussians and two Sobel filters alone, of double precision;"
        " OpenCV's is single and has boxes for Gaussians"
    )
    if SCANS.exists():
        from_any_start()
    else:
        print("../shared/data is not beside the project: no registration of the bunny scans")
    for name, module in (("open3d", open3d), ("cv2", cv2)):
        if not module:
            print(f"{name} is not installed: left out")


def bare_filters(image: np.ndarray) -> None:
    """Filter a picture as often as a corner response has to: before its gradient, for it, and its
    three products.
    """
    filtered = scipy.ndimage.gaussian_filter(image, DERIVE)
    for axis in range(2):
        scipy.ndimage.sobel(image, axis)
    for _ in range(3):
        scipy.ndimage.gaussian_filter(image, GATHER, output=filtered)


def described(name: str, rounds: int, p: np.ndarray, *, radius: float) -> None:
    """Compare descriptors, and say how near they are."""
    n = point_normals(p)
    peers = {}
    if open3d:
        cloud = cloud_of(p, n)
        search = open3d.geometry

        def theirs(how: Any) -> np.ndarray:
            return np.asarray(open3d.pipelines.registration.compute_fpfh_feature(cloud, how).data).T

        ways = {
            "open3d": search.KDTreeSearchParamRadius(radius),
            "open3d, 100 at most": search.KDTreeSearchParamHybrid(radius, 100),
        }
        peers = {label: lambda how=how: theirs(how) for label, how in ways.items()}
    compared(f"FPFH, {name}", rounds, lambda: fpfh(p, n, radius), peers=peers)
    for label, way in peers.items():
        r = np.corrcoef(fpfh(p, n, radius).ravel(), way().ravel())[0, 1]
        print(f"    correlation with {label}: {r:.4f}")


def keypoints(rounds: int, p: np.ndarray, radius: float) -> None:
    """Compare keypoints."""
    peers = {}
    if open3d:
        cloud = cloud_of(p)
        peers["open3d"] = lambda: open3d.geometry.keypoint.compute_iss_keypoints(
            cloud,
            salient_radius=radius,
            non_max_radius=radius / 2,
            gamma_21=0.975,
            gamma_32=0.975,
            min_neighbors=5,
        )
    compared(
        "ISS keypoints of the last",
        rounds,
        lambda: iss_keypoints(p, radius, radius / 2),
        peers=peers,
    )


def from_any_start() -> None:
    """Register the bunny scans from turned and moved starts, as the lesson does own scans."""
    p = read_cloud(SCANS / "bun045.ply")
    files = (SCANS / "bun000.ply", SCANS / "bun045.ply")
    T_truth = read_pose(SCANS / "bun.conf", *files)
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        source, truth = Path(folder) / "source.npz", Path(folder) / "truth.txt"
        for seed in range(STARTS):
            rng = np.random.default_rng(100 + seed)
            T = motion(exp_so3(2 * rng.normal(size=3)), 0.1 * rng.normal(size=3))
            np.savez(source, p=apply(T, p))
            np.savetxt(truth, T_truth @ inverse(T))
            began = time.process_time()
            *_, last = run(Params(target=files[0], source=source, truth=truth, up="y", seed=seed))
            took = time.process_time() - began
            assert isinstance(last.now, Scanned)
            before = (
                np.nan
                if last.now.T_before is None
                else last.now.scans.error(last.now.T_before).rotation
            )
            rows.append((before, last.now.error.rotation, took))
    before, after, took = np.array(rows).T
    print(
        f"\nbunny scans from {STARTS} random starts, every step of the lesson, files read:"
        f" {np.median(took):.2f} s each"
    )
    print(
        f"    before ICP within 0.5 degrees: {np.sum(before < 0.5)}, at most"
        f" {np.nanmax(before):.3f}"
    )
    print(
        f"    after ICP within 0.1 degrees: {np.sum(after < 0.1)}, at most {np.nanmax(after):.3f}"
    )


def cloud_of(p: np.ndarray, n: np.ndarray | None = None) -> Any:
    """Return a cloud of Open3D's."""
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(p))
    if n is not None:
        cloud.normals = open3d.utility.Vector3dVector(n)
    return cloud


def compared(
    task: str,
    rounds: int,
    ours: Callable[[], Any],
    *,
    peers: dict[str, Callable[[], Any]],
    bare: Callable[[], Any] | None = None,
) -> None:
    """Print the least CPU times, taking turns, milliseconds; the floor is what `bare` takes."""
    ways = {"": ours} | peers | ({"bare": bare} if bare else {})
    least = dict.fromkeys(ways, np.inf)
    for _ in range(rounds):
        for name, way in ways.items():
            began = time.process_time()
            way()
            least[name] = min(least[name], 1000 * (time.process_time() - began))
    mine = least.pop("")
    floor = least.pop("bare", np.nan) / min(least.values(), default=np.nan)
    line(task, mine, least, floor=f"{floor:.2f}" if np.isfinite(floor) else "")


if __name__ == "__main__":
    main()
