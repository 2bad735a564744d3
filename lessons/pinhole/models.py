"""The camera as it is calculated: the given functions, or one of them replaced by a classic mistake."""

from dataclasses import dataclass, replace

import numpy as np

from lessons.pinhole.shot import wires
from lessons.pinhole.state import Params, Shot
from workbench.algorithms.pinhole import Center, Distort, Project, follow
from workbench.data.street import street
from workbench.geometry.cameras import OPENGL_FROM_OPENCV
from workbench.geometry.distortion import Distortion
from workbench.geometry.motions import apply, inverse
from workbench.geometry.raster import PointItem, SegmentItem, render
from workbench.scene import Role, color_rows

SWAP = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])


@dataclass(frozen=True, eq=False, kw_only=True)
class Model:
    """What `follow` is given: motion, intrinsics, lens, the three functions, and what counts as depth."""

    T_camera_world: np.ndarray
    K: np.ndarray
    lens: Distortion
    project: Project
    distort: Distort
    camera_center: Center
    takes_ray_length: bool = False

    def follow(self, p_world: np.ndarray):
        """Yield the stages of these points."""
        p_camera = apply(self.T_camera_world, p_world)
        return follow(
            p_world,
            self.T_camera_world,
            self.K,
            self.lens,
            project=self.project,
            distort=self.distort,
            camera_center=self.camera_center,
            depth=np.linalg.norm(p_camera, axis=1) if self.takes_ray_length else None,
        )

    def pixels(self, p_world: np.ndarray) -> np.ndarray:
        """Return where the calculation puts these points in the picture."""
        return next(state.uv for state in self.follow(p_world) if state.stage == "pixels")


def model_of(params: Params, shot: Shot, project: Project, distort: Distort, camera_center: Center) -> Model:
    """Return the calculation with the given functions, changed by the mistake that is asked for."""
    K = shot.K if params.k_follows else shot.K_first
    model = Model(
        T_camera_world=shot.T_camera_world,
        K=K,
        lens=shot.lens,
        project=project,
        distort=distort,
        camera_center=camera_center,
    )
    f = K[0, 0]
    match params.mistake:
        case "pose inverted":
            return replace(model, T_camera_world=inverse(shot.T_camera_world))
        case "divides behind too":
            return replace(model, project=divide_anyway)
        case "OpenGL axes":
            return replace(model, T_camera_world=OPENGL_FROM_OPENCV @ shot.T_camera_world, project=divide_anyway)
        case "row before column":
            return replace(model, K=SWAP @ K)
        case "lens on pixels":
            return replace(model, distort=lambda xy, k1, k2, p1, p2: distort(f * xy, k1, k2, p1, p2) / f)
        case "t for the centre":
            return replace(model, camera_center=lambda T_camera_world: T_camera_world[:3, 3].copy())
        case "ray length for depth":
            return replace(model, takes_ray_length=True)
    return model


def divide_anyway(p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Divide by the depth whatever its sign: what lies behind gets a pixel too, upside down."""
    x, y, z = (K @ apply(T_camera_world, p_world).T)[:3]
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(z[:, None] == 0, np.nan, np.stack([x, y], axis=1) / z[:, None])


def overlaid(shot: Shot, model: Model, point: int) -> np.ndarray:
    """Return the photograph with the calculated outlines and points laid over it, whatever hides them."""
    h, w = shot.picture.shape[:2]
    lines = wires(shot.T_camera_world)
    drawn = render(
        [SegmentItem(lines, color_rows("source", len(lines)))],
        shot.T_camera_world, shot.K, w, h, shot.lens, to_pixels=model.pixels,
    )  # fmt: skip
    uv = model.pixels(street().points)
    spots = [_flat(uv, "source", 3), _flat(shot.uv[point : point + 1], "truth", 9), _flat(uv[[point]], "highlight", 7)]
    picture = shot.picture.copy()
    for layer in (drawn, *(render([spot], np.eye(4), np.eye(3), w, h) for spot in spots)):
        shown = np.isfinite(layer.depth)
        picture[shown] = layer.colors[shown]
    return picture


def _flat(uv: np.ndarray, role: Role, width: int) -> PointItem:
    """Return points that a camera with K = I at the origin sees at these very pixels."""
    return PointItem(np.column_stack([uv, np.ones(len(uv))]), color_rows(role, len(uv)), width)
