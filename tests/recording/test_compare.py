"""Two recordings as one: everything of both, on one timeline, curves in the same plots."""

import json
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests import fake
from tests.recording.latest_at import rows, shown_at
from workbench.errors import InputError
from workbench.recording.chart import Canvas
from workbench.recording.compare import compare_bytes, differences_of
from workbench.recording.contents import from_json, to_json
from workbench.recording.read import open_recording, read_chunks
from workbench.recording.viewer_files import binary
from workbench.recording.write import record


@pytest.fixture(scope="module")
def files(tmp_path_factory) -> tuple[Path, Path, Path]:
    folder = tmp_path_factory.mktemp("compare")
    a = record(fake.lesson, folder / "a.rrd")
    b = record(fake.lesson, folder / "b.rrd", fake.Params(steps=4, colors="classes", angle=45.0))
    both = folder / "both.rrd"
    both.write_bytes(compare_bytes(a, b))
    return a, b, both


def test_each_run_is_there_below_its_root(files):
    a, b, both = files
    for root, path in (("/a", a), ("/b", b)):
        for k in (0, 3):
            alone = shown_at(path, k)
            together = shown_at(
                both,
                k,
                below=(f"{root}/world", f"{root}/pictures", f"{root}/charts", f"{root}/legend"),
            )
            for entity, components in alone.items():
                if not entity.startswith("/tables"):
                    assert together[root + entity] == components, entity


def test_curves_of_both_keep_their_values_and_are_told_apart(files):
    a, b, both = files
    values: dict[str, list[float]] = {}
    styles: dict[str, dict] = {}
    for step, _, entity, components in rows(both):
        if "Scalars:scalars" in components:
            values.setdefault(entity, []).append(components["Scalars:scalars"][0])
        elif step == -1 and "SeriesLines:names" in components:
            styles[entity] = components
    for root, path in (("/a", a), ("/b", b)):
        recording = open_recording(path)
        for name in recording.curves:
            np.testing.assert_array_equal(values[f"{root}/scalars/{name}"], recording.scalars[name])
    first, second = styles["/a/scalars/error"], styles["/b/scalars/error"]
    assert first["SeriesLines:names"] == ["Distance · A"]
    assert second["SeriesLines:names"] == ["Distance · B"]
    assert first["SeriesLines:colors"] != second["SeriesLines:colors"]


def test_what_differs_is_said(files):
    a, b, both = files
    differences = {
        name: (first, second)
        for name, first, second in differences_of(open_recording(a), open_recording(b))
    }
    assert differences["angle"] == ("90", "45")
    assert differences["colors"] == ("field", "classes")
    assert differences["steps"] == ("6", "4")
    assert differences["Distance, last"] == ("0 m", "0 m")
    assert "seed" not in differences
    (document,) = (
        components for _, _, entity, components in rows(both) if entity == "/differences"
    )
    assert "| angle | 90 | 45 |" in document["TextDocument:text"][0]


def test_reruns_own_check_accepts_it(files):
    subprocess.run([str(binary()), "rrd", "verify", str(files[2])], check=True, capture_output=True)


def test_it_is_one_recording_with_a_layout(files):
    from rerun.chunk import RrdReader

    reader = RrdReader(files[2])
    assert len(reader.recordings()) == len(reader.blueprints()) == 1
    assert len(read_chunks(files[2])) > 0


def test_runs_of_two_lessons_are_refused(files, tmp_path):
    other = record(replace(fake.lesson, name="rigid"), tmp_path / "rigid.rrd")
    with pytest.raises(InputError, match=r"is a run of fake, .* of rigid"):
        compare_bytes(files[0], other)


@pytest.mark.parametrize(
    "odd",
    [
        "3",
        "{}",
        "[" * 9000,
        '{"view": {"x": 1}, "legend_height": 0, "canvases": {}}',
        (
            '{"view": {}, "legend_height": 0, "canvases": {"/charts/a": {"title": 1, "width": "x",'
            ' "height": 0, "first": 0}}}'
        ),
        '{"view": {"x": 1}, "tables": null, "legend_height": 0, "charts": {}, "pictures": {}}',
        '{"view": {}, "tables": "a", "legend_height": 0, "charts": {}, "pictures": {}}',
        (
            '{"view": {}, "tables": null, "legend_height": 0, "pictures": {},'
            ' "charts": {"a": {"title": 1, "width": "x", "height": 0, "first": -5}}}'
        ),
    ],
)
def test_a_layout_that_is_none_is_damage(files, tmp_path, monkeypatch, *, odd):
    monkeypatch.setattr("workbench.recording.write.to_json", lambda *_: odd)
    bad = record(fake.lesson, tmp_path / "bad.rrd", steps=2)
    for pair in ((bad, files[0]), (files[0], bad)):
        with pytest.raises(InputError, match=r"bad\.rrd: is damaged"):
            compare_bytes(*pair)


def test_what_older_versions_said_is_read():
    canvas = {"title": "Basin · m", "width": 300.0, "height": 186.0, "first": 3}
    old = {
        "charts": {"a/b": canvas},
        "pictures": {"photo": canvas},
        "tables": 1,
        "legend_height": 38.0,
        "view": {},
    }
    contents, view = from_json(json.dumps(old), {})
    assert contents.canvases == {
        "/charts/a\\/b": Canvas("Basin · m", 300.0, 186.0, 3),
        "/pictures/photo": Canvas("Basin · m", 300.0, 186.0, 3),
        "/tables": Canvas("Numbers", 0.0, 0.0, 1),
    }
    assert from_json(to_json(contents, view), {}) == (contents, view)
    assert from_json(json.dumps(old | {"tables": None}), {})[
        0
    ].canvases.keys() == contents.canvases.keys() - {"/tables"}
