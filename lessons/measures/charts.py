"""What stands beside the picture: sums beside the truth, and errors over what they shrink with."""

import numpy as np

from lessons.measures.captions import area, off, volume
from lessons.measures.state import State, Study
from lessons.measures.study import SURE
from workbench.algorithms.surfaces.measures import Cells, Sums
from workbench.algorithms.surfaces.monte_carlo import Balls, Estimates, Lines, Sampled, Throws
from workbench.numerals import percent
from workbench.scene import Chart, Primitive, Role, Table

FLOOR = 1e-4  # per cent: what lies below is rounding
LANTERN = Chart("Area over that of the cylinder", "log₁₀ sectors", "log₁₀ times")
FINER = Chart("Error of ever finer meshes", "log₁₀ faces", "log₁₀ error (%)")
CELLS = Chart("Error of the volume", "log₂ cells across", "log₁₀ error (%)")
AREAS = Chart("Area over the true area", "log₂ cells across", "times")
GAP = Chart("Distance from the surface's middle", unit="% of the diagonal")
HALF = Chart("Points in the half of small faces", unit="%")
HITS = Chart("Hits by dimension", "dimensions", "log₁₀ hits")


def beside(state: State) -> dict[str, Primitive]:
    """Return the charts and tables of a step."""
    result, subject = state.now, state.subject
    if state.study is not None:
        return _finer(state.study, lantern=state.params.shape == "lantern") | _sums(state)
    if isinstance(result, Sums):
        return _running(state, result.volume, result.area) | _sums(state)
    if isinstance(result, Cells):
        return _running(state, result.volumes[-1], result.areas[-1]) | _cells(state, result)
    if isinstance(result, Throws):
        return _by_chance(
            result.estimates, subject.volume, "Volume", unit=f"{subject.unit}³", drawn="throws"
        )
    if isinstance(result, Lines):
        return _by_chance(
            result.estimates, subject.area, "Area", unit=f"{subject.unit}²", drawn="lines"
        )
    return _samples(state, result) if isinstance(result, Sampled) else _balls(result)


def _running(state: State, volume: float, area: float) -> dict[str, Primitive]:
    subject = state.subject
    scene = dict[str, Primitive]()
    volumes = Chart("Volume", unit=f"{subject.unit}³")
    areas = Chart("Area", unit=f"{subject.unit}²")
    if np.isfinite(subject.volume):
        scene["volume"] = volumes.scalar(volume, "volume")
        scene["true volume"] = volumes.scalar(subject.volume, "truth", "truth")
    scene["area"] = areas.scalar(area, "area")
    scene["true area"] = areas.scalar(subject.area, "truth", "truth")
    if isinstance(state.now, Cells):
        scene["marched area"] = areas.scalar(state.now.marched[-1], "marching cubes", "other")
    return scene


def _sums(state: State) -> dict[str, Primitive]:
    sums, subject = state.now, state.subject
    if not isinstance(sums, Sums) or sums.count < len(subject.faces):
        return {}
    rows = [("area", area(subject, sums.area), area(subject, subject.area), off(state.area_error))]
    if np.isfinite(subject.volume):
        true = volume(subject, subject.volume)
        rows.append(("volume", volume(subject, sums.volume), true, off(state.volume_error)))
        plus = float(sums.parts[sums.parts > 0].sum())
        rows.append(("plus alone", volume(subject, plus), "", ""))
        rows.append(("minus alone", volume(subject, float(sums.parts.sum()) - plus), "", ""))
    return {"sums": Table("All faces", ("", "sum", "truth", "error"), tuple(rows))}


def _finer(study: Study, lantern: bool) -> dict[str, Primitive]:
    roles: tuple[Role, ...] = ("source", "other", "wrong")
    x = np.log10(study.faces)
    chart = LANTERN if lantern else FINER
    scene: dict[str, Primitive] = {}
    for (name, values), role in zip(study.errors.items(), roles, strict=False):
        y = np.log10(values) if lantern else _log(values)
        scene[f"finer {name}"] = chart.curve(x, np.round(y, 9) + 0.0, name, role)
    if lantern:
        scene["finer truth"] = chart.curve(x, np.zeros(len(x)), "truth", "truth")
    return scene


def _cells(state: State, cells: Cells) -> dict[str, Primitive]:
    subject = state.subject
    x = np.log2(cells.across)
    return {
        "volume errors": CELLS.dots(
            x, _log(np.abs(np.array(cells.volumes) / subject.volume - 1)), "volume"
        ),
        "wall areas": AREAS.curve(x, np.array(cells.areas) / subject.area, "walls of cells"),
        "marched areas": AREAS.curve(
            x, np.array(cells.marched) / subject.area, "marching cubes", "other"
        ),
        "true areas": AREAS.curve(x, np.ones(len(x)), "truth", "truth"),
    }


def _log(error: np.ndarray) -> np.ndarray:
    return np.log10(np.maximum(100 * error, FLOOR))


def _by_chance(
    estimates: Estimates, true: float, quantity: str, *, unit: str, drawn: str
) -> dict[str, Primitive]:
    sums = Chart(f"{quantity} by {drawn}", f"log₁₀ {drawn}", unit)
    off_by = Chart(f"Error by {drawn}", f"log₁₀ {drawn}", "log₁₀ error (%)")
    x = np.log10(estimates.counts)
    values = np.array(estimates.values)
    errors = np.array(estimates.errors)
    expected = np.where(errors > 0, errors, np.nan) / true
    return {
        "estimate": sums.curve(x, values, "estimate"),
        "upper": sums.curve(x, values + SURE * errors, "95 % interval", "correspondence"),
        "lower": sums.curve(x, values - SURE * errors, "its lower end", "correspondence"),
        "truth": sums.curve(x, np.full(len(x), true), "truth", "truth"),
        "errors": off_by.dots(x, _log(np.abs(values / true - 1)), "error", "wrong"),
        "standard errors": off_by.curve(x, np.log10(100 * expected), "standard error, random"),
    }


def _samples(state: State, sampled: Sampled) -> dict[str, Primitive]:
    if state.in_triangle:
        names = ("corner a", "corner b", "corner c", "middle")
        rows = tuple(
            (name, percent(share, 1), "25 %")
            for name, share in zip(names, state.quarters, strict=True)
        )
        return {
            "quarters table": Table("Points in the quarters", ("", "share", "of the area"), rows)
        }
    gap = 100 * float(np.linalg.norm(sampled.mean - state.middle)) / state.subject.diagonal
    return {
        "gap": GAP.scalar(gap, "mean of the points", "wrong"),
        "half": HALF.scalar(100 * state.half_hits, "points"),
        "true half": HALF.scalar(100 * state.half_share, "area", "truth"),
    }


def _balls(balls: Balls) -> dict[str, Primitive]:
    x, hits = np.array(balls.dimensions, float), np.array(balls.hits, float)
    return {
        "expected hits": HITS.curve(
            x, np.log10(balls.throws * np.array(balls.shares)), "expected", "truth"
        ),
        "hits": HITS.dots(x, np.log10(np.where(hits > 0, hits, np.nan)), "hits"),
    }
