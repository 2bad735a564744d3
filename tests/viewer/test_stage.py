import contextlib
from dataclasses import replace
from types import SimpleNamespace
from typing import Any
from unittest.mock import MagicMock

import numpy as np
import pytest
import viser

from workbench.lesson import View, catalog
from workbench.viewer.stage import NARROWEST, WIDEST, Aim, add_floor, eye_of


@pytest.mark.parametrize("name", list(catalog()))
def test_a_narrow_picture_shows_as_much_in_its_width_as_a_wide_one(name):
    view = catalog()[name].view
    away = view.seen_from() - np.array(view.target)
    for aspect in (1.6, NARROWEST):
        np.testing.assert_allclose(eye_of(view, aspect), view.seen_from())
    narrow = eye_of(view, 0.6) - np.array(view.target)
    assert np.linalg.norm(narrow) * 0.6 == pytest.approx(np.linalg.norm(away) * NARROWEST)
    np.testing.assert_allclose(np.cross(narrow, away), 0, atol=1e-9)
    assert np.isfinite(eye_of(view, 0.0)).all()  # a picture that has no size yet


def test_the_camera_is_fitted_to_another_width_unless_somebody_has_moved_it(monkeypatch):
    camera = SimpleNamespace(image_width=860, image_height=530, up_direction=None, position=None, look_at=None, fov=0.0)
    client: Any = SimpleNamespace(camera=camera, atomic=contextlib.nullcontext, scene=None)
    monkeypatch.setattr("workbench.viewer.stage.add_floor", lambda scene, view: None)
    lesson, aim = catalog()["icp"], Aim()
    aim.fit(client)  # nothing is wanted yet
    aim.open(lesson, lesson.params())
    aim.show(client, lesson, lesson.params())
    for width in (430, 860, 300):
        camera.image_width = width
        aim.fit(client)
        np.testing.assert_allclose(camera.position, eye_of(lesson.view, width / 530, WIDEST))  # what was in view stays
        np.testing.assert_allclose(camera.look_at, lesson.view.target)
    camera.position = moved = np.array([5.0, 5.0, 5.0])
    camera.image_width = 860
    aim.fit(client)
    assert camera.position is moved


@pytest.mark.parametrize("up", [(0.0, 1.0, 0.0), (0.0, -1.0, 0.0)])
def test_what_is_up_in_a_lesson_is_up_on_its_live_page(up):
    camera = SimpleNamespace(image_width=860, image_height=530, up_direction=None, position=None, look_at=None, fov=0.0)
    added: dict[str, dict] = {}
    scene = MagicMock()
    scene.add_grid.side_effect = lambda name, **how: added.update({name: how})
    client: Any = SimpleNamespace(camera=camera, atomic=contextlib.nullcontext, scene=scene)
    view = View(eye=(2.0, 1.0, 0.5), up=up, grid=0.5, grid_height=0.4)
    lesson, aim = replace(catalog()["icp"], view=view, presets=()), Aim()
    aim.open(lesson, lesson.params())
    aim.show(client, lesson, lesson.params())
    np.testing.assert_array_equal(camera.up_direction, up)
    np.testing.assert_allclose(camera.position, eye_of(view, 860 / 530))
    assert added["/grid"]["plane"] == "xz"
    np.testing.assert_allclose(added["/grid"]["position"], 0.4 * np.array(up))


def test_a_knob_that_leads_to_something_of_another_size_turns_the_camera_and_no_other_does(monkeypatch):
    camera = SimpleNamespace(image_width=860, image_height=530, up_direction=None, position=None, look_at=None, fov=0.0)
    client: Any = SimpleNamespace(camera=camera, atomic=contextlib.nullcontext, scene=None)
    monkeypatch.setattr("workbench.viewer.stage.add_floor", lambda scene, view: None)
    lesson, aim = catalog()["icp"], Aim()
    large = View(eye=(0.0, -30.0, 20.0), grid=lesson.view.grid, grid_height=lesson.view.grid_height)
    lesson = replace(lesson, view_for=lambda params: large if params.seed > 5 else lesson.view)
    aim.open(lesson, lesson.presets[0].params)
    for seed, view in ((1, lesson.presets[0].view or lesson.view), (6, large), (7, large), (2, lesson.view)):
        aim.show(client, lesson, replace(lesson.presets[0].params, seed=seed))
        np.testing.assert_allclose(camera.position, eye_of(view, 860 / 530))


