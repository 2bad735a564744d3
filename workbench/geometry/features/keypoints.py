"""Places that can be found again: corners of pictures, and salient points of clouds.

References: Harris and Stephens, A combined corner and edge detector, 1988; Zhong, Intrinsic shape
signatures, 2009.
"""

import numpy as np
import scipy
from jaxtyping import Float, Int

from workbench.geometry.features.fpfh import pairs_within

Image = Float[np.ndarray, "h w"]
DERIVE, GATHER = 1.0, 1.5  # standard deviations, pixels: before the gradient, and of the window
HARRIS = 0.04


def gradient(image: Image, sigma: float = DERIVE) -> tuple[Image, Image]:
    """Return the derivatives of a smoothed picture along u and v, grey levels per pixel."""
    smooth = scipy.ndimage.gaussian_filter(image, sigma)
    return scipy.ndimage.sobel(smooth, axis=1) / 8.0, scipy.ndimage.sobel(smooth, axis=0) / 8.0


def harris_response(image: Image) -> Image:
    """Return det(M) - 0.04 trace(M)^2: large at corners, negative at edges, near 0 elsewhere.

    M holds products of the derivatives, each smoothed by a Gaussian of 1.5 px (section 3).
    """
    g_u, g_v = gradient(image)
    mixed = g_u * g_v
    g_u *= g_u
    g_v *= g_v
    for product in (g_u, mixed, g_v):
        scipy.ndimage.gaussian_filter(product, GATHER, output=product)
    a, b, c = g_u, mixed, g_v
    response = a * c
    response -= np.square(b, out=b)
    a += c
    response -= HARRIS * np.square(a, out=a)
    return response


def strongest(
    response: Image, count: int, *, apart: int = 4, border: int = 0
) -> Int[np.ndarray, "k 2"]:
    """Return the largest local maxima (u, v) within `apart` pixels, `border` inside, in order."""
    top = (response == scipy.ndimage.maximum_filter(response, 2 * apart + 1)) & (response > 0)
    inside = np.zeros_like(top)
    h, w = top.shape
    inside[border : h - border, border : w - border] = True
    v, u = np.nonzero(top & inside)
    order = np.argsort(-response[v, u], kind="stable")[:count]
    return np.column_stack([u[order], v[order]])


def patches(image: Image, uv: Int[np.ndarray, "n 2"], side: int) -> Float[np.ndarray, "n d"]:
    """Return smoothed grey levels around pixels, of mean 0 and length 1; `side` is odd."""
    smooth = scipy.ndimage.gaussian_filter(image, DERIVE)
    d = np.arange(side) - side // 2
    levels = smooth[uv[:, 1, None, None] + d[:, None], uv[:, 0, None, None] + d].reshape(
        len(uv), side * side
    )
    levels = levels - levels.mean(axis=1, keepdims=True)
    return levels / np.maximum(np.linalg.norm(levels, axis=1, keepdims=True), 1e-9)


def iss_keypoints(
    p: Float[np.ndarray, "n 3"],
    radius: float,
    apart: float,
    *,
    ratio: float = 0.975,
    fewest: int = 5,
) -> Int[np.ndarray, " k"]:
    """Return the indices of salient points: spread three ways, most in the least within `apart`.

    The spread within `radius` is about the point itself, as in the paper; Open3D takes it about the
    neighbours' mean. Each variance is less than `ratio` times the next larger.
    Reference: Zhong 2009, section 2.1 (without its weights).
    """
    i, j = pairs_within(p, radius).T
    v = p[j] - p[i]
    count = len(p)
    neighbours = np.bincount(i, minlength=count) + np.bincount(j, minlength=count)
    M = np.empty((count, 3, 3))
    for a in range(3):
        for b in range(a, 3):
            product = v[:, a] * v[:, b]
            M[:, a, b] = M[:, b, a] = np.bincount(i, product, count) + np.bincount(
                j, product, count
            )
    least, middle, most = np.linalg.eigvalsh(M / np.maximum(neighbours, 1)[:, None, None]).T
    salient = (neighbours >= fewest) & (middle < ratio * most) & (least < ratio * middle)
    saliency = np.where(salient, least, 0.0)
    i, j = pairs_within(p, apart).T
    around = np.zeros(count)
    np.maximum.at(around, i, saliency[j])
    np.maximum.at(around, j, saliency[i])
    return np.flatnonzero(salient & (saliency > around))
