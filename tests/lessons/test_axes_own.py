"""Own clouds in the lesson on axes: alone, in pairs, with a pose, real ones, and those that
cannot be used.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lessons.axes.inputs import Input
from lessons.axes.lesson import lesson, run
from lessons.axes.scans import scans_of
from tests.readings import metres
from tests.truths.axes import to_nearest
from workbench.data.files import read_cloud, read_mesh, read_pose
from workbench.data.shapes.rabbit import rabbit
from workbench.errors import InputError
from workbench.geometry.motions import exp_so3, motion
from workbench.run.timeline import Timeline

R = exp_so3(np.array([0.4, -0.9, 0.6]))


def steps(params: Input) -> list[Any]:
    return list(run(params, scans_of(params)))


def text_of(params: Input, k: int) -> str:
    return Timeline(lesson, params).complete()[k].caption.text


def saved(folder: Path, **clouds: np.ndarray) -> dict[str, Any]:
    for name, p in clouds.items():
        np.save(folder / f"{name}.npy", p)
    return {name: folder / f"{name}.npy" for name in clouds}


@pytest.fixture(scope="module")
def shape() -> np.ndarray:
    return rabbit(900, np.random.default_rng(4))


@pytest.mark.parametrize("place", [0.0, 5e5])
def test_one_cloud_takes_the_place_of_the_rabbit_in_any_unit_and_place(tmp_path, shape, place):
    params = Input(**saved(tmp_path, source=1000.0 * shape + place))
    states = steps(params)
    p = scans_of(params).p_target
    assert np.ptp(p, axis=0).max() == pytest.approx(1.0, abs=0.15)
    assert np.abs(p.max(axis=0) + p.min(axis=0)).max() < 0.2
    assert states[-2].outcome.home
    assert states[-1].turns.home.all()
    assert "source.npy" in text_of(params, 0)
    assert {"shape", "side"} <= set(Timeline(lesson, params).complete().idle())


@pytest.mark.parametrize(("up", "axis"), [("z", 2), ("y", 1), ("x", 0)])
def test_it_stands_upright(tmp_path, shape, up, *, axis):
    p = scans_of(Input(**saved(tmp_path, source=shape), up=up)).p_target
    heights = shape[:, axis] - shape[:, axis].mean()
    np.testing.assert_allclose(np.corrcoef(p[:, 2], heights)[0, 1], 1.0)


def test_what_goes_wrong_goes_wrong_with_an_own_cloud_too(tmp_path, shape):
    params = Input(**saved(tmp_path, source=shape), density=3, seen=0.7, noise=0.01, fresh=True)
    states = steps(params)
    assert states[-2].outcome.rotation > 5
    assert np.isfinite(states[-2].outcome.gap)


def test_two_clouds_go_by_axes_and_nobody_knows_the_truth(tmp_path, shape):
    T = motion(R, np.array([0.2, 3.0, -1.0]))
    files = saved(tmp_path, target=shape @ R.T + T[:3, 3], source=shape[:700])
    params = Input(**files)
    states = steps(params)
    text = text_of(params, -1)
    assert states[-1].moment == "pose"
    assert "Nobody knows the truth" in text
    distance = metres(text.split("Frame on frame: ")[1].split(" (RMS)")[0])
    assert distance == pytest.approx(to_nearest(scans_of(params), states[-1]), rel=0.01)
    assert {"turn", "noise", "shape"} <= set(Timeline(lesson, params).complete().idle())


@pytest.mark.parametrize("up", ["z", "y"])
def test_a_known_pose_is_the_truth(tmp_path, shape, up):
    T = motion(R, np.array([0.2, 3.0, -1.0]))
    np.savetxt(tmp_path / "pose.txt", T)
    files = saved(tmp_path, target=shape @ R.T + T[:3, 3], source=shape)
    states = steps(Input(**files, truth=tmp_path / "pose.txt", up=up))
    assert states[-2].moment == "pose"
    assert states[-2].outcome.rotation < 1e-3


def test_what_cannot_be_used_is_refused_in_one_line(tmp_path, shape):
    files = saved(tmp_path, target=shape, source=shape[:30], one=np.ones((5, 3)), few=shape[:3])
    for params, words in (
        (Input(target=files["target"]), "give “source” too"),
        (Input(truth=tmp_path / "pose.txt"), "give “source” too"),
        (Input(source=files["source"], truth=files["few"]), "give “target” too"),
        (Input(source=tmp_path / "none.ply"), "no such file"),
        (Input(source=files["one"]), "at one place"),
        (Input(source=files["few"]), "3 points; at least 4"),
    ):
        with pytest.raises(InputError, match=words):
            scans_of(params)


def test_a_file_that_changed_is_read_anew(tmp_path, shape):
    params = Input(**saved(tmp_path, source=shape))
    first = scans_of(params).p_target
    assert scans_of(params).p_target is first
    saved(tmp_path, source=shape[:500])
    assert len(scans_of(params).p_target) == 500


def test_real_scans_by_axes_are_not_where_they_belong(shared_data):
    folder = shared_data / "icp"
    files: dict[str, Any] = {"source": folder / "bun045.ply", "target": folder / "bun000.ply"}
    states = steps(Input(**files, truth=folder / "bun.conf", up="y", points=5000))
    state = next(state for state in states if state.moment == "pose")
    assert state.outcome.rotation > 5  # each saw another part
    T = read_pose(folder / "bun.conf", files["target"], files["source"])
    scale = 1 / np.ptp(read_cloud(files["target"]), axis=0).max()
    shift = float(np.linalg.norm(T[:3, 3])) * scale
    assert 0.1 < shift < 1  # the pose is one of the scans as they are in their files
    assert state.outcome.gap < 0.1


@pytest.mark.parametrize(
    "name", ["shapes/teapot_npm.ply", "shapes/dragon_vrip_res4.ply.gz", "curvature/fertility.off"]
)
def test_real_shapes_keep_their_frame_under_a_turn(shared_data, tmp_path, name):
    path = shared_data / name
    p = read_mesh(path)[0]
    states = steps(Input(**saved(tmp_path, source=p), points=3000, up="y"))
    assert states[-2].outcome.rotation < 1e-3
    signs = steps(Input(**saved(tmp_path, source=p), points=3000, up="y", signs="largest-entry"))[
        -1
    ].turns
    assert signs.home.mean() < 0.5
