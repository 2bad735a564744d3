"""A camera's motion as a model for RANSAC: three points give up to four estimates.

Reference: Fischler and Bolles, Random Sample Consensus, 1981, section IV (the location
determination problem).
"""

import numpy as np
from jaxtyping import Float

from workbench.algorithms.robust.models import Model, finite
from workbench.geometry.cameras import normalize
from workbench.geometry.cameras.camera_motions import refined, reprojection_errors, sqpnp
from workbench.geometry.cameras.three_points import p3p


def camera_model(K: Float[np.ndarray, "3 3"]) -> Model:
    """Return the model with estimates T_camera_world and rows (X, Y, Z, u, v), metres and pixels.

    Distances are reprojection errors in pixels, infinite for a point behind the camera.
    """
    f = float(K[0, 0])

    def parts(rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return rows[..., :3], normalize(rows[..., 3:].reshape(-1, 2), K).reshape(
            *rows.shape[:-1], 2
        )

    def refit(
        rows: np.ndarray, weights: np.ndarray | None = None, start: np.ndarray | None = None
    ) -> np.ndarray:
        p_world, xy = parts(rows)
        T = sqpnp(p_world, xy) if start is None else start
        return refined(T[None], p_world, xy, weights=weights)[0]

    return Model(
        name="camera",
        sample_size=3,
        fewest=4,
        columns=5,
        unit="px",
        degenerate_when="the three points lie on one line",
        solve=lambda samples: finite(p3p(*parts(samples))[0]),
        distances=lambda Ts, rows: f * reprojection_errors(Ts, *parts(rows)),
        refit=refit,
        solve_each=lambda samples: p3p(*parts(samples)),
    )
