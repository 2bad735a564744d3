"""Robust fitting beside its peers: `python -m tests.benchmarks.bench_ransac [--seeds 40]`.

All contenders of a task see the same data and the same inlier distance, in one run and on one thread. Times are medians
of CPU time in ms; errors are the root mean square distance of the noiseless true points or matches to the estimate.
"""
# ruff: noqa: E402

import argparse
import importlib
import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

import time
from collections.abc import Callable

import numpy as np

from workbench.algorithms.models import FUNDAMENTAL, HOMOGRAPHY, PLANE, Model, rms_distance
from workbench.algorithms.ransac_batched import ransac_batched
from workbench.algorithms.scores import count_score
from workbench.data.robust import match_scene, plane_scene

FLOORS = {
    "plane, 1000 samples": "0.7 of the best peer",
    "plane, early stop": "0.34 of open3d",
    "homography": "1.9 of cv2 MAGSAC at 0.089 px against its 0.081",
    "fundamental matrix": "4.5 of cv2 at 0.154 px against its 0.081, p90 0.49 against 0.13",
}
Contender = Callable[[np.ndarray], np.ndarray | None]


def main() -> None:
    """Print one table per task."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=40)
    seeds = range(5000, 5000 + parser.parse_args().seeds)
    planes = [
        plane_scene(np.random.default_rng(seed), count=100_000, outlier_ratio=0.5, sigma=0.01) for seed in seeds[:5]
    ]
    compare("plane, 1000 samples", planes, PLANE, plane_contenders(0.02, all_samples=True))
    compare("plane, early stop", planes, PLANE, plane_contenders(0.02, all_samples=False))
    for model, task, distances in ((HOMOGRAPHY, "homography", (3.0,)), (FUNDAMENTAL, "fundamental matrix", (2.0, 3.0))):
        scenes = [
            match_scene(np.random.default_rng(seed), count=2000, outlier_ratio=0.5, sigma=1.0, flat=model is HOMOGRAPHY)
            for seed in seeds
        ]
        for distance in distances:
            compare(task, scenes, model, match_contenders(model, distance), f"inlier distance {distance} px")


def compare(task: str, scenes: list, model: Model, contenders: dict[str, Contender], note: str = "") -> None:
    """Run all contenders on all scenes, taking turns, and print their figures and the ratios to the best peer."""
    times = {name: [] for name in contenders}
    errors = {name: [] for name in contenders}
    for scene in scenes:
        for name, contender in contenders.items():
            started = time.process_time()
            estimate = contender(scene.p)
            times[name].append(1e3 * (time.process_time() - started))
            if estimate is None or estimate.shape != scene.truth.shape:
                errors[name].append(np.inf)
            else:
                errors[name].append(rms_distance(model, estimate, scene.p_true))
    print(f"\n{task} {note}   (floor, ours to peer: {FLOORS[task]})")
    print(f"  {'':22}{'ms':>9}{'ours/it':>11}{'median':>11}{'p90':>9}{'worst':>9}")
    ours = np.median(times["ours"])
    for name in contenders:
        median, p90, worst = np.quantile(errors[name], (0.5, 0.9, 1.0))
        ratio = "" if name == "ours" else f"{ours / np.median(times[name]):.2f}"
        print(f"  {name:22}{np.median(times[name]):9.2f}{ratio:>11}{median:11.4f}{p90:9.4f}{worst:9.3f}")


def plane_contenders(distance: float, *, all_samples: bool) -> dict[str, Contender]:
    """Return the ways to fit a plane, by name."""
    confidence = 1.0 - 1e-15 if all_samples else 0.99

    def ours(p: np.ndarray) -> np.ndarray | None:
        rng = np.random.default_rng(0)
        best = ransac_batched(
            p, PLANE, rng, inlier_distance=distance, score=count_score, confidence=confidence, max_iterations=1000
        ).best
        return best.estimate if best else None

    contenders: dict[str, Contender] = {"ours": ours}
    if open3d := optional("open3d"):

        def by_open3d(p: np.ndarray) -> np.ndarray:
            cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(p))
            probability = 1.0 if all_samples else 0.99
            plane, _ = cloud.segment_plane(distance, ransac_n=3, num_iterations=1000, probability=probability)
            return np.array(plane)

        contenders["open3d"] = by_open3d
    if all_samples and (measure := optional("skimage.measure")):

        def by_skimage(p: np.ndarray) -> np.ndarray:
            model, _ = measure.ransac(
                p, _PlaneModel, min_samples=3, residual_threshold=distance, max_trials=1000, rng=0, stop_probability=1
            )
            return model.params

        class _PlaneModel:
            """A plane as scikit-image's loop wants it: through three points, or by least squares."""

            def estimate(self, p: np.ndarray) -> bool:
                self.params = PLANE.refit(p)
                return True

            def residuals(self, p: np.ndarray) -> np.ndarray:
                return np.abs(p @ self.params[:3] + self.params[3])

        contenders["skimage's loop"] = by_skimage
    return contenders


def match_contenders(model: Model, distance: float) -> dict[str, Contender]:
    """Return the ways to fit a homography or a fundamental matrix, by name."""

    def ours(p: np.ndarray) -> np.ndarray | None:
        best = ransac_batched(p, model, np.random.default_rng(0), inlier_distance=distance, max_iterations=10_000).best
        return best.estimate if best else None

    contenders: dict[str, Contender] = {"ours": ours}
    flat = model is HOMOGRAPHY
    if cv2 := optional("cv2"):
        cv2.setNumThreads(1)
        find = cv2.findHomography if flat else cv2.findFundamentalMat
        for name in ("USAC_MAGSAC", "USAC_FAST", "USAC_ACCURATE", "RANSAC"):
            method = getattr(cv2, name if flat or name != "RANSAC" else "FM_RANSAC")
            contenders[f"cv2 {name}"] = lambda p, method=method: find(
                p[:, :2], p[:, 2:], method, distance, confidence=0.99
            )[0]
    if poselib := optional("poselib"):
        find_all = poselib.estimate_homography if flat else poselib.estimate_fundamental
        key = "max_reproj_error" if flat else "max_epipolar_error"
        contenders["poselib"] = lambda p: find_all(p[:, :2], p[:, 2:], {key: distance}, {})[0]
    if not flat and optional("skimage"):
        measure, transform = optional("skimage.measure"), optional("skimage.transform")
        assert measure is not None
        assert transform is not None

        def by_skimage(p: np.ndarray) -> np.ndarray | None:
            found, _ = measure.ransac(
                (p[:, :2], p[:, 2:]), transform.FundamentalMatrixTransform, min_samples=8, residual_threshold=distance,
                max_trials=1000, rng=0,
            )  # fmt: skip
            return found.params if found is not None else None

        contenders["skimage, 1000 at most"] = by_skimage
    return contenders


def optional(name: str):
    """Return a module, or None where it is not installed."""
    try:
        return importlib.import_module(name)
    except ImportError:
        return None


if __name__ == "__main__":
    main()
