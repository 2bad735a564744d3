"""The last step: four meshes of one surface in a row, ever finer, coloured by the error of K."""

import numpy as np

from lessons.curvature.state import State, Study
from workbench.geometry.meshes import edges
from workbench.numerals import percent
from workbench.scene import Field, Label, Mesh, Primitive, Segments

ALONG = np.array([2.4, 2.05, 0.0]) / np.hypot(2.4, 2.05)  # to the right of who looks at the lesson
WIDTH, BETWEEN = 0.95, 1.05  # metres: how wide one mesh is drawn, and how far the next one is
MOST_EDGES = 4000  # more of them hide the colours
SCALE = (-3.0, 1.0)  # log₁₀ of 1/m^2: one for all surfaces, so that a colour always means the same


def drawn(state: State, study: Study) -> dict[str, Primitive]:
    """Return the four meshes on one scale of colours, each with its vertices and its error."""
    scene: dict[str, Primitive] = {}
    spread = max(float(np.ptp(mesh.p, axis=0).max()) for mesh in study.meshes)
    middle = (len(study.meshes) - 1) / 2
    for k, (mesh, off) in enumerate(zip(study.meshes, study.off, strict=True)):
        p = WIDTH / spread * mesh.p + (k - middle) * BETWEEN * ALONG
        size = np.log10(np.maximum(np.abs(off), 10.0 ** SCALE[0]))
        color = Field(size, *SCALE, "log₁₀ error of K from angles", "m⁻²")
        scene[f"meshes/{k + 1}"] = Mesh(p, mesh.faces, color)
        lines = edges(mesh.faces)
        if len(lines) <= MOST_EDGES:
            scene[f"meshes/{k + 1} edges"] = Segments(p[lines], "neutral", 1, opacity=0.35)
        at = (k - middle) * BETWEEN * ALONG
        top = np.array([0.0, 0.0, float(p[:, 2].max()) + 0.22])
        below = np.array([0.0, 0.0, float(p[:, 2].min()) - 0.4])
        scene[f"meshes/{k + 1} words"] = Label(f"{len(p):,} vertices", at + below)
        scene[f"meshes/{k + 1} error"] = Label(percent(study.K[k]), at + top, "source")
    return scene
