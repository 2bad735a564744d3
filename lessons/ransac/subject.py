"""What a run is about: the rows to fit, what is true of them, and where they stand in the picture."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from lessons.ransac.params import MOST_POINTS, Params
from workbench.algorithms.models import MODELS, Model
from workbench.data import robust
from workbench.data.files import read_cloud, read_image
from workbench.data.matches import read_matches
from workbench.data.robust import RobustScene
from workbench.errors import InputError

PIXEL = 1.0 / 500.0  # metres of the picture per pixel of the built-in images
METRES = {"mm": 0.001, "cm": 0.01, "m": 1.0, "km": 1000.0}
FLOOR = -0.35  # height of the picture's ground
GAP = 0.12
UPRIGHT = {
    "z": np.eye(3),
    "y": np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]),
    "-y": np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]),
}


@dataclass(frozen=True, eq=False)
class Subject:
    """The rows of a run, and how they are shown.

    Attributes:
        model: What is fitted.
        p: The rows: points in metres, or matches in pixels.
        truth: The true parameters, where known.
        p_true: Rows free of noise that truly belong to the model, where known; else none.
        is_inlier: Which rows were made from the model, where known.
        quality: How much each row is trusted, where known.
        low, high: The ends of the window in which models are drawn, in the unit of the rows.
        places: For each half of a row that is a point (one, or two for a match), where it stands in the picture.
        sizes: Of the two images, pixels; for matches only.
        images: The images themselves, where the person gave them.
        noun: What a row is called.
    """

    model: Model
    p: np.ndarray
    truth: np.ndarray | None
    p_true: np.ndarray
    is_inlier: np.ndarray | None
    quality: np.ndarray | None
    low: np.ndarray
    high: np.ndarray
    places: tuple[Callable[[np.ndarray], np.ndarray], ...]
    sizes: tuple[np.ndarray, ...] = ()
    images: tuple[np.ndarray | None, ...] = (None, None)
    noun: str = "points"

    @cached_property
    def shown(self) -> tuple[np.ndarray, ...]:
        """The rows as points of the picture, (n, 3); for matches one array per image."""
        d = self.p.shape[1] // len(self.places)
        return tuple(place(self.p[:, k * d : (k + 1) * d]) for k, place in enumerate(self.places))


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
            raise InputError(f"{name} {given.name} cannot be fitted with a {model.name}: set model to {others}")
    if params.cloud is not None:
        return _own_cloud(params, model)
    if params.matches is not None:
        return _own_matches(params, model)
    return _built_in(
        replace(Params(), **{name: getattr(params, name) for name in (
            "model", "table", "points", "outliers", "noise", "noise_pixels", "scene_seed",
        )})
    )  # fmt: skip


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
    made = makers[params.model](rng, count=params.points, outlier_ratio=params.outliers, sigma=sigma)
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
        return Subject(model, made.p, low=low, high=high, places=(_stand_up,), **known)
    low, high = np.array([-1.15, -1.15, -0.3]), np.array([1.15, 1.15, 1.5])
    return Subject(model, made.p, low=low, high=high, places=(np.asarray,), **known)


def _own_cloud(params: Params, model: Model) -> Subject:
    assert params.cloud is not None
    p = METRES[params.cloud_unit] * read_cloud(params.cloud, fewest=model.sample_size)
    if len(p) > MOST_POINTS:
        p = p[np.random.default_rng(params.scene_seed).choice(len(p), MOST_POINTS, replace=False)]
    low, high = p.min(axis=0), p.max(axis=0)
    centre, scale = (low + high) / 2.0, 2.2 / max(float((high - low).max()), 1e-12)
    R_world_cloud = UPRIGHT[params.up]
    raised = FLOOR - (scale * (p - centre) @ R_world_cloud.T)[:, 2].min()

    def place(q: np.ndarray) -> np.ndarray:
        return scale * (q - centre) @ R_world_cloud.T + np.array([0.0, 0.0, raised])

    margin = 0.02 * (high - low).max()
    return Subject(model, p, None, p[:0], None, None, low - margin, high + margin, (place,))


def _own_matches(params: Params, model: Model) -> Subject:
    assert params.matches is not None
    found = read_matches(params.matches, fewest=model.sample_size)
    p, quality = found.p, found.quality
    if len(p) > MOST_POINTS:
        rows = np.random.default_rng(params.scene_seed).choice(len(p), MOST_POINTS, replace=False)
        p, quality = p[rows], None if quality is None else quality[rows]
    truth = found.H if model.name == "homography" else found.F
    near = np.zeros(len(p), bool) if truth is None else model.distances(truth, p) <= params.inlier_pixels
    images = tuple(None if file is None else read_image(file) for file in (params.first_image, params.second_image))
    sizes = tuple(
        1.05 * p[:, 2 * k : 2 * k + 2].max(axis=0) if image is None else np.array(image.shape[1::-1], float)
        for k, image in enumerate(images)
    )
    return _of_matches(
        model, p, sizes, 1.28 / max(float(np.max(sizes)), 1.0), images,
        truth=truth, p_true=p[near], is_inlier=None if truth is None else near, quality=quality,
    )  # fmt: skip


def _of_matches(
    model: Model, p: np.ndarray, sizes: tuple[np.ndarray, ...], pixel: float, images=(None, None), **known
) -> Subject:
    """Stand the two images up side by side, facing the viewer."""
    width_first, height = sizes[0][0] * pixel, max(size[1] for size in sizes) * pixel
    left = (-GAP / 2 - width_first, GAP / 2)
    places = tuple(_on_image(x, height + FLOOR + 0.1, pixel) for x in left)
    low, high = np.array([0.0, 0.0]), np.max(sizes, axis=0)
    return Subject(model, p, low=low, high=high, places=places, sizes=sizes, images=images, noun="matches", **known)


def _on_image(left: float, top: float, pixel: float) -> Callable[[np.ndarray], np.ndarray]:
    def place(uv: np.ndarray) -> np.ndarray:
        return np.column_stack([left + pixel * uv[:, 0], np.zeros(len(uv)), top - pixel * uv[:, 1]])

    return place


def _stand_up(p: np.ndarray) -> np.ndarray:
    """Put points of the plane upright before the viewer."""
    return np.column_stack([p[:, 0], np.zeros(len(p)), p[:, 1] + 0.7])
