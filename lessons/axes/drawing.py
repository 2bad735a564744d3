"""What the stages in space look like: two scans side by side, their frames, and frame on frame."""

import numpy as np

from lessons.axes.captions import of_race, of_state
from lessons.axes.charts import CM2, COLORS, of_space, of_starts
from lessons.axes.scans import Scans
from lessons.axes.space import HOME_DEGREES, State
from workbench.certain import sure
from workbench.data.framing import FAR, box
from workbench.data.shapes.surfaces import sphere
from workbench.data.thinning import every
from workbench.geometry.motions import apply, motion
from workbench.geometry.motions.principal_axes import largest_entry_signs
from workbench.geometry.polylines import between, fan
from workbench.lesson import Look
from workbench.numerals import angle, brief, fixed, length
from workbench.scene import (
    Classes,
    Label,
    Mesh,
    Points,
    Primitive,
    Role,
    Scene,
    Segments,
    arc,
    arrows,
    circle,
    color_map,
)

SIGMAS, BEYOND = 2.0, 1.25  # standard deviations to the ellipsoid; of it: how far an axis reaches
# lines to where points belong; the opacity of what is not chosen
MOST_MISSES = 40
GHOST = 0.3
TIPS = 0.8  # metres from the centroid to the tips of many turns
BALL = sphere(400)
EDGES = np.array([(a, a ^ bit) for a in range(8) for bit in (1, 2, 4) if a < a ^ bit])
CORNERS = np.array([[(k >> bit) & 1 for bit in range(3)] for k in range(8)])
# metres: a cell of the matrix, its first corner
CELL = 0.27
MATRIX = np.array([0.58, 0.0, 0.42])
PLACES = np.array([[-0.58, 0, 0.52], [0.58, 0, 0.52], [-0.58, 0, -0.6], [0.58, 0, -0.6]])


def draw(look: Look) -> Scene:
    """Return the picture of one step of the stages `space`, `frames` and `turn`."""
    scans, state = look.subject, look.now
    scene: dict[str, Primitive] = {"caption": of_state(look)} | of_space(look)
    if state.moment in ("frame", "signs"):
        return scene | _candidates(look)
    if state.moment == "order" and state.frames:
        return scene | _both(look)
    outcome = state.outcome if state.moment in ("pose", "turns") else None
    T = np.eye(4) if outcome is None else scans.T_world_target @ outcome.T_target_source
    scene |= _scans(scans, T)
    if state.moment == "cloud":
        return scene
    p_target = scans.p_target.mean(axis=0)
    centre = Points(state.p_centre[None], "highlight", 0.03, T, name="centroid")
    scene["centroids/source"] = centre
    scene["centroids/target"] = Points(p_target[None], "highlight", 0.03, scans.T_world_target)
    if state.jacobi is None:
        return scene
    covariance = state.jacobi.V @ state.jacobi.A @ state.jacobi.V.T
    if outcome is None:
        p = _ellipsoid(state.p_centre, covariance)
        name = "2 standard deviations"
        scene["ellipsoid"] = Mesh(p, BALL.faces, "highlight", opacity=0.2, name=name)
    if state.axes is None:
        return scene | _turned(state) | _matrix(state)
    reach = _reach(state.axes, covariance)
    if outcome is None:
        axes = largest_entry_signs(state.axes) * reach
        return scene | _lines("frame", state.p_centre, axes, name="axis {}", letters="123")
    scene |= _arrows("frame", state.p_centre, state.axes * reach, T=T)
    return scene | _boxes(scans, state, T) | _missed(scans, state, T) | _tips(scans, state)


def draw_race(look: Look) -> Scene:
    """Return the picture of one round of the stage `starts`."""
    scans, race = look.subject, look.now
    names = []
    for k in range(len(race.T)):
        role: Role = "neutral"
        words = f"{k + 1}: {length(float(race.rmse[k]), 2)}"
        if race.is_told:
            role = "truth" if race.off[k] < HOME_DEGREES else "wrong"
            words += f", {angle(float(race.off[k]), 2)} off"
        names.append((words, role))
    lit = None if not race.is_told else race.winner
    return {"caption": of_race(look)} | _four(scans, race.T, lit, names=names) | of_starts(look)


