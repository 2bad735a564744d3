"""Own clouds and matches in the RANSAC lesson: how they are read, what does not fit, and what is
said of it.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lessons.ransac.inputs import Input
from lessons.ransac.lesson import lesson
from lessons.ransac.rows import rows_of
from tests.lessons.ransac_runs import best, end, ends_right, members, part, states_of, truth_of
from workbench.algorithms.robust.models import MODELS
from workbench.errors import InputError
from workbench.knobs import with_own_files
from workbench.run.timeline import Timeline
from workbench.scene import Caption, Points


def test_an_own_cloud_and_what_does_not_fit_it(tmp_path):
    p = rows_of(Input(outliers=0.3)).p * 10 + 500
    np.savetxt(tmp_path / "cloud.csv", p, delimiter=",")
    params = Input(cloud=tmp_path / "cloud.csv", inlier_distance=0.3)
    timeline = Timeline(lesson, params).complete()
    assert timeline.stopped is None, timeline.failure
    last = end(timeline.states())
    assert best(last).count == pytest.approx(410, abs=20)
    assert np.isnan(timeline.states().subject.error(best(last).estimate))
    shown = part(timeline[-1].scene, "points", Points)
    assert np.abs(shown.p).max() < 2.5
    for other, message in (("line", "plane or sphere"), ("homography", "plane or sphere")):
        assert message in str(Timeline(lesson, replace(params, model=other)).complete().stopped)
    assert "does not say whom to trust" in str(
        Timeline(lesson, replace(params, sampler="PROSAC")).complete().stopped
    )
    assert "no such file" in str(
        Timeline(lesson, replace(params, cloud=tmp_path / "none.csv")).complete().stopped
    )


def captions_of(params) -> list[Caption]:
    timeline = Timeline(lesson, params).complete()
    assert timeline.stopped is None, timeline.failure
    return [step.caption for step in timeline.known()]


def test_what_says_how_to_read_an_own_cloud_is_kept_with_it():
    mine = Input(cloud=Path("mine.ply"), cloud_unit="mm", up="-y", outliers=0.9)
    kept = with_own_files(Input(), mine)
    assert kept == replace(Input(), cloud=Path("mine.ply"), cloud_unit="mm", up="-y")


def test_an_own_cloud_in_another_unit_is_noticed_and_converted(tmp_path):
    p = rows_of(Input(outliers=0.3)).p
    np.savetxt(tmp_path / "m.csv", p, delimiter=",")
    np.savetxt(tmp_path / "mm.csv", 1000.0 * p, delimiter=",")
    in_metres, as_metres = (
        Input(cloud=tmp_path / name, steps="improvements") for name in ("m.csv", "mm.csv")
    )
    right, wrong = captions_of(in_metres), captions_of(as_metres)
    assert not [caption for caption in right if "Mind" in caption.text]
    for caption in (wrong[0], wrong[-1]):
        assert (
            "so few of them can be expected within 30 mm of any plane. Is the cloud in m"
            " (cloud_unit)?" in caption.text
        )
    converted = captions_of(replace(as_metres, cloud_unit="mm"))
    assert [caption.text for caption in converted] == [caption.text for caption in right]
    np.savetxt(tmp_path / "km.csv", 1e-3 * p, delimiter=",")
    assert (
        "so nearly all of them"
        in captions_of(replace(in_metres, cloud=tmp_path / "km.csv"))[-1].text
    )


@pytest.mark.parametrize("rows", ["one place", "one line"])
@pytest.mark.parametrize("model", ["plane", "sphere", "homography", "fundamental matrix"])
def test_own_rows_that_determine_nothing_are_told_so(tmp_path, model, rows):
    columns = MODELS[model].columns
    p = (
        np.ones((20, columns))
        if rows == "one place"
        else np.outer(np.linspace(0.0, 50.0, 20), np.arange(1.0, columns + 1))
    )
    np.savetxt(tmp_path / "rows.csv", p, delimiter=",")
    own = {"cloud" if columns == 3 else "matches": tmp_path / "rows.csv"}
    last = captions_of(Input(model=model, most_samples=20, steps="improvements", **own))[-1]
    assert last.tone == "wrong"
    assert f"Every sample was degenerate ({MODELS[model].degenerate_when}): such" in last.text
    assert f"determine no {model}." in last.text


def test_matches_that_are_no_pixels_are_noticed(tmp_path):
    p = rows_of(Input(model="homography", outliers=0.2)).p
    np.savetxt(tmp_path / "normalised.csv", p / 640.0, delimiter=",")
    last = captions_of(
        Input(model="homography", matches=tmp_path / "normalised.csv", steps="improvements")
    )[-1]
    assert "Are the matches in pixels?" in last.text
    with pytest.raises(InputError, match="a folder, not a file"):
        rows_of(Input(model="homography", matches=tmp_path))


def test_own_matches_with_their_truth(tmp_path):
    subject = rows_of(Input(model="fundamental matrix", outliers=0.2, points=150))
    np.savez(
        tmp_path / "m.npz",
        x1=subject.p[:, :2],
        x2=subject.p[:, 2:],
        F=truth_of(subject),
        quality=np.asarray(subject.quality),
    )
    params = Input(
        model="fundamental matrix",
        matches=tmp_path / "m.npz",
        sampler="PROSAC",
        steps="improvements",
    )
    assert ends_right(states_of(params))
    assert "homography or fundamental" in str(
        Timeline(lesson, replace(params, model="plane")).complete().stopped
    )
    np.savetxt(tmp_path / "few.csv", subject.p[:5], delimiter=",")
    few = Timeline(lesson, replace(params, matches=tmp_path / "few.csv")).complete()
    assert "5 matches; at least 7" in str(few.stopped)


def test_the_real_photographs_and_the_real_room(shared_data):
    folder = shared_data / "ransac"
    pair = Input(
        model="fundamental matrix",
        matches=folder / "fountain-P11" / "gt_and_matches.npz",
        inlier_pixels=1.0,
        first_image=folder / "fountain-P11" / "0004_third.jpg",
        second_image=folder / "fountain-P11" / "0005_third.jpg",
        steps="improvements",
    )
    states = states_of(pair)
    assert best(end(states)).inliers[members(states.subject)].mean() >= 0.95
    room = Input(
        cloud=folder / "capture0001.pcd", up="-y", inlier_distance=0.02, steps="improvements"
    )
    states = states_of(room)
    assert best(end(states)).count / len(states.subject.p) == pytest.approx(0.27, abs=0.03)
