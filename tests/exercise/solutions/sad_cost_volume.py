"""What students hand in for sad_cost_volume."""

import numpy as np

NAMED = {
    "wrong_shift_turned_round_and_cut": "other direction",
    "wrong_nothing_refused": "even windows",
    "wrong_integral_of_zero_padding": "zeros around",
    "wrong_uint8_differences": "bytes wrap round",
    "wrong_mean_filter": "mean",
    "wrong_roll": "rolled round",
    "wrong_ssd": "squares",
}


def refuse(left, right, D, window):
    if left.shape != right.shape or window < 1 or window % 2 != 1 or D < 0 or D >= left.shape[1]:
        raise ValueError("bad arguments")


def box(a, window, **how):
    r = window // 2
    a = np.pad(a, r, **(how or {"mode": "edge"}))
    return np.lib.stride_tricks.sliding_window_view(a, (window, window)).sum(axis=(-2, -1))


def volume(left, right, D, window, box=box, outside=np.inf, power=1):
    refuse(left, right, D, window)
    h, w = left.shape
    a, b = left.astype(float), right.astype(float)
    cost = np.full((D + 1, h, w), outside)
    for d in range(D + 1):
        cost[d, :, d:] = box(np.abs(a[:, d:] - b[:, : w - d]) ** power, window)
    return cost


def right_slices(left, right, max_disparity, window):
    return volume(left, right, max_disparity, window)


def right_clipped_indices(left, right, max_disparity, window):
    def add(a, n):
        r = n // 2
        y = np.clip(np.arange(a.shape[0])[:, None] + np.arange(-r, r + 1), 0, a.shape[0] - 1)
        x = np.clip(np.arange(a.shape[1])[:, None] + np.arange(-r, r + 1), 0, a.shape[1] - 1)
        return a[y][:, :, x].sum(axis=(1, 3))

    return volume(left, right, max_disparity, window, add)


def right_einsum(left, right, max_disparity, window):
    def add(a, n):
        p = np.pad(a, n // 2, mode="edge")
        return np.einsum("ijkl->ij", np.lib.stride_tricks.sliding_window_view(p, (n, n)))

    return volume(left, right, max_disparity, window, add)


def right_stack(left, right, max_disparity, window):
    refuse(left, right, max_disparity, window)
    a, b = np.float64(left), np.float64(right)
    slices = []
    for d in range(max_disparity + 1):
        seen = np.abs(a[:, d:] - b[:, : b.shape[1] - d])
        slices.append(np.hstack([np.full((a.shape[0], d), np.inf), box(seen, window)]))
    return np.stack(slices)


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_integral_of_zero_padding(left, right, max_disparity, window):
    return volume(left, right, max_disparity, window, lambda a, n: box(a, n, mode="constant"))


def wrong_uint8_differences(left, right, max_disparity, window):
    refuse(left, right, max_disparity, window)
    h, w = left.shape
    cost = np.full((max_disparity + 1, h, w), np.inf)
    for d in range(max_disparity + 1):
        cost[d, :, d:] = box(np.abs(left[:, d:] - right[:, : w - d]).astype(float), window)
    return cost


def wrong_mean_filter(left, right, max_disparity, window):
    from scipy.ndimage import uniform_filter

    return volume(
        left, right, max_disparity, window, lambda a, n: uniform_filter(a, n, mode="nearest")
    )


def wrong_roll(left, right, max_disparity, window):
    refuse(left, right, max_disparity, window)
    a, b = left.astype(float), right.astype(float)
    return np.stack(
        [box(np.abs(a - np.roll(b, d, axis=1)), window) for d in range(max_disparity + 1)]
    )


def wrong_ssd(left, right, max_disparity, window):
    return volume(left, right, max_disparity, window, power=2)


def wrong_mirrored_border(left, right, max_disparity, window):
    return volume(left, right, max_disparity, window, lambda a, n: box(a, n, mode="symmetric"))


def wrong_border_is_nan(left, right, max_disparity, window):
    return volume(left, right, max_disparity, window, outside=np.nan)


def wrong_large_number_for_inf(left, right, max_disparity, window):
    return volume(left, right, max_disparity, window, outside=1e9)


def wrong_shift_turned_round_and_cut(left, right, max_disparity, window):
    refuse(left, right, max_disparity, window)
    h, w = left.shape
    cost = np.full((max_disparity + 1, h, w), np.inf)
    for d in range(max_disparity + 1):
        cost[d, :, : w - d] = box(np.abs(left[:, : w - d].astype(float) - right[:, d:]), window)
    return cost


def wrong_nothing_refused(left, right, max_disparity, window):
    h, w = left.shape
    cost = np.full((max_disparity + 1, h, w), np.inf)
    for d in range(max_disparity + 1):
        cost[d, :, d:] = box(np.abs(left[:, d:].astype(float) - right[:, : w - d]), window | 1)
    return cost


def wrong_only_sizes_refused(left, right, max_disparity, window):
    if left.shape != right.shape:
        raise ValueError("sizes")
    if max_disparity >= left.shape[1]:
        max_disparity = left.shape[1] - 1
    return volume(left, right, max_disparity, window if window % 2 else window + 1)


def wrong_asserts(left, right, max_disparity, window):
    assert left.shape == right.shape and window % 2 == 1 and max_disparity < left.shape[1]
    return volume(left, right, max_disparity, window)


def wrong_negative_windows_taken(left, right, max_disparity, window):
    return volume(left, right, max_disparity, abs(window))


def wrong_window_of_nothing_is_a_pixel(left, right, max_disparity, window):
    return volume(left, right, max_disparity, window or 1)


def wrong_rows_cut_to_the_lower_picture(left, right, max_disparity, window):
    h = min(len(left), len(right))
    return volume(left[:h], right[:h], max_disparity, window)


def wrong_far_too_many_shifts_cut(left, right, max_disparity, window):
    w = left.shape[1]
    return volume(left, right, w - 1 if max_disparity > w else max_disparity, window)


def wrong_widest_shift_refused(left, right, max_disparity, window):
    if max_disparity >= left.shape[1] - 1:
        raise ValueError("too many disparities")
    return volume(left, right, max_disparity, window)


def wrong_one_slice_is_a_picture(left, right, max_disparity, window):
    return np.squeeze(volume(left, right, max_disparity, window))


def wrong_window_larger_than_the_picture_refused(left, right, max_disparity, window):
    if window > min(left.shape):
        raise ValueError("window too large")
    return volume(left, right, max_disparity, window)


def wrong_border_of_bytes(left, right, max_disparity, window):
    if left.dtype == np.uint8:
        return volume(left, right, max_disparity, window, lambda a, n: box(a, n, mode="reflect"))
    return volume(left, right, max_disparity, window)
