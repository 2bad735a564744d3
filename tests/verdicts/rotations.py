"""When what the lesson on rotations says is true, decided with numpy and scipy's rotations from the
numbers that were asked for.
"""

import functools
import itertools
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from lessons.rotations.lesson import draw
from lessons.rotations.moving import caption as caption_of_poses
from lessons.rotations.poses import Moved
from tests.readings import NUMBER, near
from tests.verdicts import Claim, Run
from workbench.lesson import Look
from workbench.scene import Caption, caption_of

__all__ = ["CAPTIONS", "LINES", "VALUES", "WHYS", "caption", "right"]

SMALL = 1e-9


def caption(look: Look) -> Caption:
    return caption_of_poses(look) if isinstance(look.now, Moved) else caption_of(draw(look))


def of(params: Any, angles: Any, order: str | None = None) -> Rotation:
    return Rotation.from_euler(order or params.order, angles, degrees=True)


def degrees(rotation: Rotation, other: Rotation) -> float:
    return float(np.degrees((other * rotation.inv()).magnitude()))


def axles(params: Any, pitch: float) -> np.ndarray:
    """The axes of the three angles as rows, by a small change of each."""
    first, _, third = params.angles
    tiny = 1e-5
    here = np.array([first, pitch, third], float)
    axes = []
    for k in range(3):
        more = here + np.degrees(tiny) * np.eye(3)[k]
        less = here - np.degrees(tiny) * np.eye(3)[k]
        w = (of(params, more) * of(params, less).inv()).as_rotvec()
        axes.append(w / np.linalg.norm(w))
    return np.array(axes)


def lines_apart(run: Run, k: int) -> float:
    """Degrees between the first and the last axle, as lines."""
    if run.params.stage == "mean":
        return float(run.states[k].value)
    first, _, third = axles(run.params, run.states[k].value)
    sine = np.linalg.norm(np.cross(first, third))
    return float(np.degrees(np.arctan2(sine, abs(first @ third))))


def whole(run: Run, k: int) -> float:
    return float(np.degrees(of(run.params, run.params.angles).magnitude()))


def poses(params: Any) -> tuple[Rotation, Rotation]:
    turned = Rotation.from_rotvec(params.pose[3:]) * of(params, params.angles_end)
    return of(params, params.angles), turned


def nearest(T: np.ndarray) -> Rotation:
    U, _, V = np.linalg.svd(T[:3, :3])
    return Rotation.from_matrix(U @ np.diag([1, 1, np.linalg.det(U @ V)]) @ V)


@functools.lru_cache(maxsize=4)
def every_turn(run: Run) -> np.ndarray:
    rotations = [nearest(state.T_world_body) for state in run.states]
    return np.array([degrees(a, b) for a, b in itertools.pairwise(rotations)])


def turned(run: Run, k: int = -1) -> float:
    turns = every_turn(run)
    return float(turns.sum() if k == -1 else turns[:k].sum())


def shortest(run: Run, k: int = 0) -> float:
    return degrees(*poses(run.params))


def at_best(run: Run, k: int) -> np.ndarray:
    start, end = poses(run.params)
    t = k / (len(run.states) - 1)
    T = np.eye(4)
    T[:3, :3] = (Rotation.from_rotvec(t * (end * start.inv()).as_rotvec()) * start).as_matrix()
    T[:3, 3] = t * np.array(run.params.pose[:3])
    return T


def off(run: Run, k: int) -> float:
    state = run.states[k]
    if run.params.stage == "readings":
        return degrees(of(run.params, run.params.angles), Rotation.from_matrix(state.R))
    return degrees(nearest(at_best(run, k)), nearest(state.T_world_body))


def volumes(run: Run) -> np.ndarray:
    return np.array([np.linalg.det(state.T_world_body[:3, :3]) for state in run.states])


def left(run: Run, k: int) -> float:
    if run.params.stage == "mean":
        return float(np.cos(np.radians(run.states[k].value / 2)) ** 2)
    return float(abs(volumes(run)[k]))


