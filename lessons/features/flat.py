"""What one step looks like where pictures or outlines are matched: both lie side by side in a plane, seen from above."""

import numpy as np

from lessons.features.state import Outlined, Pictured, State
from workbench.geometry.polylines import between, circle, segments
from workbench.geometry.shape_context import EDGES, SECTORS, tangent_angles
from workbench.scene import Chart, Classes, Color, Field, Picture, Points, Primitive, Segments

WIDTH, NEARER, SIZE = 1.2, 0.01, 0.006  # metres
PLACES = np.array([-0.63, 0.0, 0.0]), np.array([0.63, 0.0, 0.0])
NAMES = "first", "second"
BARS = Chart("Shape context", "bin: 5 rings of 12 sectors", "%")


def pictured(now: Pictured) -> dict[str, Primitive]:
    """Return two pictures, their corners, and lines between matches."""
    shown = [_picture(now, k) for k in range(2)]
    scene: dict[str, Primitive] = dict(zip(NAMES, shown, strict=True))
    if now.uv_first is not None and now.uv_second is not None:
        for name, picture, uv in zip(NAMES, shown, (now.uv_first, now.uv_second), strict=True):
            if len(uv):
                p = picture.places(uv.astype(float), NEARER)
                scene[f"{name} corners"] = Points(p, "highlight", 0.5 * SIZE, name="corners")
        if now.pairs is not None and len(now.pairs):
            a = shown[0].places(now.uv_first[now.pairs[:, 0]].astype(float), 2 * NEARER)
            b = shown[1].places(now.uv_second[now.pairs[:, 1]].astype(float), 2 * NEARER)
            scene["matches"] = Segments(between(a, b), _color(now.right, now.known), 1.5, opacity=0.7, name="matches")
    if now.phase == "patch" and now.windows is not None:
        scene["patches"] = Picture(now.windows, "Two patches that match")
    return scene


def _picture(now: Pictured, k: int) -> Picture:
    image, pose = (now.first, now.second)[k], np.diag([1.0, -1.0, -1.0, 1.0])
    pose[:3, 3] = PLACES[k]
    shown: np.ndarray | Field = np.clip(np.rint(image), 0, 255).astype(np.uint8)
    if now.phase == "gradient" and now.strength is not None:
        top = max(float(np.percentile(now.strength[0], 99)), 1e-6)
        shown = Field(now.strength[k], 0.0, top, "gradient", "grey levels/px")
    elif now.phase == "response" and now.response is not None:
        root = np.sign(now.response[k]) * np.sqrt(np.abs(now.response[k]))
        top = max(float(np.percentile(np.sqrt(np.abs(now.response[0])), 99.5)), 1e-6)
        shown = Field(root, -top, top, "signed root of the response", map="diverging")
    width = WIDTH * image.shape[1] / max(now.first.shape[1], now.second.shape[1])
    return Picture(shown, NAMES[k], width, pose)


def outlined(state: State, now: Outlined) -> dict[str, Primitive]:
    """Return two outlines, the bins of a point, its histograms, and lines between matches."""
    first, second = (
        np.column_stack([p, np.zeros(len(p))]) + place for p, place in zip((now.first, now.second), PLACES, strict=True)
    )
    scene: dict[str, Primitive] = {
        "first": Segments(segments(first, closed=True), "target", 3, name="first outline"),
        "second": Segments(segments(second, closed=True), "source", 3, name="second outline"),
        "picked": Points(first[[now.picked]], "highlight", 3 * SIZE, name="picked point"),
    }
    if now.phase in ("bins", "histogram"):
        scene["bins"] = Segments(_bins(state, now) + PLACES[0], "neutral", 1.5, opacity=0.7, name="bins")
    if now.phase != "outlines":
        scene["there"] = Points(second[[now.picked]], "truth", 3 * SIZE, name="its true partner")
    if now.phase == "histogram" and now.f_first is not None and now.f_second is not None:
        x = np.arange(float(now.f_first.shape[1]))
        scene["bars"] = BARS.curve(x, 100 * now.f_first[now.picked], "picked point", "highlight")
        scene["bars there"] = BARS.curve(x, 100 * now.f_second[now.picked], "its true partner", "truth")
    if now.costs is not None:
        scene["costs"] = Picture(Field(now.costs, 0.0, 1.0, "cost"), "Cost of every pair")
    if now.pairs is not None:
        ends = between(first[now.pairs[:, 0]], second[now.pairs[:, 1]])
        scene["matches"] = Segments(ends, _color(now.right, None), 1.5, opacity=0.7, name="matches")
    return scene


def _bins(state: State, now: Outlined) -> np.ndarray:
    """Return the rings and sectors around the picked point, (k, 2, 3)."""
    p, n = now.first[now.picked], len(now.first)
    apart = np.linalg.norm(now.first[:, None] - now.first, axis=2)
    unit = apart.sum() / (n * (n - 1))
    start = float(tangent_angles(now.first)[now.picked]) if state.params.angles == "along the outline" else 0.0
    rings = [segments(p + unit * edge * circle(48), closed=True) for edge in EDGES]
    at = start + 2 * np.pi * np.arange(SECTORS) / SECTORS
    way = unit * np.column_stack([np.cos(at), np.sin(at)])
    flat = np.concatenate([*rings, between(p + EDGES[0] * way, p + EDGES[-1] * way)])
    return np.concatenate([flat, np.zeros((*flat.shape[:-1], 1))], axis=-1)


def _color(right: np.ndarray | None, known: np.ndarray | None) -> Color:
    if right is None:
        return "correspondence"
    kind = np.where(right, 1, 2)
    if known is None:
        return Classes(kind - 1, ("truth", "wrong"), ("right match", "wrong match"))
    return Classes(np.where(known, kind, 0), ("neutral", "truth", "wrong"), ("not known", "right match", "wrong match"))
