"""The sum of squares over the plane of centres, and the way that a descent takes there."""

from functools import lru_cache

import numpy as np

from workbench.algorithms.least_squares import Walked
from workbench.geometry.clipping import cut_to_rectangle
from workbench.geometry.level_sets import level_lines
from workbench.geometry.polylines import at_height, between, segments
from workbench.geometry.shapes.circles_spheres import costs_of_centers
from workbench.scene import Points, Primitive, Segments

REACH = 4.5  # metres from the origin that circles and centres are drawn
# points of the grid to a side; distances computed for it
FINEST = 161
COARSEST = 61
MOST_DISTANCES = 4_000_000
# at most, and from one to the next
LINES = 10
FACTOR = 2.0
DOT, HEIGHT = 0.026, 0.02  # metres; the way lies above the circles, the lines below


def on_contours(p: np.ndarray, walked: Walked) -> dict[str, Primitive]:
    """Return the level lines of the sum of squares over the centre of a circle, and centres kept,
    tried and taken back.
    """
    descent = walked.now
    kept = walked.kept[:, :2]
    scene: dict[str, Primitive] = {
        "valley": _contours(p.tobytes()),
        "way/centres": Points(_near(kept), "source", DOT),
        "way/start": Points(_near(kept[:1]), "other", 1.4 * DOT, name="its start"),
    }
    way = _cut(segments(kept))
    if len(way):
        scene["way"] = Segments(way, "source", 3.0, name="way of the centre")
    if len(walked.taken_back):
        scene["way/taken back"] = Points(
            _near(walked.taken_back[:, :2]), "wrong", DOT, name="taken back"
        )
    if descent.trial is not None and descent.phase in ("tried", "rejected"):
        step = _cut(between(descent.unknown[:2], descent.trial[:2]))
        scene["way/step"] = Segments(
            step, "highlight" if descent.phase == "tried" else "wrong", 3.0
        )
        if descent.phase == "tried":
            scene["way/trial"] = Points(
                _near(descent.trial[None, :2]), "highlight", 1.4 * DOT, name="centre tried"
            )
    return scene


@lru_cache(maxsize=8)
def _contours(p: bytes) -> Segments:
    """Return the lines on which centres are equally good, each with its best radius; twice as bad
    from line to line.
    """
    points = np.frombuffer(p).reshape(-1, 2)
    side = int(np.clip(np.sqrt(MOST_DISTANCES / len(points)), COARSEST, FINEST))
    x = np.linspace(-REACH, REACH, side)
    costs = costs_of_centers(points, np.stack(np.meshgrid(x, x), axis=-1).reshape(-1, 2)).reshape(
        side, side
    )
    levels = costs.max() / FACTOR ** np.arange(0.5, LINES)
    # it is straighter
    ends = level_lines(np.sqrt(costs), np.sqrt(levels), np.full(2, -REACH), spacing=x[1] - x[0])
    return Segments(
        at_height(ends, -HEIGHT), "neutral", 1.0, opacity=0.7, name="equally good centres"
    )


def _near(p: np.ndarray) -> np.ndarray:
    """Return the centres in the picture."""
    with np.errstate(invalid="ignore"):
        return at_height(p[(np.abs(p) <= REACH).all(axis=1)], HEIGHT)


def _cut(ends: np.ndarray) -> np.ndarray:
    """Return the parts of segments in the picture."""
    return at_height(cut_to_rectangle(ends, np.full(2, -REACH), np.full(2, REACH)), HEIGHT)
