"""The camera as it is calculated: the given functions, or one of them replaced by a classic
mistake.
"""

from collections.abc import Callable, Iterator
from functools import partial
from itertools import islice

import numpy as np

from lessons.pinhole.following import (
    STAGES,
    Center,
    Distort,
    Project,
    Stage,
    State,
    follow,
    onto_pixels,
)
from lessons.pinhole.shot import wires
from lessons.pinhole.state import Params, Shot
from workbench.data.views.street import street
from workbench.geometry.cameras import OPENGL_FROM_OPENCV
from workbench.geometry.cameras.raster import Image, PointItem, SegmentItem, render
from workbench.geometry.motions import apply, inverse
from workbench.scene import Role, color_rows

SWAP = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])

Model = Callable[[np.ndarray], Iterator[State]]
"""model(p_world) -> the stages of these points."""


def laid_out(model: Model) -> Model:
    """Return the model up to its pixels, which calculates the same points once only: others may own
    its functions.
    """
    known: dict[bytes, tuple[State, ...]] = {}

    def stages(p_world: np.ndarray) -> Iterator[State]:
        key = p_world.tobytes()
        if key not in known:
            known[key] = tuple(islice(model(p_world), STAGES.index("pixels") + 1))
        return iter(known[key])

    return stages


def pixels(model: Model, stage: Stage, K: np.ndarray, p_world: np.ndarray) -> np.ndarray:
    """Return where the calculation puts these points in the picture at a stage from the division
    on.

    Before it has pixels itself, the true K makes them of the places on the plane one metre in
    front.
    """
    now = next(state for state in model(p_world) if state.stage in (stage, "pixels"))
    return (
        now.uv
        if now.reached("pixels")
        else onto_pixels(now.xy_bent if now.reached("distort") else now.xy, K)
    )


def model_of(
    params: Params, shot: Shot, project: Project, distort: Distort, camera_center: Center
) -> Model:
    """Return the calculation with the given functions, changed by the mistake that is asked for."""
    K = shot.K if params.k_follows else shot.K_first
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
            return partial(
                model, distort=lambda xy, k1, k2, p1, p2: distort(f * xy, k1, k2, p1, p2) / f
            )
        case "t for the centre":
            return partial(model, camera_center=lambda T_camera_world: T_camera_world[:3, 3].copy())
        case "ray length for depth":
            return lambda p_world: model(p_world, depth=np.linalg.norm(apply(T, p_world), axis=1))
    return model


def divide_anyway(p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Divide by the depth whatever its sign: what lies behind gets a pixel too, upside down."""
    x, y, z = (K @ apply(T_camera_world, p_world).T)[:3]
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(z[:, None] == 0, np.nan, np.stack([x, y], axis=1) / z[:, None])


def overlaid(shot: Shot, model: Model, stage: Stage, point: int) -> np.ndarray:
    """Return the photograph with the outlines and points that a stage has calculated laid over it,
    whatever hides them.

    From the division on; before it, only the followed point's true pixel.
    """
    h, w = shot.picture.shape[:2]
    true = _flat(shot.uv[point : point + 1], "truth", 9)
    if stage in ("world", "camera"):
        return _over(shot.picture, render([true], np.eye(4), np.eye(3), w, h))
    to_pixels = partial(pixels, model, stage, shot.K)
    lines = wires(shot.T_camera_world)
    drawn = render(
        [SegmentItem(lines, color_rows("source", len(lines)))],
        shot.T_camera_world,
        shot.K,
        w,
        h,
        shot.lens,
        to_pixels=to_pixels,
    )
    uv = to_pixels(street().points)
    spots = [_flat(uv, "source", 3), true, _flat(uv[[point]], "highlight", 7)]
    return _over(
        shot.picture, drawn, *(render([spot], np.eye(4), np.eye(3), w, h) for spot in spots)
    )


def _over(picture: np.ndarray, *layers: Image) -> np.ndarray:
    picture = picture.copy()
    for layer in layers:
        shown = np.isfinite(layer.depth)
        picture[shown] = layer.colors[shown]
    return picture


def _flat(uv: np.ndarray, role: Role, width: int) -> PointItem:
    """Return points that a camera with K = I at the origin sees at these very pixels."""
    return PointItem(np.column_stack([uv, np.ones(len(uv))]), color_rows(role, len(uv)), width)
