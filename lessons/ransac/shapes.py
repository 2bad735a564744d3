"""The outlines of models: line segments and surfaces inside a window, in the picture."""

from functools import lru_cache

import numpy as np

from lessons.ransac.rows import Subject
from workbench.geometry.clipping import clip_lines, plane_in_box, segments_inside
from workbench.geometry.polylines import circle, rectangle, segments, sphere_rings
from workbench.geometry.two_views.epipolar import epipolar_lines
from workbench.geometry.two_views.homography import warped_grid

NOTHING = np.zeros((0, 2, 3))


def outline(subject: Subject, estimate: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Return the segments (n, 2, 3) that show an estimate; for a fundamental matrix, the lines of
    the matches `rows`.

    The same question has the same answer, so that a viewer is not sent again what has not changed.
    """
    return _outline(subject, estimate.tobytes(), estimate.shape, tuple(rows.tolist()))


@lru_cache(maxsize=256)
def _outline(
    subject: Subject, numbers: bytes, shape: tuple[int, ...], rows: tuple[int, ...]
) -> np.ndarray:
    name, estimate = subject.model.name, np.frombuffer(numbers).reshape(shape)
    if name == "line":
        return _placed(subject, clip_lines(estimate[None], subject.low, subject.high))
    if name == "plane":
        corners = plane_in_box(estimate, subject.low, subject.high)
        return segments(subject.places[0](corners), closed=True) if len(corners) else NOTHING
    if name == "circle":
        return _placed(
            subject,
            segments_inside(
                segments(estimate[:2] + estimate[2] * circle()), subject.low, subject.high
            ),
        )
    if name == "sphere":
        rings = sphere_rings(estimate[:3], estimate[3])
        return _placed(subject, segments_inside(rings, subject.low, subject.high))
    if name == "homography":
        low, high = -0.15 * subject.sizes[1], 1.15 * subject.sizes[1]
        return _placed(
            subject, segments_inside(warped_grid(estimate, subject.sizes[0]), low, high), 1
        )
    return _epipolar(subject, estimate, np.array(rows))


def slab(subject: Subject, estimate: np.ndarray, distance: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the outlines of a model moved to either side by a distance, and in a plane the corners
    of the band between.

    The last number of a line, plane or circle is where it lies, in metres; of other models no slab
    is drawn.
    """
    nothing = np.zeros((0, 3))
    if subject.model.name not in ("line", "plane", "circle"):
        return NOTHING, nothing
    if subject.model.name != "circle":  # whichever way its normal points
        estimate = estimate * np.sign(estimate[np.argmax(np.abs(estimate[:-1]))])
    sides = [estimate + side * distance * np.eye(len(estimate))[-1] for side in (1.0, -1.0)]
    ends = [outline(subject, side, np.zeros(0, int)) for side in sides]
    whole = subject.model.name == "line" and len(ends[0]) == len(ends[1]) == 1
    return np.concatenate(ends), np.stack([side[0] for side in ends], axis=1).reshape(
        -1, 3
    ) if whole else nothing


@lru_cache(maxsize=64)
def frames(subject: Subject) -> np.ndarray:
    """Return the borders of the two images, of the 2D window, or nothing."""
    if subject.sizes:
        borders = [rectangle(np.zeros(2), size) - 0.5 for size in subject.sizes]
        return np.concatenate(
            [
                segments(place(border), closed=True)
                for place, border in zip(subject.places, borders, strict=True)
            ]
        )
    if len(subject.low) == 2:
        return segments(subject.places[0](rectangle(subject.low, subject.high)), closed=True)
    return NOTHING


def _epipolar(subject: Subject, F: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Return the lines of the matches' pixels, in the first image and in the second."""
    matches, ends = subject.p[rows], []
    for k, lines in enumerate(
        (epipolar_lines(F.T, matches[:, 2:]), epipolar_lines(F, matches[:, :2]))
    ):
        known = lines[np.isfinite(lines).all(axis=1)]
        ends.append(_placed(subject, clip_lines(known, np.zeros(2), subject.sizes[k]), k))
    return np.concatenate(ends)


def _placed(subject: Subject, ends: np.ndarray, k: int = 0) -> np.ndarray:
    return subject.places[k](ends.reshape(-1, ends.shape[-1])).reshape(-1, 2, 3)
