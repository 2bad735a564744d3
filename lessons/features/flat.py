"""What one step looks like where pictures or outlines are matched: both lie side by side in a
plane, seen from above.
"""

import numpy as np

from lessons.features.state import Outlined, Pictured, State
from workbench.geometry.features.shape_context import EDGES, SECTORS, tangent_angles
from workbench.geometry.features.sift import Sift
from workbench.geometry.motions import R_ROWS_DOWN, motion
from workbench.geometry.polylines import at_height, between, circle, segments
from workbench.scene import Chart, Field, Picture, Points, Primitive, Role, Segments

WIDTH, NEARER, SIZE = 1.2, 0.01, 0.006  # metres
MANY = 60  # lines
ROUND = 1.5  # radius of the circle round a keypoint, in its sizes
PLACES = np.array([-0.63, 0.0, 0.0]), np.array([0.63, 0.0, 0.0])
NAMES = "first", "second"
BARS = Chart("Shape context", "bin: 5 rings of 12 sectors", "%")


def pictured(step: Pictured) -> dict[str, Primitive]:
    """Return two pictures, their corners, and lines between matches."""
    shown = [_picture(step, k) for k in range(2)]
    scene: dict[str, Primitive] = dict(zip(NAMES, shown, strict=True))
    if step.uv_first is not None and step.uv_second is not None:
        for name, picture, uv in zip(NAMES, shown, (step.uv_first, step.uv_second), strict=True):
            if len(uv) and not step.sifts:
                p = picture.places(uv.astype(float), NEARER)
                scene[f"{name} corners"] = Points(p, "highlight", SIZE, name="corners")
        if step.pairs is not None and len(step.pairs):
            a = shown[0].places(step.uv_first[step.pairs[:, 0]].astype(float), 2 * NEARER)
            b = shown[1].places(step.uv_second[step.pairs[:, 1]].astype(float), 2 * NEARER)
            scene |= lines_between(a, b, right=step.right, known=step.known)
    if step.sifts and step.phase in ("corners", "patch"):
        for k, (name, picture, sift) in enumerate(zip(NAMES, shown, step.sifts, strict=True)):
            ends = picture.places(
                _marks(sift, slice(None) if step.pairs is None else step.pairs[:, k]), NEARER
            )
            scene[f"{name} keypoints"] = Segments(
                ends, "highlight", 1.5, name="keypoints: size and direction"
            )
    if step.phase == "patch" and step.windows is not None:
        scene["patches"] = Picture(step.windows, "Two patches that match")
    return scene


def _picture(step: Pictured, k: int) -> Picture:
    image = (step.first, step.second)[k]
    shown: np.ndarray | Field = np.clip(np.rint(image), 0, 255).astype(np.uint8)
    if step.phase == "gradient" and step.strength is not None:
        top = max(float(np.percentile(step.strength[0], 99)), 1e-6)
        shown = Field(step.strength[k], 0.0, top, "gradient", "grey levels/px")
    elif step.phase == "response" and step.response is not None:
        root = np.sign(step.response[k]) * np.sqrt(np.abs(step.response[k]))
        top = max(float(np.percentile(np.sqrt(np.abs(step.response[0])), 99.5)), 1e-6)
        shown = Field(root, -top, top, "signed root of the response", map="diverging")
    width = WIDTH * image.shape[1] / max(step.first.shape[1], step.second.shape[1])
    return Picture(shown, NAMES[k], width, motion(R_ROWS_DOWN, PLACES[k]))


def _marks(sift: Sift, some: slice | np.ndarray) -> np.ndarray:
    """Return circles as wide as some keypoints and lines along their directions, pixels, (k, 2,
    2).
    """
    uv = sift.uv[some]
    angle = sift.angle[some]
    radius = ROUND * sift.sigma[some, None]
    rims = uv[:, None] + radius[:, None] * circle(24)
    tips = uv + radius * np.column_stack([np.cos(angle), np.sin(angle)])
    return np.concatenate([*(segments(rim, closed=True) for rim in rims), between(uv, tips)])


