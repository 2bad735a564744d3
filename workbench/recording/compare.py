"""Two recordings of one lesson as one: scenes beside each other, curves in the same plots."""

import tempfile
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from workbench.errors import InputError
from workbench.lesson import View
from workbench.recording.columns import curve_style
from workbench.recording.contents import Contents, both, from_json
from workbench.recording.glyphs import safe
from workbench.recording.layout import plotted, two_runs
from workbench.recording.read import Recording, open_recording, read_chunks
from workbench.recording.replay import play
from workbench.recording.sink import document, markdown
from workbench.recording.streams import application_id, stream_bytes

ROOTS = ("/a", "/b")


def compare_files(a: Path, b: Path, *, native: bool, host: str, port: int, browser: bool) -> None:
    """Play two recordings together until interrupted.

    Raises:
        InputError: If one cannot be read, or they are of different lessons.
    """
    with tempfile.TemporaryDirectory(prefix="workbench-compare-") as folder:
        file = Path(folder) / "compare.rrd"
        file.write_bytes(compare_bytes(a, b))
        play(
            {file.name: file},
            f"{a.name} · {b.name}",
            native=native,
            host=host,
            port=port,
            browser=browser,
        )


def compare_bytes(a: Path, b: Path) -> bytes:
    """Return a recording that holds two of one lesson, below `/a` and `/b`."""
    runs = dict(zip(ROOTS, (open_recording(a), open_recording(b)), strict=True))
    run_a, run_b = runs.values()
    if run_a.lesson != run_b.lesson:
        raise InputError(
            f"{a} is a run of {run_a.lesson}, {b} of {run_b.lesson}: two runs of one lesson can be"
            " compared"
        )
    application = application_id(f"compare {run_a.lesson}")
    (contents_a, view), (contents_b, _) = (_beside(run) for run in runs.values())
    differences = differences_of(run_a, run_b)

    def fill(stream: Any) -> None:
        stream.send_recording_name(safe(f"{a.name} and {b.name}"))
        stream.log("/differences", document(_table(differences)), static=True)
        for root, run in runs.items():
            stream.send_chunks(
                [
                    moved
                    for chunk in read_chunks(run.path)
                    if (moved := _below(root, chunk)) is not None
                ]
            )
        charts = Counter(scalar.chart for scalar in {**run_a.curves, **run_b.curves}.values())
        for root, run in runs.items():
            for path, scalar in run.curves.items():
                # alone in its plot a curve needs no other name: a long one hides what it names
                letter = root[1:].upper()
                name = letter if charts[scalar.chart] == 1 else f"{scalar.name} · {letter}"
                style = curve_style(scalar, name, second=root == ROOTS[1])
                stream.log(root + plotted(path, scalar), style, static=True)

    values = {root: run.scalars for root, run in runs.items()}
    names = {root: " · ".join((root[1:].upper(), run.path.name)) for root, run in runs.items()}
    return stream_bytes(
        application, fill, two_runs(view, both(contents_a, contents_b), values, names=names)
    )


def _beside(run: Recording) -> tuple[Contents, View]:
    try:
        return from_json(run.layout, run.curves)
    except InputError as error:
        raise InputError(f"{run.path}: is damaged: {error}") from None


def differences_of(a: Recording, b: Recording) -> list[tuple[str, str, str]]:
    """Return what differs between two runs, as name, of a, of b."""
    rows = [
        (name, _text(a.params.get(name)), _text(b.params.get(name)))
        for name in {**a.params, **b.params}
        if a.params.get(name) != b.params.get(name)
    ]
    rows.append(("steps", str(len(a)), str(len(b))))
    for path in (path for path in a.curves if path in b.curves):
        rows.append((f"{a.curves[path].name}, last", _last(a, path), _last(b, path)))
    if a.version != b.version:
        rows.append(("recorded by version", a.version, b.version))
    return rows


def _last(run: Recording, path: str) -> str:
    known = run.scalars[path][np.isfinite(run.scalars[path])]
    unit = f" {run.curves[path].unit}".rstrip()
    return f"{known[-1]:.4g}{unit}" if len(known) else "none"


def _text(value: Any) -> str:
    if value is None:
        return "none"
    return f"{value:g}" if isinstance(value, float) else str(value)


def _table(rows: Sequence[tuple[str, str, str]]) -> str:
    lines = [f"| {' | '.join(markdown(cell) for cell in row)} |" for row in rows]
    return "\n".join(["| | A | B |", "|---|---|---|", *lines])


def _below(root: str, chunk: Any) -> Any:
    """Return a chunk below a root entity, None where it is about the recording as a whole."""
    if chunk.entity_path.startswith("/__properties"):
        return None
    return chunk.with_entity_path(root + chunk.entity_path.rstrip("/"))
