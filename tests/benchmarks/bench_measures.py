"""Areas, volumes, samples and inside tests of meshes beside what is installed of igl, open3d,
trimesh and pyvista.

Run `python -m tests.benchmarks.bench_measures`. Least processor time of some runs, all threads; a
ratio is ours over the best peer that measures the same. open3d's `get_volume` first tests the mesh
for crossing itself and is timed on small meshes only; trimesh's `contains` casts rays one by one,
and is timed on a tenth of the points.

Areas and single inside tests stay behind igl (2.3-2.8 and 1.7 times its time when written): its
compiled loop gathers and measures a face at once, numpy writes each sum to memory in between. Whole
grids, which lessons ask for, are far ahead.
"""

import importlib
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import trimesh

from workbench.data.shapes import surfaces
from workbench.data.shapes.rabbit import rabbit_mesh
from workbench.geometry.fields.voxels import grid_over, occupied
from workbench.geometry.meshes.containment import columns, windings
from workbench.geometry.meshes.measures import signed_volume, surface_area
from workbench.geometry.points.sampling import points_on_faces

Task = Callable[[], Any]


def peer(name: str) -> Any:
    """Return an installed module or None."""
    try:
        return importlib.import_module(name)
    except ImportError:
        return None


def least(task: Task, repeats: int) -> tuple[float, float]:
    """Return the least processor time of some runs in ms, and the value as one number."""
    times = []
    value = 0.0
    for _ in range(repeats):
        start = time.process_time()
        value = task()
        times.append(1e3 * (time.process_time() - start))
    return min(times), float(np.sum(value))


def compare(
    name: str, ours: Task, peers: dict[str, Task], *, repeats: int = 7, exact: bool = True
) -> None:
    """Print one block: ours, each peer, and the ratio to the fastest of them; values must agree
    where they are exact.
    """
    own, value = least(ours, repeats)
    print(f"{name:44s} {'ours':22s} {own:9.1f} ms   value {value:.6g}", flush=True)
    times = []
    for label, task in peers.items():
        theirs, its = least(task, max(1, repeats // 2))
        times.append(theirs)
        off = (
            f"   VALUE OFF BY {its - value:+.2e}"
            if exact and abs(its - value) > 1e-6 * abs(value)
            else ""
        )
        print(f"{'':44s} {label:22s} {theirs:9.1f} ms   ratio {own / theirs:.2f}{off}", flush=True)
    if times:
        print(
            f"{'':44s} {'best':22s} {min(times):9.1f} ms   ratio {own / min(times):.2f}", flush=True
        )


def o3d_mesh(o3d: Any, p: np.ndarray, faces: np.ndarray) -> Any:
    return o3d.geometry.TriangleMesh(
        o3d.utility.Vector3dVector(p), o3d.utility.Vector3iVector(faces.astype(np.int32))
    )


def sizes(p: np.ndarray, faces: np.ndarray, igl: Any, *, o3d: Any) -> None:
    """Compare volumes and areas of one mesh."""
    volume: dict[str, Task] = {"trimesh": lambda: trimesh.Trimesh(p, faces, process=False).volume}
    area: dict[str, Task] = {"trimesh": lambda: trimesh.Trimesh(p, faces, process=False).area}
    if igl:
        volume["igl.centroid"] = lambda: igl.centroid(p, faces)[1]
        area["igl.doublearea"] = lambda: igl.doublearea(p, faces).sum() / 2
    if o3d:
        mesh = o3d_mesh(o3d, p, faces)
        area["open3d"] = mesh.get_surface_area
        if len(faces) < 6000:
            volume["open3d"] = mesh.get_volume
    name = f"{len(faces):,} faces"
    compare(f"volume, {name}", lambda: signed_volume(p, faces), volume)
    compare(f"area, {name}", lambda: surface_area(p, faces), area)


def samples(p: np.ndarray, faces: np.ndarray, n: int, *, o3d: Any) -> None:
    """Compare points drawn on one mesh."""
    rng = np.random.default_rng(0)
    mesh = trimesh.Trimesh(p, faces, process=False)
    peers: dict[str, Task] = {"trimesh": lambda: trimesh.sample.sample_surface(mesh, n, seed=0)[0]}
    if o3d:
        theirs = o3d_mesh(o3d, p, faces)
        peers["open3d"] = lambda: np.asarray(theirs.sample_points_uniformly(n).points)
    name = f"{n:,} points on {len(faces):,} faces"
    compare(
        name, lambda: points_on_faces(p, faces, rng.random((n, 3))), peers, repeats=5, exact=False
    )


def insides(n: int, igl: Any) -> None:
    """Compare inside tests on the rabbit, and its voxels."""
    p, faces = rabbit_mesh(0.035)
    q = np.random.default_rng(1).uniform(p.min(axis=0), p.max(axis=0), (n, 3))
    mesh = trimesh.Trimesh(p, faces, process=False)
    few = q[: n // 10]
    peers: dict[str, Task] = {}
    if igl:
        peers["igl fast winding"] = lambda: np.asarray(igl.fast_winding_number(p, faces, q)) > 0.5
    name = f"{n:,} points in {len(faces):,} faces"
    compare(name, lambda: windings(columns(p, faces), q) != 0, peers, exact=False)
    if peer("rtree"):
        contains: dict[str, Task] = {"trimesh contains": lambda: mesh.contains(few)}
        compare(
            f"{len(few):,} of them",
            lambda: windings(columns(p, faces), few) != 0,
            contains,
            repeats=2,
            exact=False,
        )
    grid = grid_over(p.min(axis=0), p.max(axis=0), 64, shift=np.zeros(3))
    pitch = float(grid.spacing[0])
    voxels: dict[str, Task] = {"trimesh voxelized, fill": lambda: trimesh_voxels(mesh, pitch)}
    if igl:
        centres = grid.centres()
        voxels["igl fast winding"] = lambda: (
            np.asarray(igl.fast_winding_number(p, faces, centres)) > 0.5
        )
    compare(
        "voxels, 64 along the longest side",
        lambda: occupied(p, faces, grid),
        voxels,
        repeats=3,
        exact=False,
    )


def trimesh_voxels(mesh: trimesh.Trimesh, pitch: float) -> np.ndarray:
    cells: Any = mesh.voxelized(pitch)
    return cells.fill().matrix  # surface cells count, so that it is fuller than ours


def main() -> None:
    """Print the table."""
    igl, o3d = peer("igl"), peer("open3d")
    for name, module in (("igl", igl), ("open3d", o3d), ("rtree", peer("rtree"))):
        if module is None:
            print(f"{name} is not installed and left out")
    for count in (2562, 163_842):
        ball = surfaces.sphere(count)
        sizes(ball.p, ball.faces, igl, o3d=o3d)
    ball = surfaces.sphere(40_962)
    samples(ball.p, ball.faces, 100_000, o3d=o3d)
    insides(20_000, igl)


if __name__ == "__main__":
    main()
