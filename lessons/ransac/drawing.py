"""What one step of the search looks like. Colour is a vote; who is right is a shape, shown if
asked.
"""

import numpy as np

from lessons.ransac.captions import SearchLook, caption
from lessons.ransac.flat import SIZES, chances
from lessons.ransac.rows import Subject
from lessons.ransac.search import METHODS, SHARES, errors_by_outliers
from lessons.ransac.shapes import MM, band, frames, marked, outline
from workbench.geometry.clipping import plane_in_box
from workbench.geometry.motions import R_UPRIGHT, motion
from workbench.geometry.polylines import between, fan
from workbench.scene import (
    Chart,
    Color,
    Curve,
    Label,
    Mesh,
    Picture,
    Points,
    Primitive,
    Role,
    Scene,
    Segments,
)

MOST_LINES = 150  # matches
UP = np.array([0.0, 0.0, 0.07])
VOTERS = Chart("Votes of both")
BY_SHARE = Chart(
    "Error",
    "share of the points that belong to nothing",
    "mm",
    x_range=(0.0, 0.7),
    y_range=(0.0, 350.0),
)
IMAGES = ("first image", "second image")
COLORS: dict[str, Role] = {"RANSAC": "source", "least squares": "other", "Huber": "highlight"}


def draw(look: SearchLook) -> Scene:
    """Return the picture of one step."""
    return {
        "caption": caption(look),
        **_background(look.subject),
        **_rows(look),
        **_sample(look),
        **_models(look),
        **_two_planes(look),
        **_curves(look),
    }


