"""A camera calibrated from 13 pictures of a board, beside OpenCV: `python -m
tests.benchmarks.bench_calibration`.

The same corners for both, all nine shared unknowns free, every step of ours computed; on one
thread, taking turns: the least of the rounds in CPU milliseconds, and the median of the ratios of
the turns. Ours may take twice as long. Behind them how far the answers are apart: the rms in px,
the largest entry of K in px, the largest of nine standard deviations. Real corners where
../shared/data is beside the project, else a scene of ours.
"""

# ruff: noqa: E402 (the number of threads is set before numpy starts them)
import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

import argparse
import time
from pathlib import Path

import numpy as np

from tests.benchmarks.bench_curvature import peer
from workbench.algorithms.cameras.calibration import State, calibrate
from workbench.data.views import boards

CORNERS = Path(__file__).parents[3] / "shared" / "data" / "calibration" / "corners_9x6.npz"


def main() -> None:
    """Print a line per camera."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--rounds", type=int, default=11)
    rounds = parser.parse_args().rounds
    cv2 = peer("cv2")
    print(
        f"{'camera':12}{'ours ms':>9}{'cv2 ms':>9}{'ratio':>8}{'at most':>9}{'rms':>11}{'K':>11}{'±':>11}"  # noqa: E501
    )
    for name, (p, uv) in cameras().items():

        def ours(p: np.ndarray = p, uv: np.ndarray = uv) -> State:
            *_, last = calibrate(p, uv, boards.SIZE)
            return last

        adjustment = ours().adjustment
        spent = []
        assert adjustment is not None
        if cv2 is None:
            print(f"{name:12}{min(timed(ours) for _ in range(rounds)):9.1f}")
            continue
        cv2.setNumThreads(1)
        given = (
            [p.astype(np.float32)] * len(uv),
            [pixels.astype(np.float32)[:, None] for pixels in uv],
        )

        def theirs(given: tuple = given, solve=cv2.calibrateCameraExtended) -> tuple:
            return solve(*given, boards.SIZE, None, None)

        other = theirs()
        for _ in range(rounds):
            spent.append((timed(ours), timed(theirs)))
        least = np.min(spent, axis=0)
        ratio = float(np.median([a / b for a, b in spent]))
        apart = (
            abs(np.sqrt(adjustment.cost / (uv.size / 2)) - other[0]),
            np.abs(adjustment.K - other[1]).max(),
            np.abs(adjustment.deviations - other[5].ravel()[:9]).max(),
        )
        print(
            f"{name:12}{least[0]:9.1f}{least[1]:9.1f}{ratio:8.2f}{2:9.0f}"
            + "".join(f"{difference:11.1e}" for difference in apart)
        )


def cameras() -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Return points of the board and their pixels, by camera."""
    rng = np.random.default_rng(0)
    Ts = boards.board_poses(rng, 13, tilt=0.5, distance=0.4, spread=1.0)
    views = {"built-in": (boards.board_points(), boards.board_pixels(rng, Ts, sigma=0.2))}
    if CORNERS.is_file():
        arrays = np.load(CORNERS)
        views |= {
            f"real {side}": (arrays["object_points"].astype(float), arrays[side].astype(float))
            for side in ("left", "right")
        }
    return views


def timed(task) -> float:
    """Return the CPU milliseconds of a call."""
    started = time.process_time()
    task()
    return 1e3 * (time.process_time() - started)


if __name__ == "__main__":
    main()
