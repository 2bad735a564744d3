"""Every lesson of the catalogue: what is read back from its recording is what the run said."""

import json
import subprocess
from hashlib import sha256
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest

import workbench
from tests import fake
from tests.runs import finished
from workbench import knobs, open_recording, record
from workbench.errors import InputError
from workbench.lesson import Lesson, catalog
from workbench.recording.glyphs import safe
from workbench.recording.read import FORMAT, read_chunks, reopening
from workbench.recording.sink import entity_of
from workbench.recording.viewer_files import binary
from workbench.recording.write import record_bytes
from workbench.run.timeline import Timeline

LESSONS = [fake.lesson, *catalog().values()]


@pytest.fixture(scope="module", params=LESSONS, ids=lambda lesson: lesson.name)
def run(request, tmp_path_factory) -> tuple[Timeline, Path]:
    lesson = request.param
    params = lesson.params()
    shared = lesson.name in catalog()
    timeline = finished(lesson.name, params) if shared else Timeline(lesson, params).complete()
    path = tmp_path_factory.mktemp("lessons") / f"{lesson.name}.rrd"
    path.write_bytes(record_bytes(timeline))
    return timeline, path


def test_what_is_read_back_is_what_the_run_said(run):
    timeline, path = run
    recording = open_recording(path)
    assert recording.complete
    assert len(recording) == len(timeline)
    assert recording.captions == tuple(step.caption.text for step in timeline.known())
    assert recording.tones == tuple(step.caption.tone for step in timeline.known())
    series = timeline.series()
    assert list(recording.scalars) == ["step", *series]
    np.testing.assert_array_equal(recording.scalars["step"], np.arange(len(timeline)))
    for name, curve in series.items():
        np.testing.assert_array_equal(recording.scalars[name], curve.values)
        assert (recording.curves[name].name, recording.curves[name].unit) == (
            curve.scalar.name,
            curve.scalar.unit,
        )


def test_params_and_versions_are_kept(run):
    timeline, path = run
    recording = open_recording(path)
    assert recording.lesson == timeline.lesson.name
    assert recording.title == timeline.lesson.title
    assert recording.typed_params(timeline.lesson) == timeline.params
    assert recording.params == json.loads(knobs.to_json(timeline.params))
    assert recording.seed == getattr(timeline.params, "seed", None)
    assert (recording.format, recording.version, recording.preset) == (
        FORMAT,
        workbench.__version__,
        None,
    )


def test_reruns_own_check_accepts_it(run):
    done = subprocess.run(
        [str(binary()), "rrd", "verify", str(run[1])], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr


def test_every_word_can_be_drawn(run):
    for chunk in read_chunks(run[1]):
        if chunk.entity_path.startswith("/__properties"):
            continue
        batch = chunk.to_record_batch()
        for name in batch.schema.names:
            if any(word in name for word in ("Text", "labels", "names", "AnnotationContext")):
                for text in texts_in(batch.column(name).to_pylist()):
                    assert safe(text) == text, (chunk.entity_path, name, text)


def test_running_and_recording_again_gives_the_same(run):
    timeline, path = run
    other = path.with_name("again.rrd")
    other.write_bytes(record_bytes(Timeline(timeline.lesson, timeline.params).complete()))
    assert content(path) == content(other)


def test_what_is_kept_does_not_hang_on_earlier_recordings(run):
    """Rerun drops empty text, but only until it has met text of that name."""
    timeline, path = run
    named = {entity for entity, columns in content(path) if "unit" in columns}
    assert named == {
        entity_of("scalars", name) for name, curve in timeline.series().items() if curve.scalar.unit
    }


def test_presets_are_recorded_with_their_name(tmp_path):
    recording = open_recording(record(fake.lesson, tmp_path / "a.rrd", preset="half"))
    assert recording.preset == "half"
    assert recording.params["angle"] == 180.0


def test_nothing_of_an_unfinished_run_pretends_to_be_the_end(tmp_path):
    timeline = Timeline(fake.lesson, fake.Params())
    timeline.extend()
    (tmp_path / "a.rrd").write_bytes(record_bytes(timeline))
    recording = open_recording(tmp_path / "a.rrd")
    assert (recording.complete, recording.status, len(recording)) == (False, "unfinished", 1)


def test_a_run_that_failed_keeps_its_steps_and_says_why(tmp_path):
    timeline = Timeline(fake.lesson, fake.Params(trouble="crash")).complete()
    (tmp_path / "a.rrd").write_bytes(record_bytes(timeline))
    recording = open_recording(tmp_path / "a.rrd")
    assert (recording.status, len(recording)) == (timeline.stopped, 2)


def test_a_run_without_a_step_cannot_be_recorded():
    timeline = Timeline(fake.lesson, fake.Params(scan=Path("/nowhere.npy"))).complete()
    with pytest.raises(InputError, match="nowhere"):
        record_bytes(timeline)


@pytest.mark.parametrize("lesson", LESSONS[1:], ids=lambda lesson: lesson.name)
def test_reopening_gives_the_lesson_and_its_params(lesson: Lesson, tmp_path):
    params = lesson.presets[0].params
    timeline = Timeline(lesson, params)
    timeline.extend()
    (tmp_path / "a.rrd").write_bytes(record_bytes(timeline))
    assert reopening(tmp_path / "a.rrd") == (lesson, params, [])


def content(path: Path) -> dict[tuple[str, tuple[str, ...]], bytes]:
    """Return a fingerprint of everything in a recording but ids and times, by entity and kind of
    row.
    """
    tables: dict[tuple[str, tuple[str, ...]], list[pa.Table]] = {}
    for chunk in read_chunks(path):
        table = pa.table(chunk.to_record_batch()).replace_schema_metadata()
        kept = [name for name in table.schema.names if not name.endswith(("RowId", "start_time"))]
        if kept:
            tables.setdefault((chunk.entity_path, tuple(kept)), []).append(table.select(kept))
    fingerprints = {}
    for key, parts in tables.items():
        sink = pa.BufferOutputStream()
        schema = pa.schema([field.remove_metadata() for field in parts[0].schema])
        whole = pa.concat_tables([part.cast(schema) for part in parts]).combine_chunks()
        with pa.ipc.new_stream(sink, schema) as writer:
            writer.write_table(whole)
        fingerprints[key] = sha256(sink.getvalue()).digest()
    return fingerprints


def texts_in(value):
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for item in value.values():
            yield from texts_in(item)
    elif isinstance(value, list):
        for item in value:
            yield from texts_in(item)
