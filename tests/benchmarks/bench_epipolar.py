"""Two views: eight points, triangulation, the motion between two cameras, beside OpenCV and PoseLib
where installed.

    python -m tests.benchmarks.bench_epipolar

The least CPU time of some rounds, taking turns, one thread each. 1,365 matches of two made cameras
with half a pixel of noise, 1024 x 683 pixels. Where ours are behind: eight points keep the digits
that normal equations lose (a QR of all rows before the SVD), and the linear triangulation, for the
same digits, begins with numpy's QR
of one 4 x 4 at a time, half of the peer's time, before it finds the least direction of all side by
side. Its midpoints are as near here and an order quicker. Rectification is a dozen products of
small matrices, each with numpy's call. OpenCV and PoseLib look for outliers too, of which there are
none: their motions are for more than ours.
"""

import argparse
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from lessons.epipolar.exercises import a_pair
from tests.benchmarks.bench_icp import line, optional
from workbench.geometry.cameras import normalize
from workbench.geometry.motions import angle_between, motion
from workbench.geometry.motions.alignment import degrees_between
from workbench.geometry.two_views.epipolar import (
    epipolar_constraints,
    fit_fundamental,
    rank_two,
    refine_fundamental,
)
from workbench.geometry.two_views.essential import (
    essential_from_fundamental,
    essential_to_poses,
    refine_motion,
)
from workbench.geometry.two_views.homography import homogeneous, null_vector
from workbench.geometry.two_views.rectification import rectify
from workbench.geometry.two_views.triangulation import (
    before_both,
    camera_matrix,
    midpoints,
    triangulate,
)

MATCHES = 1365
SIGMA = 0.5
cv2, poselib = optional("cv2"), optional("poselib")


def best(*tasks: Callable[[], Any], repeat: int = 5) -> list[float]:
    """Return the least CPU time of each task, milliseconds, the tasks taking turns."""
    times = np.full((repeat, len(tasks)), np.nan)
    for row in times:
        for i, task in enumerate(tasks):
            start = time.process_time()
            for _ in range(5):
                task()
            row[i] = 200 * (time.process_time() - start)
    return [float(column.min()) for column in times.T]


def compared(
    task: str,
    rounds: int,
    ours: Callable[[], Any],
    *,
    peers: dict[str, Callable[[], Any]],
    floor: str | Callable[[], Any] = "",
) -> None:
    """Print a line; a floor that is a task is measured too, and told as its ratio."""
    bare = floor if callable(floor) else lambda: None
    mine, least, *theirs = best(ours, bare, *peers.values(), repeat=rounds)
    if callable(floor):
        floor = f"{least / min(theirs):.2f}" if theirs else ""
    line(task, mine, dict(zip(peers, theirs, strict=True)), floor=floor)


def bare_eight_points(x: np.ndarray, y: np.ndarray) -> Callable[[], Any]:
    """Return what the eight-point algorithm cannot spare: both images brought to a common scale,
    and the decompositions of its rows, already made, and of F.
    """
    pixels = [np.ascontiguousarray(uv.T) for uv in (x, y)]
    rows = epipolar_constraints(homogeneous(x), homogeneous(y))

    def bare() -> None:
        for uv in pixels:
            off = uv - uv.mean(axis=1, keepdims=True)
            off *= np.sqrt(2.0) / np.sqrt(off[0] * off[0] + off[1] * off[1]).mean()
        rank_two(null_vector(rows).reshape(3, 3))

    return bare


def main() -> None:
    """Run all of them."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--rounds", type=int, default=5)
    rounds = parser.parse_args().rounds
    if cv2:
        cv2.setNumThreads(1)
    pair = a_pair(1, MATCHES, SIGMA)
    K, T, x, y = pair.K_first, pair.T_second_first, pair.uv_first, pair.uv_second
    L = pair.K_second
    P = camera_matrix(K, np.eye(4))
    Q = camera_matrix(L, T)
    xn, yn = normalize(x, K), normalize(y, L)
    print(f"{'task (ms), 1,365 matches':<44} {'ours':>8}   {'peers':<44} {'ratio':>6}   floor")
    compared(
        "eight points",
        rounds,
        lambda: fit_fundamental(x, y),
        peers={"cv2": lambda: cv2.findFundamentalMat(x, y, cv2.FM_8POINT)} if cv2 else {},
        floor=bare_eight_points(x, y),
    )
    print(
        "    floor: the normalising, a QR of all rows that keeps the digits which OpenCV's normal"
        " equations lose, and two SVDs"
    )
    triangulated = {"cv2": lambda: cv2.triangulatePoints(P, Q, x.T, y.T)} if cv2 else {}
    compared(
        "triangulation, linear",
        rounds,
        lambda: triangulate(P, Q, x, y),
        peers=triangulated,
        floor="0.5",
    )
    compared(
        "triangulation, midpoints",
        rounds,
        lambda: midpoints(T, xn, yn),
        peers=triangulated,
        floor="0.25",
    )
    for name, p in (("linear", triangulate(P, Q, x, y)), ("midpoints", midpoints(T, xn, yn))):
        off = np.median(np.linalg.norm(p - pair.p_first, axis=1))
        print(f"    {name}: {1000 * off:.2f} mm off in the median")

    def ours(refined: bool = True) -> np.ndarray:
        Ts = essential_to_poses(essential_from_fundamental(fit_fundamental(x, y), K, L))
        best = max(Ts, key=lambda T_tried: before_both(midpoints(T_tried, xn, yn), T_tried).sum())
        return refine_motion(best, x, y, K_first=K, K_second=L) if refined else best

    def by_poselib() -> np.ndarray:
        cameras = [
            {
                "model": "PINHOLE",
                "width": 1024,
                "height": 683,
                "params": [k[0, 0], k[1, 1], k[0, 2], k[1, 2]],
            }
            for k in (K, L)
        ]
        solved = poselib.estimate_relative_pose(x, y, *cameras, {"max_epipolar_error": 2.0}, {})[0]
        return motion(solved.R, solved.t)

    def by_cv2() -> np.ndarray:
        E, mask = cv2.findEssentialMat(xn, yn, np.eye(3), cv2.RANSAC, 0.999, 2.0 / 900)
        _, R, t, _ = cv2.recoverPose(E, xn, yn, np.eye(3), mask=mask)
        return motion(R, t.ravel())

    peers = ({"cv2 five points": by_cv2} if cv2 else {}) | (
        {"poselib": by_poselib} if poselib else {}
    )
    compared("motion: eight points, refined", rounds, ours, peers=peers)
    for name, made in {"ours": ours, "ours, not refined": lambda: ours(False), **peers}.items():
        T_made = made()
        direction = np.degrees(angle_between(T_made[:3, 3], T[:3, 3]))
        print(
            f"    {name}: {degrees_between(T_made, T):.3f} degrees of rotation, {direction:.3f} of"
            " direction off"
        )
    compared(
        "F refined over seven numbers",
        rounds,
        lambda: refine_fundamental(fit_fundamental(x, y), x, y),
        peers={},
    )
    none = np.zeros((5, 1))
    t = T[:3, 3:].copy()
    rectified = (
        {"cv2": lambda: cv2.stereoRectify(K, none, L, none, (1024, 683), T[:3, :3].copy(), t)}
        if cv2
        else {}
    )
    compared("rectification", rounds, lambda: rectify(T, K, L), peers=rectified)


if __name__ == "__main__":
    main()
