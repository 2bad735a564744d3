"""When what the lesson on axes says is true, decided with numpy and scipy from the scans and the
truth.
"""

import itertools
import re
from typing import Any

import numpy as np
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

from lessons.axes import captions, flat, starts
from tests.readings import near, near_length
from tests.truths.axes import HOME, degrees, eigenvectors, many, to_nearest, turn_left
from tests.verdicts import Claim, Run
from workbench.lesson import Look
from workbench.scene import Caption, caption_of

__all__ = ["CAPTIONS", "LINES", "VALUES", "WHYS", "caption", "right"]

SEED = 0  # of the presets whose lines have numbers


def caption(look: Look) -> Caption:
    if isinstance(look.subject, flat.Outline):
        return caption_of(flat.draw(look))
    is_race = isinstance(look.now, starts.Race)
    return captions.of_race(look) if is_race else captions.of_state(look)


def moment(run: Run, k: int) -> str:
    return getattr(run.states[k], "moment", "race")


def race_off(run: Run, k: int, which: int) -> float:
    return degrees(run.states[k].T[which][:3, :3], run.subject.T_target_source[:3, :3])


def kept_rmse(run: Run, k: int, which: int) -> float:
    """The closest 90 % of the distances; at the end those to the last matches, which ICP has
    kept.
    """
    T = run.states[k].T[which]
    moved = run.subject.p_source @ T[:3, :3].T + T[:3, 3]
    gaps = np.sort(np.asarray(cKDTree(run.subject.p_target).query(moved)[0]))
    return float(np.sqrt(np.mean(gaps[: int(np.ceil(0.9 * len(gaps)))] ** 2)))


def by_rmse(run: Run, k: int, which: int) -> float:
    """One of the four RMSEs in order; found anew to 1 %, since a fit that stops keeps its
    matches.
    """
    rmse = run.states[k].rmse
    for frame in range(4):
        assert np.isclose(rmse[frame], kept_rmse(run, k, frame), rtol=0.01)
    return float(np.sort(rmse)[which])


def right(run: Run, k: int) -> bool | None:
    state = run.states[k]
    scans = run.subject
    if isinstance(state, starts.Race):
        if not state.is_told:
            return None
        return race_off(run, k, int(np.argmin(state.rmse))) < HOME
    if moment(run, k) != "pose" or scans.T_target_source is None:
        return None
    return turn_left(scans, state) < HOME


def matrix(run: Run, k: int) -> np.ndarray:
    V = run.states[k].jacobi.V
    return V.T @ np.cov(run.subject.p_source.T, bias=True) @ V


def left(run: Run, k: int) -> float:
    A = matrix(run, k)
    share = float(np.linalg.norm(A - np.diag(np.diag(A))) / np.linalg.norm(A))
    by_jacobi = run.states[k].jacobi.off
    return by_jacobi if max(share, by_jacobi) < 1e-9 else share  # two ways of rounding


def turned(run: Run, k: int) -> float:
    """The angle between the frame and that of the step before; by hand, that from the scan's
    own.
    """
    V = run.states[k].jacobi.V
    if moment(run, k) == "hand":
        angle = np.degrees(Rotation.from_matrix(V).magnitude())
        return float(np.sign(run.states[k].jacobi.angle) * angle)
    before = run.states[k - 1].jacobi.V
    return float(np.degrees(Rotation.from_matrix(before.T @ V).magnitude()))


def counts(run: Run, k: int) -> float:
    state = run.states[k]
    subject = run.subject
    match moment(run, k):
        case "cloud":
            return len(subject.p_target)
        case "rotation":
            return sum(moment(run, j) == "rotation" for j in range(k + 1))
        case "frame":
            return sum(
                np.linalg.det(np.diag(signs)) > 0
                for signs in itertools.product((1.0, -1.0), repeat=3)
            )
    return len(many(state))


def deviation(which: int) -> Any:
    def found(run: Run, k: int) -> float:
        C = np.cov(run.subject.p_source.T, bias=True)
        return float(np.sqrt(np.linalg.eigvalsh(C)[2 - which]))

    return found


def lit(run: Run, k: int) -> float:
    """The frame that is lit: of the four the one whose motion the axes as they stand give."""
    state = run.states[k]
    if isinstance(state, starts.Race):
        return float(np.argmin([kept_rmse(run, k, i) for i in range(4)]) + 1)
    R = state.axes_target @ state.axes.T
    off = [degrees(frame.T_target_source[:3, :3], R) for frame in state.frames]
    return float(np.argmin(off) + 1)


def skewness(which: int) -> Any:
    def found(run: Run, k: int) -> float:
        """Up to the sign of the axis, which was open: that of the moments in the run."""
        p = run.subject.p_source - run.subject.p_source.mean(axis=0)
        along = p @ eigenvectors(run.subject.p_source)[:, which]
        size = abs(float(np.mean(along**3) / np.mean(along**2) ** 1.5))
        return size * float(np.sign(run.states[k].moments[which]))

    return found


