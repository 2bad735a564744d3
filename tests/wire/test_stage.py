"""Where a scene is seen from, and what stands where it will be."""

import json
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from tests.wire.reading import Reader
from workbench.lesson import View, catalog
from workbench.wire.nodes import Maker
from workbench.wire.packing import PageWire
from workbench.wire.stage import Aim, camera_of


def stage(view: View) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the nodes of a stage as a page has them, and what it is told besides."""
    reader = Reader()
    head = reader.read(PageWire(Maker()).step({}, {}, view))
    return reader.nodes(head["nodes"]), head["stage"]


@pytest.mark.parametrize("name", list(catalog()))
def test_a_page_is_told_the_camera_that_a_lesson_states(name):
    view = catalog()[name].view
    camera = json.loads(json.dumps(camera_of(view), allow_nan=False))
    np.testing.assert_allclose(camera["eye"], view.seen_from())
    np.testing.assert_allclose(camera["target"], view.target)
    np.testing.assert_allclose(camera["up"], view.up)
    assert camera["fov"] == pytest.approx(np.radians(view.fov_degrees))


@pytest.mark.parametrize(
    ("up", "plane"),
    [
        ((0.0, 0.0, 1.0), "xy"),
        ((0.0, 1.0, 0.0), "xz"),
        ((0.0, -1.0, 0.0), "xz"),
        ((-1.0, 0.0, 0.0), "yz"),
    ],
)
def test_the_grid_lies_across_what_is_up_and_the_scene_is_not_turned(up, plane):
    view = View(eye=(2.0, 1.0, 0.5), up=up, grid=0.25, grid_height=0.4)
    nodes, told = stage(view)
    grid = nodes["/grid"]
    assert (grid["props"]["plane"], grid["props"]["cell_size"]) == (plane, 0.25)
    np.testing.assert_allclose(grid["pose"], (1, 0, 0, 0, *(0.4 * np.array(up))))
    assert told["camera"]["up"] == list(up)
    assert "" not in nodes, (
        "the client would take the camera's place for one in the frame before the turn"
    )
    assert not [message for message in told["light"] if "Orientation" in message["type"]]
    assert all(node["pose"][:4] == [1, 0, 0, 0] for node in nodes.values())


def test_axes_have_names_at_their_ends_and_are_drawn_where_a_view_wants_them():
    nodes, _ = stage(View(grid=0.5))
    assert nodes["/axes"]["props"]["axes_length"] == 0.5
    for name, direction in zip("xyz", np.eye(3), strict=True):
        word = nodes[f"/axis/{name}"]
        assert (word["type"], word["props"]["text"]) == ("Label", name)
        along = word["pose"][4:] @ direction
        assert 0.5 < along < 0.6
        np.testing.assert_allclose(word["pose"][4:], along * direction)
    bare, _ = stage(View(grid=None, axes=False))
    assert not {"/grid", "/axes", "/axis/x", "/axis/y", "/axis/z"} & bare.keys()
    assert (
        bare["/WorldAxes"].get("visible", True) is False
        or not bare["/WorldAxes"]["props"]["show_axes"]
    )


def test_no_shadow_is_cast_and_nothing_is_mirrored():
    """They are slow without a graphics card."""
    nodes, told = stage(View())
    lights = {message["type"]: message for message in told["light"]}
    assert not lights["EnableLightsMessage"]["cast_shadow"]
    assert lights["EnvironmentMapMessage"]["hdri_data"] is None
    assert not any(node["props"].get("cast_shadow") for node in nodes.values())


def test_a_knob_that_leads_to_something_of_another_size_turns_the_camera_and_no_other_does():
    lesson = catalog()["icp"]
    aim = Aim()
    large = View(eye=(0.0, -30.0, 20.0), grid=lesson.view.grid, grid_height=lesson.view.grid_height)
    lesson = replace(lesson, view_for=lambda params: large if params.seed > 5 else lesson.view)
    preset = lesson.presets[0]
    aim.open(lesson, preset.params)
    for seed, view in ((1, preset.view or lesson.view), (6, large), (7, large), (2, lesson.view)):
        assert aim.view(lesson, replace(preset.params, seed=seed)) == view


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
def test_a_choice_that_leads_to_other_things_brings_the_camera_of_their_presets(
    name, choice, value
):
    lesson = catalog()[name]
    aim = Aim()
    params = replace(lesson.params(), **{choice: value}, seed=lesson.params().seed + 1)
    theirs = [preset.view for preset in lesson.presets if getattr(preset.params, choice) == value]
    assert lesson.preset_of(params) is None
    assert lesson.view_of(params) in theirs
    assert lesson.view_of(params) != lesson.view
    assert lesson.view_of(replace(lesson.params(), seed=lesson.params().seed + 1)) == lesson.view
    aim.open(lesson, lesson.params())
    assert aim.view(lesson, lesson.params()) == lesson.view
    assert aim.view(lesson, params) in theirs


@pytest.mark.parametrize(
    ("grid", "height", "stays"), [(0.7, 0.0, False), (None, 1.0, False), (None, 0.0, True)]
)
def test_the_view_of_a_preset_stays_behind_a_knob_unless_its_grid_is_another(grid, height, stays):
    lesson = catalog()["fitting"]
    aim = Aim()
    usual = lesson.view
    own = replace(
        usual, eye=(9.0, 9.0, 9.0), grid=grid or usual.grid, grid_height=usual.grid_height + height
    )
    preset = replace(lesson.presets[0], view=own)
    lesson = replace(lesson, presets=(preset, *lesson.presets[1:]))
    aim.open(lesson, preset.params)
    assert aim.view(lesson, preset.params) == own
    assert aim.view(lesson, replace(preset.params, seed=preset.params.seed + 1)) == (
        own if stays else usual
    )


def test_before_anything_is_opened_a_run_is_seen_by_its_own_view():
    lesson = catalog()["icp"]
    assert Aim().view(lesson, lesson.params()) == lesson.view_of(lesson.params())


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
    camera = camera_of(view)
    eye, target = np.array(camera["eye"]), np.array(camera["target"])
    assert np.isfinite(eye).all()
    v_ahead = (target - eye) / np.linalg.norm(target - eye)
    v_right = np.cross(v_ahead, camera["up"]) / np.linalg.norm(np.cross(v_ahead, camera["up"]))
    np.testing.assert_allclose(v_right, right, atol=1e-6)
    np.testing.assert_allclose(np.cross(v_right, v_ahead), upwards, atol=5e-3)


@pytest.mark.parametrize(
    "wrong",
    [
        {"eye": (0.0, 0.0, 0.0)},
        {"up": (0.0, 0.0, 0.0)},
        {"target": (np.nan, 0.0, 0.0)},
        {"eye": (1.0, 2.0)},
    ],
)
def test_a_view_from_nowhere_is_refused(wrong):
    with pytest.raises(ValueError, match="View"):
        View(**wrong)
