"""Recording many runs in one process leaves no threads behind, and small files."""

import os
import subprocess
import sys
from dataclasses import replace
from itertools import islice
from pathlib import Path

import pytest
from rerun.chunk import RrdReader

from tests import fake
from workbench.lesson import catalog
from workbench.recording.canonical import id_in
from workbench.recording.read import read_chunks
from workbench.recording.streams import application_id
from workbench.recording.write import record_bytes
from workbench.run.timeline import Timeline

ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.skipif(sys.platform != "linux", reason="counts threads in /proc")
def test_recording_again_and_again_leaves_no_threads():
    timeline = Timeline(fake.lesson, fake.Params(steps=2)).complete()
    counts = []
    for _ in range(6):
        record_bytes(timeline)
        counts.append(len(os.listdir("/proc/self/task")))
    assert counts[-1] <= counts[1]


def test_the_application_id_has_the_characters_that_every_viewer_takes():
    assert application_id("icp") != application_id("ransac")
    assert application_id("Chamfer_EMD") == "workbench-chamfer-emd"


def test_runs_share_an_application_where_they_share_a_layout_and_nowhere_else(tmp_path):
    """A viewer keeps one layout for each application: the second recording would be shown in that
    of the first.
    """

    def application(name: str, **params) -> str:
        path = tmp_path / f"{name}.rrd"
        path.write_bytes(record_bytes(Timeline(fake.lesson, fake.Params(**params)).complete()))
        own, layout = RrdReader(path).recordings()[0], RrdReader(path).blueprints()[0]
        assert own.application_id == layout.application_id
        return own.application_id

    assert application("one") == application("again") != application("longer", steps=3)


def test_a_rigid_run_of_20k_points_and_50_steps_stays_below_a_megabyte():
    icp = catalog()["icp"]
    long = Timeline(
        replace(icp, run=lambda params, subject: islice(icp.run(params, subject), 50)),
        icp.params(points=20_000),
    ).complete()
    assert len(long) == 50
    assert len(record_bytes(long)) < 1_000_000


def test_progress_is_told_step_by_step():
    told = []
    record_bytes(
        Timeline(fake.lesson, fake.Params()).complete(), progress=lambda *words: told.append(words)
    )
    assert told == [("recorded", k, 6) for k in range(1, 7)]


def test_equal_runs_have_equal_content_under_one_id_and_others_another(tmp_path):
    """Across processes too: there, whatever hangs on the time or on a random seed differs."""
    code = (
        "import sys; from pathlib import Path; from tests import fake; from workbench.run.timeline"
        " import Timeline;from workbench.recording import record_bytes; run = Timeline(fake.lesson,"
        " fake.Params(steps=3)).complete();Path(sys.argv[1]).write_bytes(record_bytes(run))"
    )
    here, elsewhere, other = tmp_path / "here.rrd", tmp_path / "there.rrd", tmp_path / "other.rrd"
    subprocess.run([sys.executable, "-c", code, str(elsewhere)], cwd=ROOT, check=True)
    here.write_bytes(record_bytes(Timeline(fake.lesson, fake.Params(steps=3)).complete()))
    other.write_bytes(
        record_bytes(Timeline(fake.lesson, fake.Params(steps=3, angle=91.0)).complete())
    )
    assert id_in(here.read_bytes()) == id_in(elsewhere.read_bytes()) != id_in(other.read_bytes())
    chunks = [
        {chunk.id: repr(chunk.to_record_batch().to_pydict()) for chunk in read_chunks(path)}
        for path in (here, elsewhere)
    ]
    assert chunks[0] == chunks[1]
    for chunk in read_chunks(here):  # rerun looks for a step by halving
        columns = chunk.to_record_batch().to_pydict()
        assert sorted(columns["rerun.controls.RowId"]) == columns["rerun.controls.RowId"]
        assert sorted(columns.get("step", ())) == list(columns.get("step", ()))
    assert len({chunk.entity_path + str(chunk.is_static) for chunk in read_chunks(here)}) == len(
        chunks[0]
    )