def gap(run: Run, k: int) -> float:
    state = run.states[k]
    scans = run.subject
    if moment(run, k) != "frame":
        return to_nearest(scans, state)
    R = state.axes_target @ state.axes.T
    moved = (scans.p_source - scans.p_source.mean(axis=0)) @ R.T + scans.p_target.mean(axis=0)
    return float(np.sqrt(np.mean(np.asarray(cKDTree(scans.p_target).query(moved)[0]) ** 2)))


def off(run: Run, k: int) -> float:
    state = run.states[k]
    if isinstance(state, starts.Race):
        return race_off(run, k, int(np.argmin(state.rmse)))
    return turn_left(run.subject, state)


def box(run: Run, k: int) -> float:
    p = run.subject.p_source
    R = run.subject.T_target_source[:3, :3]
    along, own = (np.ptp(p @ axes, axis=0).prod() for axes in (run.states[k].axes, R.T))
    return float(along / own)


def line(run: Run, k: int) -> float:
    """The angle between the first axes of both scans, in the first one's frame, without tips."""
    first, second = (eigenvectors(p)[:, 0] for p in (run.subject.p_target, run.subject.p_source))
    along = first @ run.subject.T_target_source[:3, :3] @ second
    return float(np.degrees(np.arccos(min(1.0, abs(along)))))


def sd(run: Run, k: int) -> float:
    a = np.radians(run.states[k].direction)
    return float(np.std(run.subject.p @ np.array([np.cos(a), np.sin(a)])))


def entry(run: Run, k: int) -> float:
    i, j = run.states[k].jacobi.plane
    return float(1e4 * matrix(run, k)[i, j])


VALUES = {
    "direction": lambda run, k: {24: 71.0, 54: 161.0}.get(k, 3.0 * k),
    "sd": sd,
    "n": counts,
    "m": lambda run, k: len(run.subject.p_source),
    "left": left,
    "turned": turned,
    "entry": entry,
    "a": deviation(0),
    "b": deviation(1),
    "c": deviation(2),
    "k": lit,
    "gap": gap,
    "one": skewness(0),
    "two": skewness(1),
    "off": off,
    "box": box,
    "line": line,
    "home": lambda run, k: float(np.mean(many(run.states[k]) < HOME)),
    "median": lambda run, k: float(np.median(many(run.states[k]))),
    "low": lambda run, k: by_rmse(run, k, 0),
    "following": lambda run, k: by_rmse(run, k, 1),
    "round": lambda run, k: run.states[k].round,
}


def at_home(run: Run, k: int, m: re.Match[str]) -> bool:
    return right(run, k) is False


CAPTIONS = (
    Claim(r"random turns come home", lambda run, k, m: run.states[k].turns is not None),
    Claim(r"It is wrong\.", at_home),
    Claim(r"A turn is left to find\.", None),
)


def axis_1(run: Run) -> float:
    return float(run.states[-2].outcome.axes[0])


LINES = {
    "frames": (Claim(r"right-handed", None),),
    "stray": (
        Claim(
            r"Axis 1 moves by 2° only",
            lambda run, k, m: run.params.seed != SEED or near("2", axis_1(run), 1),
        ),
    ),
}


def half_of_the_choices(run: Run, k: int, m: re.Match[str]) -> bool:
    axes = eigenvectors(run.subject.p_source)
    hands = [np.linalg.det(axes * signs) > 0 for signs in itertools.product((1, -1), repeat=3)]
    return (len(hands), sum(hands)) == (8, int(m[1]))


def rotations(run: Run) -> int:
    return sum(moment(run, k) == "rotation" for k in range(len(run.states)))


def wins(run: Run, k: int, m: re.Match[str]) -> bool:
    low, following = (by_rmse(run, k, which) for which in (0, 1))
    return (
        near_length(m["low"], low) and near_length(m["next"], following) and right(run, k) is True
    )


WHYS = {
    "second": (
        Claim(
            r"^(\d+)°",
            lambda run, k, m: near(
                m[1], np.degrees(np.arctan2(*np.linalg.eigh(run.subject.C)[1][::-1, 0])) % 180
            ),
        ),
        Claim(
            r"right angles",
            lambda run, k, m: abs(np.prod(np.linalg.eigh(run.subject.C)[1], axis=1).sum()) < 1e-12,
        ),
    ),
    "predict-rotations": (Claim(r"^(\d+) turns", lambda run, k, m: rotations(run) == int(m[1])),),
    "predict-frames": (
        Claim(r"^(\d): each line has two ends, and of the eight choices half", half_of_the_choices),
    ),
    "predict-signs": (
        Claim(
            r"^(\d+) %",
            lambda run, k, m: bool(
                abs(float(m[1]) - 100 * np.mean(many(run.states[-1]) < HOME)) <= 0.51
            ),
        ),
    ),
    "one-stray": (
        Claim(
            r"^(?P<off>[\d.]+)°\. Axis 1 turns by (?P<first>[\d.]+)°",
            lambda run, k, m: (
                near(m["off"], turn_left(run.subject, run.states[-1]))
                and near(m["first"], axis_1(run))
            ),
        ),
    ),
    "which-wins": (Claim(r"^Frame \d: (?P<low>[\d.]+ mm) against (?P<next>[\d.]+ mm)", wins),),
}
