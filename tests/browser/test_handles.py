"""Handles set a knob and follow it, the held one leads, and a click tells its ray."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.browser.feeding import Fed

pytestmark = pytest.mark.browser
KNOBS: list[dict[str, Any]] = [
    {"name": "place", "by": "gizmo", "parts": ["x", "y", "z"], "size": 0.5},
    {"name": "flat", "by": "gizmo", "parts": ["x", "y"], "size": 0.3},
    {"name": "pose", "by": "gizmo", "parts": list("abcdef"), "size": 0.2},
    {"name": "pixel", "by": "pick", "parts": ["u", "v"]},
    {"name": "angle", "by": "slider", "parts": []},
]
PARAMS = {
    "place": [1.0, 2.0, 0.5],
    "flat": [1.0, -0.5],
    "pose": [0.1, 0.2, 0.3, 0.0, 0.0, 1.0],
    "pixel": [3, 4],
    "angle": 1,
}
SHOW = "(params) => { page.run.params = params; sceneView.again(); finish(); }"
HEAR = "(message) => feed.hear(message)"
RNG = np.random.default_rng(5)


@pytest.fixture(scope="module")
def fed(chromium) -> Iterator[Fed]:
    fed = Fed(chromium, KNOBS)
    fed.add([{}])
    yield fed
    fed.close()


@pytest.fixture(autouse=True)
def begun(fed) -> None:
    fed(
        """(params) => {
      Object.assign(handles, { on: true, held: null });
      Object.assign(source, { changed: [], clicked: [] });
      sceneView.nodes = scenes[0].nodes;
      feed.shown.clear(); feed.wanted = new Map(); page.run.params = params;
      connect(); sceneView.again();
    }""",
        PARAMS,
    )


def handle(fed: Fed, name: str) -> dict[str, Any]:
    return fed("(name) => client.seen()[`/handle/${name}`]", name)


def moved(fed: Fed, name: str, position: Any, *, wxyz: Any = (1.0, 0.0, 0.0, 0.0)) -> None:
    """Let the client tell that a hand has moved a handle."""
    where = {"name": f"/handle/{name}", "position": list(position), "wxyz": list(wxyz)}
    fed(HEAR, {"type": "TransformControlsUpdateMessage", **where})


def test_a_rotation_vector_comes_back(fed):
    axes = RNG.normal(size=(60, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    angles = np.concatenate([RNG.uniform(-np.pi, np.pi, 40), [0.0, 1e-12, 1e-7, np.pi - 1e-9] * 5])
    vectors = np.vstack([axes * angles[:, None], np.pi * np.eye(3), -np.pi * np.eye(3)])
    q = np.array(fed("(all) => all.map(quaternion)", vectors.tolist()))
    wanted = Rotation.from_rotvec(vectors)
    np.testing.assert_allclose(
        np.abs((q * wanted.as_quat(scalar_first=True)).sum(1)), 1.0, atol=1e-12
    )
    back = np.array(fed("(all) => all.map(turn)", q.tolist()))
    assert (np.linalg.norm(back, axis=1) <= np.pi + 1e-9).all()
    assert (Rotation.from_rotvec(back) * wanted.inv()).magnitude().max() < 1e-7
    away = np.abs(angles) < 3
    np.testing.assert_allclose(back[:60][away], vectors[:60][away], atol=1e-8)
    other = np.array(fed("(all) => all.map(turn)", (-q).tolist()))
    assert (Rotation.from_rotvec(other) * wanted.inv()).magnitude().max() < 1e-7, (
        "of two quaternions one rotation"
    )
    assert (np.linalg.norm(other, axis=1) <= np.pi + 1e-9).all()


def test_handles_stand_where_the_params_say(fed):
    place, flat, pose = (handle(fed, name) for name in ("place", "flat", "pose"))
    assert (place["position"], place["wxyz"]) == ([1.0, 2.0, 0.5], [1, 0, 0, 0])
    assert flat["position"] == [1.0, -0.5, 0]
    assert (pose["position"], pose["wxyz"]) == (
        [0.1, 0.2, 0.3],
        pytest.approx([np.cos(0.5), 0, 0, np.sin(0.5)]),
    )
    assert [node["props"]["scale"] for node in (place, flat, pose)] == [0.5, 0.3, 0.2]
    assert [node["props"]["disable_rotations"] for node in (place, flat, pose)] == [
        True,
        True,
        False,
    ]
    assert flat["props"]["active_axes"] == [True, True, False], "a place in the plane z = 0"
    assert place["props"]["active_axes"] == [True, True, True]
    names = fed("() => Object.keys(client.seen()).filter((name) => name.startsWith('/handle/'))")
    assert names == ["/handle/place", "/handle/flat", "/handle/pose"]
    fed(SHOW, PARAMS | {"place": [0.0, 0.0, 1.0], "flat": None})
    assert handle(fed, "place")["position"] == [0.0, 0.0, 1.0]
    assert handle(fed, "flat") is None
    fed("() => { handles.on = false; sceneView.again(); }")
    assert not fed("() => Object.keys(client.seen()).some((name) => name.startsWith('/handle/'))")
    assert fed("() => client.wrong") == []


def test_what_a_hand_does_is_said_in_the_knob_s_own_numbers(fed):
    moved(fed, "place", [0.25, 0.75, -1.0])
    moved(fed, "flat", [0.25, 0.75, 0.0])
    turned = Rotation.from_rotvec([0.3, -0.4, 0.5])
    moved(fed, "pose", [1.0, 2.0, 3.0], wxyz=turned.as_quat(scalar_first=True).tolist())
    place, flat, pose = fed("() => source.changed")
    assert (place, flat) == ({"place": [0.25, 0.75, -1.0]}, {"flat": [0.25, 0.75]})
    assert pose == {"pose": pytest.approx([1.0, 2.0, 3.0, 0.3, -0.4, 0.5])}
    for name in ("nothing", "pixel", "angle"):
        moved(fed, name, [1.0, 1.0, 1.0])
    assert len(fed("() => source.changed")) == 3


def test_a_held_handle_leads_while_answers_come_late(fed):
    fed(HEAR, {"type": "TransformControlsDragStartMessage", "name": "/handle/place"})
    for x in (1.1, 1.2, 1.3):
        moved(fed, "place", [x, 2.0, 0.5])
        fed("() => { client.said = []; }")
        # the answer to what was said before
        fed(SHOW, PARAMS | {"place": [x - 0.1, 2.0, 0.5], "flat": [x, 0.0]})
        told = fed("() => client.said.map(({ name }) => name)")
        assert told
        assert set(told) == {"/handle/flat"}, "the hand is not pulled back; other handles follow"
        assert fed("() => feed.shown.get('/handle/place').position")[0] == x
    fed(HEAR, {"type": "TransformControlsDragEndMessage", "name": "/handle/place"})
    fed(SHOW, PARAMS | {"place": [1.25, 2.0, 0.5]})  # as far as the knob goes
    assert handle(fed, "place")["position"] == [1.25, 2.0, 0.5]


def test_a_handle_that_comes_again_leaves_no_place_behind(fed):
    moved(fed, "place", [1.5, 0.0, 0.0])
    fed("() => { handles.on = false; sceneView.again(); }")
    fed("() => { handles.on = true; }")
    fed(SHOW, PARAMS | {"place": [0.0, 0.0, 0.0]})
    assert handle(fed, "place")["position"] == [0.0, 0.0, 0.0]


def test_a_click_tells_its_ray(fed):
    fed(HEAR, {"type": "ScenePointerMessage", "ray_origin": [1, 2, 3], "ray_direction": [0, 0, -1]})
    assert fed("() => source.clicked") == [[[1, 2, 3], [0, 0, -1]]]
    heard = (
        "() => client.said.filter(({ type }) => type ==="
        " 'ScenePointerEnableMessage').at(-1).modifiers"
    )
    assert fed(heard) == [None], "this lesson has a knob that is set by a click"


@pytest.mark.parametrize(
    ("knobs", "can", "heard"),
    [(KNOBS, True, True), (KNOBS[:3], True, False), (KNOBS, False, False)],
)
def test_clicks_are_heard_where_a_knob_and_the_home_take_them(fed, knobs, can, *, heard):
    picks = """([knobs, can]) => {
      const { knobs: own } = LESSON, { click } = source;
      LESSON.knobs = knobs;
      if (!can) source.click = undefined;
      handles.start();
      Object.assign(LESSON, { knobs: own });
      source.click = click;
      handles.start();
      return handles.knobs.length;
    }"""
    before = fed("() => client.said.length")
    assert fed(picks, [knobs, can]) == 3
    messages = fed(
        "(n) => client.said.slice(n).map(({ type, modifiers }) => [type, modifiers])", before
    )
    enabled = [modifiers for kind, modifiers in messages if kind == "ScenePointerEnableMessage"]
    assert enabled[0] == ([None] if heard else [])
