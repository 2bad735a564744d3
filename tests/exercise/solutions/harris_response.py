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