@pytest.mark.parametrize(
    ("name", "choice", "value"),
    [
        ("features", "part", "pictures"),
        ("learning", "task", "mesh"),
        ("distances", "stage", "surface"),
        ("fitting", "shape", "sphere"),
        ("ransac", "model", "line"),
    ],
)
def test_a_choice_that_leads_to_other_things_brings_the_camera_of_their_presets(name, choice, value):
    lesson = catalog()[name]
    params = replace(lesson.params(), **{choice: value}, seed=lesson.params().seed + 1)
    theirs = [preset.view for preset in lesson.presets if getattr(preset.params, choice) == value]
    assert lesson.preset_of(params) is None
    assert lesson.view_of(params) in theirs
    assert lesson.view_of(params) != lesson.view
    assert lesson.view_of(replace(lesson.params(), seed=lesson.params().seed + 1)) == lesson.view


DOWN = View(eye=(0.0, 0.0, 4.0))


@pytest.mark.parametrize(
    ("view", "right", "upwards"),
    [
        (DOWN, (1, 0, 0), (0, 1, 0)),
        (View(eye=(1.0, 2.0, -3.0), target=(1.0, 2.0, 0.0)), (-1, 0, 0), (0, 1, 0)),
        (View(eye=(0.0, 5.0, 0.0), up=(0.0, 1.0, 0.0)), (1, 0, 0), (0, 0, -1)),
        (View(eye=(0.0, 0.0, 4.0), up=(0.0, 1.0, 0.0)), (1, 0, 0), (0, 1, 0)),
        (View(eye=(0.0, 0.0, 4.0), up=(0.0, -1.0, 0.0)), (-1, 0, 0), (0, -1, 0)),
    ],
)
def test_a_view_along_its_up_is_one_picture_with_a_right_and_an_up(view, right, upwards):
    for aspect in (1.6, 0.6):
        eye, target = eye_of(view, aspect), np.array(view.target)
        assert np.isfinite(eye).all()
        v_ahead = (target - eye) / np.linalg.norm(target - eye)
        v_right = np.cross(v_ahead, view.up) / np.linalg.norm(np.cross(v_ahead, view.up))
        np.testing.assert_allclose(v_right, right, atol=1e-6)
        np.testing.assert_allclose(np.cross(v_right, v_ahead), upwards, atol=5e-3)


@pytest.mark.parametrize(
    "wrong", [{"eye": (0.0, 0.0, 0.0)}, {"up": (0.0, 0.0, 0.0)}, {"target": (np.nan, 0.0, 0.0)}, {"eye": (1.0, 2.0)}]
)
def test_a_view_from_nowhere_is_refused(wrong):
    with pytest.raises(ValueError, match="View"):
        View(**wrong)


@pytest.mark.parametrize("up", [(0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (-1.0, 0.0, 0.0)])
def test_the_camera_is_turned_and_the_scene_is_not(up):
    """The browser turns the scene at the end of a batch, after it has placed the camera by the turn before."""
    with_root: list[str] = []
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    try:
        queue = server.scene._websock_interface.queue_message
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(
                server.scene._websock_interface,
                "queue_message",
                lambda message: (with_root.append(type(message).__name__) if getattr(message, "name", 0) == "" else 0,
                                 queue(message)),
            )  # fmt: skip
            add_floor(server.scene, View(up=up))
    finally:
        server.stop()
    assert with_root == []
