"""Own points and photographs in the fitting lesson, a real scan, and files that must be refused."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lessons.fitting.fit_scenes import arc_points, cap_points, pipe_points
from lessons.fitting.lesson import lesson, run
from lessons.fitting.state import Params
from workbench.algorithms.least_squares import Walked
from workbench.data.files import read_cloud
from workbench.errors import InputError
from workbench.geometry.shapes.lines_planes import angle_between_planes, fit_hyperplane
from workbench.scene import caption_of


def steps(params: Params) -> list[Any]:
    return list(run(params))


def written(folder: Path, p: np.ndarray, name: str = "points.csv") -> Path:
    path = folder / name
    np.savetxt(path, p, delimiter=",")
    return path


def test_an_own_rim_keeps_its_unit(tmp_path):
    rng = np.random.default_rng(0)
    p = 300 + 12.0 * arc_points(np.radians(120), 80) + 0.1 * rng.normal(size=(80, 2))
    states = steps(Params(cloud=written(tmp_path, p), cloud_unit="mm"))
    ended = [state for state in states if isinstance(state.now, Walked)][-1]
    assert ended.now.now.unknown[2] * ended.subject.scale == pytest.approx(0.012, rel=0.02)
    text = caption_of(lesson.draw(ended)).text
    assert "R = 1" in text
    assert " mm" in text
    assert "drawn anew from the points" in caption_of(lesson.draw(states[-1])).text
    assert caption_of(lesson.draw(states[-1])).tone == "good"


@pytest.mark.parametrize(("shape", "places"), [("sphere", cap_points), ("cylinder", pipe_points)])
def test_own_points_in_space(tmp_path, shape, places):
    p = 5 + 2 * places(np.radians(200), 200) + 0.01 * np.random.default_rng(0).normal(size=(200, 3))
    states = steps(
        Params(shape=shape, cloud=written(tmp_path, p), start=(0.2, 0.1, 0.0), start_tilt=20.0)
    )
    ended = [state for state in states if isinstance(state.now, Walked)][-1]
    assert ended.now.now.unknown[-1] * ended.subject.scale == pytest.approx(2.0, rel=0.02)


def test_rivals_and_starts_take_own_points_too(tmp_path):
    path = written(
        tmp_path,
        arc_points(2.0, 40) + 0.01 * np.random.default_rng(0).normal(size=(40, 2)),
        "rim.txt",
    )
    assert len(steps(Params(stage="algebraic", cloud=path))) == 5
    assert steps(Params(stage="basin", cloud=path))[-1].now.now.done.any()


@pytest.mark.parametrize(
    ("text", "more", "words"),
    [
        ("", {}, "empty"),
        ("1,2\n", {}, "at least 6 lines"),
        ("x,y\n" + "1,2\n" * 9, {}, "one place"),
        ("".join(f"{k},{2 * k}\n" for k in range(9)), {}, "on a line"),
        ("1,2\n3,4\n5,six\n7,8\n9,1\n2,2\n", {}, "two numbers"),
        ("1,2\n3,nan\n5,6\n7,8\n9,1\n2,2\n", {}, "finite"),
        (
            "".join(f"{k},{k * k},{k % 3}\n" for k in range(9)),
            {},
            "3 columns, and a circle needs 2",
        ),
        (
            "".join(f"{k},{k * k}\n" for k in range(9)),
            {"stage": "robust"},
            "2 columns, and a plane needs 3",
        ),
        ("".join(f"{k},{k * k}\n" for k in range(9)), {"stage": "line"}, "not used"),
        ("".join(f"{k},{k * k},0\n" for k in range(9)), {"shape": "sphere"}, "on a plane"),
    ],
)
def test_what_cannot_be_used_is_refused(tmp_path, text, more, *, words):
    path = tmp_path / "points.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=words):
        steps(Params(cloud=path, **more))


def test_own_photographs(tmp_path):
    from PIL import Image

    v, u = np.mgrid[:90, :120]
    disc = np.where(np.hypot(u - 52, v - 41) < 20, 200, 30).astype(np.uint8)
    Image.fromarray(disc).save(tmp_path / "disc.png")
    end = steps(Params(stage="coin", arc=90.0, image=tmp_path / "disc.png", coin=(50, 40)))[-1]
    assert (*end.subject.rim.center, end.subject.rim.radius) == pytest.approx((52, 41, 20), abs=0.5)
    Image.fromarray(np.zeros((1000, 1000), np.uint8)).save(tmp_path / "large.png")
    with pytest.raises(InputError, match="make it smaller"):
        steps(Params(stage="coin", image=tmp_path / "large.png"))


def test_a_kinect_plane_has_errors_that_are_alike(shared_data):
    """Halves of a plane differ by many times what independent errors allow; cells of 10 cm are off
    together.
    """
    p = read_cloud(shared_data / "ransac" / "capture0001.pcd")
    rng = np.random.default_rng(0)
    some = p[rng.choice(len(p), 4000, replace=False)]
    best = np.zeros(4)
    votes = 0
    for _ in range(300):
        a, b, c = some[rng.choice(len(some), 3, replace=False)]
        normal = np.cross(b - a, c - a)
        if np.linalg.norm(normal) > 1e-6:
            normal /= np.linalg.norm(normal)
            count = int((np.abs((some - a) @ normal) < 0.015).sum())
            if count > votes:
                best = np.append(normal, -normal @ a)
                votes = count
    for _ in range(4):
        best = fit_hyperplane(p[np.abs(p @ best[:3] + best[3]) < 0.02])
    q = p[np.abs(p @ best[:3] + best[3]) < 0.02]
    axes = np.linalg.eigh(np.cov(q.T))[1]
    sigma = float(np.sqrt(np.mean((q @ best[:3] + best[3]) ** 2)))
    for axis in (1, 2):
        along = q @ axes[:, axis]
        half = along < np.median(along)
        promised = max(
            np.degrees(sigma / np.sqrt(h.sum() * np.linalg.eigvalsh(np.cov(q[h].T))[1]))
            for h in (half, ~half)
        )
        off = np.degrees(angle_between_planes(fit_hyperplane(q[half]), fit_hyperplane(q[~half])))
        assert off > 8 * promised


def test_a_kinect_scan_in_the_lesson(shared_data):
    path = shared_data / "ransac" / "capture0001.pcd"
    states = steps(Params(stage="robust", loss="Huber then Tukey", cloud=path, noise=0.01))
    assert states[-1].now.last
    assert np.isnan(states[-1].plane_errors[0])
    assert caption_of(lesson.draw(states[-1])).tone == "info"
