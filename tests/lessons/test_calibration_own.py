"""Own corners in the calibration lesson: two real cameras, a picture, units, and what is
refused.
"""

import shutil
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from scipy import ndimage

from lessons.calibration.lesson import draw, lesson, run
from lessons.calibration.state import Params, State
from workbench import open_recording, record
from workbench.certain import as_a, sure
from workbench.data.views.boards import board_points
from workbench.errors import InputError
from workbench.run.timeline import Timeline
from workbench.scene import Camera, Picture, Segments, Table, caption_of


@pytest.fixture(scope="module")
def corners(shared_data: Path) -> Path:
    return shared_data / "calibration" / "corners_9x6.npz"


def end(params: Params) -> State:
    *_, last = run(params)
    return last


def test_the_left_camera(corners, shared_data):
    states = list(
        run(
            Params(
                corners=corners,
                lens="k1 k2 p1 p2 k3",
                images=shared_data / "calibration" / "left01.jpg",
            )
        )
    )
    last = states[-1]
    assert last.rms == pytest.approx(0.40877, abs=1e-4)
    assert last.now.K is not None
    assert last.now.K[0, 0] == pytest.approx(536.07, abs=0.02)
    assert last.subject.size == (640, 480)
    views = next(state for state in states if state.ending is not None)
    assert views.ending is not None
    assert views.ending.worst == 1
    assert "69 % of the sum of squares" in caption_of(draw(views)).text
    scene = draw(last)
    caption = caption_of(scene)
    picture = scene["picture"]
    assert caption.tone == "info"
    assert "Nobody knows the truth" in caption.text
    assert "map" not in scene
    assert "f/truth" not in scene
    assert isinstance(picture, Picture)
    assert picture.size == (640, 480)
    assert picture.rgb().std() > 20
    other = draw(views)["picture"]  # of view 1 there is no picture
    assert isinstance(other, Picture)
    assert other.rgb().std() == 0


def test_pictures_lie_below_the_corners_of_their_views(corners, tmp_path):
    """A corner of the board is a saddle: its four neighbours along the diagonals are two dark and
    two bright.
    """
    folder = corners.parent
    shutil.make_archive(str(tmp_path / "all"), "zip", folder)
    for images in (folder, tmp_path / "all.zip"):
        states = list(run(Params(corners=corners, images=images)))
        for state, name in (
            (states[0], "left01.jpg"),
            (states[13], "left14.jpg"),
            (states[-3], "left02.jpg"),
        ):
            picture = draw(state)["picture"]
            assert isinstance(picture, Picture)
            assert picture.title == f"View {state.shown}, {name}"
            assert picture.size == (640, 480)
            level = ndimage.gaussian_filter(picture.rgb()[..., 0].astype(float), 1.0)
            u, v = state.subject.uv[state.shown].T
            ring = [
                ndimage.map_coordinates(level, [v + 4 * np.sin(a), u + 4 * np.cos(a)])
                for a in np.arange(32) * np.pi / 16
            ]
            signs = np.sign(ring - np.mean(ring, axis=0))
            assert ((signs != np.roll(signs, 1, axis=0)).sum(axis=0) == 4).mean() > 0.9


def test_corners_without_a_number_leave_the_same_camera(corners, tmp_path):
    """View 3 is lost whole and three corners elsewhere: f is within its own ±, views keep their
    numbers and pictures.
    """
    with np.load(corners) as arrays:
        given = {name: arrays[name] for name in arrays.files}
    whole = end(Params(corners=corners))
    assert whole.now.K is not None
    assert whole.now.adjustment is not None
    given["left"] = given["left"].astype(float)
    given["left"][3] = np.nan
    for view, point in ((0, 10), (5, 10), (7, 31)):
        given["left"][view, point] = np.nan
    np.savez(tmp_path / "gaps.npz", **given)
    params = Params(corners=tmp_path / "gaps.npz", images=corners.parent)
    timeline = Timeline(lesson, params).complete()
    assert timeline.stopped is None
    assert "57 of 702 corners left out" in timeline[0].caption.text
    assert "view 3 and 2 points of the board in all views" in timeline[0].caption.text
    last = timeline[-1].state
    assert 3 not in last.subject.views
    assert len(last.subject.views) == len(whole.subject.views) - 1
    assert abs(last.now.K[0, 0] - whole.now.K[0, 0]) < 2 * whole.now.adjustment.deviations[0]
    fifth = next(
        step.state for step in timeline.known() if step.state.subject.views[step.state.shown] == 5
    )
    picture = draw(fifth)["picture"]
    assert isinstance(picture, Picture)
    assert picture.title == "View 5, left06.jpg"


