"""Pose from points as the lesson finds it, beside its peers: `python -m tests.benchmarks.bench_pose
[--rounds 5]`.

The same points for all contenders of a task, one thread, CPU time, the least of the rounds that
take turns. P3P, SQPnP, EPnP and IPPE are called as the lesson calls them in its 60 other pictures,
for many problems side by side; one by one numpy's calls cost many times what they compute; that is
shown too. RANSAC is the lesson's, step by step, to its end: it solves samples some dozens at once
and judges them one by one.
"""
# ruff: noqa: E402

import argparse
import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

import time
from collections.abc import Callable

import numpy as np

from tests.benchmarks.bench_ransac import optional
from tests.geometry.views import triples, view
from workbench.algorithms.robust.camera_model import camera_model
from workbench.algorithms.robust.ransac import Judge, ransac
from workbench.algorithms.robust.samplers import uniform_samples
from workbench.geometry.cameras import intrinsics
from workbench.geometry.cameras.camera_motions import refined, sqpnp
from workbench.geometry.cameras.control_points import epnp
from workbench.geometry.cameras.planar_motions import planar_motions
from workbench.geometry.cameras.three_points import p3p, unit_rays
from workbench.geometry.motions import exp_so3, motion
from workbench.geometry.motions.alignment import degrees_between

F = 800.0
PIXEL = 1 / 800
K = intrinsics(F, 320.0, 240.0)
Contender = Callable[[], np.ndarray | None]


def main() -> None:
    """Print one table per task."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=5)
    rounds = parser.parse_args().rounds
    cv2, poselib = optional("cv2"), optional("poselib")
    if cv2:
        cv2.setNumThreads(1)
    three(rounds, cv2, poselib)
    for n in (20, 200):
        many(rounds, n, cv2)
    for n in (4, 20, 200):
        by_control_points(rounds, n, cv2)
    planes(rounds, cv2)
    for outliers in (0.5, 0.7):
        among_outliers(rounds, outliers, cv2, poselib=poselib)


def three(rounds: int, cv2, poselib) -> None:
    """Compare P3P on 1,000 triples."""
    _, p, xy = triples(1000)
    rays = [list(ray) for ray in unit_rays(xy)]
    pairs = list(zip(p, xy, strict=True))
    ways: dict[str, Contender] = {
        "ours, side by side": lambda: np.array(len(p3p(p, xy)[0])),
        "ours, one by one": lambda: np.array(
            sum(len(p3p(p[k : k + 1], xy[k : k + 1])[0]) for k in range(1000))
        ),
    }
    if cv2:

        def by_opencv() -> np.ndarray:
            solve = [
                cv2.solveP3P(a[:, None], b[:, None].copy(), np.eye(3), None, cv2.SOLVEPNP_P3P)
                for a, b in pairs
            ]
            return np.array(sum(result[0] for result in solve))

        ways["cv2 solveP3P"] = by_opencv
    if poselib:
        ways["poselib p3p"] = lambda: np.array(
            sum(len(poselib.p3p(a, list(b))) for a, b in zip(rays, p, strict=True))
        )
    compare(
        "P3P, 1,000 triples; last column: solutions",
        rounds,
        ways,
        judged=lambda count: float(count),
        per=1000,
    )


def many(rounds: int, n: int, cv2) -> None:
    """Compare SQPnP on 60 pictures of n points."""
    views = [view(seed, n, sigma=PIXEL) for seed in range(60)]
    p, xy = np.stack([picture[1] for picture in views]), np.stack([picture[2] for picture in views])
    ways: dict[str, Contender] = {
        "ours, side by side": lambda: sqpnp(p, xy),
        "ours, one by one": lambda: np.stack([sqpnp(a, b) for a, b in zip(p, xy, strict=True)]),
        "ours, refined": lambda: refined(sqpnp(p, xy), p, xy),
    }
    if cv2:
        for name, flag in (("SQPNP", cv2.SOLVEPNP_SQPNP), ("default", cv2.SOLVEPNP_ITERATIVE)):
            ways[f"cv2 {name}"] = lambda flag=flag: np.stack(
                [by_cv2(cv2, a, b, flag=flag) for a, b in zip(p, xy, strict=True)]
            )
    compare(
        f"SQPnP, 60 pictures of {n} points; degrees",
        rounds,
        ways,
        judged=lambda Ts: middle(Ts, views),
        per=60,
    )


def by_control_points(rounds: int, n: int, cv2) -> None:
    """Compare EPnP on 60 pictures of n points."""
    views = [view(seed, n, sigma=PIXEL) for seed in range(60)]
    p, xy = np.stack([picture[1] for picture in views]), np.stack([picture[2] for picture in views])
    ways: dict[str, Contender] = {
        "ours, side by side": lambda: epnp(p, xy),
        "ours, one by one": lambda: np.stack([epnp(a, b) for a, b in zip(p, xy, strict=True)]),
    }
    if cv2:
        ways["cv2 EPNP"] = lambda: np.stack(
            [by_cv2(cv2, a, b, flag=cv2.SOLVEPNP_EPNP) for a, b in zip(p, xy, strict=True)]
        )
    compare(
        f"EPnP, 60 pictures of {n} points; degrees",
        rounds,
        ways,
        judged=lambda Ts: middle(Ts, views),
        per=60,
    )


def planes(rounds: int, cv2) -> None:
    """Compare IPPE on 60 pictures of 20 points."""
    views = [view(seed, 20, sigma=PIXEL, flat=True) for seed in range(60)]
    p, xy = np.stack([picture[1] for picture in views]), np.stack([picture[2] for picture in views])
    ways: dict[str, Contender] = {
        "ours, side by side": lambda: planar_motions(p, xy)[:, 0],
        "ours, one by one": lambda: np.stack(
            [planar_motions(a, b)[0] for a, b in zip(p, xy, strict=True)]
        ),
    }
    if cv2:
        ways["cv2 IPPE"] = lambda: np.stack(
            [by_cv2(cv2, p, xy, flag=cv2.SOLVEPNP_IPPE) for _, p, xy in views]
        )
    compare(
        "IPPE, 60 pictures of 20 points of a plane; no column",
        rounds,
        ways,
        judged=lambda Ts: 0.0,
        per=60,
    )


def among_outliers(rounds: int, outliers: float, cv2, *, poselib) -> None:
    """Compare RANSAC on 10 pictures of 200 points."""
    views = []
    for seed in range(10):
        T, p, xy = view(seed, 200, sigma=PIXEL)
        wrong = int(outliers * 200)
        xy[:wrong] = np.random.default_rng(seed + 500).uniform([-0.4, -0.3], [0.4, 0.3], (wrong, 2))
        views.append((T, p, F * xy + [320, 240]))
    ways: dict[str, Contender] = {
        "ours": lambda: np.stack([by_ransac(p, uv) for _, p, uv in views])
    }
    if cv2:
        options = {"reprojectionError": 3.0, "confidence": 0.99, "iterationsCount": 2000}

        def theirs(p: np.ndarray, uv: np.ndarray) -> np.ndarray:
            _, turn, t, _ = cv2.solvePnPRansac(p[:, None], uv[:, None].copy(), K, None, **options)
            return motion(exp_so3(turn.ravel()), t.ravel())

        ways["cv2 solvePnPRansac"] = lambda: np.stack([theirs(p, uv) for _, p, uv in views])
    if poselib:
        camera = {"model": "PINHOLE", "width": 640, "height": 480, "params": [F, F, 320, 240]}
        bundle = {"max_reproj_error": 3.0, "success_prob": 0.99}
        ways["poselib"] = lambda: np.stack(
            [
                motion(estimate.R, estimate.t)
                for _, p, uv in views
                for estimate in [poselib.estimate_absolute_pose(uv, p, camera, bundle, {})[0]]
            ]
        )
    task = f"RANSAC, 10 pictures of 200 points, {100 * outliers:.0f} % outliers; degrees"
    compare(task, rounds, ways, judged=lambda Ts: middle(Ts, views), per=10)


def by_ransac(p: np.ndarray, uv: np.ndarray) -> np.ndarray:
    """Return the lesson's way, run to its last step."""
    rows = np.column_stack([p, uv])
    model = camera_model(K)
    samples = uniform_samples(len(rows), 3, np.random.default_rng(0))
    *_, last = ransac(rows, model, samples, judge=Judge(rows, model, 3.0), max_iterations=500)
    return last.best.estimate if last.best else np.eye(4)


