"""What one step of RANSAC looks like: points, the sample, the model it gives, the best so far, and
the curves.
"""

import numpy as np

from lessons.ransac.captions import caption
from lessons.ransac.shapes import frames, outline, slab
from lessons.ransac.state import State, Subject
from workbench.algorithms.robust.ransac import Fit
from workbench.geometry.clipping import plane_in_box
from workbench.geometry.motions import R_UPRIGHT, motion
from workbench.geometry.polylines import between, fan
from workbench.numerals import brief
from workbench.scene import (
    Chart,
    Classes,
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

MOST_LINES = 150
EPIPOLAR_ROWS = 8
SCORE, SAMPLES = Chart("Score"), Chart("Samples")
BAND = np.array([[0, 1, 2], [1, 3, 2]])
RIVAL_COLORS: dict[str, Role] = {"least squares": "other", "Huber": "neutral"}


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    parts = (
        _background(state.subject) | _rows(state) | _sample(state) | _models(state) | _curves(state)
    )
    return {"caption": caption(state)} | parts


def _rows(state: State) -> dict[str, Primitive]:
    """Draw all rows, coloured by their votes on the fit in question: the trial, or else the
    best.
    """
    subject, now = state.subject, state.now
    fit = (
        now.trial
        if now.phase in ("inliers", "best", "refit")
        else now.best
        if now.phase == "stop"
        else None
    )
    radius = _radius(subject)
    color = "neutral"
    if fit is not None:
        color = Classes.marking(
            ~fit.inliers, "neutral", "vote against", others=("target", "vote for")
        )
    names = (subject.noun,) if len(subject.shown) == 1 else ("first image", "second image")
    scene: dict[str, Primitive] = {
        path: Points(p, color, radius, name=name)
        for path, p, name in zip(("points", "points in second"), subject.shown, names, strict=False)
    }
    if len(subject.shown) == 2:
        rows = (
            np.zeros(0, int)
            if fit is None
            else np.flatnonzero(fit.inliers)[:: 1 + fit.count // MOST_LINES]
        )
        ends = between(*(p[rows] for p in subject.shown))
        scene["matches"] = Segments(
            ends, "correspondence", 1.0, opacity=0.5, name="matches that vote for it"
        )
    return scene


def _radius(subject: Subject) -> float:
    return float(np.clip((0.22 if subject.sizes else 0.32) / np.sqrt(len(subject.p)), 0.004, 0.016))


def _sample(state: State) -> dict[str, Primitive]:
    subject, now = state.subject, state.now
    rows = now.sample if now.phase not in ("refit", "stop") else now.sample[:0]
    if not len(rows):
        return {}
    p = np.concatenate([shown[rows] for shown in subject.shown])
    scene: dict[str, Primitive] = {
        "sample": Points(p, "highlight", 2.2 * _radius(subject), name="the sample")
    }
    if len(subject.shown) == 2:
        ends = between(*(p[rows] for p in subject.shown))
        scene["sample matches"] = Segments(ends, "highlight", 2.0, name="matches of the sample")
    return scene


def _models(state: State) -> dict[str, Primitive]:
    """Draw the truth, the best so far and the model under test, one of them with its slab, and at
    the end the rivals.
    """
    subject, now = state.subject, state.now
    scene: dict[str, Primitive] = {}
    if subject.truth is not None:
        scene |= _model(subject, "truth", subject.truth, color="truth", width=3.0, name="truth")
    for rival in state.rivals if now.phase in ("refit", "stop") and not subject.sizes else ():
        color = RIVAL_COLORS[rival.name]
        scene |= _model(
            subject, f"rival {rival.name}", rival.estimate, color=color, width=2.0, name=rival.name
        )
    tested = now.estimate if now.phase in ("model", "inliers") else None
    if now.best is not None:
        opacity = (
            0.0 if tested is not None else 0.35 if now.phase in ("best", "refit", "stop") else 0.15
        )
        scene |= _model(
            subject,
            "best",
            now.best.estimate,
            color="source",
            width=3.0,
            opacity=opacity,
            name="best so far",
        )
        scene |= _slab(state, now.best.estimate, "source")
    if tested is not None:
        name = f"{subject.model.name} of the sample"
        scene |= _model(
            subject, "trial", tested, color="highlight", width=2.5, opacity=0.3, name=name
        )
        scene |= _slab(state, tested, "highlight")
    return scene


def _slab(state: State, estimate: np.ndarray, color: Role) -> dict[str, Primitive]:
    """Draw where a point is near enough to vote."""
    edges, band = slab(state.subject, estimate, state.inlier_distance)
    if not len(edges):
        return {}
    name = f"± {brief(1000 * state.inlier_distance)} mm"
    scene: dict[str, Primitive] = {"slab": Segments(edges, color, 1.5)}
    if len(band):
        scene["slab/band"] = Mesh(band, BAND, color, opacity=0.25, flat=True)
    at = edges.reshape(-1, 3)
    scene["slab name"] = Label(name, at[np.argmax(at @ [1.0, -0.6, -0.4])], color)
    return scene


def _model(
    subject: Subject,
    path: str,
    estimate: np.ndarray,
    *,
    color: Role,
    width: float,
    opacity: float = 0.0,
    name: str,
) -> dict[str, Primitive]:
    """Draw the outline of a model, and of a plane its surface too where it has an opacity."""
    rows = np.arange(0, len(subject.p), max(1, len(subject.p) // EPIPOLAR_ROWS))[:EPIPOLAR_ROWS]
    if subject.is_inlier is not None:
        rows = np.flatnonzero(subject.is_inlier)[:EPIPOLAR_ROWS]
    scene: dict[str, Primitive] = {
        path: Segments(outline(subject, estimate, rows), color, width, name=name)
    }
    if subject.model.name == "plane" and opacity > 0.0:
        corners = plane_in_box(estimate, subject.low, subject.high)
        if len(corners):
            surface = Mesh(
                subject.places[0](corners), fan(len(corners)), color, opacity=opacity, flat=True
            )
            scene[f"{path}/surface"] = surface
    return scene


def _background(subject: Subject) -> dict[str, Primitive]:
    scene: dict[str, Primitive] = {}
    borders = frames(subject)
    if len(borders):
        scene["frame"] = Segments(borders, "neutral", 1.5)
    for k, (word, place) in enumerate(
        zip(("first image", "second image"), subject.places, strict=False)
    ):
        if not subject.sizes:
            break
        w, _ = subject.sizes[k]
        scene[f"label {word}"] = Label(word, place(np.array([[w / 2.0, -14.0 * w / 640.0]]))[0])
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
    return Picture(
        image, width=float(right[0] - corner[0]) * w / (w - 1.0), T_world_object=T_world_image
    )


def _curves(state: State) -> dict[str, Primitive]:
    subject, now = state.subject, state.now
    unit, drawn = subject.model.unit, float(now.iteration)
    scene: dict[str, Primitive] = {
        "best score": SCORE.scalar(now.best.score if now.best else 0.0, "best so far"),
        "needed": SAMPLES.scalar(float(max(now.needed - drawn, 0.0)), "still needed", "other"),
        "drawn": SAMPLES.scalar(drawn, "drawn", "neutral"),
    }
    if now.trial is not None and now.phase == "inliers":
        scene["trial score"] = SCORE.scalar(now.trial.score, "this sample", "highlight")
    error = Chart("Error to the truth", unit=unit)
    if np.isfinite(state.best_error):
        scene["best error"] = error.scalar(state.best_error, "best so far", log=True)
    for rival in state.rivals if len(subject.p_true) else ():
        scene[f"error {rival.name}"] = error.scalar(
            rival.error, rival.name, RIVAL_COLORS[rival.name], log=True
        )
    fit = now.trial if now.trial is not None else now.best
    if fit is not None:
        scene["distances"] = _histogram(fit, state)
    return scene


def _histogram(fit: Fit, state: State) -> Curve:
    """Count how many rows lie how far from the model in question; the mark is the inlier
    distance.
    """
    limit, unit = state.inlier_distance, state.subject.model.unit
    chart = Chart("Distances to the model", f"distance ({unit})", "how many")
    return chart.histogram(
        fit.distances,
        np.linspace(0.0, 8.0 * limit, 33),
        state.subject.noun,
        "target",
        marks=(limit,),
    )
