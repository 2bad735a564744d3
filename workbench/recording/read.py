"""Reads a recording back, without a viewer, and wary of damaged files."""

import json
import re
import reprlib
import subprocess
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
from rerun.chunk import RrdReader

from workbench import knobs
from workbench.errors import InputError
from workbench.lesson import Lesson, catalog
from workbench.machinery.version import __version__
from workbench.moved import moved
from workbench.recording.viewer_files import binary, quiet_environment
from workbench.scene import Scalar

FOREIGN = "is no Rerun recording, or is damaged"
FORMAT = 2
"""What this version writes and reads; it grows when an older version could not read a new
recording.
"""


@dataclass(frozen=True, eq=False, repr=False)
class Recording:
    """What a recording says of its run.

    Attributes:
        params: Field name to value, as JSON has them; `Params` themselves come from `typed_params`.
        preset: Where the params come from, or None.
        seed: None where the lesson has none.
        status: `complete`, or why the run ended before its end.
        format: The format's number.
        version: The version of the workbench that wrote it.
        captions: What happened, step by step.
        tones: `info`, `good` or `wrong`, step by step.
        scalars: Read-only columns by path, `step` first, NaN where a step has none.
        curves: How each scalar is drawn, by path: name, unit, colour; with its last value.
        layout: What stands beside the scene and how that is first seen, for a viewer.
    """

    path: Path
    lesson: str
    title: str
    params: Mapping[str, Any]
    preset: str | None
    seed: int | None
    status: str
    format: int
    version: str
    captions: tuple[str, ...]
    tones: tuple[str, ...]
    scalars: Mapping[str, np.ndarray]
    curves: Mapping[str, Scalar]
    layout: str

    def __len__(self) -> int:
        """Return the number of steps."""
        return len(self.captions)

    def __repr__(self) -> str:
        """Return one short line: file, lesson, preset, how many steps, how it ended."""
        words = [
            self.path.name,
            self.lesson,
            *([] if self.preset is None else [f"preset {self.preset}"]),
        ]
        shown = [reprlib.repr(word) for word in (*words, self.status)]
        return f"<Recording {shown[0]}: {', '.join(shown[1:-1])}, {len(self):,} steps, {shown[-1]}>"

    @property
    def complete(self) -> bool:
        """Whether the run was recorded to its end."""
        return self.status == "complete"

    def typed_params(self, lesson: Lesson) -> Any:
        """Return the params as the lesson's own Params; raise InputError where they do not fit.

        Paths among them are what the file says: a run of these params reads those files.
        """
        return knobs.make(lesson.params, self.params)


def open_recording(path: str | Path) -> Recording:
    """Read a recording.

    Raises:
        InputError: If the file is missing, empty, damaged, cut short, or no recording of a run.
    """
    path = Path(path)
    _check_file(path)
    chunks = read_chunks(path)
    try:
        return _recording(path, chunks)
    except InputError:
        raise
    except Exception as error:  # whatever a damaged file makes of its values
        raise InputError(f"{path}: is damaged ({type(error).__name__})") from error


def reopening(
    path: Path, given: Lesson | None = None, *, files: bool = False
) -> tuple[Lesson, Any, list[str]]:
    """Return the lesson and the params of a recording, and a line for what is not as it was.

    The lesson's name is looked up in the catalogue and nowhere else: a recording may come from
    anybody. A `given` lesson has to have that name; `files` lets the run read the files named.

    Raises:
        InputError: If the file cannot be read, its lesson is not here, or it names files and may
            not.
    """
    recording = open_recording(path)
    led = moved(recording.lesson, None, recording.params)
    lesson = _lesson_of(recording, led.lesson, given)
    told = recording.params if given is not None else led.values
    lines = []
    if lesson.name != recording.lesson:
        lines.append(
            f"{path}: this run of {recording.lesson} is one of the lesson {lesson.name} now"
        )
    if recording.version != __version__:
        lines.append(
            f"{path}: recorded by version {recording.version}, this is {__version__}; the run may"
            " differ"
        )
    if recording.format > FORMAT:
        lines.append(
            f"{path}: format {recording.format} is newer than this version's {FORMAT}; trying all"
            " the same"
        )
    fields = {field.name: field for field in knobs.fields_of(lesson.params)}
    values = {}
    for name, value in told.items():
        if name not in fields:
            lines.append(f"{path}: the lesson has no parameter {name} any more; left out")
            continue
        try:
            values[name] = fields[name].clean(value)
        except InputError as error:
            lines.append(f"{path}: {error}; left at its default")
    named = [
        f"{name} {values[name]}"
        for name in values
        if fields[name].sensitive and values[name] is not None
    ]
    if named and not files:
        raise InputError(
            f"{path}: was made from files ({', '.join(named)}); a recording may come from anybody,"
            " so they are read only with --files"
        )
    return lesson, knobs.make(lesson.params, values), lines


def _lesson_of(recording: Recording, name: str, given: Lesson | None) -> Lesson:
    """Return the lesson of a recording: the one given if it has the name, or the catalogue's."""
    path = recording.path
    if given is not None and given.name == recording.lesson:
        return given
    if given is not None and given.name != name:
        raise InputError(
            f"{path}: is a run of the lesson {name[:80]!r}, and the lesson given is {given.name!r}"
        )
    lesson = catalog().get(name) if given is None else given
    if lesson is None:
        raise InputError(
            f"{path}: is a run of the lesson {name[:80]!r}, which is not installed; if you have its"
            " file, name it: --lesson FILE.py"
        )
    return lesson