def _rows(look: SearchLook) -> dict[str, Primitive]:
    """Draw all rows, coloured by their votes on the fit in question: the trial, or the best."""
    subject, state = look.subject, look.now
    fit = state.trial if state.phase in ("inliers", "best", "refit") else None
    fit = state.best if state.phase == "stop" else fit
    color: Color = "neutral" if fit is None else marked(fit.inliers)
    scene: dict[str, Primitive] = {}
    for k, p in enumerate(subject.shown):
        path = ("points", "points in second")[k]
        name = IMAGES[k] if subject.sizes else "points"
        scene[path] = Points(p, color, _radius(subject), name=name)
        if look.params.who_is_right and subject.is_inlier is not None:
            halo = Points(p[subject.is_inlier], "truth", 2.2 * _radius(subject), opacity=0.3)
            scene[f"who is right/{k}"] = halo
    if subject.sizes:
        rows = np.zeros(0, np.intp)
        if fit is not None:
            rows = np.flatnonzero(fit.inliers)[:: 1 + fit.count // MOST_LINES]
        ends = between(*(p[rows] for p in subject.shown))
        name = "matches that vote for it"
        scene["matches"] = Segments(ends, "correspondence", 1.0, opacity=0.5, name=name)
    return scene


def _radius(subject: Subject) -> float:
    size = 0.22 if subject.sizes else 0.4
    return float(np.clip(size / np.sqrt(len(subject.p)), 0.004, 0.02))


def _sample(look: SearchLook) -> dict[str, Primitive]:
    subject, state = look.subject, look.now
    if state.phase in ("refit", "stop") or not len(state.sample):
        return {}
    p = [shown[state.sample] for shown in subject.shown]
    dots = Points(np.concatenate(p), "highlight", 2.2 * _radius(subject), name="the sample")
    if len(p) == 1:
        return {"sample": dots}
    ends = Segments(between(*p), "highlight", 2.0, name="matches of the sample")
    return {"sample": dots, "sample matches": ends}


def _models(look: SearchLook) -> dict[str, Primitive]:
    """Draw the model under test or the best so far with its band, and at the end the others."""
    subject, state = look.subject, look.now
    over = state.phase in ("refit", "stop")
    scene: dict[str, Primitive] = {}
    if subject.truth is not None and (over or look.params.who_is_right):
        scene["truth"] = Segments(outline(subject, subject.truth), "truth", 3.0, name="truth")
    if over and not subject.sizes:
        for name, estimate in (subject.rivals or {}).items():
            ends = outline(subject, estimate)
            scene[f"rival/{name}"] = Segments(ends, COLORS[name], 2.0, name=name)
            if len(ends):  # by its highest end
                top = ends.reshape(-1, 3)[ends.reshape(-1, 3)[:, 2].argmax()]
                scene[f"rival/{name}/name"] = Label(name, top + UP, COLORS[name])
    tested = state.estimate if state.phase in ("model", "inliers") else None
    if state.best is not None:
        ends = outline(subject, state.best.estimate)
        scene["best"] = Segments(ends, "source", 3.0, name="best so far")
    if tested is not None:
        name = f"{subject.model.name} of the sample"
        scene["trial"] = Segments(outline(subject, tested), "highlight", 2.5, name=name)
        scene |= band(subject, tested, "highlight", reach=subject.limit)
        return scene | _surface(subject, "trial", tested, color="highlight", opacity=0.3)
    if state.best is None:
        return scene
    scene |= band(subject, state.best.estimate, "source", reach=subject.limit)
    opacity = 0.35 if over or state.phase == "best" else 0.15
    return scene | _surface(subject, "best", state.best.estimate, color="source", opacity=opacity)


def _surface(
    subject: Subject, path: str, estimate: np.ndarray, *, color: Role, opacity: float
) -> dict[str, Primitive]:
    if subject.model.name != "plane":
        return {}
    corners = plane_in_box(estimate, subject.low, subject.high)
    if not len(corners):
        return {}
    p = subject.places[0](corners)
    return {f"{path}/surface": Mesh(p, fan(len(corners)), color, opacity=opacity, flat=True)}


def _two_planes(look: SearchLook) -> dict[str, Primitive]:
    """Count the votes of both planes' points for the best so far, beside the planes and as
    curves.
    """
    subject = look.subject
    best = look.now.best
    if subject.is_other is None or subject.is_inlier is None:
        return {}
    scene: dict[str, Primitive] = {}
    for name, rows, up in (("table", subject.is_inlier, 0.1), ("wall", subject.is_other, 0.6)):
        votes = 0 if best is None else int(best.inliers[rows].sum())
        if rows.any():
            place = subject.shown[0][rows].mean(axis=0) + np.array([0.0, 0.0, up])
            scene[f"count/{name}"] = Label(f"{name}: {votes} votes", place)
        role: Role = "truth" if name == "table" else "source"
        scene[f"votes/{name}"] = VOTERS.scalar(votes, name, role)
    return scene


def _background(subject: Subject) -> dict[str, Primitive]:
    borders = frames(subject)
    scene: dict[str, Primitive] = {}
    if len(borders):
        scene["frame"] = Segments(borders, "neutral", 1.5)
    for k, size in enumerate(subject.sizes):
        word = IMAGES[k]
        place = subject.places[k]
        top = np.array([[size[0] / 2.0, -14.0 * size[0] / 640.0]])
        scene[f"label {word}"] = Label(word, place(top)[0])
        image = subject.images[k]
        if image is not None:
            scene[f"picture {word}"] = _photograph(image, place)
    return scene


def _photograph(image: np.ndarray, place) -> Picture:
    """Hang a photograph just behind its pixels."""
    h, w = image.shape[:2]
    corner, right = place(np.array([[0.0, 0.0], [w - 1.0, 0.0]]))
    centre = place(np.array([[(w - 1.0) / 2.0, (h - 1.0) / 2.0]]))[0]
    T_world_image = motion(R_UPRIGHT, centre + np.array([0.0, 0.01, 0.0]))
    width = float(right[0] - corner[0]) * w / (w - 1.0)
    return Picture(image, width=width, T_world_object=T_world_image)


def _curves(look: SearchLook) -> dict[str, Primitive]:
    params, subject, state = look.params, look.subject, look.now
    unit = subject.model.unit
    drawn = float(state.iteration)
    votes = Chart("Votes" if params.score == "count" else "Score")
    samples = Chart("Samples")
    left = float(max(state.needed - drawn, 0.0))
    scene: dict[str, Primitive] = {
        "best score": votes.scalar(state.best.score if state.best else 0.0, "best"),
        "needed": samples.scalar(left, "needed", "other"),
        "drawn": samples.scalar(drawn, "drawn", "neutral"),
    }
    if state.trial is not None and state.phase == "inliers":
        scene["trial score"] = votes.scalar(state.trial.score, "this", "highlight")
    error = Chart("Error to the truth", unit=unit)
    best = subject.error(state.best.estimate if state.best else None)
    if np.isfinite(best):
        scene["best error"] = error.scalar(best, "best", log=True)
    for name, estimate in (subject.rivals or {}).items() if len(subject.p_true) else ():
        off = subject.error(estimate)
        scene[f"error {name}"] = error.scalar(off, name, COLORS[name], log=True)
    fit = state.trial if state.trial is not None else state.best
    if fit is not None:
        scene["distances"] = _histogram(subject, fit.distances)
    if subject.is_inlier is not None:
        w = float(subject.is_inlier.mean())
        scene |= chances(w, subject.model.sample_size, state.iteration, sizes=tuple(SIZES))
    if params.model == "plane" and params.table == "alone" and params.cloud is None:
        scene |= _by_share(look, best) if state.phase == "stop" else {}
    return scene


def _by_share(look: SearchLook, error: float) -> dict[str, Primitive]:
    """Return the errors of three methods over the share of outliers, and where this run is."""
    errors = MM * errors_by_outliers(look.params)
    if not np.isfinite(error):
        return {}
    scene: dict[str, Primitive] = {
        f"share/{name}": BY_SHARE.whole(SHARES, row, name, COLORS[name])
        for name, row in zip(METHODS, errors, strict=True)
        if np.isfinite(row).all()
    }
    mark = BY_SHARE.mark(look.params.outliers, MM * error, "RANSAC here", knob="outliers")
    return scene | {"share/mark": mark}


def _histogram(subject: Subject, distances: np.ndarray) -> Curve:
    """Count how many rows lie how far from the model in question; the mark is the inlier
    distance.
    """
    limit = subject.limit
    unit = subject.model.unit
    noun = f"number of {subject.noun}"
    chart = Chart("Distances to the model", f"distance ({unit})", noun)
    bins = np.linspace(0.0, 8.0 * limit, 33)
    return chart.histogram(distances, bins, subject.noun, "target", marks=(limit,))
