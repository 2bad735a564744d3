"""The small files for trying own data do what they are there for."""

from pathlib import Path

import numpy as np
import pytest

from workbench.lesson import catalog
from workbench.run.timeline import Timeline

DATA = Path(__file__).resolve().parents[1] / "assets" / "data"


def run(name: str, **values) -> Timeline:
    lesson = catalog()[name]
    files = {
        key: DATA / value if isinstance(value, str) and "." in value else value
        for key, value in values.items()
    }
    timeline = Timeline(lesson, lesson.params(**files)).complete()
    assert timeline.stopped is None
    return timeline


def last(timeline: Timeline, path: str) -> float:
    values = timeline.series()[path].values
    return float(values[np.isfinite(values)][-1])


def test_the_two_scans_come_together():
    scans = run(
        "icp",
        target="rabbit_target.ply",
        source="rabbit_source.ply",
        truth="rabbit_pose.txt",
        keep=0.7,
    )
    assert last(scans, "rotation error") < 1.0


def test_the_cloud_has_a_floor():
    timeline = run("ransac", cloud="floor_and_clutter.ply")
    fit = timeline[-1].state.best.estimate
    assert abs(fit[2]) == pytest.approx(1.0, abs=1e-3)
    assert fit[3] == pytest.approx(0.0, abs=0.01)


def test_the_mesh_is_a_torus():
    assert "add up to 0 π" in run("curvature", mesh="torus.ply")[-1].caption.text


def test_the_pair_of_pictures_has_depth():
    timeline = run(
        "disparity",
        left="left.png",
        right="right.png",
        own_baseline=0.1,
        own_focal_length=150.0,
        shrink=1,
    )
    known = timeline[-1].state.depth[np.isfinite(timeline[-1].state.depth)]
    assert 0.5 < np.median(known) < 5
