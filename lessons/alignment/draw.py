"""What one step looks like: two scans side by side, their frames, and the second one brought to the
first.
"""

import numpy as np

from lessons.alignment.axes import signed_axes
from lessons.alignment.captions import caption
from lessons.alignment.charts import beside_axes
from lessons.alignment.state import Outcome, Scans, State
from workbench.data.shapes.surfaces import sphere
from workbench.data.thinning import every
from workbench.geometry.motions import apply
from workbench.geometry.motions.principal_axes import largest_entry_signs
from workbench.geometry.polylines import between
from workbench.numerals import angle, brief
from workbench.scene import Classes, Label, Mesh, Points, Primitive, Role, Scene, Segments

COLORS: tuple[Role, Role, Role] = ("x", "y", "z")
SIGMAS = 2.0  # standard deviations to the ellipsoid
BEYOND = 1.25  # of the ellipsoid: how far an axis reaches
MOST_MISSES = 40
TIPS = 0.8  # metres from the centroid to the tips of many turns
BALL = sphere(400)
EDGES = np.array([(a, a ^ bit) for a in range(8) for bit in (1, 2, 4) if a < a ^ bit])
CORNERS = np.array([[(k >> bit) & 1 for bit in range(3)] for k in range(8)])


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    return {"caption": caption(state)} | _in_space(state) | beside_axes(state)


def _in_space(state: State) -> dict[str, Primitive]:
    scans, outcome = state.scans, state.outcome if state.moment in ("pose", "turns") else None
    T_world_source = (
        np.eye(4) if outcome is None else scans.T_world_target @ outcome.T_target_source
    )
    scene = _scans(scans, T_world_source)
    if state.moment == "cloud":
        return scene
    p_target = scans.p_target.mean(axis=0)
    scene["centroids/source"] = Points(
        state.p_centre[None], "highlight", 0.03, T_world_source, name="centroid"
    )
    scene["centroids/target"] = Points(p_target[None], "highlight", 0.03, scans.T_world_target)
    if state.jacobi is None:
        return scene
    covariance = state.jacobi.V @ state.jacobi.A @ state.jacobi.V.T
    if outcome is None:
        scene["ellipsoid"] = Mesh(
            _ellipsoid(state.p_centre, covariance),
            BALL.faces,
            "highlight",
            opacity=0.2,
            name="2 standard deviations",
        )
    if state.axes is None:
        reach = BEYOND * SIGMAS * np.sqrt(np.maximum(np.diag(state.jacobi.A), 1e-6))
        return scene | _lines("frame", state.p_centre, state.jacobi.V * reach, "turned {}", "xyz")
    axes, axes_target = signed_axes(state)
    reach = (
        BEYOND
        * SIGMAS
        * np.sqrt(np.maximum(np.einsum("ij,ik,kj->j", axes, covariance, axes), 1e-6))
    )
    if state.moment == "order":
        return scene | _lines(
            "frame", state.p_centre, largest_entry_signs(axes) * reach, "axis {}", "123"
        )
    scene |= _arrows("frame", state.p_centre, axes * reach, T_world_source)
    if outcome is None:  # else it lies on the other
        scene |= _arrows("target frame", p_target, axes_target * reach, scans.T_world_target, 0.6)
    if np.isfinite(state.box):
        name = f"box along the axes, {brief(state.box)} × the shape's own"
        scene["box"] = Segments(
            _box(scans.p_source, axes), "highlight", 2, T_world_source, name=name
        )
    if outcome is not None:
        scene |= _missed(scans, outcome, T_world_source)
    if state.turns is not None:
        home = np.repeat(~state.turns.home, 2).astype(np.uint8)
        names = ("axes 1 and 2 where a turn comes home", "where it does not")
        tips = p_target + TIPS * state.turns.tips.reshape(-1, 3)
        scene["tips"] = Points(
            tips, Classes(home, ("truth", "wrong"), names), 0.016, scans.T_world_target
        )
    return scene