def outlined(state: State, step: Outlined) -> dict[str, Primitive]:
    """Return two outlines, the bins of a point, its histograms, and lines between matches."""
    first, second = (
        at_height(p) + place for p, place in zip((step.first, step.second), PLACES, strict=True)
    )
    scene: dict[str, Primitive] = {
        "first": Segments(segments(first, closed=True), "target", 3, name="first outline"),
        "second": Segments(segments(second, closed=True), "source", 3, name="second outline"),
        "picked": Points(first[[step.picked]], "highlight", 3 * SIZE, name="picked point"),
    }
    if step.phase in ("bins", "histogram"):
        scene["bins"] = Segments(
            _bins(state, step) + PLACES[0], "neutral", 1.5, opacity=0.7, name="bins"
        )
    if step.phase != "outlines":
        scene["there"] = Points(second[[step.picked]], "truth", 3 * SIZE, name="its true partner")
    if step.phase == "histogram" and step.f_first is not None and step.f_second is not None:
        x = np.arange(float(step.f_first.shape[1]))
        scene["bars"] = BARS.curve(x, 100 * step.f_first[step.picked], "picked point", "highlight")
        scene["bars there"] = BARS.curve(
            x, 100 * step.f_second[step.picked], "its true partner", "truth"
        )
    if step.costs is not None:
        scene["costs"] = Picture(Field(step.costs, 0.0, 1.0, "cost"), "Cost of every pair")
    if step.pairs is not None:
        scene |= lines_between(first[step.pairs[:, 0]], second[step.pairs[:, 1]], right=step.right)
    return scene


def _bins(state: State, step: Outlined) -> np.ndarray:
    """Return the rings and sectors around the picked point, (k, 2, 3)."""
    p = step.first[step.picked]
    n = len(step.first)
    apart = np.linalg.norm(step.first[:, None] - step.first, axis=2)
    unit = apart.sum() / (n * (n - 1))
    start = (
        float(tangent_angles(step.first)[step.picked])
        if state.params.angles == "along the outline"
        else 0.0
    )
    rings = [segments(p + unit * edge * circle(48), closed=True) for edge in EDGES]
    at = start + 2 * np.pi * np.arange(SECTORS) / SECTORS
    way = unit * np.column_stack([np.cos(at), np.sin(at)])
    return at_height(np.concatenate([*rings, between(p + EDGES[0] * way, p + EDGES[-1] * way)]))


def lines_between(
    a: np.ndarray,
    b: np.ndarray,
    *,
    right: np.ndarray | None,
    known: np.ndarray | None = None,
    thin: str = "wrong match",
) -> dict[str, Primitive]:
    """Return lines between matches: those that are wrong are thin where there are many, so that the
    right ones show.

    Args:
        a: Places of the first set, metres.
        b: Places of their matches.
        right: Which are right; None where nobody knows.
        known: Of which the truth is known; of all by default.
        thin: What the others are called.
    """
    if right is None:
        return {
            "matches": Segments(between(a, b), "correspondence", 1.5, opacity=0.7, name="matches")
        }
    known = np.ones(len(right), bool) if known is None else known
    width, opacity = (1.0, 0.45) if len(right) > MANY else (2.0, 0.9)
    thick = 2.5 if right.sum() <= MANY else 1.5
    agrees = "right match" if thin == "wrong match" else "agrees"
    kinds: tuple[tuple[str, np.ndarray, Role, float, float, str], ...] = (
        ("matches/unknown", ~known, "neutral", 1.0, 0.4, "truth not known"),
        ("matches/wrong", known & ~right, "wrong", width, opacity, thin),
        ("matches/right", known & right, "truth", thick, 0.9, agrees),
    )
    return {
        path: Segments(between(a[some], b[some]), color, width, opacity=opacity, name=name)
        for path, some, color, width, opacity, name in kinds
        if some.any()
    }
