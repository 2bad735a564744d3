"""What students hand in for harris_response."""

import numpy as np
from scipy import ndimage as ndi

NAMED = {
    "wrong_pixels_alone": "no window",
    "wrong_trace_once": "trace not squared",
    "wrong_smoothed_derivatives": "smoothed before multiplying",
    "wrong_sobel_as_it_is": "not over eight",
    "wrong_plus": "trace added",
}
K = 0.04


def _gradients(image):
    g = ndi.gaussian_filter(image, 1)
    return ndi.sobel(g, axis=1) / 8, ndi.sobel(g, axis=0) / 8


def right_short(image):
    gu, gv = _gradients(image)
    A, B, C = (ndi.gaussian_filter(x, 1.5) for x in (gu * gu, gu * gv, gv * gv))
    return A * C - B**2 - K * (A + C) ** 2


def right_default_axis(image):
    g = ndi.gaussian_filter(image.astype(float), sigma=1.0)
    gu, gv = ndi.sobel(g) / 8.0, ndi.sobel(g, 0) / 8.0
    m = np.empty((*image.shape, 2, 2))
    m[..., 0, 0] = ndi.gaussian_filter(gu**2, 1.5)
    m[..., 0, 1] = m[..., 1, 0] = ndi.gaussian_filter(gu * gv, 1.5)
    m[..., 1, 1] = ndi.gaussian_filter(gv**2, 1.5)
    return np.linalg.det(m) - 0.04 * np.trace(m, axis1=-2, axis2=-1) ** 2


def right_axes_exchanged(image):
    gv, gu = _gradients(image)
    A, B, C = (ndi.gaussian_filter(x, 1.5) for x in (gu * gu, gu * gv, gv * gv))
    return A * C - B * B - K * (A + C) ** 2


def right_eigenvalues_by_roots(image):
    gu, gv = _gradients(image)
    A, B, C = (ndi.gaussian_filter(x, 1.5) for x in (gu * gu, gu * gv, gv * gv))
    middle, root = (A + C) / 2, np.sqrt(((A - C) / 2) ** 2 + B * B)
    return (middle - root) * (middle + root) - K * (2 * middle) ** 2


def right_separable(image):
    g = ndi.gaussian_filter1d(ndi.gaussian_filter1d(image, 1.0, axis=0), 1.0, axis=1)
    gu = ndi.correlate1d(ndi.correlate1d(g, [1, 2, 1], axis=0), [-1, 0, 1], axis=1) / 8
    gv = ndi.correlate1d(ndi.correlate1d(g, [1, 2, 1], axis=1), [-1, 0, 1], axis=0) / 8

    def window(x):
        return ndi.gaussian_filter1d(ndi.gaussian_filter1d(x, 1.5, axis=1), 1.5, axis=0)

    A, B, C = window(gu**2), window(gu * gv), window(gv**2)
    return A * C - B * B - K * (A + C) ** 2


def right_scaled_at_the_end(image):
    g = ndi.gaussian_filter(image, 1)
    gu, gv = ndi.sobel(g, axis=1), ndi.sobel(g, axis=0)
    A, B, C = (ndi.gaussian_filter(x, 1.5) for x in (gu * gu, gu * gv, gv * gv))
    return (A * C - B * B - K * (A + C) ** 2) / 8**4


def right_padded_by_hand(image):
    h, w = image.shape
    p = np.pad(ndi.gaussian_filter(image, 1.0), 1, mode="symmetric")
    s = [[p[i : i + h, j : j + w] for j in range(3)] for i in range(3)]
    gu = ((s[0][2] + 2 * s[1][2] + s[2][2]) - (s[0][0] + 2 * s[1][0] + s[2][0])) / 8
    gv = ((s[2][0] + 2 * s[2][1] + s[2][2]) - (s[0][0] + 2 * s[0][1] + s[0][2])) / 8
    A, B, C = (
        ndi.gaussian_filter(gu * gu, 1.5),
        ndi.gaussian_filter(gu * gv, 1.5),
        ndi.gaussian_filter(gv * gv, 1.5),
    )
    return A * C - B * B - K * (A + C) ** 2


def right_from_pixels_by_loop_over_products(image):
    g = _gradients(image)
    M = [[ndi.gaussian_filter(a * b, 1.5) for a in g] for b in g]
    determinant = M[0][0] * M[1][1] - M[0][1] * M[1][0]
    trace = M[0][0] + M[1][1]
    return determinant - K * trace * trace


def right_complex_gradient(image):
    gu, gv = _gradients(image)
    z = gu + 1j * gv
    energy = ndi.gaussian_filter(np.abs(z) ** 2, 1.5)
    square = z * z
    p, q = ndi.gaussian_filter(square.real, 1.5), ndi.gaussian_filter(square.imag, 1.5)
    return (energy**2 - p**2 - q**2) / 4 - K * energy**2


# wrong ---------------------------------------------------------------------------------------------------------------


def _answer(gu, gv, window=1.5, k=K):
    A, B, C = (ndi.gaussian_filter(x, window) for x in (gu * gu, gu * gv, gv * gv))
    return A * C - B * B - k * (A + C) ** 2


def wrong_pixels_alone(image):
    gu, gv = _gradients(image)
    A, B, C = gu * gu, gu * gv, gv * gv
    return A * C - B**2 - K * (A + C) ** 2


def wrong_trace_once(image):
    gu, gv = _gradients(image)
    A, B, C = (ndi.gaussian_filter(x, 1.5) for x in (gu * gu, gu * gv, gv * gv))
    return A * C - B**2 - K * (A + C)


