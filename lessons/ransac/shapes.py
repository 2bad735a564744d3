"""Parts of the picture: outlines of models, the band in which one votes, colours of votes."""

import numpy as np

from lessons.ransac.rows import Subject
from workbench.geometry.clipping import clip_lines, plane_in_box, segments_inside
from workbench.geometry.polylines import circle, rectangle, segments, sphere_rings
from workbench.geometry.two_views.epipolar import epipolar_lines
from workbench.geometry.two_views.homography import warped_grid
from workbench.numerals import brief
from workbench.scene import Classes, Label, Mesh, Primitive, Role, Segments

MM = 1000.0
NOTHING = np.zeros((0, 2, 3))
MATCHES = 8  # of which epipolar lines are drawn


def marked(votes: np.ndarray) -> Classes:
    """Return the colours of points by their votes."""
    return Classes.marking(~votes, "neutral", "votes against", others=("target", "votes for"))


def outline(subject: Subject, estimate: np.ndarray) -> np.ndarray:
    """Return the segments (n, 2, 3) that show an estimate; of F the lines of some matches."""
    name = subject.model.name
    ends = NOTHING
    if name == "plane":
        corners = plane_in_box(estimate, subject.low, subject.high)
        return segments(subject.places[0](corners), closed=True) if len(corners) else NOTHING
    if name == "fundamental matrix":
        return _epipolar(subject, estimate)
    if name == "homography":
        grid = warped_grid(estimate, subject.sizes[0])
        inside = segments_inside(grid, -0.15 * subject.sizes[1], 1.15 * subject.sizes[1])
        return _placed(subject, inside, 1)
    if name == "line":
        return _placed(subject, clip_lines(estimate[None], subject.low, subject.high))
    if name == "circle":
        ends = segments(estimate[:2] + estimate[2] * circle())
    if name == "sphere":
        ends = sphere_rings(estimate[:3], estimate[3])
    return _placed(subject, segments_inside(ends, subject.low, subject.high))


def band(
    subject: Subject, estimate: np.ndarray, color: Role, *, reach: float, named: bool = True
) -> dict[str, Primitive]:
    """Return where a point is near enough to a line, plane or circle to vote for it.

    The last number of these is where they lie, in metres; of other models no band is drawn.
    """
    name = subject.model.name
    if name not in ("line", "plane", "circle"):
        return {}
    if name != "circle":  # whichever way its normal points
        estimate = estimate * np.sign(estimate[np.argmax(np.abs(estimate[:-1]))])
    sides = [
        outline(subject, estimate + side * np.eye(len(estimate))[-1]) for side in (reach, -reach)
    ]
    edges = np.concatenate(sides)
    if not len(edges):
        return {}
    scene: dict[str, Primitive] = {"slab": Segments(edges, color, 1.5, opacity=0.7)}
    if name == "line" and len(sides[0]) == len(sides[1]) == 1:
        corners = np.stack([side[0] for side in sides], axis=1).reshape(-1, 3)
        faces = np.array([[0, 1, 2], [1, 3, 2]])
        scene["slab/band"] = Mesh(corners, faces, color, opacity=0.2, flat=True)
    if named:
        at = edges.reshape(-1, 3)
        place = at[np.argmax(at @ [1.0, -0.6, -0.4])]
        aside = np.array([0.3 if subject.model.columns == 2 else 0.0, 0.0, 0.0])
        scene["slab/name"] = Label(f"± {brief(MM * reach)} mm", place + aside, color)
    return scene


def frames(subject: Subject) -> np.ndarray:
    """Return the borders of the two images, of the window of a drawing, or nothing."""
    if len(subject.low) == 3:
        return NOTHING
    borders = [rectangle(np.zeros(2), size) - 0.5 for size in subject.sizes]
    borders = borders or [rectangle(subject.low, subject.high)]
    places = zip(subject.places, borders, strict=True)
    return np.concatenate([segments(place(border), closed=True) for place, border in places])


def _epipolar(subject: Subject, F: np.ndarray) -> np.ndarray:
    """Return the lines of some matches' pixels, in the first image and in the second."""
    rows = np.arange(0, len(subject.p), max(1, len(subject.p) // MATCHES))
    if subject.is_inlier is not None:
        rows = np.flatnonzero(subject.is_inlier)
    p = subject.p[rows[:MATCHES]]
    ends = []
    for k, lines in enumerate((epipolar_lines(F.T, p[:, 2:]), epipolar_lines(F, p[:, :2]))):
        known = lines[np.isfinite(lines).all(axis=1)]
        ends.append(_placed(subject, clip_lines(known, np.zeros(2), subject.sizes[k]), k))
    return np.concatenate(ends)


def _placed(subject: Subject, ends: np.ndarray, k: int = 0) -> np.ndarray:
    return subject.places[k](ends.reshape(-1, ends.shape[-1])).reshape(-1, 2, 3)
