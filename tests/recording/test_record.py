"""`record` and `open_recording` as Python calls them: what is asked for is what is recorded, or one
line says why not.
"""

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests import fake
from workbench import open_recording, record
from workbench.errors import InputError
from workbench.recording.read import read_chunks

ROOT = Path(__file__).resolve().parents[2]
MANY = replace(
    fake.lesson,
    name="n" * 300,
    title="t" * 300,
    presets=(replace(fake.lesson.presets[0], name="p" * 300),),
)


def name_of(path: Path) -> str:
    """The recording's name, as a viewer shows it."""
    cells = [
        chunk.to_record_batch().to_pydict()
        for chunk in read_chunks(path)
        if chunk.entity_path == "/__properties"
    ]
    return next(cell["RecordingInfo:name"][0][0] for cell in cells if "RecordingInfo:name" in cell)


@pytest.mark.parametrize(
    ("given", "params", "preset", "name"),
    [
        ({"steps": 2}, fake.Params(steps=2), None, "Every primitive, steps 2"),
        ({"preset": "short"}, fake.Params(steps=2), "short", "Every primitive, Two steps"),
        (
            {"preset": "short", "steps": 2},
            fake.Params(steps=2),
            "short",
            "Every primitive, Two steps",
        ),
        (
            {"preset": "short", "wobble": True, "place": [1, 0, 0]},
            fake.Params(steps=2, wobble=True, place=(1.0, 0.0, 0.0)),
            None,
            "Every primitive, steps 2, wobble True, place 1,0,0",
        ),
        ({"params": fake.Params(steps=2)}, fake.Params(steps=2), None, "Every primitive, steps 2"),
    ],
)
def test_what_is_asked_for_is_recorded_under_its_own_name(tmp_path, given, params, *, preset, name):
    path = record(fake.lesson, tmp_path / "a.rrd", **given)
    recording = open_recording(path)
    assert recording.typed_params(fake.lesson) == params
    assert recording.preset == preset
    assert name_of(path) == name


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"stepps": 2}, "unknown parameter 'stepps'; did you mean steps"),
        ({"steps": 0}, "steps = 0: a whole number from 1 to 5000"),
        ({"steps": "many"}, "steps = 'many': a whole number from 1 to 5000"),
        ({"preset": "none"}, "has no preset 'none'; there are: half, short, classes"),
        (
            {"params": fake.Params(), "steps": 2},
            "params and steps=…: give whole params, or a preset and single values",
        ),
        (
            {"params": fake.Params(), "preset": "half"},
            "params and preset 'half': give whole params",
        ),
        ({"params": {"steps": 2}}, "takes Params, not dict"),
    ],
)
def test_what_cannot_be_used_is_one_line_and_leaves_nothing(tmp_path, given, message):
    with pytest.raises(InputError) as caught:
        record(fake.lesson, tmp_path / "a.rrd", **given)
    assert message in str(caught.value)
    assert os.listdir(tmp_path) == []


def test_a_file_is_run_where_it_is_given_as_a_path(tmp_path):
    (tmp_path / "mine.py").write_text("from tests.fake import lesson\n")
    recording = open_recording(record(tmp_path / "mine.py", tmp_path / "a.rrd", steps=2))
    assert (recording.lesson, len(recording)) == ("fake", 2)
    with pytest.raises(InputError, match="no lesson is named"):
        record(str(tmp_path / "mine.py"), tmp_path / "b.rrd")


def test_a_recording_is_shown_in_one_short_line(fake_file, tmp_path):
    assert repr(open_recording(fake_file)) == "<Recording 'fake.rrd': 'fake', 6 steps, 'complete'>"
    for lesson, text in ((MANY, "preset p"), (replace(MANY, name="\x1b[2J\n"), "x1b")):
        path = record(lesson, tmp_path / f"{'a' * 200}.rrd", preset="p" * 300, force=True)
        shown = repr(open_recording(path))
        assert text in shown
        assert len(shown) < 200
        assert shown.isprintable()


def test_nothing_of_a_recording_can_be_changed(fake_file):
    recording = open_recording(fake_file)
    assert len(recording.scalars) > 2
    for values in recording.scalars.values():
        with pytest.raises(ValueError, match="read-only"):
            values[0] = 1
    assert not np.asarray(recording.scalars["step"]).flags.writeable


def test_type_checkers_are_told_that_there_are_types():
    assert (ROOT / "workbench" / "py.typed").is_file()


def test_a_recording_that_says_more_steps_than_it_has_costs_no_memory(tmp_path, monkeypatch):
    from workbench.recording import write

    facts = write.facts

    def odd(**values):
        return facts(**(values | ({"steps": 10**15} if "digest" in values else {})))

    monkeypatch.setattr(write, "facts", odd)
    with pytest.raises(InputError, match="fewer captions than steps"):
        open_recording(record(fake.lesson, tmp_path / "a.rrd"))
