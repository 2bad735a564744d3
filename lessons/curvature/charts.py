"""What stands beside the picture: estimates against the truth, errors, sums, and the vertex in
numbers.
"""

import numpy as np

from lessons.curvature.state import State
from workbench.certain import sure
from workbench.data.thinning import evenly
from workbench.geometry.points.normals import surface_variation
from workbench.numerals import brief
from workbench.scene import Chart, Primitive, Role, Scalar, Table

SAMPLES = 300
FLOOR = 0.001  # per cent: what lies below is rounding


def beside(state: State) -> dict[str, Primitive]:
    """Return the charts and the table of a step."""
    scene: dict[str, Primitive] = dict(_errors(state))
    stage = state.stage
    if stage != "finer":
        if state.subject.truth is not None or stage in ("gaussian", "quadric"):
            scene |= _against(state, "K", "gaussian", estimate=state.now.K, which=0)
        if state.subject.truth is not None or stage in ("mean", "quadric"):
            scene |= _against(state, "H", "mean", estimate=state.now.H, which=1)
    if stage == "total":
        scene |= _sum(state)
    if stage == "finer":
        scene |= _finer(state)
    if stage != "mesh":
        scene["vertex table"] = vertex_table(state)
    return scene


def _errors(state: State) -> dict[str, Primitive]:
    roles: dict[str, Role] = {
        "K": "source",
        "H": "other",
        "K by fit": "highlight",
        "H by fit": "truth",
    }
    return {
        f"error {name}": Scalar(round(100 * error, 6), name, "Error to the truth", "%", roles[name])
        for name, error in state.errors.items()
    }


def _against(
    state: State, letter: str, name: str, *, estimate: np.ndarray, which: int
) -> dict[str, Primitive]:
    """Return the estimates of some vertices in the order of their truth; without a truth a
    histogram.
    """
    unit = "m⁻²" if letter == "K" else "m⁻¹"
    known = len(estimate) > 0
    inside = state.subject.inside
    rows = np.flatnonzero(inside & np.isfinite(estimate) if known else inside)
    if not len(rows):
        return {}
    surface, fits = state.subject.truth, state.now.quadrics
    if surface is None:
        values = _rounded(np.clip(estimate[rows], *np.percentile(estimate[rows], [2, 98])))
        chart = Chart(f"{letter} of all vertices", f"{letter} ({unit})", "vertices")
        return {f"histogram {letter}": chart.histogram(values, 40, f"vertices with this {letter}")}
    true = getattr(surface, name)
    rows = rows[np.argsort(true[rows], kind="stable")]
    rows = rows[evenly(len(rows), SAMPLES)]
    x = np.linspace(0, 100, len(rows))
    chart = Chart(
        f"{letter} and its truth",
        f"vertices in the order of the true {letter} (%)",
        f"{letter} ({unit})",
    )
    way = "from angles" if letter == "K" else "from cotangents"
    scene: dict[str, Primitive] = {
        f"truth {letter}": chart.curve(x, _rounded(true[rows]), "truth", "truth")
    }
    if known:
        scene[f"estimates {letter}"] = chart.dots(x, _rounded(estimate[rows]), way)
    if fits is not None:
        scene[f"fits {letter}"] = chart.dots(
            x, _rounded(fits.curvatures()[which][rows]), "quadric fit", "highlight"
        )
    return scene


def _sum(state: State) -> dict[str, Primitive]:
    mesh = state.now
    running = np.cumsum(np.sort(mesh.defects)[::-1])
    k = evenly(len(running), SAMPLES)
    share = 100 * (k + 1) / len(running)
    chart = Chart("Sum of angle defects", "vertices added, largest defect first (%)", "rad")
    return {
        "running sum": chart.curve(share, running[k], "sum so far"),
        "expected sum": chart.curve(share, np.full(len(k), 2 * np.pi * mesh.chi), "2π χ", "truth"),
    }


def _finer(state: State) -> dict[str, Primitive]:
    study = sure(state.study)
    x = np.log10(study.counts)
    scene: dict[str, Primitive] = {}
    for letter, way, ours, fit in (
        ("K", "from angles", study.K, study.K_fit),
        ("H", "from cotangents", study.H, study.H_fit),
    ):
        chart = Chart(f"Error of {letter} on finer meshes", "log₁₀ vertices", "log₁₀ error (%)")
        both: tuple[tuple[str, np.ndarray, Role], ...] = (
            (way, ours, "source"),
            ("by fit", fit, "highlight"),
        )
        for name, error, role in both:
            y = np.log10(np.maximum(100 * error, FLOOR))
            scene[f"finer {letter} {name}"] = chart.curve(x, y, f"{letter} {name}", role)
    return scene


def vertex_table(state: State) -> Table:
    """Return what is known about the vertex, beside the truth."""
    mesh = state.now
    v = state.now.vertex
    rows: list[tuple[str, str, str]] = []

    def add(name: str, values: np.ndarray, unit: str, *, true: str | None = None) -> None:
        if len(values):
            known = "" if true is None else _number(state.true(true))
            rows.append((f"{name} ({unit})", _number(float(values[v])), known))

    rows.append(("sum of angles (°)", f"{np.degrees(mesh.angles.sum()):.2f}", ""))
    add("angle defect", np.degrees(mesh.defects), "°")
    add("mixed area A", mesh.areas, "m²")
    add("K = defect / A", mesh.K, "m⁻²", true="gaussian")
    if len(mesh.normals_2H):
        length = np.linalg.norm(mesh.normals_2H, axis=1)
        rows.append(
            (
                "length of 2 H n (m⁻¹)",
                _number(float(length[v])),
                _number(2 * abs(state.true("mean"))),
            )
        )
    add("H", mesh.H, "m⁻¹", true="mean")
    add("k₁", mesh.k1, "m⁻¹", true="k1")
    add("k₂", mesh.k2, "m⁻¹", true="k2")
    if mesh.quadrics is not None:
        K, H = mesh.quadrics.curvatures()
        add("K by fit", K, "m⁻²", true="gaussian")
        add("H by fit", H, "m⁻¹", true="mean")
        rows.append(
            (
                "surface variation of the rings",
                f"{surface_variation(state.subject.p[state.two_rings]):.4f}",
                "",
            )
        )
    return Table(f"At vertex {v:,}", ("", "here", "truth"), tuple(rows))


def _number(value: float) -> str:
    if not np.isfinite(value):
        return "–"
    return brief(value, 4)


def _rounded(values: np.ndarray) -> np.ndarray:
    """Leave out rounding errors, which a chart would otherwise enlarge where everything is 0."""
    return np.round(values, 9) + 0.0
