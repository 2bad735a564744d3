"""What one step looks like."""

import numpy as np

from workbench.scene import Caption, Points, Scalar, Scene, Segments

from .state import TRUE, State


def draw(state: State) -> Scene:
    """Show the points, the true circle and the fitted one, and how far they are apart."""
    kind = (
        f"Gauss-Newton step {state.k}" if state.k else f"The algebraic fit of {len(state.p)} points"
    )
    said = (
        f"{kind} gives radius {state.circle[2]:.3f} m, {1000 * state.error:.1f} mm from the truth"
    )
    return {
        "points": Points(in_space(state.p), "target", 0.015, name="measured points"),
        "truth": Segments(outline(TRUE), "truth", name="true circle"),
        "circle": Segments(outline(state.circle), "source", 2.5, name="fitted circle"),
        "rms": Scalar(state.rms, "RMS distance", "Distance to the circle", "m"),
        "error": Scalar(state.error, "error of the radius", "Error to the truth", "m", "truth"),
        "caption": Caption(f"{said}; the points lie {1000 * state.rms:.2f} mm (RMS) from it."),
    }


def in_space(p: np.ndarray) -> np.ndarray:
    return np.concatenate([p, np.zeros((*p.shape[:-1], 1))], axis=-1)


def outline(circle: np.ndarray) -> np.ndarray:
    angles = np.linspace(0, 2 * np.pi, 121)
    p = circle[:2] + circle[2] * np.column_stack([np.cos(angles), np.sin(angles)])
    return in_space(np.stack([p[:-1], p[1:]], axis=1))
