"""Where a camera was that saw four points or more: EPnP, by four control points.

Every point is a weighted sum of the control points, in the world and in the camera's frame alike.
That each point lies on its ray is linear in the control points' coordinates x in the camera's
frame: M x = 0. So x is a mix of the null vectors of M, or of its lowest ones where there is noise,
and the mix is the one that keeps the control points' distances. The cost grows with the number of
points.
Reference: Lepetit, Moreno-Noguer and Fua, EPnP: An Accurate O(n) Solution to the PnP Problem, IJCV
81, 2009.
"""

import numpy as np
from jaxtyping import Float

from workbench.geometry.cameras.camera_motions import ray_forms, rms_reprojection
from workbench.geometry.cameras.planar_motions import FLAT
from workbench.geometry.motions.alignment import nearest_rotation

_STEPS = 10
_NUDGE = 1e-12


def epnp(
    p_world: Float[np.ndarray, "*k n 3"], xy: Float[np.ndarray, "*k n 2"]
) -> Float[np.ndarray, "*k 4 4"]:
    """Return the motions T_camera_world by EPnP: the best mix of N = 1 to 4 null vectors.

    Points of one plane have three control points and mixes of up to three vectors. Four points
    leave four null vectors, so that only the control points' distances decide: six equations,
    solved by Gauss-Newton from a linear start, that may end elsewhere.
    Reference: Lepetit et al. 2009, 3.1 to 3.5. For N = 4 the linear start has the products with the
    first weight alone as unknowns, as in the authors' program; the paper relinearises.

    Raises:
        ValueError: If there are fewer than four points, or they lie on one line.
    """
    if p_world.shape[-2] < 4:
        raise ValueError(f"EPnP takes four points or more, not {p_world.shape[-2]}")
    batch = p_world.shape[:-2]
    p, xy = (rows.reshape(-1, *rows.shape[-2:]) for rows in (p_world, xy))
    p_mean = p.mean(axis=1)
    q = p - p_mean[:, None]
    _, extents, axes = np.linalg.svd(q, full_matrices=False)
    if not (extents[:, 1] > 1e-9 * extents[:, 0]).all():
        raise ValueError("EPnP takes points that do not lie on one line")
    flat = extents[:, 2] <= FLAT * extents[:, 1]
    T = np.tile(np.eye(4), (len(p), 1, 1))
    for rows, directions in ((flat, 2), (~flat, 3)):
        if rows.any():
            arms = (extents[rows, :directions, None] / np.sqrt(q.shape[1])) * axes[
                rows, :directions
            ]
            along = q[rows] @ np.swapaxes(arms, 1, 2)
            # Either end of an axis would do: the heavier one
            lean = (along * along * along).sum(axis=1)
            T[rows] = _motions(q[rows], xy[rows], np.where(lean < 0.0, -1.0, 1.0)[..., None] * arms)
    T[:, :3, 3] -= (T[:, :3, :3] @ p_mean[..., None])[..., 0]
    return T.reshape(*batch, 4, 4)


def _motions(q: np.ndarray, xy: np.ndarray, arms: np.ndarray) -> np.ndarray:
    """Return the motions for points about their mean, the arms' ends being control points too."""
    along = q @ np.swapaxes(arms / np.square(arms).sum(axis=-1, keepdims=True), 1, 2)
    # (k, n, c), barycentric
    shares = np.concatenate([1.0 - along.sum(axis=-1, keepdims=True), along], axis=-1)
    controls = np.concatenate([np.zeros_like(arms[:, :1]), arms], axis=1)
    vectors = _null_vectors(shares, xy)
    first, second = np.triu_indices(controls.shape[1], 1)
    apart = vectors[:, :, first] - vectors[:, :, second]
    products = np.einsum("kaex,kbex->kabe", apart, apart)
    squared = np.square(controls[:, first] - controls[:, second]).sum(axis=-1)
    starts = np.stack([_start(products, squared, N) for N in range(1, controls.shape[1] + 1)])
    mixes = _downhill(starts, products, squared)
    p_camera = shares @ np.einsum("Nka,kacx->Nkcx", mixes, vectors)
    p_camera *= np.where(p_camera[..., 2].sum(axis=-1) < 0.0, -1.0, 1.0)[..., None, None]
    Ts = np.zeros((*p_camera.shape[:2], 4, 4))
    Ts[..., :3, :3] = nearest_rotation(np.swapaxes(p_camera, -1, -2) @ q)
    Ts[..., :3, 3] = p_camera.mean(axis=-2)
    Ts[..., 3, 3] = 1.0
    return Ts[np.argmin(rms_reprojection(Ts, q, xy), axis=0), np.arange(len(q))]


def _null_vectors(shares: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Return the lowest vectors of M' M, one per control point, as places: (k, c, c, 3)."""
    k, n, c = shares.shape
    pairs = (shares[..., :, None] * shares[..., None, :]).reshape(k, n, c * c)
    blocks = (np.swapaxes(pairs, 1, 2) @ ray_forms(xy).reshape(k, n, 9)).reshape(k, c, c, 3, 3)
    MtM = blocks.transpose(0, 1, 3, 2, 4).reshape(k, 3 * c, 3 * c)
    nudge = np.trace(MtM, axis1=1, axis2=2)[:, None] * _NUDGE * np.arange(3 * c)
    # Of four points any basis would do: not rounding shall choose it
    MtM[:, range(3 * c), range(3 * c)] += nudge
    return np.swapaxes(np.linalg.eigh(MtM)[1][..., :c], 1, 2).reshape(k, c, c, 3)


def _start(products: np.ndarray, squared: np.ndarray, N: int) -> np.ndarray:
    """Return weights of the first N vectors, by linear equations in their products (3.3)."""
    c = products.shape[1]
    a, b = np.triu_indices(N) if c > N else (np.zeros(N, int), np.arange(N))
    L = np.where(a == b, 1.0, 2.0) * np.swapaxes(products[:, a, b], 1, 2)
    solution = (np.linalg.pinv(L) @ squared[..., None])[..., 0]
    if c == N:
        least = 1e-9 * np.abs(solution).max(axis=1, keepdims=True) + 1e-300
        first = np.sqrt(np.maximum(np.abs(solution[:, :1]), least))
        return np.concatenate([first, np.sign(solution[:, :1]) * solution[:, 1:] / first], axis=1)
    B = np.zeros((len(products), N, N))
    B[:, a, b] = B[:, b, a] = solution
    values, vectors = np.linalg.eigh(B)  # products of weights have rank one: take the nearest
    weights = np.zeros((len(products), c))
    weights[:, :N] = np.sqrt(np.maximum(values[:, -1:], 0.0)) * vectors[..., -1]
    return weights


def _downhill(weights: np.ndarray, products: np.ndarray, squared: np.ndarray) -> np.ndarray:
    """Take Gauss-Newton steps on control points' squared distances from several starts (3.5)."""
    c = products.shape[1]
    along = np.moveaxis(products, 3, 1)
    for _ in range(_STEPS):
        half = (along @ weights[..., None, :, None])[..., 0]
        left = (half @ weights[..., None])[..., 0] - squared
        J = 2.0 * half
        A = np.swapaxes(J, -1, -2) @ J
        A[..., range(c), range(c)] += 1e-12 * np.trace(A, axis1=-2, axis2=-1)[..., None] + 1e-300
        weights = weights - np.linalg.solve(A, np.swapaxes(J, -1, -2) @ left[..., None])[..., 0]
    return weights