def _scans(scans: Scans, T_world_source: np.ndarray) -> dict[str, Primitive]:
    radius = _radius(scans)
    scene: dict[str, Primitive] = {
        "target": Points(scans.p_target, "target", radius, scans.T_world_target, name="first scan"),
        "source": Points(scans.p_source, "source", radius, T_world_source, name="second scan"),
    }
    if scans.stray is not None:
        size = 0.02 + 0.01 * float(np.linalg.norm(scans.stray))
        name = "stray point"
        scene["stray"] = Points(scans.stray[None], "wrong", size, T_world_source, name=name)
    return scene


def _radius(scans: Scans) -> float:
    return float(np.clip(0.3 / np.sqrt(len(scans.p_source)), 0.003, 0.012))


def _reach(axes: np.ndarray, covariance: np.ndarray) -> np.ndarray:
    variances = np.einsum("ij,ik,kj->j", axes, covariance, axes)
    return BEYOND * SIGMAS * np.sqrt(np.maximum(variances, 1e-6))


def _candidates(look: Look) -> dict[str, Primitive]:
    """Return the four frames that the axes allow: each brings a ghost over, and one is lit."""
    scans, state = look.subject, look.now
    chosen = state.frame - 1
    names: list[tuple[str, Role]] = []
    for k, frame in enumerate(state.frames):
        picked = state.moment == "signs" and k == chosen
        words = f"{k + 1}: {length(frame.gap, 2)}"
        names.append(
            (f"{words}, by the rule" if picked else words, "source" if k == chosen else "neutral")
        )
    T = np.stack([frame.T_target_source for frame in state.frames])
    cell = _cells(scans)[chosen] @ T[chosen]
    axes = sure(state.axes)
    covariance = sure(state.jacobi).V @ sure(state.jacobi).A @ sure(state.jacobi).V.T
    shown = _arrows("frame", state.p_centre, axes * _reach(axes, covariance), T=cell)
    return _four(scans, T, chosen, names=names) | shown


def _both(look: Look) -> dict[str, Primitive]:
    """Return both scans side by side, each with its axes as lines."""
    scans = look.subject
    state = look.now
    scene = dict[str, Primitive]()
    both: tuple[tuple[Role, np.ndarray, np.ndarray], ...] = (
        ("target", scans.p_target, state.axes_target),
        ("source", scans.p_source, state.axes),
    )
    covariance = state.jacobi.V @ state.jacobi.A @ state.jacobi.V.T
    for (role, p, axes), x in zip(both, (-0.62, 0.62), strict=True):
        T = motion(np.eye(3), np.array([x, 0.0, 0.0]) - p.mean(axis=0))
        name = "first scan" if role == "target" else "second scan"
        scene[f"both/{role}"] = Points(p, role, _radius(scans), T, name=name)
        ends = axes * _reach(state.axes, covariance)
        name = "axis {}" if role == "source" else ""
        scene |= _lines(f"axes/{role}", p.mean(axis=0), ends, name=name, letters="123", T=T)
    return scene


def _cells(scans: Scans) -> np.ndarray:
    """Return where each of four copies of the target is shown (4, 4, 4)."""
    size = max(1.0, float(np.ptp(box(scans.p_target, FAR), axis=0).max()))
    middle = scans.p_target.mean(axis=0)
    return np.stack([motion(np.eye(3), size * place - middle) for place in PLACES])


def _four(
    scans: Scans, T: np.ndarray, lit: int | None, *, names: list[tuple[str, Role]]
) -> dict[str, Primitive]:
    """Return four copies of the target, the source laid on each by a motion; those not lit are
    ghosts.
    """
    scene = dict[str, Primitive]()
    radius = _radius(scans)
    low = float(scans.p_target[:, 2].min() - scans.p_target[:, 2].mean())
    for k, T_cell in enumerate(_cells(scans)):
        faint = lit is not None and k != lit
        first, second = ("first scan", "second scan") if k == (lit or 0) else ("", "")
        scene[f"four/{k + 1}/target"] = Points(
            scans.p_target, "target", radius, T_cell, GHOST if faint else 0.5, name=first
        )
        scene[f"four/{k + 1}/source"] = Points(
            scans.p_source, "source", radius, T_cell @ T[k], GHOST if faint else 1.0, name=second
        )
        words, role = names[k]
        middle = scans.p_target.mean(axis=0) + np.array([0.0, -0.1, low - 0.14])
        scene[f"four/{k + 1}/name"] = Label(words, middle, role, T_cell)
    return scene