def wrong_smoothed_derivatives(image):
    gu, gv = (ndi.gaussian_filter(x, 1.5) for x in _gradients(image))
    A, B, C = gu * gu, gu * gv, gv * gv
    return A * C - B**2 - K * (A + C) ** 2


def wrong_sobel_as_it_is(image):
    g = ndi.gaussian_filter(image, 1)
    return _answer(ndi.sobel(g, axis=1), ndi.sobel(g, axis=0))


def wrong_plus(image):
    gu, gv = _gradients(image)
    A, B, C = (ndi.gaussian_filter(x, 1.5) for x in (gu * gu, gu * gv, gv * gv))
    return A * C - B**2 + K * (A + C) ** 2


def wrong_other_constant(image):
    return _answer(*_gradients(image), k=0.06)


def wrong_determinant_alone(image):
    return _answer(*_gradients(image), k=0.0)


def wrong_smaller_eigenvalue(image):
    gu, gv = _gradients(image)
    A, B, C = (ndi.gaussian_filter(x, 1.5) for x in (gu * gu, gu * gv, gv * gv))
    return (A + C) / 2 - np.sqrt(((A - C) / 2) ** 2 + B * B)


def wrong_noble(image):
    gu, gv = _gradients(image)
    A, B, C = (ndi.gaussian_filter(x, 1.5) for x in (gu * gu, gu * gv, gv * gv))
    return (A * C - B * B) / (A + C + 1e-12)


def wrong_unsmoothed(image):
    return _answer(ndi.sobel(image, axis=1) / 8, ndi.sobel(image, axis=0) / 8)


def wrong_gaussians_exchanged(image):
    g = ndi.gaussian_filter(image, 1.5)
    return _answer(ndi.sobel(g, axis=1) / 8, ndi.sobel(g, axis=0) / 8, window=1.0)


def wrong_narrow_window(image):
    return _answer(*_gradients(image), window=1.0)


def wrong_box_window(image):
    gu, gv = _gradients(image)
    A, B, C = (ndi.uniform_filter(x, 5) for x in (gu * gu, gu * gv, gv * gv))
    return A * C - B**2 - K * (A + C) ** 2


def wrong_sum_window(image):
    gu, gv = _gradients(image)
    A, B, C = (9 * ndi.uniform_filter(x, 3) for x in (gu * gu, gu * gv, gv * gv))
    return A * C - B**2 - K * (A + C) ** 2


def wrong_numpy_gradient(image):
    gv, gu = np.gradient(ndi.gaussian_filter(image, 1.0))
    return _answer(gu, gv)


def wrong_gaussian_derivative(image):
    return _answer(
        ndi.gaussian_filter(image, 1.0, order=(0, 1)), ndi.gaussian_filter(image, 1.0, order=(1, 0))
    )


def wrong_prewitt(image):
    g = ndi.gaussian_filter(image, 1.0)
    return _answer(ndi.prewitt(g, axis=1) / 6, ndi.prewitt(g, axis=0) / 6)


def wrong_over_four(image):
    g = ndi.gaussian_filter(image, 1.0)
    return _answer(ndi.sobel(g, axis=1) / 4, ndi.sobel(g, axis=0) / 4)


def wrong_variances(image):
    g = ndi.gaussian_filter(image, 1.0**0.5)
    return _answer(ndi.sobel(g, axis=1) / 8, ndi.sobel(g, axis=0) / 8, window=1.5**0.5)


def wrong_zeros_outside(image):
    g = ndi.gaussian_filter(image, 1.0, mode="constant")
    gu, gv = (ndi.sobel(g, axis=axis, mode="constant") / 8 for axis in (1, 0))
    A, B, C = (ndi.gaussian_filter(x, 1.5, mode="constant") for x in (gu * gu, gu * gv, gv * gv))
    return A * C - B**2 - K * (A + C) ** 2


def wrong_negative_cut(image):
    return np.maximum(right_short(image), 0)


def wrong_absolute(image):
    return np.abs(right_short(image))


def wrong_scaled_to_one(image):
    R = right_short(image)
    return R / max(np.abs(R).max(), 1e-12)


def wrong_product_not_squared(image):
    gu, gv = _gradients(image)
    A, B, C = (ndi.gaussian_filter(x, 1.5) for x in (gu * gu, gu * gv, gv * gv))
    return A * C - B - K * (A + C) ** 2


def wrong_without_the_mixed_product(image):
    gu, gv = _gradients(image)
    A, C = (ndi.gaussian_filter(x, 1.5) for x in (gu * gu, gv * gv))
    return A * C - K * (A + C) ** 2


def wrong_one_axis(image):
    g = ndi.gaussian_filter(image, 1.0)
    return _answer(ndi.sobel(g) / 8, ndi.sobel(g) / 8)


def wrong_mask(image):
    R = right_short(image)
    return R > 0.01 * R.max()


def wrong_transposed(image):
    return right_short(image).T


def wrong_whole_levels(image):
    return _answer(*_gradients(np.rint(image)))


def wrong_between_zero_and_one(image):
    return right_short(image / 255)


def wrong_shifted_in_place(image):
    image -= image.mean()
    return right_short(image)


def wrong_grey_levels_up_to_255(image):
    return right_short(np.clip(image, 0, 255))


def wrong_small_is_zero(image):
    R = right_short(image)
    return np.where(np.abs(R) < 1e-9, 0, R)


def wrong_nothing_in_small_pictures(image):
    return right_short(image) if min(image.shape) > 8 else np.zeros(image.shape)
