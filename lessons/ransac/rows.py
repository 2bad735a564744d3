"""The rows of a search, built in or a person's own, what is true of them, and where they stand."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from lessons.ransac import robust_scenes as robust
from lessons.ransac.inputs import MOST_POINTS, Input
from workbench.algorithms.robust import ransac
from workbench.algorithms.robust.models import MODELS, Model, rms_distance
from workbench.algorithms.robust.samplers import termination_length
from workbench.data.files import read_cloud, read_image
from workbench.data.files.matches import read_matches
from workbench.data.framing import METRES, extent, frame
from workbench.errors import InputError
from workbench.knobs import called
from workbench.lesson import cached

PIXEL = 1.0 / 500.0  # metres of the picture per pixel of the built-in images
# the height of the picture's ground; between two images
FLOOR = -0.35
GAP = 0.12
WIDTH = 2.2  # metres of the picture that own clouds are shown wide


@dataclass(frozen=True, eq=False, kw_only=True)
class Subject:
    """The rows of a run, and how they are shown.

    Attributes:
        model: What is fitted.
        p: The rows: points in metres, or matches in pixels.
        truth: The true parameters, where known.
        p_true: Rows free of noise that truly belong to the model, where known; else none.
        is_inlier: Which rows were made from the model, where known.
        is_other: Which rows were made from a second model, where there is one.
        quality: How much each row is trusted, where known.
        low, high: The window in which models are drawn, in the unit of the rows.
        places: For each half of a row that is a point (one, or two for a match), where it stands.
        sizes: Of the two images, pixels; for matches only.
        images: The images themselves, where the person gave them.
        limit: How near a row votes, in the unit of the model.
        rivals: By name, what methods that use all rows at once make of them.
    """

    model: Model
    p: np.ndarray
    truth: np.ndarray | None = None
    p_true: np.ndarray
    is_inlier: np.ndarray | None = None
    is_other: np.ndarray | None = None
    quality: np.ndarray | None = None
    low: np.ndarray
    high: np.ndarray
    places: tuple[Callable[[np.ndarray], np.ndarray], ...]
    sizes: tuple[np.ndarray, ...] = ()
    images: tuple[np.ndarray | None, ...] = (None, None)
    limit: float = 0.0
    rivals: dict[str, np.ndarray] | None = None

    @property
    def noun(self) -> str:
        """What a row is called."""
        return "matches" if self.sizes else "points"

    @cached_property
    def shown(self) -> tuple[np.ndarray, ...]:
        """The rows as points of the picture, (n, 3); for matches one array per image."""
        d = self.p.shape[1] // len(self.places)
        return tuple(place(self.p[:, k * d : (k + 1) * d]) for k, place in enumerate(self.places))

    def trusted(self, fit: ransac.Fit) -> tuple[int, float]:
        """Return among how many of the most trusted rows a fit has its largest share of votes."""
        assert self.quality is not None
        return termination_length(fit.inliers, self.quality, self.model.sample_size)

    def error(self, estimate: np.ndarray | None) -> float:
        """Return the RMS distance of the noiseless rows to an estimate; NaN where not known."""
        if estimate is None or not len(self.p_true):
            return float("nan")
        return rms_distance(self.model, estimate, self.p_true)

    def without(self, rows: np.ndarray) -> "Subject":
        """Return the subject without some rows; what is true of the others stays."""
        parts = {
            name: None if (old := getattr(self, name)) is None else old[~rows]
            for name in ("p", "is_inlier", "is_other", "quality")
        }
        return replace(self, **parts)


def rows_of(params: Input) -> Subject:
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
    return built_in(params, params.outliers)


@cached
def built_in(params: Input, outliers: float) -> Subject:
    """Return a scene of our own with a share of outliers."""
    model = MODELS[params.model]
    rng = np.random.default_rng(params.scene_seed)
    sigma = params.noise_pixels if model.unit == "px" else params.noise
    given = {"count": params.points, "outlier_ratio": outliers, "sigma": sigma}
    if params.model == "plane" and params.table == "beside a wall":
        made = robust.two_planes_scene(rng, wall=params.wall, **given)
    elif params.model == "plane" and params.table == "with a wire":
        made = robust.wire_scene(rng, **given)
    else:
        made = {
            "line": robust.line_scene,
            "plane": robust.plane_scene,
            "circle": robust.circle_scene,
            "sphere": robust.sphere_scene,
            "homography": robust.wall_matches,
            "fundamental matrix": robust.match_scene,
        }[params.model](rng, **given)
    names = ("truth", "p_true", "is_inlier", "is_other", "quality")
    known: dict[str, Any] = {name: getattr(made, name) for name in names}
    if model.unit == "px":
        size = np.array(robust.IMAGE_SIZE, float)
        return _of_matches(model, made.p, (size, size), pixel=PIXEL, **known)
    if model.columns == 2:
        window = np.array([1.1, 1.1])
        return Subject(model=model, p=made.p, low=-window, high=window, places=(stand_up,), **known)
    low = np.array([-1.15, -1.15, -0.3])
    high = np.array([1.15, 1.15, 1.5])
    return Subject(model=model, p=made.p, low=low, high=high, places=(np.asarray,), **known)


def stand_up(p: np.ndarray, nearer: float = 0.0) -> np.ndarray:
    """Put points of the plane upright before the viewer, who is at -y."""
    return np.column_stack([p[:, 0], np.full(len(p), -nearer), p[:, 1] + 0.7])


def _own_cloud(params: Input, model: Model) -> Subject:
    assert params.cloud is not None
    p = METRES[params.cloud_unit] * read_cloud(params.cloud, fewest=model.sample_size)
    if len(p) > MOST_POINTS:
        rng = np.random.default_rng(params.scene_seed)
        p = p[rng.choice(len(p), MOST_POINTS, replace=False)]
    margin = 0.02 * extent(p)
    return Subject(
        model=model,
        p=p,
        p_true=p[:0],
        low=p.min(axis=0) - margin,
        high=p.max(axis=0) + margin,
        places=(frame(p, WIDTH, up=params.up).standing(p, FLOOR).shown,),
    )


def _own_matches(params: Input, model: Model) -> Subject:
    assert params.matches is not None
    matches = read_matches(params.matches, fewest=model.sample_size)
    p, quality = matches.p, matches.quality
    if len(p) > MOST_POINTS:
        rng = np.random.default_rng(params.scene_seed)
        rows = rng.choice(len(p), MOST_POINTS, replace=False)
        p = p[rows]
        quality = None if quality is None else quality[rows]
    truth = matches.H if model.name == "homography" else matches.F
    near = np.zeros(len(p), bool)
    if truth is not None:
        near = model.distances(truth, p) <= params.inlier_pixels
    files = (params.first_image, params.second_image)
    images = tuple(None if file is None else read_image(file) for file in files)
    sizes = tuple(
        1.05 * p[:, 2 * k : 2 * k + 2].max(axis=0)
        if image is None
        else np.array(image.shape[1::-1], float)
        for k, image in enumerate(images)
    )
    known = None if truth is None else near
    return _of_matches(
        model,
        p,
        sizes,
        pixel=1.28 / max(float(np.max(sizes)), 1.0),
        images=images,
        truth=truth,
        p_true=p[near],
        is_inlier=known,
        quality=quality,
    )


def _of_matches(
    model: Model,
    p: np.ndarray,
    sizes: tuple[np.ndarray, ...],
    *,
    pixel: float,
    images=(None, None),
    **known,
) -> Subject:
    """Stand the two images up side by side, facing the viewer."""
    width_first = sizes[0][0] * pixel
    height = max(size[1] for size in sizes) * pixel
    left = (-GAP / 2 - width_first, GAP / 2)
    return Subject(
        model=model,
        p=p,
        low=np.array([0.0, 0.0]),
        high=np.max(sizes, axis=0),
        places=tuple(_on_image(x, height + FLOOR + 0.1, pixel) for x in left),
        sizes=sizes,
        images=images,
        **known,
    )


def _on_image(left: float, top: float, pixel: float) -> Callable[[np.ndarray], np.ndarray]:
    def place(uv: np.ndarray) -> np.ndarray:
        x = left + pixel * uv[:, 0]
        z = top - pixel * uv[:, 1]
        return np.column_stack([x, np.zeros(len(uv)), z])

    return place
