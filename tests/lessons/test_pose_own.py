"""Own points and pixels in the pose lesson, real ones among them, and files that must be
refused.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lessons.pose.lesson import draw, run
from lessons.pose.state import Params
from tests.geometry.views import view
from workbench.errors import InputError
from workbench.knobs import with_own_files
from workbench.scene import Camera, Points, caption_of


def written(folder: Path, p_world: np.ndarray, uv: np.ndarray) -> Path:
    np.savetxt(folder / "points.csv", np.column_stack([p_world, uv]), delimiter=",")
    return folder / "points.csv"


def stop_of(params: Params) -> Any:
    *_, last = run(params)
    return last


@pytest.mark.parametrize("method", ["P3P", "DLT", "SQPnP", "EPnP", "RANSAC"])
def test_own_points_give_their_camera(tmp_path, method):
    T, p_world, xy = view(3, 20, sigma=0.5 / 800)
    path = written(tmp_path, p_world + 3000.0, 800 * xy + [400, 300])
    last = stop_of(Params(sightings=path, method=method, principal=(400.0, 300.0)))
    assert last.T is not None
    np.testing.assert_allclose(last.T[:3, :3], T[:3, :3], atol=0.01)
    scene = draw(last)
    assert caption_of(scene).tone == "info"  # nobody knows the truth
    points, camera = scene["points"], scene["estimate"]
    assert isinstance(points, Points)
    assert isinstance(camera, Camera)
    assert np.ptp(points.p, axis=0).max() == pytest.approx(1.0)
    assert camera.T_world_object is not None
    assert np.linalg.norm(camera.T_world_object[:3, 3]) < 10
    assert "truth" not in scene


def test_a_real_board_by_ippe(tmp_path, shared_data):
    corners = np.load(shared_data / "calibration" / "corners_9x6.npz")
    path = written(tmp_path, corners["object_points"], corners["left"][0])
    last = stop_of(Params(sightings=path, method="IPPE", focal=540.0, principal=(342.0, 236.0)))
    # left_intrinsics.yml, the first view's translation, with its lens
    known = np.array([-0.0752, -0.1089, 0.3997])
    assert np.linalg.norm(last.T[:3, 3] - known) < 0.02
    # what the lens, which is left out here, does to a corner
    assert last.subject.pixel_errors(last.T).mean() < 3


def test_the_focal_length_of_own_pixels_is_the_persons_and_decides(tmp_path):
    """A camera of 600 px: with its own focal length it is where it was, with the guess of 800 px it
    is too far away.
    """
    T, p_world, xy = view(3, 20)
    path = written(tmp_path, p_world, 600 * xy + [319.5, 239.5])
    for focal, off in ((600.0, 1e-6), (800.0, None)):
        for f in (300.0, 800.0):  # the focal length of our own camera has no part in it
            last = stop_of(Params(sightings=path, method="SQPnP", focal=focal, f=f))
            wrong = np.abs(last.T - T).max()
            assert wrong < off if off else wrong > 0.5


def test_files_of_one_place_or_of_too_few_points_are_refused(tmp_path):
    corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]])
    with pytest.raises(InputError, match="pixels lie at one place"):
        stop_of(Params(sightings=written(tmp_path, corners, np.ones((4, 2)))))
    with pytest.raises(InputError, match="points lie at one place"):
        stop_of(Params(sightings=written(tmp_path, np.ones((5, 3)), np.ones((5, 2)))))
    with pytest.raises(InputError, match="3 points"):
        stop_of(Params(sightings=written(tmp_path, np.eye(3), np.eye(3)[:, :2])))
    (tmp_path / "points.csv").write_text("")
    with pytest.raises(InputError, match="0 points"):
        stop_of(Params(sightings=tmp_path / "points.csv"))


def test_points_on_a_line_come_to_an_end(tmp_path):
    line = np.linspace(0, 1, 8)[:, None] * [1.0, 2.0, 0.5]
    path = written(tmp_path, line, 300 + 100 * line[:, :2])
    for method in ("P3P", "SQPnP"):
        for state in run(Params(sightings=path, method=method)):
            draw(state)
    with pytest.raises(InputError, match="one line"):
        stop_of(Params(sightings=path, method="EPnP"))


def test_how_a_file_is_read_is_kept_with_it():
    mine = Params(sightings=Path("mine.csv"), focal=540.0, principal=(5.0, 6.0), up="y", noise=3.0)
    assert with_own_files(Params(), mine) == Params(
        sightings=Path("mine.csv"), focal=540.0, principal=(5.0, 6.0), up="y"
    )
