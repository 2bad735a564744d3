"""Own places and own objects in the coordinates lesson, real scans, and files that must be
refused.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lessons.coordinates.lesson import lesson, run
from lessons.coordinates.state import Params
from workbench.data.files import read_cloud
from workbench.errors import InputError
from workbench.geometry.shapes.curvilinear import spherical_from_cartesian
from workbench.scene import caption_of


def steps(params: Params) -> list[Any]:
    return list(run(params))


def listed(folder: Path, *rows: str) -> Path:
    path = folder / "towns.csv"
    path.write_text("lat,lon,name\n" + "\n".join(rows))
    return path


def test_own_places_take_the_cities_place(tmp_path):
    path = listed(tmp_path, "48.1,11.6,Munich", "50.1,8.7,Frankfurt", "53.6,10.0,Hamburg")
    states = steps(Params(stage="globe", places=path))
    text = caption_of(lesson.draw(states[-2])).text
    assert text.startswith("Munich to Hamburg: 622 km")
    scene = lesson.draw(states[-1])
    assert {"name/0", "name/1", "name/2"} <= set(scene)
    assert caption_of(scene).tone == "good"  # so near to each other means of numbers do


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        (("10,20,a", "-10,-160,b"), "antipodes"),
        (("0,0,a", "0,120,b", "0,240,c"), "cancel"),
        (("10,20,a", "30,40,b", "10,20,a"), "one place"),
        (("0,0,a",), "1 places"),
    ],
)
def test_places_without_way_or_middle_are_refused(tmp_path, rows, words):
    with pytest.raises(InputError, match=words):
        next(run(Params(stage="globe", places=listed(tmp_path, *rows))))


def test_an_own_object_takes_the_houses_place(tmp_path):
    p = np.random.default_rng(0).uniform(-300, 300, (400, 3)) + 5000
    np.save(tmp_path / "box.npy", p)
    states = steps(Params(stage="project", cloud=tmp_path / "box.npy"))
    thing = states[0].subject
    assert thing.name == "box.npy"
    assert np.ptp(thing.p, axis=0).max() == pytest.approx(1.1, abs=0.06)
    assert thing.half_depth == pytest.approx(np.abs(thing.p[:, 1]).max())
    assert {"perspective", "parallel", "rays"} <= set(lesson.draw(states[2]))


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (np.ones((9, 3)), "no depth"),
        (np.eye(3)[[0, 2, 0, 2]], "no depth"),
        (np.ones((1, 3)), "1 point"),
    ],
)
def test_objects_without_depth_are_refused(tmp_path, content, words):
    np.save(tmp_path / "flat.npy", content)
    with pytest.raises(InputError, match=words):
        next(run(Params(stage="project", cloud=tmp_path / "flat.npy")))


def test_a_changed_file_is_read_anew(tmp_path):
    path = tmp_path / "one.npy"
    rng = np.random.default_rng(0)
    np.save(path, rng.normal(size=(50, 3)))
    first = steps(Params(stage="project", cloud=path))[0].subject
    assert steps(Params(stage="project", cloud=path))[0].subject is first
    np.save(path, rng.normal(size=(80, 3)))
    assert len(steps(Params(stage="project", cloud=path))[0].subject.p) > len(first.p)


def test_rays_of_a_real_depth_camera_lie_on_a_grid_of_pixels(shared_data):
    p = read_cloud(shared_data / "ransac" / "capture0001.pcd")
    p = p[np.isfinite(p).all(axis=1)]
    x, y = 526.0 * p[:, 0] / np.abs(p[:, 2]), 526.0 * p[:, 1] / np.abs(p[:, 2])
    for uv in (x, y):
        steps = np.diff(np.unique(uv.round(1)))
        assert 0.5 < np.median(steps[steps > 0.3]) < 1.5
    states = steps_of_real(shared_data / "ransac" / "capture0001.pcd", "y")
    assert states[-1].now.near == pytest.approx(1 / 99)


def test_a_real_vehicle_scan_as_a_range_image_shows_no_rings(shared_data):
    p = read_cloud(shared_data / "icp" / "car_cloud400.csv")
    r, polar, _ = spherical_from_cartesian(p).T
    elevation = np.pi / 2 - polar[r > 0]
    counts = np.sort(np.histogram(elevation, 200)[0])[::-1]
    needed = int(np.searchsorted(np.cumsum(counts), 0.9 * counts.sum())) + 1
    # of 200 bins, for 90 % of the points; a scanner of 64 rings would need some 60
    assert 120 < needed < 180
    assert len(steps_of_real(shared_data / "icp" / "car_cloud400.csv", "z")) == 17


def steps_of_real(path: Path, up: Any) -> list[Any]:
    states = steps(Params(stage="project", cloud=path, up=up))
    assert len(states[0].subject.p) <= 3000
    return states
