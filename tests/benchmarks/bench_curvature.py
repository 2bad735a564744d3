"""Curvature of a mesh, and the spectrum of its Laplacian, beside their peers: `python -m
tests.benchmarks.bench_curvature`.

All contenders of a task see the same mesh in one run and on one thread, taking turns; figures are
medians of CPU milliseconds. K and H are followed by their relative L2 error in per cent on a
regular torus, where formulas converge, and on a jittered one, where only fits do. Floors are ratios
to the best peer that a prototype reached.
"""

# ruff: noqa: E402 (the number of threads is set before numpy starts them)
import importlib
import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VTK_SMP_MAX_THREADS"):
    os.environ.setdefault(_name, "1")

import statistics
import time
from collections.abc import Callable
from types import ModuleType

import numpy as np
import scipy

from workbench.data.shapes.surfaces import Surface, sphere, torus
from workbench.geometry.meshes.curvature import curvatures, gaussian_curvature
from workbench.geometry.meshes.laplacian import cotangent_laplacian, eigenpairs, mixed_areas
from workbench.geometry.meshes.quadric_fit import fit_quadrics

Estimate = tuple[np.ndarray | None, np.ndarray | None]
Contender = Callable[[], object]

FLOORS = {
    ("K and H", 20_000): 0.9,
    ("K and H", 200_000): 0.7,
    ("eigenpairs", "sphere"): 0.77,
    ("eigenpairs", "torus"): 0.56,
}


def main() -> None:
    """Print one table per task."""
    igl, pyvista, lapy = (peer(name) for name in ("igl", "pyvista", "lapy"))
    for count in (20_000, 200_000):
        jittered = torus(count, jitter=0.2, rng=np.random.default_rng(0))
        for surface, kind in ((torus(count), "regular"), (jittered, "jittered")):
            title = f"K and H of a {kind} torus, {len(surface.p):,} vertices"
            compare(
                title,
                both(surface, igl, pyvista),
                surface,
                floor=FLOORS.get(("K and H", count)),
                repeats=7,
            )
        compare(
            f"K alone, {count:,} vertices",
            gaussian(torus(count), igl, pyvista),
            torus(count),
            floor=None,
            repeats=7,
        )
    for count in (20_000, 200_000):
        surface = torus(count, jitter=0.2, rng=np.random.default_rng(0))
        title = f"K, H and directions by quadrics on a jittered torus, {len(surface.p):,} vertices"
        compare(title, fits(surface, igl), surface, floor=None, repeats=3)
    for name, surface in (("sphere", sphere(20_000)), ("torus", torus(20_000))):
        title = f"50 eigenpairs of the cotangent Laplacian, {name}, {len(surface.p):,} vertices"
        compare(
            title, spectra(surface, igl, lapy), None, floor=FLOORS["eigenpairs", name], repeats=2
        )


def both(
    surface: Surface, igl: ModuleType | None, pyvista: ModuleType | None
) -> dict[str, Contender]:
    """Return who gives K and H: we give k1, k2, normals and areas too."""
    p, faces = surface.p, surface.faces

    def ours() -> Estimate:
        estimate = curvatures(p, faces)
        return estimate.gaussian, estimate.mean

    contenders: dict[str, Contender] = {"ours": ours}
    if igl is not None:

        def theirs() -> Estimate:
            areas = igl.massmatrix(p, faces, igl.MASSMATRIX_TYPE_VORONOI).diagonal()
            normals = -(igl.cotmatrix(p, faces) @ p) / areas[:, None]
            return igl.gaussian_curvature(p, faces) / areas, np.linalg.norm(normals, axis=1) / 2

        contenders["igl"] = theirs
    if pyvista is not None:
        contenders["pyvista"] = lambda: tuple(
            pyvista.PolyData.from_regular_faces(p, faces).curvature(kind)
            for kind in ("gaussian", "mean")
        )
    return contenders


def gaussian(
    surface: Surface, igl: ModuleType | None, pyvista: ModuleType | None
) -> dict[str, Contender]:
    """Return who gives K alone; pyvista divides by a third of the faces around, not by mixed
    areas.
    """
    p, faces = surface.p, surface.faces
    contenders: dict[str, Contender] = {"ours": lambda: (gaussian_curvature(p, faces), None)}
    if igl is not None:
        contenders["igl"] = lambda: (
            igl.gaussian_curvature(p, faces)
            / igl.massmatrix(p, faces, igl.MASSMATRIX_TYPE_VORONOI).diagonal(),
            None,
        )
    if pyvista is not None:
        contenders["pyvista"] = lambda: (
            pyvista.PolyData.from_regular_faces(p, faces).curvature("gaussian"),
            None,
        )
    return contenders


