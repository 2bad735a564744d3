"""Compares principal axes and the similarity of pairs with scikit-learn, numpy, open3d,
scikit-image and trimesh.

    python -m tests.benchmarks.bench_alignment

Peers that are not installed are left out. Times are the best of a few runs, ours and the peers in
turn, so that a ratio is of one run on one machine. Below the time stands how far axis 3 of each is
off, a thousand kilometres from the origin.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
import scipy

from tests.benchmarks.bench_icp import best, line, open3d, optional, trimesh
from workbench.geometry.motions import exp_so3
from workbench.geometry.motions.alignment import align_similarity
from workbench.geometry.motions.principal_axes import (
    canonical_signs,
    degrees_between_axes,
    principal_axes,
)

AWAY = 1e6  # metres: where moments about the origin have lost their digits
N = 100_000

decomposition, transform = optional("sklearn.decomposition"), optional("skimage.transform")


def by_numpy(p: np.ndarray) -> np.ndarray:
    return np.linalg.eigh(np.cov(p.T))[1][:, ::-1]


def by_open3d(p: np.ndarray) -> np.ndarray:
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(p))
    return np.linalg.eigh(cloud.compute_mean_and_covariance()[1])[1][:, ::-1]


def by_sklearn(p: np.ndarray) -> np.ndarray:
    return decomposition.PCA(3).fit(p).components_.T


def bench_axes() -> None:
    p = np.random.default_rng(0).normal(size=(N, 3)) * [3.0, 2.0, 1.0] + 5.0
    peers: dict[str, Callable[[np.ndarray], np.ndarray]] = {"numpy": by_numpy}
    peers |= {"sklearn": by_sklearn} if decomposition else {}
    peers |= {"open3d": by_open3d} if open3d else {}
    ours, *theirs = best(
        lambda: principal_axes(p), *(lambda f=f: f(p) for f in peers.values()), repeat=15
    )
    line(
        "principal axes, 100,000 points",
        ours,
        dict(zip(peers, theirs, strict=True)),
        floor="0.7, ratio 0.2 to sklearn",
    )
    small = np.random.default_rng(1).normal(size=(5000, 3)) * [0.5, 0.3, 0.2]
    right = by_numpy(small)
    off = {
        name: degrees_between_axes(f(small + AWAY), right)[2]
        for name, f in {"ours": principal_axes, **peers}.items()
    }
    print(
        "    axis 3 off at 1e6 m, degrees: "
        + ", ".join(f"{name} {value:.4f}" for name, value in off.items())
    )
    ours = best(lambda: canonical_signs(right, p), repeat=15)[0]
    line("their signs by third moments, 100,000 points", ours, {})


def bench_similarity() -> None:
    p = np.random.default_rng(0).normal(size=(N, 3))
    q = 1.3 * p @ exp_so3(np.array([0.1, 0.2, 0.3])).T + [1.0, 2.0, 3.0]
    peers: dict[str, Callable[[], Any]] = {}
    if transform:
        kind = transform.SimilarityTransform
        estimate = getattr(kind, "from_estimate", None)
        peers["skimage"] = (
            (lambda: estimate(p, q))
            if estimate
            else (lambda: kind(dimensionality=3).estimate(p, q))
        )
    if trimesh:
        peers["trimesh"] = lambda: trimesh.registration.procrustes(p, q, reflection=False)
    peers["scipy"] = lambda: scipy.spatial.procrustes(q, p)
    ours, *theirs = best(lambda: align_similarity(q, p), *peers.values(), repeat=5)
    line(
        "similarity of pairs, 100,000",
        ours,
        dict(zip(peers, theirs, strict=True)),
        floor="3.0, ratio 0.33 to skimage",
    )


def main() -> None:
    print(f"{'task (ms)':<44} {'ours':>8}   {'peers':<44} {'ratio':>6}   floor")
    bench_axes()
    bench_similarity()


if __name__ == "__main__":
    main()