def _turned(state: State) -> dict[str, Primitive]:
    """Return the frame as it stands, and the plane in which it was turned, with its angle."""
    rotated = sure(state.jacobi)
    m = state.p_centre
    reach = BEYOND * SIGMAS * np.sqrt(np.maximum(np.diag(rotated.A), 1e-6))
    scene = _lines("frame", m, rotated.V * reach, name="turned {}", letters="xyz")
    if rotated.plane is None:
        return scene
    i, j = rotated.plane
    c, s = np.cos(rotated.angle), np.sin(rotated.angle)
    before = rotated.V[:, i] * c - rotated.V[:, j] * s  # V G^T: where axis i was
    about = np.cross(rotated.V[:, i], rotated.V[:, j])
    radius = 0.55
    ring = circle(m, about, radius, "neutral", opacity=0.5)
    p = ring.ends[:, 0]
    name = "plane of the turn"
    scene["plane"] = Mesh(p, fan(len(p)), "neutral", opacity=0.12, name=name)
    degrees = float(np.degrees(rotated.angle))
    if abs(degrees) > 0.5:
        scene |= arc("angle", m, before, degrees, about=about, radius=radius, color="highlight")
    return scene


def _matrix(state: State) -> dict[str, Primitive]:
    """Return the covariance in the frame as nine cells; those off the diagonal show their size."""
    rotated = sure(state.jacobi)
    first = rotated.V @ rotated.A @ rotated.V.T
    most = float(np.abs(first - np.diag(np.diag(first))).max()) or 1.0
    right = np.array([CELL, 0.0, 0.0])
    down = np.array([0.0, 0.0, -CELL])
    corners = []
    levels = []
    scene = dict[str, Primitive]()
    for i in range(3):
        for j in range(3):
            p = MATRIX + j * right + i * down
            gap = 0.04 * (right + down)
            corners.append(
                [
                    p + gap,
                    p + right + gap * [-1, 0, 1],
                    p + right + down - gap,
                    p + down + gap * [1, 0, -1],
                ]
            )
            levels.append(0.5 if i == j else 0.5 + 0.5 * rotated.A[i, j] / most)
            middle = p + (right + down) / 2 - [0.0, 0.02, 0.0]
            turned = rotated.plane is not None and {i, j} == set(rotated.plane)
            role: Role = "highlight" if turned else "neutral"
            scene[f"matrix/{i}{j}"] = Label(
                fixed(CM2 * rotated.A[i, j], 0), middle, role, stays=True
            )
    faces = np.concatenate(
        [[[4 * k, 4 * k + 1, 4 * k + 2], [4 * k, 4 * k + 2, 4 * k + 3]] for k in range(9)]
    )
    for k, name in enumerate("xyz"):
        across, below = MATRIX + (k + 0.5) * right, MATRIX + (k + 0.5) * down
        scene[f"matrix/{name} across"] = Label(name, across - 0.3 * down, COLORS[k], stays=True)
        scene[f"matrix/{name} down"] = Label(name, below - 0.3 * right, COLORS[k], stays=True)
    scene["matrix/unit"] = Label("covariance, cm²", MATRIX + 1.5 * right - 0.6 * down, "neutral")
    colors = np.repeat(color_map("diverging", np.array(levels)), 4, axis=0)
    name = "covariance in the frame, cm²"
    return scene | {"cells": Mesh(np.concatenate(corners), faces, colors, flat=True, name=name)}


def _boxes(scans: Scans, state: State, T: np.ndarray) -> dict[str, Primitive]:
    """Return the box along the axes, and that along the shape's own sides."""
    if not np.isfinite(state.box):
        return {}
    own = sure(scans.T_target_source)[:3, :3].T
    name = f"box along the axes, {brief(state.box)} × the shape's own"
    along = Segments(_box(scans.p_source, sure(state.axes)), "highlight", 2, T, name=name)
    sides = Segments(_box(scans.p_source, own), "truth", 2, T, 0.7, name="the shape's own box")
    return {"box": along, "own box": sides}


