"""Stereo matching as the lesson runs it, beside OpenCV: `python -m tests.benchmarks.bench_stereo
[--rounds 5]`.

Ours is the lesson's step-by-step `match`, every step computed, on the pairs and at the sizes of its
presets and of own pairs. Every contender runs on the same pictures, taking turns, on one thread.
Times are the CPU time of the process in ms, the least over the rounds. Errors are shares of the
pixels that both cameras see (known from the truth) whose disparity is over 1 or 2 px off, a
contender's rejected pixels counted as `none` and left out of both.

Where ours are behind: a path goes from line to line, with some ten of numpy's calls for each; and
every step is shown with its map: while comparing, each goes on from the one before, and the sum
after each path is searched anew. A floor is what these alone take, over OpenCV's eight paths, or
its blocks; `unseen` is one map by our functions, without the steps on its way.
"""

import argparse
import collections
import functools
import importlib
import time
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import numpy as np

from workbench.algorithms.stereo.cost_volume import census_cost_volume, sad_cost_volume
from workbench.algorithms.stereo.disparity import match, usual_penalties
from workbench.algorithms.stereo.disparity_map import winner_takes_all, winners
from workbench.algorithms.stereo.semiglobal import semi_global
from workbench.data.files import read_image
from workbench.data.views.stereo import StereoPair, grey, motorcycle_pair, shrunk, synthetic_views
from workbench.geometry.cameras.stereo import StereoCamera

CONES = Path(__file__).resolve().parents[3] / "shared" / "data" / "stereo" / "cones"
BLOCK = 3
Matcher = Callable[[np.ndarray, np.ndarray], np.ndarray]
Step = TypeVar("Step")


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
    for name, task in tasks().items():
        for method, contenders in (("paths", semi_global_contenders), ("blocks", block_contenders)):
            alone = {
                row: functools.partial(run, task, paths=method == "paths")
                for row, run in (("unseen", unseen), ("floor", bare))
            }
            compare(
                f"{method}, {name}", task, contenders(task.disparities), rounds=rounds, alone=alone
            )
    print(
        "\na floor: a comparison at every shift, the additions and minima of eq. 13, line by line,"
        " and the winners that the steps show; of blocks, without eq. 13"
    )


def tasks() -> dict[str, Task]:
    """Return the default run's balls, the motorcycle of its preset, and cones at half their size
    where they are there.
    """
    camera = StereoCamera(150.0, 79.5, 59.5, 0.1)
    views = synthetic_views("spheres", camera, (160, 120), rng=np.random.default_rng(0))
    balls = views.exposed(4.0)
    by_name = {
        "balls 160 x 120, 32": task_of(balls, 32),
        "motorcycle 185 x 125, 32": task_of(shrunk(motorcycle_pair(), 4), 32),
    }
    return by_name | (
        {"cones 225 x 187, 32": task_of(shrunk(cones(), 2), 32)} if CONES.is_dir() else {}
    )


def task_of(pair: StereoPair, disparities: int) -> Task:
    """Return the grey pictures of a pair, and its truth."""
    assert pair.disparity is not None
    assert pair.visible is not None
    left, right = (np.rint(grey(picture)).astype(np.uint8) for picture in (pair.left, pair.right))
    return Task(
        left, right, pair.disparity, pair.visible & (pair.disparity < disparities - 1), disparities
    )


def cones() -> StereoPair:
    """Return Middlebury's cones; both cameras see what the two true maps agree on."""
    left, right = (read_image(CONES / name) for name in ("im2.png", "im6.png"))
    truth, other = (read_image(CONES / name) / 4.0 for name in ("disp2.pgm", "disp6.pgm"))
    partner = np.rint(np.arange(truth.shape[1]) - truth).astype(int)
    counterpart = np.take_along_axis(other, np.clip(partner, 0, None), axis=1)
    visible = (truth > 0) & (partner >= 0) & (counterpart > 0) & (np.abs(counterpart - truth) <= 1)
    return StereoPair(left, right, StereoCamera(1.0, 0.0, 0.0, 1.0), truth, visible)


def ours(disparities: int, window: int, *, paths: bool) -> Matcher:
    """Return the lesson's way, run to its last step: census with eight paths, or the lowest sum of
    differences.
    """
    penalties = functools.partial(usual_penalties, smoothness=1.0) if paths else None
    compare_by = census_cost_volume if paths else sad_cost_volume

    def run(left: np.ndarray, right: np.ndarray) -> np.ndarray:
        steps = match(
            left.astype(float),
            right.astype(float),
            disparities - 1,
            window=window,
            penalties=penalties,
            compare=compare_by,
        )
        return final(steps).disparity

    return run


def final(steps: Iterable[Step]) -> Step:
    """Return the last step, each let go for the next: the lesson keeps no volume of a step."""
    (last,) = collections.deque(steps, maxlen=1)
    return last


