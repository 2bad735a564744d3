"""Projecting, undistorting and drawing, against OpenCV where it is installed.

Run: python -m tests.benchmarks.bench_cameras. Figures are CPU milliseconds of this process, the
median of five runs; OpenCV is held to one thread so that both count alike.
"""

import importlib
import statistics
import time
from collections.abc import Callable

import numpy as np

from workbench.data.views.street import street
from workbench.geometry.cameras import intrinsics, look_at, normalize, project
from workbench.geometry.cameras.distortion import NONE, Distortion
from workbench.geometry.cameras.raster import Item, MeshItem, SegmentItem, render
from workbench.geometry.motions import exp_so3, motion

N = 1_000_000
LENS = Distortion(-0.26637, -0.038589, 0.0017832, -0.00028122, 0.23839)
K = intrinsics(535.9, 342.3, 235.6)
# over the best peer: what a prototype in numpy and scipy reached
FLOORS = {"project": 0.15, "undistort": 0.39}


def milliseconds(task: Callable[[], object], repeats: int = 5) -> float:
    """Return the median CPU time of a task."""
    task()
    times = []
    for _ in range(repeats):
        start = time.process_time()
        task()
        times.append(time.process_time() - start)
    return 1000 * statistics.median(times)


def main() -> None:
    """Print one row per task: ours, OpenCV, the ratio, its floor, and by how much the two
    differ.
    """
    rng = np.random.default_rng(0)
    w = np.array([0.1, -0.2, 0.05])
    T_camera_world = motion(exp_so3(w), np.array([0.1, -0.2, 6.0]))
    p_world = rng.uniform(-2, 2, (N, 3))
    uv = project(p_world, T_camera_world, K, LENS)
    ours = {
        "project": milliseconds(lambda: project(p_world, T_camera_world, K, LENS)),
        "undistort": milliseconds(lambda: normalize(uv, K, LENS)),
    }
    print(
        f"{'task (1M points, 5 coefficients)':36}{'ours ms':>9}{'cv2 ms':>9}{'ratio':>7}{'floor':>7}{'differ by':>12}"  # noqa: E501
    )
    theirs, gaps = peers(p_world, w, T_camera_world[:3, 3], uv=uv)
    for task, floor in FLOORS.items():
        if task in theirs:
            ratio = (
                f"{theirs[task]:9.1f}{ours[task] / theirs[task]:7.3f}{floor:7.2f}{gaps[task]:12.1e}"
            )
        else:
            ratio = f"{'-':>9}{'-':>7}{floor:7.2f}{'-':>12}"
        print(f"{task:36}{ours[task]:9.1f}{ratio}")

    scene = street()
    items: list[Item] = [
        MeshItem(solid.p_world, solid.faces, solid.colors) for solid in scene.solids.values()
    ]
    items.append(SegmentItem(scene.edges, np.zeros((len(scene.edges), 3), np.uint8)))
    eye = look_at(np.array([0.5, -3.0, 1.7]), np.array([0.3, 8.0, 1.0]))
    K_small = intrinsics(260.0, 159.5, 119.5)
    faces = sum(len(solid.faces) for solid in scene.solids.values())
    for name, lens in (("no lens", NONE), ("barrel", Distortion(-0.3, 0.08))):
        spent = milliseconds(
            lambda lens=lens: render(items, eye, K_small, width=320, height=240, distortion=lens)
        )
        print(
            f"{f'draw the street, {faces:,} faces, {name}':36}{spent:9.1f}   (320 x 240, goal 50)"
        )


def peers(
    p_world: np.ndarray, w: np.ndarray, t: np.ndarray, *, uv: np.ndarray
) -> tuple[dict, dict]:
    """Return OpenCV's times for the tasks and how far its answers are from ours; nothing where it
    is not installed.
    """
    try:
        cv2 = importlib.import_module("cv2")
    except ImportError:
        return {}, {}
    cv2.setNumThreads(1)
    coefficients = np.array(LENS)
    stop = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, 40, 1e-14)

    def forward() -> np.ndarray:
        return cv2.projectPoints(p_world, w, t, K, coefficients)[0][:, 0]

    def back() -> np.ndarray:
        return cv2.undistortPoints(uv[:, None], K, coefficients, criteria=stop)[:, 0]

    gaps = {
        "project": np.abs(forward() - uv).max(),
        "undistort": np.abs(back() - normalize(uv, K, LENS)).max(),
    }
    return {"project": milliseconds(forward), "undistort": milliseconds(back)}, gaps


if __name__ == "__main__":
    main()
