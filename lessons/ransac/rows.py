"""Where the rows of a run come from, built-in scenes or the person's own files, and where they
stand in the picture.
"""

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np

from lessons.ransac import robust_scenes as robust
from lessons.ransac.robust_scenes import RobustScene
from lessons.ransac.state import MOST_POINTS, Params, Subject
from workbench.algorithms.robust.models import MODELS, Model
from workbench.data.files import read_cloud, read_image
from workbench.data.files.matches import read_matches
from workbench.data.framing import METRES, extent, frame
from workbench.errors import InputError
from workbench.knobs import called, only

PIXEL = 1.0 / 500.0  # metres of the picture per pixel of the built-in images
FLOOR = -0.35  # height of the picture's ground
GAP = 0.12
WIDTH = 2.2  # metres of the picture that own clouds are shown wide


def subject_of(params: Params) -> Subject:
    """Return the rows that the params name.

    Raises:
        InputError: If a file cannot be used, or not with this model.
    """
    model = MODELS[params.model]
    for given, unit, name, others in (
        (params.cloud, "m", "cloud", "plane or sphere"),
        (params.matches, "px", "matches", "homography or fundamental matrix"),
    ):
        if given is not None and (model.unit != unit or model.columns == 2):
            raise InputError(
                f"{name} {given.name} cannot be fitted with a {model.name}: set {called('model')}"
                f" to {others}"
            )
    if params.cloud is not None:
        return _own_cloud(params, model)
    if params.matches is not None:
        return _own_matches(params, model)
    if params.first_image is not None or params.second_image is not None:
        raise InputError(f"own images are shown under own matches: give {called('matches')} too")
    return _built_in(
        only(params, "model", "table", "points", "outliers", "noise", "noise_pixels", "scene_seed")
    )


@lru_cache(maxsize=64)
def _built_in(params: Params) -> Subject:
    model, rng = MODELS[params.model], np.random.default_rng(params.scene_seed)
    sigma = params.noise_pixels if model.unit == "px" else params.noise
    makers: dict[str, Callable[..., RobustScene]] = {
        "line": robust.line_scene,
        "plane": {
            "alone": robust.plane_scene,
            "beside a wall": robust.two_planes_scene,
            "with a wire": robust.wire_scene,
        }[params.table],
        "circle": robust.circle_scene,
        "sphere": robust.sphere_scene,
        "homography": lambda rng, **options: robust.match_scene(rng, flat=True, **options),
        "fundamental matrix": robust.match_scene,
    }
    made = makers[params.model](
        rng, count=params.points, outlier_ratio=params.outliers, sigma=sigma
    )
    known: dict[str, Any] = {
        "truth": made.truth,
        "p_true": made.p_true,
        "is_inlier": made.is_inlier,
        "quality": made.quality,
    }
    if model.unit == "px":
        size = np.array(robust.IMAGE_SIZE, float)
        return _of_matches(model, made.p, (size, size), PIXEL, **known)
    if model.columns == 2:
        low, high = np.array([-1.1, -1.1]), np.array([1.1, 1.1])
        return Subject(model=model, p=made.p, low=low, high=high, places=(_stand_up,), **known)
    low, high = np.array([-1.15, -1.15, -0.3]), np.array([1.15, 1.15, 1.5])
    return Subject(model=model, p=made.p, low=low, high=high, places=(np.asarray,), **known)


def _own_cloud(params: Params, model: Model) -> Subject:
    assert params.cloud is not None
    p = METRES[params.cloud_unit] * read_cloud(params.cloud, fewest=model.sample_size)
    if len(p) > MOST_POINTS:
        p = p[np.random.default_rng(params.scene_seed).choice(len(p), MOST_POINTS, replace=False)]
    margin = 0.02 * extent(p)
    return Subject(
        model=model,
        p=p,
        p_true=p[:0],
        low=p.min(axis=0) - margin,
        high=p.max(axis=0) + margin,
        places=(frame(p, WIDTH, up=params.up).standing(p, FLOOR).shown,),
    )


def _own_matches(params: Params, model: Model) -> Subject:
    assert params.matches is not None
    found = read_matches(params.matches, fewest=model.sample_size)
    p, quality = found.p, found.quality
    if len(p) > MOST_POINTS:
        rows = np.random.default_rng(params.scene_seed).choice(len(p), MOST_POINTS, replace=False)
        p, quality = p[rows], None if quality is None else quality[rows]
    truth = found.H if model.name == "homography" else found.F
    near = (
        np.zeros(len(p), bool)
        if truth is None
        else model.distances(truth, p) <= params.inlier_pixels
    )
    images = tuple(
        None if file is None else read_image(file)
        for file in (params.first_image, params.second_image)
    )
    sizes = tuple(
        (
            1.05 * p[:, 2 * k : 2 * k + 2].max(axis=0)
            if image is None
            else np.array(image.shape[1::-1], float)
        )
        for k, image in enumerate(images)
    )
    return _of_matches(
        model,
        p,
        sizes,
        1.28 / max(float(np.max(sizes)), 1.0),
        images,
        truth=truth,
        p_true=p[near],
        is_inlier=None if truth is None else near,
        quality=quality,
    )


def _of_matches(
    model: Model,
    p: np.ndarray,
    sizes: tuple[np.ndarray, ...],
    pixel: float,
    images=(None, None),
    **known,
) -> Subject:
    """Stand the two images up side by side, facing the viewer."""
    width_first, height = sizes[0][0] * pixel, max(size[1] for size in sizes) * pixel
    left = (-GAP / 2 - width_first, GAP / 2)
    places = tuple(_on_image(x, height + FLOOR + 0.1, pixel) for x in left)
    return Subject(
        model=model,
        p=p,
        low=np.array([0.0, 0.0]),
        high=np.max(sizes, axis=0),
        places=places,
        sizes=sizes,
        images=images,
        noun="matches",
        **known,
    )


def _on_image(left: float, top: float, pixel: float) -> Callable[[np.ndarray], np.ndarray]:
    def place(uv: np.ndarray) -> np.ndarray:
        return np.column_stack([left + pixel * uv[:, 0], np.zeros(len(uv)), top - pixel * uv[:, 1]])

    return place


def _stand_up(p: np.ndarray) -> np.ndarray:
    """Put points of the plane upright before the viewer."""
    return np.column_stack([p[:, 0], np.zeros(len(p)), p[:, 1] + 0.7])