def missed(run: Run, k: int) -> float:
    p = np.column_stack([run.subject.solid.p, np.ones(len(run.subject.solid.p))])
    end = np.eye(4)
    end[:3, :3] = poses(run.params)[1].as_matrix()
    end[:3, 3] = run.params.pose[:3]
    return float(np.linalg.norm((p @ (run.states[k].T_world_body - end).T)[:, :3], axis=1).max())


def aside(run: Run, k: int) -> float:
    return float(np.linalg.norm((run.states[k].T_world_body - at_best(run, k))[:3, 3]))


VALUES = {
    "pitch": lambda run, k: float(run.states[k].value),
    "apart": lines_apart,
    "off": off,
    "angle": lambda run, k: float(run.states[k].value),
    "half": lambda run, k: run.states[k].value / 2,
    "other": lambda run, k: 180 - run.states[k].value / 2,
    "left": left,
    "shortest": shortest,
    "t": lambda run, k: k / (len(run.states) - 1),
    "turned": turned,
    "aside": aside,
    "missed": missed,
    "lowest": lambda run, k: float(np.abs(volumes(run)).min()),
}


def right(run: Run, k: int) -> bool | None:
    """Judged are bodies that are none any more, and the end of a way."""
    if run.params.stage != "poses":
        return None
    if abs(volumes(run)[k] - 1.0) > SMALL:
        return False
    if k < len(run.states) - 1:
        return None
    if missed(run, k) > SMALL:
        return False
    if np.abs(np.abs(volumes(run)) - 1.0).max() > SMALL:
        return None
    return True if turned(run) <= shortest(run) + 0.05 else None


CAPTIONS = (
    Claim(r"from the right rotation", None),
    Claim(r": the same rotation", lambda run, k, m: off(run, k) < 1e-6),
)


def pitch_lost(run: Run, k: int, m: Any) -> bool:
    rank = np.linalg.matrix_rank(axles(run.params, run.states[-1].value), tol=1e-4)
    named = of(run.params, [float(x.replace("−", "-")) for x in (m[2], m[3], m[4])])
    return int(m[1]) == rank and abs(degrees(named, of(run.params, run.params.angles)) - 1) < 0.02


LINES: dict[str, tuple[Claim, ...]] = {
    "family": (
        Claim(
            r"a whole family of triples makes the same pose",
            lambda run, k, m: max(off(run, i) for i in range(4)) < 1e-6,
        ),
    ),
    "conventions": (
        Claim(
            r"four different rotations",
            lambda run, k, m: (
                min(
                    degrees(Rotation.from_matrix(a.R), Rotation.from_matrix(b.R))
                    for a, b in itertools.combinations(run.states[1:], 2)
                )
                > 10
            ),
        ),
    ),
}
N = NUMBER
WHYS = {
    "lost-direction": (
        Claim(rf"^(\d)\. The outer[^(]*\(30, 90, 50\)° to \(({N}), ({N}), ({N})\)°", pitch_lost),
    ),
    "same-turn": (
        Claim(
            rf"The other two are ({N})° and ({N})° off",
            lambda run, k, m: near(m[1], off(run, 2)) and near(m[2], off(run, 3)),
        ),
    ),
    "sum-of-turns": (
        Claim(rf"^({N})°, about", lambda run, k, m: near(m[1], whole(run, k))),
        Claim(
            r"as far from x as from y and z",
            lambda run, k, m: bool(np.ptp(of(run.params, run.params.angles).as_rotvec()) < 1e-9),
        ),
    ),
    "long-way": (
        Claim(rf"^({N})°\. On the circle", lambda run, k, m: near(m[1], turned(run))),
        Claim(r"−q is 150° away", lambda run, k, m: abs(shortest(run) - 60) < 1e-9),
    ),
    "mean-heading": (
        Claim(rf"^({N})°", lambda run, k, m: near(m[1], turned(run))),
        Claim(rf"only ({N})° apart", lambda run, k, m: near(m[1], shortest(run))),
    ),
    "mean-matrix": (
        Claim(rf"^({N}) %", lambda run, k, m: near(m[1], 100 * np.cos(np.radians(85)) ** 2)),
        Claim(r"0\.087", lambda run, k, m: abs(np.cos(np.radians(85)) - 0.0872) < 1e-4),
    ),
}
