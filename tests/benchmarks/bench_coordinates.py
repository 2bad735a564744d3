"""Spherical coordinates and distances on a globe beside trimesh, astropy and pyproj, where they are
installed.

    python -m tests.benchmarks.bench_coordinates

The least time of some rounds, taking turns. trimesh takes the polar angle by arccos, which is 0 for
a billionth of a radian; pyproj goes over an ellipsoid, here flattened by nothing, which is more
work than a sphere needs: that ratio compares answers, not algorithms.
"""

import argparse

import numpy as np

from tests.benchmarks.bench_icp import best, line, optional
from workbench.geometry.shapes.curvilinear import cartesian_from_spherical, spherical_from_cartesian
from workbench.geometry.shapes.globe import EARTH_RADIUS, great_circle_distance
from workbench.geometry.shapes.projective import meet

N, WAYS = 1_000_000, 100_000
trimesh, astropy, pyproj = (optional(name) for name in ("trimesh", "astropy.coordinates", "pyproj"))


def bench_spherical(rounds: int) -> None:
    p = np.random.default_rng(0).normal(size=(N, 3))
    peers = {}
    if trimesh:
        n = p / np.linalg.norm(p, axis=1, keepdims=True)
        peers["trimesh, angles alone"] = lambda: trimesh.util.vector_to_spherical(n)
    if astropy:
        peers["astropy"] = lambda: astropy.cartesian_to_spherical(*p.T)
    ours, *theirs = best(lambda: spherical_from_cartesian(p), *peers.values(), repeat=rounds)
    line(
        "spherical coordinates, 1,000,000 points",
        ours,
        dict(zip(peers, theirs, strict=True)),
        floor="0.66 to trimesh",
    )
    c = spherical_from_cartesian(p)
    print(f"    back, farthest off: {np.abs(cartesian_from_spherical(c) - p).max():.1e} m")
    if trimesh:
        near = np.array([[np.sin(1e-9), 0.0, np.cos(1e-9)]])
        theirs = trimesh.util.vector_to_spherical(near)[0, 1]
        print(
            f"    polar angle of a billionth: ours {spherical_from_cartesian(near)[0, 1]:.3e},"
            f" trimesh {theirs:.3e}"
        )


def bench_distances(rounds: int) -> None:
    rng = np.random.default_rng(0)
    a, b = (
        np.column_stack([rng.uniform(-90, 90, WAYS), rng.uniform(-180, 180, WAYS)])
        for _ in range(2)
    )
    geod = pyproj.Geod(a=EARTH_RADIUS, f=0.0) if pyproj else None
    peers = {"pyproj": lambda: geod.inv(a[:, 1], a[:, 0], b[:, 1], b[:, 0])} if geod else {}
    ours, *theirs = best(lambda: great_circle_distance(a, b), *peers.values(), repeat=rounds)
    line("distances on a sphere, 100,000", ours, dict(zip(peers, theirs, strict=True)), floor="0.1")
    if geod:
        off = np.abs(
            great_circle_distance(a, b) - geod.inv(a[:, 1], a[:, 0], b[:, 1], b[:, 0])[2]
        ).max()
        earth = pyproj.Geod(ellps="WGS84").inv(a[:, 1], a[:, 0], b[:, 1], b[:, 0])[2]
        share = np.abs(great_circle_distance(a, b) / earth - 1)
        print(
            f"    farthest off: {off:.1e} m; the ellipsoid is {share.mean():.2%} off on average,"
            f" {share.max():.2%} at most"
        )


def bench_meetings(rounds: int) -> None:
    a, b = np.random.default_rng(0).normal(size=(2, N, 3))
    ours, theirs = best(lambda: meet(a, b), lambda: np.cross(a, b), repeat=rounds)
    line("meetings of lines, 1,000,000", ours, {"numpy": theirs})


def main() -> None:
    """Run all of them."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--rounds", type=int, default=5)
    rounds = parser.parse_args().rounds
    print(f"{'task (ms)':<44} {'ours':>8}   {'peers':<44} {'ratio':>6}   floor")
    bench_spherical(rounds)
    bench_distances(rounds)
    bench_meetings(rounds)


if __name__ == "__main__":
    main()
