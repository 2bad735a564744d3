"""The functions in the lesson's slots, and the mistakes that can be made in them."""

from dataclasses import dataclass, replace

import numpy as np

from lessons.curvature.inputs import Input
from workbench.algorithms.surfaces.curvature import Defects, Gaussian, MeanNormals
from workbench.geometry.meshes import on_boundary
from workbench.geometry.meshes.laplacian import mixed_areas


@dataclass(frozen=True)
class Functions:
    """What measures a mesh: angle defects, K, and the mean-curvature normals."""

    defects: Defects
    gaussian: Gaussian
    normals: MeanNormals


def with_mistake(params: Input, functions: Functions) -> Functions:
    """Return the three functions, one of them spoilt by the chosen mistake."""
    defects, gaussian, normals = functions.defects, functions.gaussian, functions.normals
    if params.mistake == "2 pi on the border":
        return replace(
            functions,
            defects=lambda p, faces: defects(p, faces) + np.pi * on_boundary(faces, len(p)),
        )
    if params.mistake == "defect taken for K":
        return replace(
            functions, gaussian=lambda p, faces: gaussian(p, faces) * mixed_areas(p, faces)
        )
    if params.mistake == "H without the half":
        return replace(functions, normals=lambda p, faces: 2 * normals(p, faces))
    return functions
