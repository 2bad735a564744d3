"""Fits of circles, cylinders and lines beside scipy, circle-fit and OpenCV, where they are
installed.

    python -m tests.benchmarks.bench_fitting

The least time of some rounds, taking turns, of 20 fits each. Ours is the lesson's descent with
every moment of it, as the lesson draws it. cv2.fitLine iterates with Huber's weights, which let
outliers pull (compare the angles), in a compiled loop over points.
"""

# ruff: noqa: E402

import argparse
import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

import numpy as np
import scipy

from lessons.fitting.fit_scenes import arc_points, pipe_points
from lessons.fitting.round_shapes import CIRCLE, CYLINDER, RoundShape
from tests.benchmarks.bench_icp import best, line, optional
from tests.truths.fitting import distances
from workbench.algorithms.least_squares import damped_step, descend
from workbench.algorithms.robust import HUBER, TUKEY, reweighted_fit
from workbench.algorithms.robust.models import LINE
from workbench.geometry.shapes.algebraic_fits import fit_algebraic
from workbench.geometry.shapes.lines_planes import line_angle

N, FITS = 1000, 20
circle_fit, cv2 = optional("circle_fit"), optional("cv2")


def descent(shape: RoundShape, p: np.ndarray, start: np.ndarray) -> np.ndarray:
    *_, end = descend(
        lambda c: shape.linearise(c, p),
        shape.retract,
        start,
        damped_step=damped_step,
        tolerance=1e-10,
    )
    return end.unknown


def several(fit):
    def fits():
        for _ in range(FITS):
            fit()

    return fits


def compare(task: str, ours, peers: dict, *, floor: str = "") -> None:
    mine, *theirs = best(several(ours), *(several(peer) for peer in peers.values()), repeat=ROUNDS)
    line(f"{task}, {FITS} times", mine, dict(zip(peers, theirs, strict=True)), floor=floor)


def bench_circle() -> None:
    p = arc_points(np.radians(90), N) + 0.02 * np.random.default_rng(0).normal(size=(N, 2))
    start = np.array([0.5, 0.4, 0.7])

    def scipys() -> np.ndarray:
        return scipy.optimize.least_squares(
            lambda c: CIRCLE.linearise(c, p)[0], start, method="lm"
        ).x

    compare(
        "circle, 1,000 points, from afar", lambda: descent(CIRCLE, p, start), {"scipy lm": scipys}
    )
    print(f"    R: ours {descent(CIRCLE, p, start)[2]:.5f}, scipy {scipys()[2]:.5f}")
    peers = {"circle-fit": lambda: circle_fit.taubinSVD(p)} if circle_fit else {}
    compare("Taubin's circle, 1,000 points", lambda: fit_algebraic(p), peers)
    if circle_fit:
        print(f"    R: ours {fit_algebraic(p)[2]:.5f}, circle-fit {circle_fit.taubinSVD(p)[2]:.5f}")


def bench_cylinder() -> None:
    p = pipe_points(2 * np.pi, 2000) + 0.01 * np.random.default_rng(0).normal(size=(2000, 3))
    lean = np.array([0.0, 0, 0, np.sin(0.5), 0, np.cos(0.5), 1.0])

    def scipys():
        away = lambda x: distances("cylinder", np.array([x[0], x[1], 0, x[2], x[3], 1, x[4]]), p)  # noqa: E731
        return scipy.optimize.least_squares(away, [0, 0, np.tan(0.5), 0, 1.0], method="lm").x

    compare("cylinder, 2,000 points", lambda: descent(CYLINDER, p, lean), {"scipy lm": scipys})
    print(f"    R: ours {descent(CYLINDER, p, lean)[6]:.5f}, scipy {scipys()[4]:.5f}")


def bench_line() -> None:
    rng = np.random.default_rng(0)
    x = np.linspace(0, 1, 200)
    p = np.column_stack([x, 0.5 * x]) + 0.01 * rng.normal(size=(200, 2))
    p[:40, 1] += rng.uniform(0, 1, 40)

    def ours():
        *_, huber = reweighted_fit(p, LINE, HUBER, corner=0.01345)
        *_, tukey = reweighted_fit(p, LINE, TUKEY, corner=0.04685, start=huber.estimate)
        return tukey.estimate

    def opencvs():
        return cv2.fitLine(p.astype(np.float32), cv2.DIST_HUBER, 0, 1e-4, 1e-4).ravel()

    compare(
        "line, 200 points, 40 off: Huber, then Tukey", ours, {"cv2 HUBER": opencvs} if cv2 else {}
    )
    true = np.degrees(np.arctan(0.5))
    print(f"    degrees off: ours {abs(np.degrees(line_angle(ours())) - true):.2f}", end="")
    if cv2:
        vx, vy, *_ = opencvs()
        print(f", cv2 {abs(np.degrees(np.arctan2(vy, vx)) - true):.2f}", end="")
    print()


ROUNDS = 5


def main() -> None:
    """Run all of them."""
    global ROUNDS
    parser = argparse.ArgumentParser()
    parser.add_argument("--rounds", type=int, default=ROUNDS)
    ROUNDS = parser.parse_args().rounds
    print(f"{'task (ms)':<44} {'ours':>8}   {'peers':<44} {'ratio':>6}   floor")
    bench_circle()
    bench_cylinder()
    bench_line()


if __name__ == "__main__":
    main()
