"""Stereo matching beside OpenCV: `python -m tests.benchmarks.bench_stereo [--rounds 5]`.

Every contender runs on the same pictures, taking turns, on one thread. Times are the CPU time of the process in ms, the
least over the rounds. Errors are shares of the pixels that both cameras see (known from the truth) whose disparity
is over 1 or 2 px off, a contender's rejected pixels counted as `none` and left out of both.
"""

import argparse
import importlib
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from workbench.algorithms.disparity import block_matching, disparity_map
from workbench.data.files import read_image
from workbench.data.stereo import grey, synthetic_pair
from workbench.geometry.stereo import StereoCamera

CONES = Path(__file__).resolve().parents[3] / "shared" / "data" / "stereo" / "cones"
BLOCK = 9
FLOORS = {
    "semi-global 450 x 375, 64": "floor: 188 ms on the machine of 3WAY 22, HH 65-96: 8.5 of 3WAY, 2.1-2.7 of HH",
    "semi-global 1280 x 960, 128": "floor: 2100-2920 ms: 8 of 3WAY, 2.0 of HH",
    "blocks 450 x 375, 64": "floor: 81 ms: 6-9 of StereoBM, which rejects 13 % of the pixels",
    "blocks 1280 x 960, 128": "floor: 990 ms: 6-9 of StereoBM",
}
Matcher = Callable[[np.ndarray, np.ndarray], np.ndarray]


class Task(NamedTuple):
    """Two pictures, the true disparity of the left one, and where both cameras see it."""

    left: np.ndarray
    right: np.ndarray
    truth: np.ndarray
    visible: np.ndarray
    disparities: int


def main() -> None:
    """Print one table per task."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=5)
    rounds = parser.parse_args().rounds
    small = cones() if CONES.is_dir() else made(450, 375, 64)
    large = made(1280, 960, 128)
    for task, size in ((small, "450 x 375, 64"), (large, "1280 x 960, 128")):
        compare(f"semi-global {size}", task, semi_global_contenders(task.disparities), rounds)
        compare(f"blocks {size}", task, block_contenders(task.disparities), rounds)


def cones() -> Task:
    """Return Middlebury's cones; both cameras see what the two true maps agree on."""
    left, right = (np.rint(grey(read_image(CONES / name))).astype(np.uint8) for name in ("im2.png", "im6.png"))
    truth, other = (read_image(CONES / name) / 4.0 for name in ("disp2.pgm", "disp6.pgm"))
    partner = np.rint(np.arange(truth.shape[1]) - truth).astype(int)
    there = np.take_along_axis(other, np.clip(partner, 0, None), axis=1)
    return Task(left, right, truth, (truth > 0) & (partner >= 0) & (there > 0) & (np.abs(there - truth) <= 1), 64)


def made(w: int, h: int, disparities: int) -> Task:
    """Return balls before a wall whose nearest point has a disparity just inside the range."""
    camera = StereoCamera(f=0.94 * w, cx=(w - 1) / 2, cy=(h - 1) / 2, baseline=0.105 * disparities * 9.1 / w)
    pair: Any = synthetic_pair("spheres", camera, (w, h), 4.0, np.random.default_rng(0))
    left, right = (np.rint(grey(picture)).astype(np.uint8) for picture in (pair.left, pair.right))
    return Task(left, right, pair.disparity, pair.visible & (pair.disparity < disparities - 1), disparities)


def semi_global_contenders(disparities: int) -> dict[str, Matcher]:
    """Return ours and OpenCV's two, at the penalties of its documentation for 5 x 5 blocks."""
    found: dict[str, Matcher] = {"ours, 8 paths": lambda left, right: disparity_map(left, right, disparities - 1)[0]}
    cv2 = peer()
    if cv2 is not None:
        for name, mode in (("cv2 3WAY", cv2.STEREO_SGBM_MODE_SGBM_3WAY), ("cv2 HH, 8 paths", cv2.STEREO_SGBM_MODE_HH)):
            matcher = cv2.StereoSGBM_create(0, disparities, 5, P1=8 * 25, P2=32 * 25, disp12MaxDiff=1, mode=mode)
            found[name] = as_floats(matcher)
    return found


def block_contenders(disparities: int) -> dict[str, Matcher]:
    """Return ours and OpenCV's block matching with windows of the same side."""
    found: dict[str, Matcher] = {"ours": lambda left, right: block_matching(left, right, disparities - 1, BLOCK)[0]}
    cv2 = peer()
    if cv2 is not None:
        found["cv2 StereoBM"] = as_floats(cv2.StereoBM_create(disparities, BLOCK))
    return found


def peer() -> Any:
    """Return OpenCV on one thread, None where it is not installed."""
    try:
        cv2 = importlib.import_module("cv2")
    except ImportError:
        return None
    cv2.setNumThreads(1)
    return cv2


def as_floats(matcher: Any) -> Matcher:
    """Return an OpenCV matcher whose disparities are pixels, NaN where it rejects."""

    def run(left: np.ndarray, right: np.ndarray) -> np.ndarray:
        sixteenths = matcher.compute(left, right)
        return np.where(sixteenths < 0, np.nan, sixteenths / 16.0)

    return run


def compare(name: str, task: Task, contenders: dict[str, Matcher], rounds: int) -> None:
    """Run all contenders, taking turns, and print times, errors and ratios to the fastest peer."""
    times: dict[str, list[float]] = {who: [] for who in contenders}
    maps = {}
    for _ in range(rounds):
        for who, matcher in contenders.items():
            started = time.process_time()
            maps[who] = matcher(task.left, task.right)
            times[who].append(1e3 * (time.process_time() - started))
    least = {who: min(taken) for who, taken in times.items()}
    print(f"\n{name}  ({FLOORS[name]})")
    print(f"  {'':18}{'ms':>8}{'ours over it':>14}{'bad 1 px':>10}{'bad 2 px':>10}{'none':>8}")
    for who, found in maps.items():
        off = np.abs(found - task.truth)[task.visible]
        known = np.isfinite(off)
        bad = [100 * float((off[known] > limit).mean()) for limit in (1, 2)]
        ratio = least["ours" if "ours" in least else "ours, 8 paths"] / least[who]
        print(f"  {who:18}{least[who]:8.1f}{ratio:14.2f}{bad[0]:9.2f}%{bad[1]:9.2f}%{100 * (~known).mean():7.2f}%")


if __name__ == "__main__":
    main()
