"""The camera as it is calculated: the given functions, or one replaced by a classic mistake."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from itertools import islice

import numpy as np

from lessons.pinhole import following as pinhole
from lessons.pinhole.following import (
    STAGES,
    Center,
    Distort,
    Project,
    Stage,
    follow,
    onto_pixels,
)
from lessons.pinhole.inputs import Input
from lessons.pinhole.shot import Shot, wires
from workbench.geometry.cameras import OPENGL_FROM_OPENCV
from workbench.geometry.cameras.raster import SegmentItem, render
from workbench.geometry.motions import apply, inverse
from workbench.scene import color_rows

SWAP = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])

Model = Callable[[np.ndarray], Iterator[pinhole.State]]
"""model(p_world) -> the stages of these points."""


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One stage of all points through the calculation, beside the true shot.

    Attributes:
        now: How far the calculation has come.
        picture: The photograph with what this stage has calculated laid over it, if anything.
        error: Median distance to the true pixels, as far as the stage tells, px; NaN before it
            does.
        found, missed, false: How many points have a calculated pixel; how many lack one that the
            camera does see; and how many have one that the camera does not see.
    """

    now: pinhole.State
    picture: np.ndarray
    error: float
    found: int
    missed: int
    false: int


def compared(shot: Shot, now: pinhole.State) -> tuple[float, int, int, int]:
    """Return the median distance from the true pixels, and how many are found, missed and false.

    Before pixels are reached, both sides are scaled with the true K, so that all stages speak of
    pixels.
    """
    if not now.reached("divide"):
        return float("nan"), 0, 0, 0
    true, got = shot.uv, onto_pixels(now.xy_bent, shot.K)
    if not now.reached("distort"):
        true, got = onto_pixels(shot.xy, shot.K), onto_pixels(now.xy, shot.K)
    if now.reached("pixels"):
        got = now.uv
    seen, found = np.isfinite(true).all(axis=1), np.isfinite(got).all(axis=1)
    off = np.linalg.norm(got - true, axis=1)[seen & found]
    error = float(np.median(off)) if len(off) else float("nan")
    return error, int(found.sum()), int((seen & ~found).sum()), int((found & ~seen).sum())


def laid_out(model: Model) -> Model:
    """Return the model up to its pixels, which calculates the same points once only.

    Its functions may be others' and live in another process.
    """
    known: dict[bytes, tuple[pinhole.State, ...]] = {}

    def stages(p_world: np.ndarray) -> Iterator[pinhole.State]:
        key = p_world.tobytes()
        if key not in known:
            known[key] = tuple(islice(model(p_world), STAGES.index("pixels") + 1))
        return iter(known[key])

    return stages


def model_of(
    params: Input, shot: Shot, project: Project, distort: Distort, camera_center: Center
) -> Model:
    """Return the calculation with the given functions, changed by the mistake that is asked for."""
    K = shot.K
    if params.edit != "none" and not params.k_follows:
        K = shot.K_first
    T, f = shot.T_camera_world, K[0, 0]
    model = partial(
        follow,
        T_camera_world=T,
        K=K,
        lens=shot.lens,
        project=project,
        distort=distort,
        camera_center=camera_center,
    )
    match params.mistake:
        case "pose inverted":
            return partial(model, T_camera_world=inverse(T))
        case "divides behind too":
            return partial(model, project=divide_anyway)
        case "OpenGL axes":
            return partial(model, T_camera_world=OPENGL_FROM_OPENCV @ T, project=divide_anyway)
        case "row before column":
            return partial(model, K=SWAP @ K)
        case "lens on pixels":
            return partial(model, distort=lambda xy, *k: distort(f * xy, *k) / f)
        case "t for the centre":
            return partial(model, camera_center=lambda T_camera_world: T_camera_world[:3, 3].copy())
        case "ray length for depth":
            return lambda p: model(p, depth=np.linalg.norm(apply(T, p), axis=1))
    return model


def divide_anyway(p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Divide by the depth whatever its sign: what lies behind gets a pixel too, upside down."""
    x, y, z = (K @ apply(T_camera_world, p_world).T)[:3]
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(z[:, None] == 0, np.nan, np.stack([x, y], axis=1) / z[:, None])


def overlaid(shot: Shot, model: Model, stage: Stage) -> np.ndarray:
    """Return the photograph with the outlines that a stage has calculated laid over it.

    From the division on; whatever hides them in the street.
    """
    if stage in ("world", "camera"):
        return shot.picture
    lines, (h, w) = wires(shot.T_camera_world), shot.picture.shape[:2]

    def to_pixels(p_world: np.ndarray) -> np.ndarray:
        """Before the calculation has pixels itself, the true K makes them."""
        now = next(state for state in model(p_world) if state.stage in (stage, "pixels"))
        if now.reached("pixels"):
            return now.uv
        return onto_pixels(now.xy_bent if now.reached("distort") else now.xy, shot.K)

    drawn = render(
        [SegmentItem(lines, color_rows("source", len(lines)))],
        shot.T_camera_world,
        shot.K,
        w,
        h,
        shot.lens,
        to_pixels=to_pixels,
    )
    shown, picture = np.isfinite(drawn.depth), shot.picture.copy()
    picture[shown] = drawn.colors[shown]
    return picture