def fits(surface: Surface, igl: ModuleType | None) -> dict[str, Contender]:
    """Return who fits quadrics: igl over all vertices within five mean edges unless told
    otherwise.
    """
    p, faces = surface.p, surface.faces

    def ours() -> Estimate:
        quadrics = fit_quadrics(p, faces)
        quadrics.principal_directions()
        return quadrics.curvatures()

    def theirs(radius: int) -> Estimate:
        assert igl is not None
        _, _, k1, k2, _ = igl.principal_curvature(p, faces, radius)
        return k1 * k2, (k1 + k2) / 2

    contenders: dict[str, Contender] = {"ours, 2 rings": ours}
    if igl is not None and len(p) < 50_000:
        contenders |= {"igl, radius 2": lambda: theirs(2), "igl, radius 5": lambda: theirs(5)}
    return contenders


def spectra(
    surface: Surface, igl: ModuleType | None, lapy: ModuleType | None
) -> dict[str, Contender]:
    """Return who finds the smallest eigenvalues of L u = lambda M u; what is returned is their sum,
    to compare.
    """
    p, faces = surface.p, surface.faces

    def shifted(L: object, M: object) -> float:
        return float(scipy.sparse.linalg.eigsh(L, 50, M, sigma=-0.01)[0].sum())  # type: ignore[arg-type]

    def plain() -> float:
        return shifted(
            cotangent_laplacian(p, faces).tocsc(),
            scipy.sparse.diags_array(mixed_areas(p, faces)).tocsc(),
        )

    contenders: dict[str, Contender] = {"ours": lambda: float(eigenpairs(p, faces, 50)[0].sum())}
    contenders["our L, eigsh as it is"] = plain
    if igl is not None:
        contenders["igl + eigsh"] = lambda: shifted(
            -igl.cotmatrix(p, faces), igl.massmatrix(p, faces, igl.MASSMATRIX_TYPE_VORONOI)
        )
    if lapy is not None:
        contenders["lapy"] = lambda: float(
            lapy.Solver(lapy.TriaMesh(p, faces), lump=True).eigs(50)[0].sum()
        )
    return contenders


def compare(
    title: str,
    contenders: dict[str, Contender],
    surface: Surface | None,
    *,
    floor: float | None,
    repeats: int,
) -> dict[str, float]:
    """Run all contenders in turns, print their figures and our ratio to each, and return the
    medians, milliseconds.
    """
    times: dict[str, list[float]] = {name: [] for name in contenders}
    answers = {name: contender() for name, contender in contenders.items()}
    for _ in range(repeats):
        for name, contender in contenders.items():
            started = time.process_time()
            contender()
            times[name].append(1e3 * (time.process_time() - started))
    medians = {name: statistics.median(spent) for name, spent in times.items()}
    ours = next(iter(medians.values()))
    print(f"\n{title}" + (f"   (floor, ours to the best peer: {floor})" if floor else ""))
    heads = ("K error %", "H error %") if surface else ("what must agree", "")
    print(f"  {'':24}{'ms':>9}{'ours / it':>11}{heads[0]:>20}{heads[1]:>12}")
    for name, answer in answers.items():
        print(
            f"  {name:24}{medians[name]:9.1f}{ours / medians[name]:11.2f}{describe(answer, surface)}"  # noqa: E501
        )
    return medians


def describe(answer: object, surface: Surface | None) -> str:
    """Write down how far K and H are from the truth, in per cent; H without its sign, which not all
    peers give.
    """
    if surface is None or not isinstance(answer, tuple):
        return f"{answer:20.4f}"
    cells = []
    for estimate, true in zip(answer, (surface.gaussian, np.abs(surface.mean)), strict=True):
        if estimate is None:
            cells.append("-")
            continue
        estimate = np.abs(estimate) if len(cells) else estimate
        cells.append(f"{100 * np.linalg.norm(estimate - true) / np.linalg.norm(true):.3f}")
    return f"{cells[0]:>20}{cells[1]:>12}"


def peer(name: str) -> ModuleType | None:
    """Return a module where it is installed."""
    try:
        return importlib.import_module(name)
    except ImportError:
        print(f"{name} is not installed and left out")
        return None


if __name__ == "__main__":
    main()
