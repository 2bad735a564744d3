"""RANSAC as the lesson runs it, beside its peers: `python -m tests.benchmarks.bench_ransac [--seeds
10]`.

Ours is the lesson's step-by-step `ransac` with its defaults (uniform samples, 99 % confidence, 500
samples at most), run to its end. All contenders of a task see the same rows and the same inlier
distance, in one run and on one thread: 5,000 points for a plane, the most that the lesson takes,
and 600 matches. Times are medians of CPU time in ms; errors are the root mean square distance of
the noiseless true points or matches to the estimate.

Where ours are behind: the floor is the arithmetic of the same run without its steps, each call of
numpy on small arrays: the samples solved 64 at a time, the distances of all estimates, the refits.
"""

# ruff: noqa: E402

import argparse
import functools
import importlib
import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from lessons.ransac.robust_scenes import match_scene, plane_scene
from workbench.algorithms.robust.models import FUNDAMENTAL, HOMOGRAPHY, PLANE, Model, rms_distance
from workbench.algorithms.robust.ransac import Judge, ransac
from workbench.algorithms.robust.samplers import uniform_samples
from workbench.viewer.runs import settle

MOST_SAMPLES = 500
Contender = Callable[[np.ndarray], np.ndarray | None]


def main() -> None:
    """Print one table per task."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=10)
    seeds = range(5000, 5000 + parser.parse_args().seeds)
    settle()  # as the server does: collections of garbage are no part of an algorithm
    planes = [
        plane_scene(np.random.default_rng(seed), count=5000, outlier_ratio=0.5, sigma=0.01)
        for seed in seeds
    ]
    compare("plane", planes, PLANE, contenders=plane_contenders(0.02), distance=0.02)
    for model, distance in ((HOMOGRAPHY, 3.5), (FUNDAMENTAL, 2.0)):
        flat = model is HOMOGRAPHY
        scenes = [
            match_scene(
                np.random.default_rng(seed), count=600, outlier_ratio=0.3, sigma=1.0, flat=flat
            )
            for seed in seeds
        ]
        compare(
            model.name,
            scenes,
            model,
            contenders=match_contenders(model, distance),
            distance=distance,
        )
    print("\n  the arithmetic alone: our run's samples solved, distances and refits, without steps")


def compare(
    task: str, scenes: list, model: Model, *, contenders: dict[str, Contender], distance: float
) -> None:
    """Run all contenders on all scenes, taking turns, and print their figures, the ratios to each
    peer, and the ratio to the quickest that the arithmetic of ours alone reaches.
    """
    times = {name: [] for name in contenders}
    errors = {name: [] for name in contenders}
    least: list[float] = []
    for scene in scenes:
        arithmetic = bare(model, distance, scene.p)
        started = time.process_time()
        arithmetic()
        least.append(1e3 * (time.process_time() - started))
        for name, contender in contenders.items():
            started = time.process_time()
            estimate = contender(scene.p)
            times[name].append(1e3 * (time.process_time() - started))
            if estimate is None or estimate.shape != scene.truth.shape:
                errors[name].append(np.inf)
            else:
                errors[name].append(rms_distance(model, estimate, scene.p_true))
    print(f"\n{task}, inlier distance {distance} {model.unit}")
    print(f"  {'':22}{'ms':>9}{'ours/it':>11}{'median':>11}{'p90':>9}{'worst':>9}")
    ours = np.median(times["ours"])
    for name in contenders:
        median, p90, worst = np.quantile(errors[name], (0.5, 0.9, 1.0))
        ratio = "" if name == "ours" else f"{ours / np.median(times[name]):.2f}"
        print(
            f"  {name:22}{np.median(times[name]):9.2f}{ratio:>11}{median:11.4f}{p90:9.4f}{worst:9.3f}"  # noqa: E501
        )

    if peers := [np.median(spent) for name, spent in times.items() if name != "ours"]:
        arithmetic = np.median(least)
        floor = arithmetic / min(peers)
        print(f"  {'the arithmetic alone':22}{arithmetic:9.2f}{'':11}floor {floor:.2f}")


def bare(model: Model, distance: float, p: np.ndarray) -> Callable[[], None]:
    """Return what repeats the calls of the model's functions that one run of ours makes."""
    calls = []

    def kept(function: Callable) -> Callable:
        def call(*args: Any, **more: Any) -> Any:
            calls.append(functools.partial(function, *args, **more))
            return function(*args, **more)

        return call

    recorded = replace(
        model,
        solve=kept(model.solve),
        solve_each=model.solve_each and kept(model.solve_each),
        distances=kept(model.distances),
        refit=kept(model.refit),
    )
    ours(recorded, distance)(p)

    def again() -> None:
        for call in calls:
            call()

    return again


