"""The values that captions about the paper and the balls carry, found anew from angles and edges
alone.
"""

import numpy as np
from scipy.optimize import brentq

from lessons.curvature import balls
from lessons.curvature.inputs import Input
from tests.verdicts import Run


def _height(run: Run, k: int) -> float:
    """Return the height of the paper, found from the angle that neighbouring corners make."""
    gap = run.states[k].gap
    angle = np.radians((360.0 - gap) / 6)

    def miss(up: float) -> float:
        """Return how far two neighbouring corners miss the angle, one `up`, radians."""
        other = up if gap > 0 else -up
        a, b = (np.array([np.sqrt(1 - z * z), z]) for z in (up, other))
        return float(np.arccos(0.5 * a[0] * b[0] + a[1] * b[1]) - angle)

    up = brentq(miss, 0.0, 0.999)
    return up if gap > 0 else 2 * up


def _ball(k: int) -> tuple[int, float, float]:
    """Return how many vertices a ball has, and at its vertex the gap in radians and the area, both
    from the edges alone: the law of cosines, and Meyer's cotangents of angles that are all acute.
    """
    subject = balls.setup(Input(stage="balls"))
    surface, v = subject.surfaces[k], subject.vertices[k]
    gap = 2 * np.pi
    area = 0.0
    for face in surface.faces[(surface.faces == v).any(axis=1)]:
        corner, a, b = surface.p[np.roll(face, -int(np.flatnonzero(face == v)[0]))]
        u, w, far = (float(np.linalg.norm(d)) for d in (a - corner, b - corner, b - a))
        gap -= np.arccos((u * u + w * w - far * far) / (2 * u * w))
        at_a = np.arccos((u * u + far * far - w * w) / (2 * u * far))
        at_b = np.arccos((w * w + far * far - u * u) / (2 * w * far))
        area += (u * u / np.tan(at_b) + w * w / np.tan(at_a)) / 8
    return len(surface.p), float(gap), area


def _gap_said(run: Run, k: int) -> float:
    """Return the gap in degrees, of the paper or of a ball."""
    return float(np.degrees(_ball(k)[1])) if run.params.stage == "balls" else run.states[k].gap


VALUES = {
    "vertices": lambda run, k: _ball(k)[0],
    "area": lambda run, k: _ball(k)[2],
    "K": lambda run, k: _ball(k)[1] / _ball(k)[2],
    "angle": lambda run, k: 60.0 - run.states[k].gap / 6,
    "gap": _gap_said,
    "overlap": lambda run, k: -run.states[k].gap,
    "height": _height,
}
