"""The pane before the camera: the photograph on it, and what the calculation puts there."""

from dataclasses import replace

import numpy as np

from lessons.pinhole.captions import PinholeLook
from lessons.pinhole.following import off_pixels, onto_pixels
from lessons.pinhole.shot import ALONG_RAILS, Shot, pinhole_of
from workbench.data.views.street import street
from workbench.geometry.cameras import project, vanishing_points
from workbench.geometry.cameras.distortion import distort, is_invertible
from workbench.geometry.motions import apply, inverse
from workbench.geometry.polylines import between, circle, segments
from workbench.numerals import coordinates, fixed, pixels
from workbench.scene import (
    Classes,
    Label,
    Picture,
    Points,
    Primitive,
    Segments,
    dashed,
    dimension,
)

LAYER = 0.006  # of the pane's width, from the photograph to what is drawn on it
SPOT, FOLLOWED = 0.0055, 0.01  # radii of dots, likewise
RING = 0.035  # of the ring around the followed dot
BEYOND = 0.12  # of the photograph's size: so far outside of it points are shown
ON_RAILS = (3, 4)  # the points that are on a rail


def standing(look: PinholeLook) -> Picture:
    """Return the pane where it stands, with the photograph and what is laid over it."""
    shot = look.subject
    away = look.params.pane * look.params.dolly
    h, w = look.now.picture.shape[:2]
    f, cx, cy = shot.K[0, 0], shot.K[0, 2], shot.K[1, 2]
    T = inverse(shot.T_camera_world)
    middle = away * np.array([((w - 1) / 2 - cx) / f, ((h - 1) / 2 - cy) / f, 1.0])
    T[:3, 3] = apply(T, middle)
    title = "Photograph"
    if look.now.now.reached("divide"):
        title = "Photograph, calculated outlines orange"
    return Picture(look.now.picture, title, away * w / f, T)


def places(glass: Picture, uv: np.ndarray, layers: float = 1.0) -> np.ndarray:
    """Return where pixels (..., 2) are on the pane, (..., 3), so near that it does not hide
    them.
    """
    assert glass.width is not None
    return glass.places(uv, layers * LAYER * glass.width)


def dot(glass: Picture, uv: np.ndarray, *, ringed: bool) -> dict[str, Primitive]:
    """Return the dot where the followed ray pierces the pane, with a ring where it is the topic."""
    assert glass.width is not None
    spot = Points(places(glass, uv[None], 2), "highlight", FOLLOWED * glass.width, name="its dot")
    if not ringed:
        return {"landed": spot}
    around = uv + RING * glass.size[0] * circle(48)
    ring = Segments(segments(places(glass, around, 2)), "highlight", 4.0)
    return {"landed": spot, "landed/ring": ring}


def seen_at(glass: Picture, shot: Shot, p: np.ndarray) -> np.ndarray:
    """Return where points (n, 3) that are in front are seen on the pane, (n, 3)."""
    return places(glass, project(p, shot.T_camera_world, shot.K, shot.lens))


def landed(look: PinholeLook, glass: Picture) -> dict[str, Primitive]:
    """Return the dots of all points on the pane, the followed one larger."""
    shot = look.subject
    state = look.now.now
    k = look.subject.k
    uv = state.seen(shot.K)
    near = _near(glass, uv)
    if not near.any():
        return {}
    assert glass.width is not None
    spots = Points(places(glass, uv[near]), "source", SPOT * glass.width, name="calculated")
    parts: dict[str, Primitive] = {"plane": spots}
    if state.stage == "pixels":
        outside = ~_near(glass, uv[near], 0.0)
        inside = ("source", "in the picture")
        color = Classes.marking(outside, "correspondence", "outside it", others=inside)
        parts["plane"] = replace(spots, color=color, name=None)
    if near[k]:
        parts |= dot(glass, uv[k], ringed=bool(look.params.z))
    if state.stage == "pixels" and near[k]:
        words = f"(u, v) = {coordinates(uv[k], 0)}"
        at = places(glass, uv[k] - [0.0, 0.04 * glass.size[1]], 2)
        parts["pixel"] = Label(words, at, "highlight")
    return parts


