"""What one step looks like."""

import numpy as np

from workbench.scene import Caption, Points, Scalar, Scene, Segments

from .state import CENTRE, RADIUS, State


def draw(state: State) -> Scene:
    """Show the points, the true circle and the fitted one, and how far they are apart."""
    scene: Scene = {
        "points": Points(in_space(state.p), "target", 0.015, name="measured points"),
        "truth": Segments(outline(np.array([*CENTRE, RADIUS])), "truth", name="true circle"),
        "rms": Scalar(state.rms, "RMS distance", "Distance to the circle", "m"),
        "error": Scalar(state.error, "error of the radius", "Error to the truth", "m", "truth"),
        "caption": caption(state),
    }
    if state.circle is None:
        return scene
    return {**scene, "circle": Segments(outline(state.circle), "source", 2.5, name="fitted circle")}


def caption(state: State) -> Caption:
    """Say what happened, with its numbers."""
    if state.circle is None:
        return Caption(f"{len(state.p)} points were measured near a circle of radius {RADIUS:g} m (green).")
    kind = "The algebraic fit gives" if state.k == 1 else f"Gauss-Newton step {state.k - 1} gives"
    said = f"{kind} radius {state.circle[2]:.3f} m, {1000 * state.error:.1f} mm from the truth"
    return Caption(f"{said}; the points lie {1000 * state.rms:.2f} mm (RMS) from it.")


def in_space(p: np.ndarray) -> np.ndarray:
    """Return points of the plane as points in space, (..., 3), on the ground."""
    return np.concatenate([p, np.zeros((*p.shape[:-1], 1))], axis=-1)


def outline(circle: np.ndarray) -> np.ndarray:
    """Return a circle as 120 line segments, (120, 2, 3)."""
    angles = np.linspace(0, 2 * np.pi, 121)
    p = circle[:2] + circle[2] * np.column_stack([np.cos(angles), np.sin(angles)])
    return in_space(np.stack([p[:-1], p[1:]], axis=1))