def bare(task: Task, *, paths: bool) -> None:
    """Compare at every shift, take the winners that the steps show, and of paths the additions and
    minima too, each array as narrow as ours and laid out like it.
    """
    h, w = task.left.shape
    most = task.disparities
    single, summed = (np.zeros((most, h, w), kind) for kind in (np.uint8, np.uint16))
    codes = np.zeros((h, w), np.uint32 if paths else float)
    for d in range(most):
        a = codes[:, d:]
        b = codes[:, : w - d]
        single[d, :, d:] = np.bitwise_count(a ^ b) if paths else np.abs(a - b)
    for winner in winners(single):
        winner.astype(float)
    if not paths:
        return
    for pairs, lines, along in ((1, w, h), (3, h, w)):  # of opposite directions
        rise, limit, L = np.zeros((3, pairs, most, 2 * along), np.uint16)
        cost = np.zeros((most, 2 * along), np.uint16)
        for _ in range(lines):
            np.minimum(rise, rise, out=L)
            L += cost[0, 0]
            np.minimum(L, rise, out=L)
            np.minimum(L, limit, out=L)
            L += cost
            np.subtract(L, np.minimum.reduce(L, axis=1, keepdims=True), out=rise)
    for _ in range(8):
        summed = summed + single
        winner_takes_all(summed).astype(float)


def unseen(task: Task, *, paths: bool) -> None:
    """Find the map by our functions, without a step on the way."""
    most = task.disparities - 1
    left, right = (picture.astype(float) for picture in (task.left, task.right))
    if not paths:
        winner_takes_all(sad_cost_volume(left, right, most, 5))
        return
    cost = census_cost_volume(left, right, most, BLOCK)
    winner_takes_all(final(semi_global(cost, *usual_penalties(cost, smoothness=1.0))).total)


def semi_global_contenders(disparities: int) -> dict[str, Matcher]:
    """Return ours and OpenCV's two, at the penalties of its documentation for 5 x 5 blocks."""
    contenders: dict[str, Matcher] = {"ours": ours(disparities, BLOCK, paths=True)}
    cv2 = peer()
    if cv2 is not None:
        for name, mode in (
            ("cv2 3WAY", cv2.STEREO_SGBM_MODE_SGBM_3WAY),
            ("cv2 HH, 8 paths", cv2.STEREO_SGBM_MODE_HH),
        ):
            matcher = cv2.StereoSGBM_create(
                0, disparities, 5, P1=8 * 25, P2=32 * 25, disp12MaxDiff=1, mode=mode
            )
            contenders[name] = as_floats(matcher)
    return contenders


def block_contenders(disparities: int) -> dict[str, Matcher]:
    """Return ours and OpenCV's block matching, whose windows are 5 pixels wide at least."""
    contenders: dict[str, Matcher] = {"ours": ours(disparities, 5, paths=False)}
    cv2 = peer()
    if cv2 is not None:
        contenders["cv2 StereoBM"] = as_floats(cv2.StereoBM_create(disparities, 5))
    return contenders


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


def compare(
    name: str,
    task: Task,
    contenders: dict[str, Matcher],
    *,
    rounds: int,
    alone: dict[str, Callable[[], None]],
) -> None:
    """Run all contenders, taking turns, and print times, errors, ratios to the fastest peer, and
    what ratio the parts that stand alone reach.
    """
    times: dict[str, list[float]] = {row: [] for row in (*contenders, *alone)}
    maps = {}
    for _ in range(rounds):
        for row, matcher in contenders.items():
            started = time.process_time()
            maps[row] = matcher(task.left, task.right)
            times[row].append(1e3 * (time.process_time() - started))
        for row, part in alone.items():
            started = time.process_time()
            part()
            times[row].append(1e3 * (time.process_time() - started))
    least = {row: min(taken) for row, taken in times.items()}
    *_, last = contenders  # OpenCV's eight paths, or blocks
    print(f"\n{name}")
    print(f"  {'':18}{'ms':>8}{'ours over it':>14}{'bad 1 px':>10}{'bad 2 px':>10}{'none':>8}")
    for row, disparities in maps.items():
        off = np.abs(disparities - task.truth)[task.visible]
        known = np.isfinite(off)
        bad = [100 * float((off[known] > limit).mean()) for limit in (1, 2)]
        ratio = least["ours"] / least[row]
        print(
            f"  {row:18}{least[row]:8.1f}{ratio:14.2f}{bad[0]:9.2f}%{bad[1]:9.2f}%{100 * (~known).mean():7.2f}%"  # noqa: E501
        )
    if len(contenders) > 1:
        for row in alone:
            print(f"  {row:18}{least[row]:8.1f}{least[row] / least[last]:14.2f}")


if __name__ == "__main__":
    main()
