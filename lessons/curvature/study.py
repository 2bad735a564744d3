"""How wrong the estimates are, and whether a finer mesh makes them better."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from lessons.curvature.inputs import Input
from lessons.curvature.mesh import surface_of
from lessons.curvature.state import Study
from workbench.algorithms.surfaces.curvature import Gaussian, MeanNormals
from workbench.data.shapes.surfaces import Surface
from workbench.geometry.meshes import on_boundary, vertex_normals
from workbench.geometry.meshes.curvature import mean_from_normals
from workbench.geometry.meshes.quadric_fit import fit_quadrics
from workbench.lesson import cached

Letter = Literal["gaussian", "mean"]
COUNTS = (400, 1000, 2500, 6400)


def study_of(
    params: Input, gaussian_curvature: Gaussian, mean_curvature_normals: MeanNormals
) -> Study:
    """Measure a built-in surface on four meshes, the last with edges four times shorter than the
    first.
    """
    errors: dict[str, list[float]] = {name: [] for name in ("K", "H", "K_fit", "H_fit")}
    meshes = _meshes(params)
    off = []
    for made in meshes:
        p, faces = made.surface.p, made.surface.faces
        K = gaussian_curvature(p, faces)
        off.append(np.where(made.inside, K - made.surface.gaussian, np.nan))
        H = mean_from_normals(mean_curvature_normals(p, faces), made.normals)
        estimates: tuple[tuple[str, Letter, np.ndarray], ...] = (
            ("K", "gaussian", K),
            ("H", "mean", H),
            ("K_fit", "gaussian", made.K_fit),
            ("H_fit", "mean", made.H_fit),
        )
        for name, letter, estimate in estimates:
            errors[name].append(error_of(made.surface, made.inside, letter, estimate=estimate))
    counts = np.array([len(made.surface.p) for made in meshes], dtype=float)
    return Study(
        counts=counts,
        meshes=tuple(made.surface for made in meshes),
        off=tuple(off),
        **{name: np.array(values) for name, values in errors.items()},
    )


@dataclass(frozen=True, eq=False, kw_only=True)
class _Made:
    """One of the four meshes, and what does not depend on the functions in the slots."""

    surface: Surface
    inside: np.ndarray
    normals: np.ndarray
    K_fit: np.ndarray
    H_fit: np.ndarray


@cached
def _meshes(params: Input) -> tuple[_Made, ...]:
    return tuple(_made(surface_of(params, count)) for count in COUNTS)


def _made(surface: Surface) -> _Made:
    p, faces = surface.p, surface.faces
    K_fit, H_fit = fit_quadrics(p, faces).curvatures()
    return _Made(
        surface=surface,
        inside=~on_boundary(faces, len(p)),
        normals=vertex_normals(p, faces),
        K_fit=K_fit,
        H_fit=H_fit,
    )


def error_of(surface: Surface, inside: np.ndarray, name: Letter, *, estimate: np.ndarray) -> float:
    """Return the relative L2 error of K or H over the vertices inside the border.

    Where the truth is 0 everywhere, the error is related to what the larger principal curvature
    alone would give, and on a plane to a sphere of one metre.
    """
    true = getattr(surface, name)[inside]
    size = np.linalg.norm(true)
    if size <= 1e-6 * np.sqrt(len(true)):
        larger = np.maximum(np.abs(surface.k1), np.abs(surface.k2))[inside]
        size = np.linalg.norm(larger**2 if name == "gaussian" else larger)
    return float(np.linalg.norm(estimate[inside] - true) / (size or np.sqrt(len(true))))
