"""What stands beside the picture: sums beside the truth, and errors over what they shrink with."""

import numpy as np

from lessons.measures.state import State, Study
from lessons.measures.words import SURE, area, off, volume
from workbench.algorithms.measures import Cells, Sums
from workbench.algorithms.monte_carlo import Balls, Estimates, Lines, Sampled, Throws
from workbench.numerals import percent
from workbench.scene import Curve, Primitive, Role, Scalar, Table

FLOOR = 1e-4  # per cent: what lies below is rounding


def beside(state: State) -> dict[str, Primitive]:
    """Return the charts and tables of a step."""
    now, subject = state.now, state.subject
    if state.study is not None:
        return _finer(state.study, lantern=state.params.shape == "lantern") | _sums(state)
    if isinstance(now, Sums):
        return _running(state, now.volume, now.area) | _sums(state)
    if isinstance(now, Cells):
        return _running(state, now.volumes[-1], now.areas[-1]) | _cells(state, now)
    if isinstance(now, Throws):
        return _by_chance(now.estimates, subject.volume, "Volume", f"{subject.unit}³", "throws")
    if isinstance(now, Lines):
        return _by_chance(now.estimates, subject.area, "Area", f"{subject.unit}²", "lines")
    return _samples(state, now) if isinstance(now, Sampled) else _balls(now)


def _running(state: State, volume: float, area: float) -> dict[str, Primitive]:
    subject = state.subject
    scene: dict[str, Primitive] = {}
    if np.isfinite(subject.volume):
        scene["volume"] = Scalar(volume, "volume", "Volume", f"{subject.unit}³")
        scene["true volume"] = Scalar(subject.volume, "truth", "Volume", f"{subject.unit}³", "truth")
    scene["area"] = Scalar(area, "area", "Area", f"{subject.unit}²")
    scene["true area"] = Scalar(subject.area, "truth", "Area", f"{subject.unit}²", "truth")
    if isinstance(state.now, Cells):
        scene["marched area"] = Scalar(state.now.marched[-1], "marching cubes", "Area", f"{subject.unit}²", "other")
    return scene


def _sums(state: State) -> dict[str, Primitive]:
    now, subject = state.now, state.subject
    if not isinstance(now, Sums) or now.count < len(subject.faces):
        return {}
    rows = [("area", area(subject, now.area), area(subject, subject.area), off(state.area_error))]
    if np.isfinite(subject.volume):
        true = volume(subject, subject.volume)
        rows.append(("volume", volume(subject, now.volume), true, off(state.volume_error)))
        plus = float(now.parts[now.parts > 0].sum())
        rows.append(("plus alone", volume(subject, plus), "", ""))
        rows.append(("minus alone", volume(subject, float(now.parts.sum()) - plus), "", ""))
    return {"sums": Table("All faces", ("", "sum", "truth", "error"), tuple(rows))}


def _finer(study: Study, lantern: bool) -> dict[str, Primitive]:
    roles: tuple[Role, ...] = ("source", "other", "wrong")
    x, label = np.log10(study.faces), "log₁₀ sectors" if lantern else "log₁₀ faces"
    chart = "Area over that of the cylinder" if lantern else "Error of ever finer meshes"
    unit = "log₁₀ times" if lantern else "log₁₀ error (%)"
    scene: dict[str, Primitive] = {}
    for (name, values), role in zip(study.errors.items(), roles, strict=False):
        y = np.log10(values if lantern else np.maximum(100 * values, FLOOR))
        scene[f"finer {name}"] = Curve(x, np.round(y, 9) + 0.0, name, chart, label, unit, role)
    if lantern:
        scene["finer truth"] = Curve(x, np.zeros(len(x)), "truth", chart, label, unit, "truth")
    return scene


def _cells(state: State, now: Cells) -> dict[str, Primitive]:
    subject, x = state.subject, np.log2(now.across)
    label = "log₂ cells across"
    off_volume = np.abs(np.array(now.volumes) / subject.volume - 1)
    chart = "Area over the true area"
    return {
        "volume errors": _dots(x, off_volume, "volume", "Error of the volume", label, "source"),
        "wall areas": Curve(x, np.array(now.areas) / subject.area, "walls of cells", chart, label, "times"),
        "marched areas": Curve(
            x, np.array(now.marched) / subject.area, "marching cubes", chart, label, "times", "other"
        ),
        "true areas": Curve(x, np.ones(len(x)), "truth", chart, label, "times", "truth"),
    }


def _dots(x: np.ndarray, error: np.ndarray, name: str, chart: str, label: str, role: Role) -> Curve:
    return Curve(x, np.log10(np.maximum(100 * error, FLOOR)), name, chart, label, "log₁₀ error (%)", role, "dots")


def _by_chance(estimates: Estimates, true: float, what: str, unit: str, drawn: str) -> dict[str, Primitive]:
    x, label = np.log10(estimates.counts), f"log₁₀ {drawn}"
    values, errors = np.array(estimates.values), np.array(estimates.errors)
    chart, bad = f"{what} by {drawn}", np.abs(values / true - 1)
    expected = np.where(errors > 0, errors, np.nan) / true
    return {
        "estimate": Curve(x, values, "estimate", chart, label, unit, "source"),
        "upper": Curve(x, values + SURE * errors, "95 % interval", chart, label, unit, "correspondence"),
        "lower": Curve(x, values - SURE * errors, "its lower end", chart, label, unit, "correspondence"),
        "truth": Curve(x, np.full(len(x), true), "truth", chart, label, unit, "truth"),
        "errors": _dots(x, bad, "error", f"Error by {drawn}", label, "wrong"),
        "standard errors": Curve(
            x,
            np.log10(100 * expected),
            "standard error, random",
            f"Error by {drawn}",
            label,
            "log₁₀ error (%)",
            "source",
        ),
    }


def _samples(state: State, now: Sampled) -> dict[str, Primitive]:
    if state.in_triangle:
        names = ("corner a", "corner b", "corner c", "middle")
        rows = tuple((name, percent(share, 1), "25 %") for name, share in zip(names, state.quarters, strict=True))
        return {"quarters table": Table("Points in the quarters", ("", "share", "of the area"), rows)}
    gap = 100 * float(np.linalg.norm(now.mean - state.middle)) / state.subject.diagonal
    chart = "Points in the half of small faces"
    return {
        "gap": Scalar(gap, "mean of the points", "Distance from the surface's middle", "% of the diagonal", "wrong"),
        "half": Scalar(100 * state.half_hits, "points", chart, "%", "source"),
        "true half": Scalar(100 * state.half_share, "area", chart, "%", "truth"),
    }


def _balls(now: Balls) -> dict[str, Primitive]:
    x, label, chart = np.array(now.dimensions, float), "dimensions", "Hits by dimension"
    hits = np.array(now.hits, float)
    expected = np.log10(now.throws * np.array(now.shares))
    return {
        "expected hits": Curve(x, expected, "expected", chart, label, "log₁₀ hits", "truth"),
        "hits": Curve(
            x, np.log10(np.where(hits > 0, hits, np.nan)), "hits", chart, label, "log₁₀ hits", "source", "dots"
        ),
    }
