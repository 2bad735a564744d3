"""Write the corner response of a picture. The part "pictures" of the lesson takes its corners from
your function: `--part pictures --turn 0`.
"""

import numpy as np
import scipy
from jaxtyping import Float

from lessons.features.exercises import STUDENTS
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    band,
    beside,
    check,
    contract,
    left_alone,
    mistake,
    worst,
)
from workbench.geometry.features import keypoints


@contract(
    slot="harris_response",
    preset="patches",
    examples=(
        ("harris_response(np.zeros((3, 4)))", "[[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]]"),
        ("harris_response(np.outer(np.arange(9.0), np.ones(9)))[4, 4]", "-0.0354"),
    ),
)
def harris_response(image: Float[np.ndarray, "h w"]) -> Float[np.ndarray, "h w"]:
    """Return det(M) - 0.04 trace(M)^2 of every pixel.

    Smooth the picture by a Gaussian of 1 px. Its derivatives g_u (along columns) and g_v (along
    rows) are Sobel's over 8, in grey levels per pixel. M = [[A, B], [B, C]] holds g_u g_u, g_u g_v
    and g_v g_v, each of them smoothed by a Gaussian of 1.5 px after multiplying. All of it with
    scipy.ndimage's gaussian_filter and sobel as they are by default.

    Args:
        image: Grey levels, indexed [v, u].

    Returns:
        One number per pixel, of the picture's shape. The input stays as it is.
    """
    return keypoints.harris_response(image)


HINT = "det M - 0.04 (trace M)^2, with M's products multiplied first and smoothed then."