def ours(model: Model, distance: float) -> Contender:
    """Return the lesson's way, run to its last step."""

    def fit(p: np.ndarray) -> np.ndarray | None:
        samples = uniform_samples(len(p), model.sample_size, np.random.default_rng(0))
        *_, last = ransac(
            p, model, samples, judge=Judge(p, model, distance), max_iterations=MOST_SAMPLES
        )
        return last.best.estimate if last.best else None

    return fit


def plane_contenders(distance: float) -> dict[str, Contender]:
    """Return the ways to fit a plane, by name."""
    contenders: dict[str, Contender] = {"ours": ours(PLANE, distance)}
    if open3d := optional("open3d"):

        def by_open3d(p: np.ndarray) -> np.ndarray:
            cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(p))
            plane, _ = cloud.segment_plane(
                distance, ransac_n=3, num_iterations=MOST_SAMPLES, probability=0.99
            )
            return np.array(plane)

        contenders["open3d"] = by_open3d
    if measure := optional("skimage.measure"):

        def by_skimage(p: np.ndarray) -> np.ndarray:
            model, _ = measure.ransac(
                p,
                _PlaneModel,
                min_samples=3,
                residual_threshold=distance,
                max_trials=MOST_SAMPLES,
                rng=0,
                stop_probability=0.99,
            )
            return model.params

        class _PlaneModel:
            """A plane as scikit-image's loop wants it: through three points, or by least
            squares.
            """

            params: np.ndarray

            @classmethod
            def from_estimate(cls, p: np.ndarray) -> "_PlaneModel":
                made = cls()
                made.params = PLANE.refit(p)
                return made

            def residuals(self, p: np.ndarray) -> np.ndarray:
                return np.abs(p @ self.params[:3] + self.params[3])

        contenders["skimage"] = by_skimage
    return contenders


def match_contenders(model: Model, distance: float) -> dict[str, Contender]:
    """Return the ways to fit a homography or a fundamental matrix, by name."""
    contenders: dict[str, Contender] = {"ours": ours(model, distance)}
    flat = model is HOMOGRAPHY
    if cv2 := optional("cv2"):
        cv2.setNumThreads(1)
        find = cv2.findHomography if flat else cv2.findFundamentalMat
        for name in ("USAC_MAGSAC", "RANSAC"):
            method = getattr(cv2, name if flat or name != "RANSAC" else "FM_RANSAC")
            contenders[f"cv2 {name}"] = lambda p, method=method: find(
                p[:, :2], p[:, 2:], method, distance, confidence=0.99
            )[0]
    if poselib := optional("poselib"):
        find_all = poselib.estimate_homography if flat else poselib.estimate_fundamental
        key = "max_reproj_error" if flat else "max_epipolar_error"
        contenders["poselib"] = lambda p: find_all(p[:, :2], p[:, 2:], {key: distance}, {})[0]
    transform, measure = optional("skimage.transform"), optional("skimage.measure")
    if transform and measure:
        kind = transform.ProjectiveTransform if flat else transform.FundamentalMatrixTransform

        def by_skimage(p: np.ndarray) -> np.ndarray | None:
            fitted, _ = measure.ransac(
                (p[:, :2], p[:, 2:]),
                kind,
                min_samples=4 if flat else 8,
                residual_threshold=distance,
                max_trials=MOST_SAMPLES,
                rng=0,
                stop_probability=0.99,
            )
            return fitted.params if fitted is not None else None

        contenders["skimage"] = by_skimage
    return contenders


def optional(name: str):
    """Return a module, or None where it is not installed."""
    try:
        return importlib.import_module(name)
    except ImportError:
        return None


if __name__ == "__main__":
    main()