def _missed(scans: Scans, state: State, T_world_source: np.ndarray) -> dict[str, Primitive]:
    """Return lines from where some points came to lie to where they belong, and how far off it
    is.
    """
    T = scans.T_target_source
    outcome = sure(state.outcome)
    if T is None or state.turns is not None:
        return {}
    p = scans.p_source[every(len(scans.p_source), MOST_MISSES)]
    clouds = apply(T_world_source, scans.p_source), apply(scans.T_world_target, scans.p_target)
    high = max(float(np.percentile(cloud[:, 2], 99)) for cloud in clouds)
    top = np.array([scans.T_world_target[0, 3], 0.0, high + 0.2])
    words = f"{angle(outcome.rotation)} from the truth"
    scene: dict[str, Primitive] = {"off": Label(words, top, "truth" if outcome.home else "wrong")}
    if not outcome.home:
        ends = between(apply(T_world_source, p), apply(scans.T_world_target @ T, p))
        scene["missed"] = Segments(ends, "wrong", 1.5, opacity=0.8, name="to where points belong")
    return scene


def _tips(scans: Scans, state: State) -> dict[str, Primitive]:
    """Return a globe round the target with the tips of axes 1 and 2 after many turns."""
    if state.turns is None:
        return {}
    m = scans.p_target.mean(axis=0)
    T = scans.T_world_target
    away = np.repeat(~state.turns.home, 2).astype(np.uint8)
    names = ("axes 1 and 2 where a turn comes home", "where it does not")
    tips = m + TIPS * state.turns.tips.reshape(-1, 3)
    scene: dict[str, Primitive] = {
        "tips": Points(tips, Classes(away, ("truth", "wrong"), names), 0.02, T)
    }
    for k in range(2):
        v = sure(state.axes_target)[:, k]
        front = int(np.count_nonzero(state.turns.tips[:, k] @ v > 0))
        for count, side in ((front, v), (len(away) // 2 - front, -v)):
            place = m + 1.15 * TIPS * side
            name = f"tips/{k + 1}{'-' if side is not v else '+'}"
            scene[name] = Label(f"axis {k + 1}: {count}", place, COLORS[k], T)
    for k, about in enumerate(np.eye(3)):
        ring = circle(apply(T, m), about, TIPS, "neutral", opacity=0.35)
        scene[f"globe/{k}"] = ring
    return scene


def _lines(
    path: str,
    p: np.ndarray,
    axes: np.ndarray,
    *,
    name: str,
    letters: str,
    T: np.ndarray | None = None,
) -> dict[str, Primitive]:
    """Return three lines through a point, along the columns of a matrix, as long to either side."""
    ends = between(p - axes.T, p + axes.T)
    return {
        f"{path}/{k + 1}": Segments(ends[[k]], COLORS[k], 4, T, name=name.format(letters[k]))
        for k in range(3)
    }


def _arrows(path: str, p: np.ndarray, axes: np.ndarray, *, T: np.ndarray) -> dict[str, Primitive]:
    """Return three arrows from a point, along the columns of a matrix, with their numbers."""
    scene: dict[str, Primitive] = {}
    for k in range(3):
        arrow = arrows(p[None], p[None] + axes[:, k], COLORS[k], head=0.1, name=f"axis {k + 1}")
        scene[f"{path}/{k + 1}"] = Segments(arrow.ends, COLORS[k], 4, T, name=arrow.name)
        scene[f"{path}/{k + 1} name"] = Label(str(k + 1), p + 1.08 * axes[:, k], COLORS[k], T)
    return scene


def _ellipsoid(p: np.ndarray, covariance: np.ndarray) -> np.ndarray:
    variances, axes = np.linalg.eigh(covariance)
    return p + SIGMAS * (BALL.p * np.sqrt(np.maximum(variances, 1e-8))) @ axes.T


def _box(p: np.ndarray, axes: np.ndarray) -> np.ndarray:
    """Return the edges of the box of points along three axes."""
    low, high = (end((p @ axes), axis=0) for end in (np.min, np.max))
    return ((low + CORNERS * (high - low)) @ axes.T)[EDGES]