def textured(seed: int, h: int, w: int) -> np.ndarray:
    """Return a picture of bright and dark blocks with noise."""
    rng = np.random.default_rng(seed)
    blocks = rng.uniform(20.0, 235.0, (h // 8 + 1, w // 8 + 1))
    return np.kron(blocks, np.ones((8, 8)))[:h, :w] + rng.normal(0.0, 3.0, (h, w))


def judged(candidate: Function, image: np.ndarray, label: str) -> Verdict:
    """Judge by the largest difference, as a share of the largest response."""
    got = candidate(image)
    right = keypoints.harris_response(image)
    off = np.abs(got - right)
    off = np.where(np.isfinite(off), off, np.inf)
    at = np.unravel_index(int(off.argmax()), off.shape)
    share = float(off.max() / max(float(np.abs(right).max()), 1e-12))
    hint = beside(got[at], right[at], HINT, f"The response at row {at[0]}, column {at[1]}")
    return band(
        f"{label}: largest difference over the largest response",
        share,
        "",
        good=1e-6,
        fair=1e-3,
        hint=hint,
    )


@check(2)
def blocks(candidate: Function) -> Verdict:
    """A picture of bright and dark blocks."""
    return judged(candidate, textured(STUDENTS, 40, 56), "40 rows of 56")


@check(1)
def an_edge_is_no_corner(candidate: Function) -> Verdict:
    """Along a straight edge the response is negative, across either way."""
    edge = np.where(np.arange(32) < 16, 40.0, 200.0) * np.ones((32, 1))
    return worst([judged(candidate, edge, "Upright edge"), judged(candidate, edge.T, "Level edge")])


@check(1)
def inputs_are_left_alone(candidate: Function) -> Verdict:
    """The picture is not changed."""
    return left_alone(candidate, judged(candidate, textured(STUDENTS + 1, 24, 24), "24 rows of 24"))


def products(image: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return g_u, g_v, and the two again, as scipy has them."""
    smooth = scipy.ndimage.gaussian_filter(np.asarray(image, float), 1.0)
    g_u, g_v = scipy.ndimage.sobel(smooth, axis=1) / 8.0, scipy.ndimage.sobel(smooth, axis=0) / 8.0
    return g_u * g_u, g_u * g_v, g_v * g_v, smooth


def gathered(x: np.ndarray) -> np.ndarray:
    """Return the window's mean."""
    return scipy.ndimage.gaussian_filter(x, 1.5)


@mistake(
    "You left out the window: of a single pixel's derivatives det M is 0. Smooth the three products"
    " by 1.5 px."
)
def no_window(image: np.ndarray) -> np.ndarray:
    """Takes the products of each pixel alone."""
    a, b, c, _ = products(image)
    return a * c - b * b - 0.04 * (a + c) ** 2


@mistake(
    "Your trace is not squared: det M is of the fourth order in grey levels, so the trace enters as"
    " its square."
)
def trace_not_squared(image: np.ndarray) -> np.ndarray:
    """Subtracts 0.04 trace M."""
    a, b, c = (gathered(x) for x in products(image)[:3])
    return a * c - b * b - 0.04 * (a + c)


@mistake(
    "You smoothed the derivatives and multiplied then, so det M is 0 everywhere. Multiply first,"
    " smooth the products."
)
def smoothed_before_multiplying(image: np.ndarray) -> np.ndarray:
    """Averages the derivatives."""
    smooth = products(image)[3]
    g_u, g_v = (gathered(scipy.ndimage.sobel(smooth, axis=axis) / 8.0) for axis in (1, 0))
    a, b, c = g_u * g_u, g_u * g_v, g_v * g_v
    return a * c - b * b - 0.04 * (a + c) ** 2


@mistake(
    "Your derivatives are not Sobel's over 8: its weights sum to 8 on a slope of one grey level per"
    " pixel."
)
def not_over_eight(image: np.ndarray) -> np.ndarray:
    """Leaves out the 8."""
    a, b, c = (64.0 * gathered(x) for x in products(image)[:3])
    return a * c - b * b - 0.04 * (a + c) ** 2


@mistake("You added trace(M)² where it has to be subtracted: so edges win over corners.")
def trace_added(image: np.ndarray) -> np.ndarray:
    """Det + 0.04 trace²."""
    a, b, c = (gathered(x) for x in products(image)[:3])
    return a * c - b * b + 0.04 * (a + c) ** 2


@alternative
def in_numpy_alone(image: np.ndarray) -> np.ndarray:
    """Sums over windows, rows and then columns; beyond the border the picture is mirrored."""

    def filtered(x: np.ndarray, weights: np.ndarray, axis: int) -> np.ndarray:
        reach = len(weights) // 2
        padded = np.pad(
            x, [(reach, reach) if k == axis else (0, 0) for k in (0, 1)], mode="symmetric"
        )
        return np.lib.stride_tricks.sliding_window_view(padded, len(weights), axis) @ weights

    def smoothed(x: np.ndarray, sigma: float) -> np.ndarray:
        weights = np.exp(-((np.arange(-round(4 * sigma), round(4 * sigma) + 1) / sigma) ** 2) / 2)
        weights = weights / weights.sum()
        return filtered(filtered(x, weights, 0), weights, 1)

    smooth = smoothed(image, 1.0)
    one_two_one = np.array([1, 2, 1])
    difference = np.array([-1, 0, 1])
    g_u = filtered(filtered(smooth, difference, 1), one_two_one, 0) / 8
    g_v = filtered(filtered(smooth, difference, 0), one_two_one, 1) / 8
    a, b, c = (smoothed(x, 1.5) for x in (g_u * g_u, g_u * g_v, g_v * g_v))
    return a * c - b * b - 0.04 * (a + c) ** 2


@alternative
def by_eigenvalues(image: np.ndarray) -> np.ndarray:
    """Det is the product of the eigenvalues, trace their sum."""
    a, b, c = (gathered(x) for x in products(image)[:3])
    low, high = np.linalg.eigvalsh(
        np.stack([np.stack([a, b], -1), np.stack([b, c], -1)], -2)
    ).transpose(2, 0, 1)
    return low * high - 0.04 * (low + high) ** 2


@alternative
def by_correlation(image: np.ndarray) -> np.ndarray:
    """Sobel's weights written out."""
    smooth = scipy.ndimage.gaussian_filter(image, 1.0)
    weights = np.outer([1.0, 2.0, 1.0], [-1.0, 0.0, 1.0]) / 8.0
    g_u, g_v = (scipy.ndimage.correlate(smooth, k) for k in (weights, weights.T))
    a, b, c = (scipy.ndimage.gaussian_filter(x, 1.5) for x in (g_u**2, g_u * g_v, g_v**2))
    return a * c - b**2 - 0.04 * (a + c) ** 2