def _both(scans: Scans, T_world_source: np.ndarray) -> tuple[tuple[np.ndarray, np.ndarray], ...]:
    return (T_world_source, scans.p_source), (scans.T_world_target, scans.p_target)


def _scans(scans: Scans, T_world_source: np.ndarray) -> dict[str, Primitive]:
    radius = float(np.clip(0.3 / np.sqrt(len(scans.p_source)), 0.003, 0.012))
    scene: dict[str, Primitive] = {
        "target": Points(scans.p_target, "target", radius, scans.T_world_target, name="first scan"),
        "source": Points(scans.p_source, "source", radius, T_world_source, name="second scan"),
    }
    if scans.stray is not None:
        size = 0.02 + 0.01 * float(np.linalg.norm(scans.stray))
        scene["stray"] = Points(
            scans.stray[None], "wrong", size, T_world_source, name="stray point"
        )
    return scene


def _missed(scans: Scans, outcome: Outcome, T_world_source: np.ndarray) -> dict[str, Primitive]:
    """Return lines from where some points came to lie to where they belong, and how far the turn is
    off in words.
    """
    T = scans.T_target_source
    if T is None or not np.isfinite(outcome.rotation):
        return {}
    p = scans.p_source[every(len(scans.p_source), MOST_MISSES)]
    true = apply(scans.T_world_target @ T, p)
    high = max(float(apply(T_here, q)[:, 2].max()) for T_here, q in _both(scans, T_world_source))
    top = np.array([scans.T_world_target[0, 3], 0.0, high + 0.3])
    scene: dict[str, Primitive] = {
        "off": Label(
            f"{angle(outcome.rotation)} from the truth", top, "truth" if outcome.home else "wrong"
        )
    }
    if not outcome.home:
        ends = between(apply(T_world_source, p), true)
        scene["missed"] = Segments(ends, "wrong", 1.5, opacity=0.8, name="to where points belong")
    return scene


def _lines(
    path: str,
    p: np.ndarray,
    axes: np.ndarray,
    name: str,
    letters: str,
    T: np.ndarray | None = None,
    opacity: float = 1.0,
) -> dict[str, Primitive]:
    """Return three lines through a point, along the columns of a matrix and as long to either
    side.
    """
    ends = between(p - axes.T, p + axes.T)
    return {
        f"{path}/{k + 1}": Segments(
            ends[[k]], COLORS[k], 4, T, opacity, name=name.format(letters[k]) if name else ""
        )
        for k in range(3)
    }


def _arrows(
    path: str, p: np.ndarray, axes: np.ndarray, T: np.ndarray, opacity: float = 1.0
) -> dict[str, Primitive]:
    """Return three arrows from a point, along the columns of a matrix."""
    scene: dict[str, Primitive] = {}
    for k in range(3):
        tip, aside = p + axes[:, k], axes[:, (k + 1) % 3]
        across = 0.05 * aside / max(float(np.linalg.norm(aside)), 1e-9)
        neck = p + 0.85 * axes[:, k]
        ends = np.array([[p, tip], [tip, neck + across], [tip, neck - across]])
        name = f"axis {k + 1}" if opacity == 1.0 else ""
        scene[f"{path}/{k + 1}"] = Segments(ends, COLORS[k], 4, T, opacity, name=name)
    return scene


def _ellipsoid(p: np.ndarray, covariance: np.ndarray) -> np.ndarray:
    variances, axes = np.linalg.eigh(covariance)
    return p + SIGMAS * (BALL.p * np.sqrt(np.maximum(variances, 1e-8))) @ axes.T


def _box(p: np.ndarray, axes: np.ndarray) -> np.ndarray:
    """Return the edges of the box of points along three axes."""
    low, high = (end((p @ axes), axis=0) for end in (np.min, np.max))
    return ((low + CORNERS * (high - low)) @ axes.T)[EDGES]
