"""What one step looks like: both pictures upright, below them the scene with both cameras, and the
numbers beside.
"""

import functools
from dataclasses import dataclass

import numpy as np

from lessons.epipolar.captions import caption
from lessons.epipolar.charts import beside
from lessons.epipolar.state import State
from workbench.algorithms.two_views import Followed
from workbench.certain import sure
from workbench.data.thinning import evenly, every
from workbench.data.views.skyline import skyline
from workbench.data.views.street import street
from workbench.data.views.two_views import EYE, MODEL, What
from workbench.geometry.cameras import camera_center
from workbench.geometry.clipping import clip_lines
from workbench.geometry.motions import inverse, motion
from workbench.geometry.polylines import between, fan, sphere_rings
from workbench.geometry.two_views.epipolar import epipolar_lines, epipoles, fundamental_from_cameras
from workbench.geometry.two_views.homography import transform_pixels
from workbench.geometry.two_views.rectification import fitted, warp
from workbench.geometry.two_views.triangulation import camera_matrix, triangulation_covariances
from workbench.lesson import View
from workbench.numerals import length
from workbench.scene import Camera, Label, Mesh, Picture, Points, Primitive, Role, Scene, Segments

VIEW = View(
    eye=(14.0, -16.0, 11.0), target=(0.5, 5.0, 5.2), fov_degrees=34.0, grid=None, axes=False
)
# of a picture, between both, and their middle above the target, metres
WIDTH = 8.6
APART = 0.35
ABOVE = 2.3
LAYER = 0.04  # metres from a picture to what is drawn on it
SHOWN_LINES, SHOWN_ELLIPSOIDS, SHOWN_POINTS = 8, 10, 400
DEEP, REACH = 14.0, 45.0  # metres that a ray is drawn, and from the first camera that anything is
SCALE_AT = np.array([-0.4, 0.5, 0.2])  # of a model
# metres between cameras, drawn, below which a pointer tells the direction; and its length
CLOSE = 0.3
POINTER = 1.8


@dataclass(frozen=True, eq=False)
class Side:
    """A picture that stands before the eye, and where pixels of its matches are on it."""

    picture: Picture
    size: tuple[int, int]
    to_shown: np.ndarray

    def places(self, uv: np.ndarray, layer: int = 1) -> np.ndarray:
        """Return where pixels (..., 2) stand in the world."""
        shown = transform_pixels(self.to_shown, uv.reshape(-1, 2)).reshape(uv.shape)
        return self.picture.places(shown, layer * LAYER)

    def inside(self, uv: np.ndarray) -> np.ndarray:
        """Tell which pixels the picture has."""
        with np.errstate(invalid="ignore"):
            return np.asarray(((uv >= -0.5) & (uv <= np.array(self.size) - 0.5)).all(axis=1))

    def lines(self, lines: np.ndarray, layer: int = 2) -> np.ndarray:
        """Return the parts of lines (a, b, c) on the picture as segments in the world."""
        known = lines[np.isfinite(lines).all(axis=1)]
        return self.places(clip_lines(known, np.full(2, -0.5), np.array(self.size) - 0.5), layer)


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    return {"caption": caption(state), **_pictures(state), **_space(state), **beside(state)}


def _sides(state: State) -> tuple[Side, Side]:
    views = state.views
    H = _rectifying(state)
    sides = []
    for k, word in enumerate(("first", "second")):
        picture = _hung(views, k, None if H is None else H[k].tobytes(), word=word)
        to_shown = np.diag([1 / views.strides[k], 1 / views.strides[k], 1.0]) if H is None else H[k]
        sides.append(Side(picture, views.sizes[k], to_shown))
    return sides[0], sides[1]


def _rectifying(state: State) -> tuple[np.ndarray, np.ndarray] | None:
    """Return what takes pixels to the rectified pictures as they are shown; None where they are
    not, or cannot be.
    """
    rectification = None if isinstance(state.now, Followed) else state.now.rectification
    if rectification is None:
        return None
    views = state.views
    try:
        return fitted(
            rectification.H_first,
            rectification.H_second,
            size_first=views.sizes[0],
            size_second=views.sizes[1],
            size=_shown_size(views, 0),
        )
    except ValueError:
        return None