def test_pictures_alone(corners, tmp_path):
    for path in corners.parent.glob("left*.jpg"):
        shutil.copyfile(path, tmp_path / path.name)
    for k, level in enumerate((40, 200, 90, 10)):
        Image.new("L", (640, 480), level).save(tmp_path / f"a{k}.png")
    states = list(run(Params(images=tmp_path, lens="k1 k2 p1 p2 k3")))
    assert (
        "No whole board was found in 4 pictures: a0.png, a1.png, a2.png …."
        in caption_of(draw(states[0])).text
    )
    last = states[-1]
    assert len(last.subject.views) == 13
    assert last.rms == pytest.approx(0.179, abs=0.001)
    assert last.now.K is not None
    assert last.now.K[0, 0] == pytest.approx(533.1, abs=0.1)
    picture = draw(last)["picture"]
    assert isinstance(picture, Picture)
    assert picture.title == "View 0, left01.jpg"
    turned = end(Params(images=tmp_path, board=(6, 9), lens="k1 k2 p1 p2 k3"))
    assert turned.rms == pytest.approx(last.rms, abs=1e-3)
    few = tmp_path / "few"
    few.mkdir()
    for name in ("left01.jpg", "left03.jpg"):
        shutil.copyfile(tmp_path / name, few / name)
    with pytest.raises(
        InputError, match="few: a whole board of 8 x 6 inner corners in 0 of 2 pictures"
    ):
        next(run(Params(images=few, board=(8, 6))))
    with pytest.raises(InputError, match="in 1 of 1 pictures"):
        next(run(Params(images=tmp_path / "left01.jpg")))
    for k in range(30):
        Image.new("L", (640, 480), k).save(tmp_path / f"b{k}.png")
    with pytest.raises(InputError, match="47 pictures; up to 40"):
        next(run(Params(images=tmp_path)))


def test_pictures_are_recorded(corners, tmp_path):
    path = tmp_path / "own.rrd"
    record(lesson, path, params=Params(corners=corners, images=corners.parent, leave_out=1))
    assert len(open_recording(path).captions) == 23
    assert path.stat().st_size > 12 * 50_000  # 12 pictures; empty ones take nothing


def test_pictures_without_names_shrunk_and_one_missing(corners, tmp_path):
    arrays = np.load(corners)
    small = tmp_path / "small"
    small.mkdir()
    for k, path in enumerate(sorted(corners.parent.glob("left*.jpg"))):
        Image.open(path).resize((320, 240)).save(small / f"p{k}.png")
    board, uv = arrays["object_points"], arrays["left"]
    np.savez(tmp_path / "sized.npz", board=board, uv=uv, size=[640, 480])
    np.savez(tmp_path / "plain.npz", board=board, uv=uv)
    np.savez(
        tmp_path / "named.npz",
        board=board,
        uv=uv,
        names=[f"p{k}" for k in range(13)],
        size=[640, 480],
    )
    state = next(run(Params(corners=tmp_path / "sized.npz", images=small)))
    assert state.subject.size == (640, 480)
    picture = draw(state)["picture"]
    assert isinstance(picture, Picture)
    assert (picture.title, picture.size) == ("View 0, p0.png", (320, 240))
    with pytest.raises(
        InputError, match="small: pictures of 320 x 240 pixels, and corners as far as"
    ):
        next(run(Params(corners=tmp_path / "plain.npz", images=small)))
    (small / "p0.png").unlink()
    with pytest.raises(InputError, match="small: 12 pictures for 13 views"):
        next(run(Params(corners=tmp_path / "sized.npz", images=small)))
    picture = draw(next(run(Params(corners=tmp_path / "named.npz", images=small))))["picture"]
    assert isinstance(picture, Picture)
    assert picture.title == "View 0, no picture"
    Image.new("L", (320, 320)).save(small / "p4.png")
    with pytest.raises(InputError, match=r"p4.png has 320 x 320 pixels, p1.png 320 x 240"):
        next(run(Params(corners=tmp_path / "named.npz", images=small)))
    for path in small.iterdir():
        Image.new("L", (320, 320)).save(path)
    with pytest.raises(
        InputError, match="small: pictures of 320 x 320 pixels, and corners of 640 x 480"
    ):
        next(run(Params(corners=tmp_path / "named.npz", images=small)))
    (small / "p4.png").write_text("no picture")
    with pytest.raises(InputError, match=r"p4.png: not readable"):
        next(run(Params(corners=tmp_path / "named.npz", images=small)))


