"""How wrong the estimates are, and whether a finer mesh makes them better."""

import functools
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from lessons.curvature.params import Params
from lessons.curvature.subject import shape_of, surface_of
from workbench.algorithms.curvature import Gaussian, MeanNormals
from workbench.data.surfaces import Surface
from workbench.geometry.curvature import mean_from_normals
from workbench.geometry.meshes import on_boundary, vertex_normals
from workbench.geometry.quadric_fit import fit_quadrics

Letter = Literal["gaussian", "mean"]
COUNTS = (400, 1000, 2500, 6400)


@dataclass(frozen=True, eq=False)
class Study:
    """Relative errors of four estimates on ever finer meshes of one surface.

    Attributes:
        counts: How many vertices the meshes have.
        K, H: Errors of the angle defects and the cotangents.
        K_fit, H_fit: Errors of the quadric fits.
    """

    counts: np.ndarray
    K: np.ndarray
    H: np.ndarray
    K_fit: np.ndarray
    H_fit: np.ndarray


def study_of(params: Params, gaussian_curvature: Gaussian, mean_curvature_normals: MeanNormals) -> Study:
    """Measure a built-in surface on four meshes, the last with edges four times shorter than the first."""
    rows = []
    for made in _meshes(*shape_of(params)):
        p, faces, inside = made.surface.p, made.surface.faces, made.inside
        H = mean_from_normals(mean_curvature_normals(p, faces), made.normals)
        estimates: tuple[tuple[np.ndarray, Letter], ...] = (
            (gaussian_curvature(p, faces), "gaussian"),
            (H, "mean"),
            (made.K_fit, "gaussian"),
            (made.H_fit, "mean"),
        )
        rows.append((len(p), *(error_of(made.surface, inside, name, estimate) for estimate, name in estimates)))
    return Study(*np.array(rows, dtype=float).T)


@dataclass(frozen=True, eq=False)
class _Made:
    """One of the four meshes, and what does not depend on the functions in the slots."""

    surface: Surface
    inside: np.ndarray
    normals: np.ndarray
    K_fit: np.ndarray
    H_fit: np.ndarray


@functools.lru_cache(maxsize=8)
def _meshes(name: str, *rest: Any) -> tuple[_Made, ...]:
    surfaces = [surface_of(name, count, *rest) for count in COUNTS]
    return tuple(
        _Made(
            s, ~on_boundary(s.faces, len(s.p)), vertex_normals(s.p, s.faces), *fit_quadrics(s.p, s.faces).curvatures()
        )
        for s in surfaces
    )


def error_of(surface: Surface, inside: np.ndarray, name: Letter, estimate: np.ndarray) -> float:
    """Return the relative L2 error of K or H over the vertices inside the border.

    Where the truth is 0 everywhere, the error is related to what the larger principal curvature alone would give, and on
    a plane to a sphere of one metre.
    """
    true = getattr(surface, name)[inside]
    size = np.linalg.norm(true)
    if size <= 1e-6 * np.sqrt(len(true)):
        larger = np.maximum(np.abs(surface.k1), np.abs(surface.k2))[inside]
        size = np.linalg.norm(larger**2 if name == "gaussian" else larger)
    return float(np.linalg.norm(estimate[inside] - true) / (size or np.sqrt(len(true))))