def _shown_size(views, k: int) -> tuple[int, int]:
    (w, h), stride = views.sizes[k], views.strides[k]
    return -(-w // stride), -(-h // stride)


@functools.lru_cache(maxsize=32)
def _hung(views, k: int, H: bytes | None, *, word: str) -> Picture:
    """Return a picture where it stands, warped where H is given: the same object at every step that
    shows the same.
    """
    w, h = _shown_size(views, k)
    image = views.images[k]
    image = np.full((h, w, 3), 247, np.uint8) if image is None else image
    if H is not None:
        s = views.strides[k]
        image = warp(
            image, np.frombuffer(H).reshape(3, 3) @ np.diag([s, s, 1.0]), _shown_size(views, 0)
        )
    side = (k - 0.5) * (WIDTH + APART)
    return Picture(image, f"{word} picture", WIDTH, VIEW.facing(side, ABOVE, 0.0))


def _pictures(state: State) -> dict[str, Primitive]:
    """Return both pictures with matches, the followed pixel, its line, and the lines of some
    matches.
    """
    result = state.now
    views = state.views
    sides = _sides(state)
    scene: dict[str, Primitive] = {}
    # in a rectified one nobody picks a pixel
    kind = "picture" if _rectifying(state) is None else "rectified"
    roles: tuple[tuple[str, Role], ...] = (("first", "target"), ("second", "source"))
    for k, (word, role) in enumerate(roles):
        picture = sides[k].picture
        scene[f"{word}/{kind}"] = picture
        scene[f"{word}/edge"] = Segments(picture.border(LAYER), role, 2)
        scene[f"{word}/label"] = Label(
            f"{word} picture", picture.places(np.array([picture.size[0] / 2, -20.0])), role
        )
    uv = state.uv_first[None]
    scene["first/pixel"] = Points(sides[0].places(uv, 3), "highlight", 0.13, name="followed pixel")
    if isinstance(result, Followed):
        seen = sides[1].inside(result.uv_second)
        scene["second/pixels"] = Points(
            sides[1].places(result.uv_second[seen], 3), "highlight", 0.1
        )
        if result.stage == "ray":
            return scene
    F_true = None
    if state.T_true is not None and state.moved:
        F_true = fundamental_from_cameras(views.K_first, views.K_second, state.T_true)
    F = F_true if isinstance(result, Followed) else result.F
    assert F is not None
    rows = evenly(len(views.matches), SHOWN_LINES)
    first, second = views.matches[:, :2], views.matches[:, 2:]
    if not isinstance(result, Followed) or result.stage == "pencil":
        for k, (word, points) in enumerate((("first", first), ("second", second))):
            scene[f"{word}/matches"] = Points(
                sides[k].places(points), "target", 0.06, name="matches" if k else ""
            )
        scene["second/lines"] = Segments(
            sides[1].lines(epipolar_lines(F, first[rows])), "source", 1.5
        )
        scene["first/lines"] = Segments(
            sides[0].lines(epipolar_lines(F.T, second[rows])), "source", 1.5, opacity=0.6
        )
        for k, (word, epipole) in enumerate(zip(("first", "second"), epipoles(F), strict=True)):
            with np.errstate(divide="ignore", invalid="ignore"):
                e = epipole[None, :2] / epipole[2]
            if sides[k].inside(e)[0] and np.linalg.matrix_rank(F, 1e-9) == 2:
                scene[f"{word}/epipole"] = Points(
                    sides[k].places(e, 3), "source", 0.15, name="epipole"
                )
    scene["second/line"] = Segments(
        sides[1].lines(epipolar_lines(F, uv)), "highlight", 4, name="its line"
    )
    if F_true is not None and not isinstance(result, Followed):
        scene["second/true line"] = Segments(
            sides[1].lines(epipolar_lines(F_true, uv), 3), "truth", 2, name="its true line"
        )
    return scene


def _space(state: State) -> dict[str, Primitive]:
    """Return the cameras, the followed ray and plane, and the points, all as large as they are
    drawn.
    """
    views, result = state.views, state.now
    T_world_first = inverse(views.T_first_world)
    w, h = views.sizes[0]
    scene: dict[str, Primitive] = {
        "first/camera": Camera(
            views.K_first, w, h, T_world_first, 1.3, color="target", name="first camera"
        ),
        **_scenery(state.params.scene if views.depth is not None else None),
    }
    cameras: tuple[tuple[str, np.ndarray | None, Role, str], ...] = (
        ("true camera", _drawn(state.T_true, views.model), "truth", "true second camera"),
        ("camera", _drawn(state.T_second_first, views.model), "source", "estimated second camera"),
    )
    for path, T, role, name in cameras:
        if T is None:
            continue
        T_world_second = T_world_first @ inverse(T)
        scene[path] = Camera(
            views.K_second, *views.sizes[1], T_world_second, 1.3, color=role, name=name
        )
        way = camera_center(T)
        if 0.0 < np.linalg.norm(way) < CLOSE:
            pointer = between(np.zeros(3), POINTER * way / np.linalg.norm(way))
            scene[f"direction/{path}"] = Segments(
                pointer, role, 5, T_world_first, name=f"way to the {name}"
            )
    if isinstance(result, Followed):
        assert state.T_true is not None
        return scene | _followed(
            result, camera_center(state.T_true) / views.model, T_world_first, model=views.model
        )
    shown = evenly(len(views.matches), SHOWN_POINTS)
    p_true = None if views.p_first is None else views.p_first[shown] / views.model
    if p_true is not None:
        scene["true points"] = Points(p_true, "truth", 0.06, T_world_first)
    if result.p_first is None:
        return scene
    p = state.length / views.model * result.p_first[shown]
    near = np.linalg.norm(np.nan_to_num(p, nan=np.inf), axis=1) < REACH
    scene["points"] = Points(p[near], "source", 0.07, T_world_first, name="estimated points")
    if p_true is not None:
        ends = between(p_true[near], p[near])
        scene["misses"] = Segments(
            ends, "wrong", 1, T_world_first, opacity=0.5, name="their errors"
        )
    if result.stage == "points":
        scene["uncertainty"] = _ellipsoids(
            state, p[near][every(int(near.sum()), SHOWN_ELLIPSOIDS)], T_world_first
        )
    return scene


def _drawn(T: np.ndarray | None, model: float) -> np.ndarray | None:
    """Return a motion with its translation as long as it is drawn."""
    return None if T is None else motion(T[:3, :3], T[:3, 3] / model)


def _followed(
    ray: Followed, p_center: np.ndarray, T_world_first: np.ndarray, *, model: float
) -> dict[str, Primitive]:
    """Return the ray of the followed pixel with marks, the rays that the second camera sees them
    by, and the plane.
    """
    near = ray.depths <= DEEP * model
    p = ray.p_first[near] / model
    end = ray.p_first[-1] * min(1.0 / model, DEEP / ray.p_first[-1, 2])
    scene: dict[str, Primitive] = {
        "ray": Segments(
            between(np.zeros(3), end), "highlight", 3, T_world_first, name="ray of the pixel"
        ),
        "marks": Points(p, "highlight", 0.14, T_world_first),
        "rays": Segments(between(p_center, p), "correspondence", 1, T_world_first),
    }
    for depth, place in zip(ray.depths[near][::2], p[::2], strict=True):
        scene[f"mark/{depth:g}"] = Label(
            length(float(depth)), place + np.array([0.0, -0.35, 0.0]), "highlight", T_world_first
        )
    if ray.stage != "ray":
        corners = np.stack([np.zeros(3), end, p_center])
        scene["plane"] = Mesh(
            corners,
            fan(3),
            "highlight",
            T_world_first,
            opacity=0.35,
            flat=True,
            name="epipolar plane",
        )
        scene["baseline"] = Segments(between(np.zeros(3), p_center), "neutral", 4, T_world_first)
    return scene


def _ellipsoids(state: State, p: np.ndarray, T_world_first: np.ndarray) -> Segments:
    """Return where points lie with two standard deviations, from the noise or what the lines say of
    it.
    """
    T = sure(_drawn(state.T_second_first, state.views.model))
    n = len(state.views.matches)
    sigma = state.views.sigma or state.to_lines(state.views.matches) * np.sqrt(n / max(n - 5, 1))
    Ps = camera_matrix(state.K_first, np.eye(4)), camera_matrix(state.K_second, T)
    rings = sphere_rings(np.zeros(3), 2.0, 24)
    parts = [np.empty((0, 2, 3))]
    for place, covariance in zip(p, triangulation_covariances(*Ps, p, sigma=sigma), strict=True):
        if np.isfinite(covariance).all() and np.trace(covariance) < REACH:
            values, axes = np.linalg.eigh(covariance)
            parts.append(place + rings @ (axes * np.sqrt(np.maximum(values, 0.0))).T)
    return Segments(
        np.concatenate(parts), "source", 1, T_world_first, name="two standard deviations"
    )


@functools.cache
def _scenery(subject: What | None) -> dict[str, Primitive]:
    """Return the outlines of what was photographed, as large as it is drawn; none of a person's
    scene.
    """
    if subject is None:
        return {}
    if subject == "far":
        model = Segments(EYE + (skyline().edges - EYE) / MODEL, "neutral", 1, opacity=0.5)
        return {"street": model, "scale": Label(f"drawn 1 : {MODEL:.0f}", SCALE_AT, "neutral")}
    scene = street()
    rails = np.array([[[x, -2.0, 0.06], [x, 22.0, 0.06]] for x in (-0.75, 0.75)])
    return {"street": Segments(np.concatenate([scene.edges, rails]), "neutral", 1, opacity=0.5)}