def by_cv2(cv2, p: np.ndarray, xy: np.ndarray, *, flag: int) -> np.ndarray:
    """Return a solver of OpenCV's."""
    _, turn, t = cv2.solvePnP(p[:, None], xy[:, None].copy(), np.eye(3), None, flags=flag)
    return motion(exp_so3(turn.ravel()), t.ravel())


def middle(Ts: np.ndarray, views: list) -> float:
    """Return the median rotation error, degrees."""
    return float(
        np.median([degrees_between(T, picture[0]) for T, picture in zip(Ts, views, strict=True)])
    )


def compare(
    task: str,
    rounds: int,
    ways: dict[str, Contender],
    *,
    judged: Callable[[np.ndarray], float],
    per: int,
) -> None:
    """Run all contenders, taking turns, and print their times per problem, ours over theirs, and
    what came out.
    """
    least = dict.fromkeys(ways, np.inf)
    results = {}
    for _ in range(rounds):
        for name, way in ways.items():
            started = time.process_time()
            results[name] = way()
            least[name] = min(least[name], 1e6 * (time.process_time() - started) / per)
    ours = least[next(iter(ways))]
    print(f"\n{task}")
    print(f"  {'':22}{'µs each':>10}{'ours/it':>10}{'':>12}")
    for name in ways:
        ratio = "" if name.startswith("ours") else f"{ours / least[name]:.2f}"
        print(f"  {name:22}{least[name]:10.1f}{ratio:>10}{judged(results[name]):12.4g}")
    for name in ("cv2", "poselib"):
        if not optional(name):
            print(f"  {name} is not installed: left out")


if __name__ == "__main__":
    main()
