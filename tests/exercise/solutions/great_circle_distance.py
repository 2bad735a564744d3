"""What students hand in for great_circle_distance."""

import numpy as np

NAMED = {
    "wrong_chord": "chord",
    "wrong_plane": "flat degrees",
    "wrong_equirectangular": "plane with cosine",
    "wrong_no_radians": "degrees as radians",
    "wrong_swapped": "swapped",
    "wrong_cosines_by_vectors": "law of cosines",
    "wrong_half": "half the angle",
    "wrong_no_radius": "without the radius",
    "wrong_answer_in_degrees": "angle in degrees",
}


def right_haversine(a, b, radius):
    la, lb = np.radians(a), np.radians(b)
    d = lb - la
    h = np.sin(d[:, 0] / 2) ** 2 + np.cos(la[:, 0]) * np.cos(lb[:, 0]) * np.sin(d[:, 1] / 2) ** 2
    return 2 * radius * np.arcsin(np.minimum(1, np.sqrt(h)))


def right_vincenty(a, b, radius):
    p, l1 = np.radians(a).T
    q, l2 = np.radians(b).T
    d = l2 - l1
    y = np.hypot(np.cos(q) * np.sin(d), np.cos(p) * np.sin(q) - np.sin(p) * np.cos(q) * np.cos(d))
    return radius * np.arctan2(y, np.sin(p) * np.sin(q) + np.cos(p) * np.cos(q) * np.cos(d))


def unit(places):
    lat, lon = np.radians(places[:, 0]), np.radians(places[:, 1])
    return np.stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)], axis=1)


def right_cross_and_dot(a, b, radius):
    p, q = unit(a), unit(b)
    return radius * np.arctan2(np.linalg.norm(np.cross(p, q), axis=1), np.sum(p * q, axis=1))


def right_from_the_chord(a, b, radius):
    chord = np.linalg.norm(unit(a) - unit(b), axis=1)
    return 2 * radius * np.arcsin(np.clip(chord / 2, 0, 1))


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_chord(a, b, radius):
    return radius * np.linalg.norm(unit(a) - unit(b), axis=1)


def wrong_plane(a, b, radius):
    return radius * np.sqrt((np.radians(a - b) ** 2).sum(axis=1))


def wrong_equirectangular(a, b, radius):
    la, lb = np.radians(a), np.radians(b)
    x = (lb[:, 1] - la[:, 1]) * np.cos((la[:, 0] + lb[:, 0]) / 2)
    return radius * np.sqrt(x**2 + (lb[:, 0] - la[:, 0]) ** 2)


def wrong_no_radians(a, b, radius):
    lat1, lon1 = a.T
    lat2, lon2 = b.T
    h = (
        np.sin((lat2 - lat1) / 2) ** 2
        + np.cos(lat1) * np.cos(lat2) * np.sin((lon2 - lon1) / 2) ** 2
    )
    return 2 * radius * np.arcsin(np.sqrt(np.clip(h, 0, 1)))


def wrong_swapped(a, b, radius):
    lon1, lat1 = np.radians(a).T
    lon2, lat2 = np.radians(b).T
    h = (
        np.sin((lat2 - lat1) / 2) ** 2
        + np.cos(lat1) * np.cos(lat2) * np.sin((lon2 - lon1) / 2) ** 2
    )
    return 2 * radius * np.arcsin(np.sqrt(np.clip(h, 0, 1)))


def wrong_cosines_by_vectors(a, b, radius):
    return radius * np.arccos(np.clip(np.sum(unit(a) * unit(b), axis=1), -1, 1))


def wrong_half(a, b, radius):
    return right_haversine(a, b, radius) / 2


def wrong_no_radius(a, b, radius):
    return right_haversine(a, b, 1.0)


def wrong_answer_in_degrees(a, b, radius):
    return radius * np.degrees(right_haversine(a, b, 1.0))


def wrong_no_root(a, b, radius):
    la, lb = np.radians(a), np.radians(b)
    h = np.sin((lb[:, 0] - la[:, 0]) / 2) ** 2
    h = h + np.cos(la[:, 0]) * np.cos(lb[:, 0]) * np.sin((lb[:, 1] - la[:, 1]) / 2) ** 2
    return 2 * radius * np.arcsin(np.clip(h, 0, 1))


def wrong_unclipped(a, b, radius):
    la, lb = np.radians(a), np.radians(b)
    h = np.sin((lb[:, 0] - la[:, 0]) / 2) ** 2
    h += np.cos(la[:, 0]) * np.cos(lb[:, 0]) * np.sin((lb[:, 1] - la[:, 1]) / 2) ** 2
    return 2 * radius * np.arcsin(np.sqrt(h * (1 + 4e-16)))


def wrong_in_place(a, b, radius):
    a *= np.pi / 180
    b *= np.pi / 180
    h = np.sin((b[:, 0] - a[:, 0]) / 2) ** 2
    h = h + np.cos(a[:, 0]) * np.cos(b[:, 0]) * np.sin((b[:, 1] - a[:, 1]) / 2) ** 2
    return 2 * radius * np.arcsin(np.sqrt(np.clip(h, 0, 1)))


def wrong_nearly_opposite_is_opposite(a, b, radius):
    d = right_haversine(a, b, radius)
    return np.where(d > 0.999 * np.pi * radius, np.pi * radius, d)


def wrong_rounded_to_a_micrometre(a, b, radius):
    return np.round(right_haversine(a, b, radius), 6)


def wrong_longitude_counts_at_the_poles(a, b, radius):
    d = right_haversine(a, b, radius)
    turned = np.radians(np.abs(a[:, 1] - b[:, 1]))
    return np.where((np.abs(a[:, 0]) == 90) & (a[:, 0] == b[:, 0]), radius * turned, d)