def test_a_picture_that_breaks_off_ends_the_run_where_it_is_shown(corners, tmp_path):
    for path in corners.parent.glob("left*.jpg"):
        shutil.copyfile(path, tmp_path / path.name)
    whole = (tmp_path / "left05.jpg").read_bytes()
    (tmp_path / "left05.jpg").write_bytes(whole[: len(whole) // 2])
    timeline = Timeline(lesson, Params(corners=corners, images=tmp_path))
    timeline.complete()
    assert len(timeline) == 5
    assert timeline.stopped is not None
    assert timeline.stopped.startswith("left05.jpg: not readable as an image")


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
    np.savez(
        tmp_path / "mm.npz", object_points=1000 * arrays["object_points"], corners=arrays["right"]
    )
    other = end(Params(corners=tmp_path / "mm.npz", unit="mm", lens="k1 k2 p1 p2 k3"))
    assert other.now.K is not None
    assert last.now.K is not None
    np.testing.assert_allclose(other.now.K, last.now.K, atol=1e-3)
    np.testing.assert_allclose(other.now.Ts_camera_board, last.now.Ts_camera_board, atol=1e-5)
    # metres that are millimetres
    wrong = draw(end(Params(corners=tmp_path / "mm.npz", lens="k1 k2 p1 p2 k3")))
    right = draw(last)
    for path, kind in (("boards/0", Segments), ("camera", Camera)):
        T_wrong, T_right = (
            sure(as_a(kind, scene[path]).T_world_object) for scene in (wrong, right)
        )
        np.testing.assert_allclose(T_wrong, T_right, atol=1e-5)


def test_another_board_shape_and_a_table_without_truth(tmp_path):
    p = board_points(5, 4, 0.1)
    rng = np.random.default_rng(0)
    uv = []
    for x, y in ((0.3, 0.0), (-0.2, 0.3), (0.1, -0.4), (-0.3, -0.2)):
        c = p @ np.array([[1, 0, -x], [0, 1, -y], [x, y, 1]]) + [-0.2, -0.15, 1.2]  # nearly turns
        uv.append(600 * c[:, :2] / c[:, 2:] + [320, 240] + 0.1 * rng.normal(size=(20, 2)))
    np.savez(tmp_path / "c.npz", board=p, uv=np.array(uv), size=[640, 480])
    scene = draw(end(Params(corners=tmp_path / "c.npz", lens="none")))
    table = scene["camera in numbers"]
    assert isinstance(table, Table)
    assert table.header == ("", "found", "±")


def test_what_is_refused(corners, tmp_path, shared_data):
    np.savez(tmp_path / "one.npz", board=board_points(), uv=np.load(corners)["left"][:1])
    np.savez(tmp_path / "none.npz", nothing=np.zeros(3))
    (tmp_path / "empty.csv").write_text("")
    for path, message in (
        (tmp_path / "one.npz", "1 views"),
        (tmp_path / "none.npz", "no arrays"),
        (tmp_path / "empty.csv", "no lines"),
        (shared_data / "calibration" / "left01.jpg", "text files"),
        (tmp_path, "folder"),
    ):
        with pytest.raises(InputError, match=message):
            list(run(Params(corners=path)))
