"""Own corners in the calibration lesson: two real cameras, a picture, units, and what is refused."""

from pathlib import Path

import numpy as np
import pytest

from lessons.calibration.lesson import lesson, run
from lessons.calibration.state import Params, State
from workbench.data.boards import board_points
from workbench.errors import InputError
from workbench.scene import Camera, Picture, Segments, Table, caption_of


@pytest.fixture(scope="module")
def corners(shared_data: Path) -> Path:
    return shared_data / "calibration" / "corners_9x6.npz"


def end(params: Params) -> State:
    *_, last = run(params)
    return last


def test_the_left_camera(corners, shared_data):
    states = list(run(Params(corners=corners, lens="k1 k2 p1 p2 k3", image=shared_data / "calibration" / "left01.jpg")))
    last = states[-1]
    assert last.rms == pytest.approx(0.40877, abs=1e-4)
    assert last.now.K is not None
    assert last.now.K[0, 0] == pytest.approx(536.07, abs=0.02)
    assert last.subject.size == (640, 480)
    views = next(state for state in states if state.ending is not None)
    assert views.ending is not None
    assert views.ending.worst == 1
    assert "69 % of the sum of squares" in caption_of(lesson.draw(views)).text
    scene = lesson.draw(last)
    caption, picture = caption_of(scene), scene["picture"]
    assert caption.tone == "info"
    assert "Nobody knows the truth" in caption.text
    assert "map" not in scene
    assert "f/truth" not in scene
    assert isinstance(picture, Picture)
    assert picture.size == (640, 480)
    assert picture.rgb().std() > 20
    other = lesson.draw(views)["picture"]  # of view 1 there is no picture
    assert isinstance(other, Picture)
    assert other.rgb().std() == 0


def test_without_its_bad_view_and_with_cauchys_loss(corners):
    best = end(Params(corners=corners, leave_out=1, lens="k1 k2 p1 p2 k3"))
    robust = end(Params(corners=corners, loss="Cauchy"))
    assert best.rms == pytest.approx(0.234, abs=0.001)
    for state, f in ((best, 534.1), (robust, 533.8)):
        assert state.now.K is not None
        assert state.now.K[0, 0] == pytest.approx(f, abs=0.3)


def test_the_right_camera_and_a_board_in_millimetres(corners, tmp_path):
    last = end(Params(corners=corners, camera="second", lens="k1 k2 p1 p2 k3"))
    assert last.rms == pytest.approx(0.4587, abs=1e-4)
    arrays = np.load(corners)
    np.savez(tmp_path / "mm.npz", object_points=1000 * arrays["object_points"], corners=arrays["right"])
    other = end(Params(corners=tmp_path / "mm.npz", unit="mm", lens="k1 k2 p1 p2 k3"))
    assert other.now.K is not None
    assert last.now.K is not None
    np.testing.assert_allclose(other.now.K, last.now.K, atol=1e-3)
    np.testing.assert_allclose(other.now.Ts_camera_board, last.now.Ts_camera_board, atol=1e-5)
    wrong = lesson.draw(end(Params(corners=tmp_path / "mm.npz", lens="k1 k2 p1 p2 k3")))  # metres that are millimetres
    right = lesson.draw(last)
    for path in ("boards/0", "camera"):
        assert isinstance(wrong[path], Segments | Camera)
        np.testing.assert_allclose(wrong[path].T_world_object, right[path].T_world_object, atol=1e-5)  # type: ignore[union-attr]


def test_another_board_shape_and_a_table_without_truth(tmp_path):
    p = board_points(5, 4, 0.1)
    rng = np.random.default_rng(0)
    uv = []
    for x, y in ((0.3, 0.0), (-0.2, 0.3), (0.1, -0.4), (-0.3, -0.2)):
        c = p @ np.array([[1, 0, -x], [0, 1, -y], [x, y, 1]]) + [-0.2, -0.15, 1.2]  # nearly turns
        uv.append(600 * c[:, :2] / c[:, 2:] + [320, 240] + 0.1 * rng.normal(size=(20, 2)))
    np.savez(tmp_path / "c.npz", board=p, uv=np.array(uv), size=[640, 480])
    scene = lesson.draw(end(Params(corners=tmp_path / "c.npz", lens="none")))
    table = scene["camera in numbers"]
    assert isinstance(table, Table)
    assert table.header == ("", "found", "±")


def test_what_is_refused(corners, tmp_path, shared_data):
    np.savez(tmp_path / "one.npz", board=board_points(), uv=np.load(corners)["left"][:1])
    np.savez(tmp_path / "none.npz", nothing=np.zeros(3))
    (tmp_path / "empty.csv").write_text("")
    for path, said in (
        (tmp_path / "one.npz", "1 views"),
        (tmp_path / "none.npz", "no arrays"),
        (tmp_path / "empty.csv", "no lines"),
        (shared_data / "calibration" / "left01.jpg", "text files"),
        (tmp_path, "folder"),
    ):
        with pytest.raises(InputError, match=said):
            list(run(Params(corners=path)))
