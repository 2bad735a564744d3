"""When what the lesson on pairs says is true, decided with numpy and scipy from the scans and
the truth.
"""

import re
from collections.abc import Callable

import numpy as np
from scipy.spatial.transform import Rotation

from lessons.pairs.drawing import caption as caption_space
from lessons.pairs.flat import Bands
from lessons.pairs.flat import draw as draw_flat
from tests.readings import LENGTH, NUMBER, near, near_length
from tests.verdicts import Claim, Run
from workbench.lesson import Look
from workbench.scene import Caption, caption_of

__all__ = ["CAPTIONS", "LINES", "VALUES", "WHYS", "caption", "right"]

FLIP, SCALE = 5, 6


def caption(look: Look) -> Caption:
    if isinstance(look.subject, Bands):
        return caption_of(draw_flat(look))
    return caption_space(look)


def flat(run: Run) -> bool:
    return isinstance(run.subject, Bands)


def map_of(run: Run, k: int) -> np.ndarray:
    return run.states[k].now.T_target_source


def rmse(run: Run, k: int) -> float:
    scans = run.subject
    if flat(run):
        z = (scans.p_source[:, 0] + 1j * scans.p_source[:, 1]) * np.exp(
            1j * np.radians(run.states[k].angle)
        )
        return float(
            np.sqrt(np.mean(np.abs(z - scans.p_target[:, 0] - 1j * scans.p_target[:, 1]) ** 2))
        )
    T = map_of(run, k)
    moved = scans.p_source @ T[:3, :3].T + T[:3, 3]
    return float(np.sqrt(((scans.p_target - moved) ** 2).sum(axis=1).mean()))


def off(run: Run, k: int = FLIP) -> float:
    """Degrees from the truth of the rotation in the map; NaN where there is none to compare."""
    T = map_of(run, k)
    true = run.subject.T_target_source
    if true is None or np.linalg.det(T[:3, :3]) < 0:
        return float("nan")
    rotation, other = (
        Rotation.from_matrix(A[:3, :3] / np.cbrt(np.linalg.det(A[:3, :3]))) for A in (T, true)
    )
    return float(np.degrees((rotation * other.inv()).magnitude()))


def scale(run: Run, k: int = SCALE) -> float:
    return float(np.linalg.norm(map_of(run, k)[:3, 0]))


def true_scale(run: Run) -> float:
    return float(np.linalg.norm(run.subject.T_target_source[:3, 0]))


def strengths(run: Run) -> np.ndarray:
    p, q = (points - points.mean(axis=0) for points in (run.subject.p_target, run.subject.p_source))
    return 1e4 * np.linalg.svd(p.T @ q / len(p), compute_uv=False)


def right(run: Run, k: int) -> bool | None:
    if flat(run) or k != SCALE or not np.isfinite(off(run, k)):
        return None
    return off(run, k) < 10.0 and abs(scale(run) / true_scale(run) - 1) < 0.02


CAPTIONS = (
    Claim(r"\d+ of them wrong", None),
    Claim(
        rf"The scale is {NUMBER} instead of {NUMBER}",
        lambda run, k, m: abs(scale(run) / true_scale(run) - 1) >= 0.02,
    ),
)


def turn_in(run: Run, k: int) -> float:
    before = map_of(run, k - 1)[:3, :3]
    after = map_of(run, k)[:3, :3]
    return float(np.degrees(Rotation.from_matrix(after @ before.T).magnitude()))


VALUES = {
    "angle": lambda run, k: run.states[k].angle if run.states[k].angle > -180 else 180.0,
    "rmse": rmse,
    "n": lambda run, k: len(run.subject.p_source),
    "wrong": lambda run, k: round(run.params.wrong / 100 * len(run.subject.p_source)),
    "a": lambda run, k: strengths(run)[0],
    "b": lambda run, k: strengths(run)[1],
    "c": lambda run, k: strengths(run)[2],
    "turn": turn_in,
    "off": off,
    "there": scale,
    "true": lambda run, k: true_scale(run),
}


def seen(holds: Callable[[Run], bool]) -> Callable[[Run, int, re.Match[str]], bool]:
    """Judge a number that is seen at the presets' own seed, and there alone."""
    return lambda run, k, m: run.params.seed != 0 or holds(run)


LINES = {
    "half-wrong-pairs": (
        Claim(r"Half of the pairs are wrong", lambda run, k, m: run.subject.is_wrong.mean() == 0.5),
        Claim(
            r"750 of 1,500 points have the partner of another point",
            lambda run, k, m: run.subject.is_wrong.sum() == 750,
        ),
    ),
    "mirrored": (
        Claim(
            r"the weakest, which costs least",
            lambda run, k, m: abs(rmse(run, FLIP) ** 2 - 4e-4 * strengths(run).min()) < 1e-9,
        ),
    ),
    "scale": (Claim(r"the scale comes out too small", lambda run, k, m: scale(run) < 0.97 * 1.5),),
    "scale-clean": (
        Claim(r"the scale is 1\.50 again", seen(lambda run: abs(scale(run) - 1.5) < 0.005)),
    ),
}


def priced(run: Run, k: int, m: re.Match[str]) -> bool:
    return (
        near_length(m[1], rmse(run, FLIP), 2)
        and abs(rmse(run, FLIP) ** 2 - 4e-4 * strengths(run).sum()) < 1e-9
    )


def there_and_back(run: Run, k: int, m: re.Match[str]) -> bool:
    p, q = run.subject.p_target, run.subject.p_source
    p, q = p - p.mean(axis=0), q - q.mean(axis=0)
    trace = np.linalg.svd(p.T @ q, compute_uv=False).sum()
    forward, back = trace / (q**2).sum(), trace / (p**2).sum()
    written = [float(m[i]) for i in (1, 2, 3)]
    return (
        bool(np.allclose(written, [forward, back, forward * back], atol=6e-4))
        and forward * back < 0.98
    )


WHYS = {
    "how-many-valleys": (
        Claim(
            rf"^One valley, at 0°, and one top, ({LENGTH}) high, on the opposite side",
            lambda run, k, m: (
                near_length(m[1], max(rmse(run, i) for i in range(121)), 2)
                and int(np.argmin([rmse(run, i) for i in range(121)])) == 60
                and int(np.argmax([rmse(run, i) for i in range(121)])) in (0, 120)
            ),
        ),
    ),
    "predict-negated": (Claim(rf"^({LENGTH})\. Add the three prices and take the root", priced),),
    "predict-product": (
        Claim(rf"^({NUMBER}) there and ({NUMBER}) back: ({NUMBER}) in all", there_and_back),
    ),
    "half-wrong": (
        Claim(rf"^({NUMBER})°\.", lambda run, k, m: near(m[1], off(run)) and off(run) < 5.0),
        Claim(r"Each wrong band pulls its own way, and 750 such pulls nearly cancel", None),
        Claim(r"The right ones all pull the same way", None),
    ),
}