def read_chunks(path: Path) -> list[Any]:
    """Return the chunks of the one recording in a file, layouts left out.

    A damaged file can end this process from inside rerun: `open_recording` has it checked in
    another one first.

    Raises:
        InputError: If the file cannot be read.
    """
    try:
        with warnings.catch_warnings():
            # of bytes behind the end: what is read is held to its digest
            warnings.simplefilter("ignore")
            reader = RrdReader(path)
        stores = reader.recordings()
        chunks = [chunk for store in stores for chunk in reader.stream(store=store)]
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror or error}") from error
    except (RuntimeError, ValueError) as error:
        raise InputError(f"{path}: {FOREIGN}") from error
    if len(stores) != 1:
        raise InputError(f"{path}: holds {len(stores)} recordings, one is expected")
    return chunks


def _check_file(path: Path) -> None:
    """Raise InputError if the file is missing, empty, foreign, or not to be decoded."""
    try:
        if not path.is_file():
            raise InputError(f"{path}: no such file")
        if path.stat().st_size == 0:
            raise InputError(f"{path}: is empty")
        path.open("rb").close()
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror or error}") from error
    check = subprocess.run(
        [str(binary()), "rrd", "verify", str(path.absolute())],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        env=quiet_environment(),
        check=False,
    )
    if check.returncode:
        raise InputError(f"{path}: {FOREIGN}")


def digest(params: str, captions: Sequence[str], scalars: Mapping[str, np.ndarray]) -> str:
    """Return a fingerprint of what is read back; the format itself has no checksum."""
    told = sha256(json.dumps([params, list(captions), list(scalars)]).encode())
    for values in scalars.values():
        told.update(np.ascontiguousarray(values, dtype="<f8").tobytes())
    return told.hexdigest()


def _recording(path: Path, chunks: Sequence[Any]) -> Recording:
    facts, result = _properties(chunks, "run"), _properties(chunks, "result")
    if not facts:
        raise InputError(f"{path}: is a Rerun recording, but not of a run of the workbench")
    if not result:
        raise InputError(f"{path}: is cut short: its end is missing")
    n = int(result["steps"])
    told = sum(
        chunk.num_rows
        for chunk in chunks
        if chunk.entity_path == "/caption" and not chunk.is_static
    )
    if not 0 < n <= told:
        raise InputError(f"{path}: is damaged: it has fewer captions than steps")
    captions = _column(chunks, "/caption", "caption", n=n)
    paths = [
        chunk.entity_path
        for chunk in chunks
        if chunk.entity_path.startswith("/scalars/") and not chunk.is_static
    ]
    series = {
        _scene_path(entity): np.array(_column(chunks, entity, "Scalars:scalars", n=n), float)
        for entity in paths
    }
    abouts = {path: _static(chunks, entity) for path, entity in zip(series, paths, strict=True)}
    order = sorted(series, key=lambda path: int(abouts[path]["order"]))
    scalars = {path: series[path] for path in order}
    if (
        any(caption is None for caption in captions)
        or digest(facts["params"], captions, scalars) != result["digest"]
    ):
        raise InputError(f"{path}: is damaged: its content does not fit its fingerprint")
    params = json.loads(facts["params"])
    if not isinstance(params, dict):
        raise InputError(f"{path}: is damaged: its parameters are no JSON object")
    for values in (steps := np.arange(n), *scalars.values()):
        values.setflags(write=False)
    return Recording(
        path=path,
        lesson=str(facts["lesson"]),
        title=str(facts["title"]),
        params=params,
        preset=str(facts.get("preset") or "") or None,
        seed=int(facts["seed"]) if "seed" in params else None,
        status=str(result["status"]),
        format=int(facts["format"]),
        version=str(facts["version"]),
        captions=tuple(captions),
        tones=tuple(_column(chunks, "/caption", "tone", n=n)),
        scalars={"step": steps, **scalars},
        curves={path: _scalar(abouts[path], scalars[path]) for path in order},
        layout=facts["layout"],
    )


def _scalar(about: Mapping[str, Any], values: np.ndarray) -> Scalar:
    known = values[np.isfinite(values)]
    return Scalar(
        value=float(known[-1]) if len(known) else float("nan"),
        name=about["name"],
        chart=about["chart"],
        unit=about.get("unit") or "",
        color=about["role"],
        log=bool(about["logarithmic"]),
    )


def _properties(chunks: Sequence[Any], name: str) -> dict[str, Any]:
    return _static(chunks, f"/__properties/{name}")


def _static(chunks: Sequence[Any], entity: str) -> dict[str, Any]:
    """Return the static values of an entity, the first of each component."""
    values: dict[str, Any] = {}
    for chunk in chunks:
        if chunk.entity_path == entity and chunk.is_static:
            for name, column in chunk.to_record_batch().to_pydict().items():
                known = [cell[0] for cell in column if isinstance(cell, list) and cell]
                if known:
                    values[name] = known[-1]
    return values


def _column(chunks: Sequence[Any], entity: str, component: str, *, n: int) -> list[Any]:
    """Return one component of an entity, step by step; None where a step has none."""
    values: list[Any] = [None] * n
    for chunk in chunks:
        if chunk.entity_path == entity and not chunk.is_static:
            columns = chunk.to_record_batch().to_pydict()
            for step, cell in zip(columns["step"], columns.get(component, ()), strict=False):
                if cell:
                    values[step] = cell[0]
    return values


def _scene_path(entity: str) -> str:
    """Return a scene's path from an entity's, where special signs stand behind a backslash or as
    `\\u{code}`.
    """
    return re.sub(
        r"\\u\{([0-9A-Fa-f]+)\}|\\(.)",
        lambda match: chr(int(match[1], 16)) if match[1] else match[2],
        entity.removeprefix("/scalars/"),
    )
