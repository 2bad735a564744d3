"""The camera as it is calculated: the given functions, or one replaced by a classic mistake."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache, partial
from itertools import islice

import numpy as np

from lessons.pinhole import following as pinhole
from lessons.pinhole.following import STAGES, Center, Distort, Project, Stage, follow, onto_pixels
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


def compared(shot: Shot, state: pinhole.State, picture: np.ndarray) -> State:
    """Return a stage beside the true shot.

    Before pixels are reached, both sides are scaled with the true K, so that all stages speak of
    pixels.
    """
    if not state.reached("divide"):
        return State(now=state, picture=picture, error=float("nan"), found=0, missed=0, false=0)
    true = shot.uv if state.reached("distort") else onto_pixels(shot.xy, shot.K)
    got = state.seen(shot.K)
    seen = np.isfinite(true).all(axis=1)
    projected = np.isfinite(got).all(axis=1)
    off = np.linalg.norm(got - true, axis=1)[seen & projected]
    return State(
        now=state,
        picture=picture,
        error=float(np.median(off)) if len(off) else float("nan"),
        found=int(projected.sum()),
        missed=int((seen & ~projected).sum()),
        false=int((projected & ~seen).sum()),
    )


def model_of(
    params: Input, shot: Shot, project: Project, *, distort: Distort, camera_center: Center
) -> Model:
    """Return the calculation with the given functions, changed by the mistake that is asked for."""
    K = shot.K_first if params.forgets_k else shot.K
    T = shot.T_camera_world
    f = K[0, 0]
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


def overlays(shot: Shot, model: Model) -> Callable[[Stage], np.ndarray]:
    """Return what gives the photograph with the outlines that a stage has calculated laid over it.

    From the division on; whatever hides them in the street. The outlines are calculated once for
    all stages, since functions may be others' and live in another process.
    """
    lines = wires(shot.T_camera_world)
    item = SegmentItem(lines, color_rows("source", len(lines)))
    h, w = shot.picture.shape[:2]

    @cache
    def calculated(p_world: bytes) -> dict[Stage, pinhole.State]:
        p = np.frombuffer(p_world).reshape(-1, 3).copy()
        return {state.stage: state for state in islice(model(p), len(STAGES) - 1)}

    @cache
    def laid_over(stage: Stage) -> np.ndarray:
        drawn = render(
            [item],
            shot.T_camera_world,
            shot.K,
            width=w,
            height=h,
            distortion=shot.lens,
            to_pixels=lambda p: calculated(np.asarray(p, float).tobytes())[stage].seen(shot.K),
        )
        shown = np.isfinite(drawn.depth)
        return np.where(shown[..., None], drawn.colors, shot.picture)

    def overlaid(stage: Stage) -> np.ndarray:
        if stage in ("world", "camera"):
            return shot.picture
        return laid_over("pixels" if stage == "back" else stage)

    return overlaid