def bent_grid(look: PinholeLook, glass: Picture) -> dict[str, Primitive]:
    """Return a straight grid, the same as the lens bends it, and how far it moves the points."""
    shot = look.subject
    state = look.now.now
    w, h = glass.size
    across, down = (np.linspace(-0.5, size - 0.5, 9) for size in (w, h))
    t = np.linspace(0.0, 1.0, 25)
    lines = [np.column_stack([np.full(25, u), t * h - 0.5]) for u in across]
    lines += [np.column_stack([t * w - 0.5, np.full(25, v)]) for v in down]
    straight = np.concatenate([between(line[:-1], line[1:]) for line in lines])
    xy = off_pixels(straight.reshape(-1, 2), shot.K)
    bent = onto_pixels(distort(xy, *shot.lens), shot.K).reshape(straight.shape)
    whole = is_invertible(xy, shot.lens).reshape(-1, 2).all(axis=1)
    parts: dict[str, Primitive] = {
        "grid": Segments(places(glass, straight), "neutral", 1.0, name="straight grid"),
        "bent": Segments(places(glass, bent[whole], 1.5), "source", 2.0, name="bent by the lens"),
    }
    ideal, moved = (onto_pixels(points, shot.K) for points in (state.xy, state.xy_bent))
    both = _near(glass, ideal) & _near(glass, moved)
    if both.any():
        ends = places(glass, between(ideal[both], moved[both]), 2)
        parts["moves"] = Segments(ends, "other", 3, name="moved by the lens")
    return parts


def measured(look: PinholeLook, glass: Picture) -> dict[str, Primitive]:
    """Return the principal point and its distances from the corner; in edited ones, the middle."""
    params = look.params
    busy = params.heights or params.dolly != 1 or params.point in ON_RAILS
    if params.edit == "none" and (busy or params.mistake != "none"):
        return {}
    cx, cy = look.subject.K[:2, 2]
    w, h = glass.size
    uv = np.array([[cx, cy], [0.0, cy], [cx, 0.0], [(w - 1) / 2, (h - 1) / 2]])
    at, left, top, middle = places(glass, uv, 2)
    assert glass.width is not None
    radius = FOLLOWED * glass.width
    parts: dict[str, Primitive] = {
        "principal": Points(at[None], "truth", radius, name="principal point"),
    }
    if params.edit != "none":
        parts["middle"] = Points(middle[None], "neutral", radius, name="middle of the picture")
    if min(cx, cy) > 1:
        right, down = (at - left) / cx, (at - top) / cy
        for path, end, aside, c in (("cx", left, down, cx), ("cy", top, right, cy)):
            text = "should be " * params.forgets_k + f"{path} = {fixed(c, 2)}"
            parts |= dimension(path, end, at, aside=0.06 * h * aside, color="truth", text=text)
    return parts


def vanishing(look: PinholeLook, glass: Picture) -> dict[str, Primitive]:
    """Return where the rails run to in the picture, and how far a turn or a step has moved that."""
    shot, params = look.subject, look.params
    uv = shot.vanishing
    if params.point not in ON_RAILS or any(shot.lens) or not _near(glass, uv[None])[0]:
        return {}
    assert glass.width is not None
    place = places(glass, uv, 2)
    above = places(glass, uv - [0.0, 0.05 * glass.size[1]], 2)
    parts: dict[str, Primitive] = {
        "vanishing": Points(place[None], "truth", 1.5 * FOLLOWED * glass.width, name="K R d"),
    }
    for i, rail in enumerate(street().rails):
        near = rail[0] + np.array([0.0, 2.0, 0.0])
        start = project(near[None], shot.T_camera_world, shot.K)
        if np.isfinite(start).all():
            line = places(glass, np.concatenate([start, uv[None]]))
            parts[f"prolonged/{i}"] = dashed(line, "truth", dash=0.02 * glass.width)
    if not (params.turn or params.aside):
        return parts | {"vanishing/name": Label("K R d", above, "truth")}
    first = pinhole_of(replace(params, turn=0.0, aside=0.0), params.dolly)
    before = vanishing_points(ALONG_RAILS, first.T_camera_world, first.K)[0]
    away = float(np.linalg.norm(uv - before))
    spot = places(glass, before, 1.5)
    parts["vanishing/before"] = Points(spot[None], "neutral", FOLLOWED * glass.width, name="before")
    words = f"K R d, moved by {pixels(away)}"
    return parts | {"vanishing/name": Label(words, above, "truth")}


def _near(glass: Picture, uv: np.ndarray, beyond: float = BEYOND) -> np.ndarray:
    """Say which pixels are in the photograph, or so close to it by its size."""
    size = np.array(glass.size)
    return np.all((uv + 0.5 > -beyond * size) & (uv + 0.5 < (1 + beyond) * size), axis=1)
