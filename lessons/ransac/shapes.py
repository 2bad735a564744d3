"""The outlines of models: line segments and surfaces inside a window, in the picture."""

from functools import lru_cache

import numpy as np

from lessons.ransac.state import Subject
from workbench.geometry.clipping import clip_lines, plane_in_box
from workbench.geometry.epipolar import epipolar_lines
from workbench.geometry.homography import transform_pixels
from workbench.geometry.polylines import segments

ARC = np.linspace(0.0, 2.0 * np.pi, 65)
NOTHING = np.zeros((0, 2, 3))


def outline(subject: Subject, estimate: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Return the segments (n, 2, 3) that show an estimate; for a fundamental matrix, the lines of the matches `rows`.

    The same question has the same answer, so that a viewer is not sent again what has not changed.
    """
    return _outline(subject, estimate.tobytes(), estimate.shape, tuple(rows.tolist()))


@lru_cache(maxsize=256)
def _outline(subject: Subject, numbers: bytes, shape: tuple[int, ...], rows: tuple[int, ...]) -> np.ndarray:
    name, estimate = subject.model.name, np.frombuffer(numbers).reshape(shape)
    if name == "line":
        return _placed(subject, clip_lines(estimate[None], subject.low, subject.high))
    if name == "plane":
        corners = plane_in_box(estimate, subject.low, subject.high)
        return segments(subject.places[0](corners), closed=True) if len(corners) else NOTHING
    if name == "circle":
        points = estimate[:2] + estimate[2] * np.column_stack([np.cos(ARC), np.sin(ARC)])
        return _placed(subject, _inside(segments(points), subject.low, subject.high))
    if name == "sphere":
        return _placed(subject, _inside(_rings(estimate), subject.low, subject.high))
    if name == "homography":
        return _warped_grid(subject, estimate)
    return _epipolar(subject, estimate, np.array(rows))


def slab(subject: Subject, estimate: np.ndarray, distance: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the outlines of a model moved to either side by a distance, and in a plane the corners of the band between.

    The last number of a line, plane or circle is where it lies, in metres; of other models no slab is drawn.
    """
    nothing = np.zeros((0, 3))
    if subject.model.name not in ("line", "plane", "circle"):
        return NOTHING, nothing
    if subject.model.name != "circle":  # whichever way its normal points
        estimate = estimate * np.sign(estimate[np.argmax(np.abs(estimate[:-1]))])
    sides = [estimate + side * distance * np.eye(len(estimate))[-1] for side in (1.0, -1.0)]
    ends = [outline(subject, side, np.zeros(0, int)) for side in sides]
    whole = subject.model.name == "line" and len(ends[0]) == len(ends[1]) == 1
    return np.concatenate(ends), np.stack([side[0] for side in ends], axis=1).reshape(-1, 3) if whole else nothing


@lru_cache(maxsize=64)
def frames(subject: Subject) -> np.ndarray:
    """Return the borders of the two images, of the 2D window, or nothing."""
    if subject.sizes:
        borders = [np.array([[0, 0], [w, 0], [w, h], [0, h]], float) - 0.5 for w, h in subject.sizes]
        return np.concatenate(
            [segments(place(border), closed=True) for place, border in zip(subject.places, borders, strict=True)]
        )
    if len(subject.low) == 2:
        (x0, y0), (x1, y1) = subject.low, subject.high
        border = np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])
        return segments(subject.places[0](border), closed=True)
    return NOTHING


def _epipolar(subject: Subject, F: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Return the lines of the matches' pixels, in the first image and in the second."""
    matches, ends = subject.p[rows], []
    for k, lines in enumerate((epipolar_lines(F.T, matches[:, 2:]), epipolar_lines(F, matches[:, :2]))):
        known = lines[np.isfinite(lines).all(axis=1)]
        ends.append(_placed(subject, clip_lines(known, np.zeros(2), subject.sizes[k]), k))
    return np.concatenate(ends)


def _warped_grid(subject: Subject, H: np.ndarray, cells: int = 4, pieces: int = 8) -> np.ndarray:
    """Return a grid of the first image, as the homography puts it into the second."""
    w, h = subject.sizes[0]
    t, ticks = np.linspace(0.0, 1.0, cells * pieces + 1), np.linspace(0.0, 1.0, cells + 1)
    lines = [np.column_stack([np.full_like(t, x), t]) for x in ticks]
    lines += [line[:, ::-1] for line in lines]
    ends = np.concatenate([segments(line * [w, h]) for line in lines])
    with np.errstate(all="ignore"):
        moved = transform_pixels(H, ends.reshape(-1, 2)).reshape(-1, 2, 2)
    return _placed(subject, _inside(moved, -0.15 * subject.sizes[1], 1.15 * subject.sizes[1]), 1)


def _rings(sphere: np.ndarray) -> np.ndarray:
    """Return three great circles and two circles of latitude."""
    centre, radius = sphere[:3], sphere[3]
    c, s, zero = np.cos(ARC), np.sin(ARC), np.zeros_like(ARC)
    rings = [np.column_stack([c, s, zero]), np.column_stack([c, zero, s]), np.column_stack([zero, c, s])]
    rings += [np.column_stack([0.8 * c, 0.8 * s, zero + z]) for z in (-0.6, 0.6)]
    return np.concatenate([segments(centre + radius * ring) for ring in rings])


def _inside(ends: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Return the segments whose ends are both finite and inside the window."""
    return ends[(np.isfinite(ends) & (ends >= low) & (ends <= high)).all(axis=(1, 2))]


def _placed(subject: Subject, ends: np.ndarray, k: int = 0) -> np.ndarray:
    return subject.places[k](ends.reshape(-1, ends.shape[-1])).reshape(-1, 2, 3)
