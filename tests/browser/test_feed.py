"""What viser's client is told: whatever was shown before, it ends with what is wanted, and is told
no more than it lacks.
"""

import itertools
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

from tests import fake
from tests.browser.feeding import VIEW, Fed
from tests.wire.kinds import ENDS, FACE, KINDS, MOVED, SMALL
from tests.wire.reading import Reader
from workbench.lesson import View
from workbench.run.timeline import Timeline
from workbench.scene import Camera, Label, Mesh, Points, Scene, Segments
from workbench.wire.nodes import Maker
from workbench.wire.packing import PageWire

pytestmark = pytest.mark.browser


def pose(turn: tuple[float, float, float], t: tuple[float, float, float]) -> np.ndarray:
    T = np.eye(4)
    T[:3, :3] = Rotation.from_rotvec(turn).as_matrix()
    T[:3, 3] = t
    return T


VEIL = Mesh(np.eye(3), FACE, "target", opacity=0.4)
SEVERAL: tuple[Scene, ...] = (
    {"v": VEIL, "l": Segments(ENDS), "c": Camera(fake.K, 64, 48, image=SMALL)},
    {
        "v": replace(VEIL, color="source"),
        "l": Segments(ENDS),
        "c": Camera(fake.K, 64, 48, image=SMALL),
    },
    {"l": Segments(2 * ENDS, "wrong"), "c": Camera(fake.K, 64, 48, MOVED, image=SMALL)},
    {
        "v": VEIL,
        "l": Label("no line", np.ones(3)),
        "x/y": Points(np.eye(3)),
        "x": Points(np.eye(3), T_world_object=MOVED),
    },
)
STEPS = [step.scene for step in Timeline(fake.lesson, fake.Params(points=20)).complete().known()]
ALL: tuple[Scene, ...] = (*KINDS, *SEVERAL, *STEPS)
CLOUD = Points(np.random.default_rng(0).uniform(size=(2000, 3)), "source", T_world_object=np.eye(4))
GOAL = pose((0.0, 0.0, 1.4), (1.0, 2.0, 3.0))
BEFORE: Scene = {
    "cloud": CLOUD,
    "still": KINDS[0]["x"],
    "lines": Segments(ENDS),
    "word": Label("w", np.zeros(3)),
}
AFTER: Scene = {
    "cloud": replace(CLOUD, T_world_object=GOAL),
    "still": KINDS[0]["x"],
    "lines": Segments(3 * ENDS, T_world_object=GOAL),
    "word": Label("w", np.ones(3)),
}


@pytest.fixture(scope="module")
def fed(chromium) -> Iterator[Fed]:
    """A page that has read ALL, then BEFORE and AFTER."""
    fed = Fed(chromium)
    assert fed.add(ALL) == range(len(ALL))
    fed.add([BEFORE, AFTER])
    yield fed
    fed.close()


@pytest.fixture(autouse=True)
def plain(fed) -> None:
    """Begin each test in the light, with nothing shown, pinned or read of."""
    fed("""() => {
      Object.assign(sceneView, { nodes: null, path: "", pinned: null });
      feed.shown.clear(); feed.wanted = new Map(); feed.dark = false; feed.stage = null; labels.show(feed.shown); connect();
    }""")


@pytest.mark.parametrize("k", range(len(ALL)))
def test_a_client_has_of_a_scene_what_its_nodes_say(fed, k):
    reader = Reader()
    wanted = reader.nodes(reader.read(PageWire(Maker()).step({}, ALL[k], VIEW))["nodes"])
    reply = fed(
        "async (k) => { sceneView.step(scenes[k].nodes, 0); await settled(); return [seen(),"
        " client.wrong]; }",
        k,
    )
    assert reply[1] == []
    words = {name: node for name, node in wanted.items() if node["type"] == "Label"}
    visible = {name for name, node in wanted.items() if node.get("visible", True)} - words.keys()
    assert reply[0].keys() == visible | {f"word {name}" for name in words}
    poses = {name: np.array(node["pose"]) for name, node in wanted.items()}
    for key, node in reply[0].items():
        name = key.removeprefix("word ")
        if "word" in node:
            assert node["word"] == wanted[name]["props"]["text"]
            assert node["opacity"] == wanted[name].get("fade", 1)
            np.testing.assert_allclose(node["position"], poses[name][4:], atol=1e-8)
            continue
        assert node["type"] == wanted[name]["type"]
        assert node["props"].keys() == wanted[name]["props"].keys()
        parent = poses.get(name.rpartition("/")[0], np.array([1.0, 0, 0, 0, 0, 0, 0]))
        turn = Rotation.from_quat(parent[:4], scalar_first=True)
        np.testing.assert_allclose(
            node["position"], turn.apply(poses[name][4:]) + parent[4:], atol=1e-8
        )
        wxyz = (turn * Rotation.from_quat(poses[name][:4], scalar_first=True)).as_quat(
            scalar_first=True
        )
        assert abs(np.dot(wxyz, node["wxyz"])) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("by", "together"), [(0, 1), (1, 1), (0, 3)], ids=["jump", "next", "three at once"]
)
def test_whatever_was_shown_before_leaves_nothing(fed, by, together):
    numbers = range(len(KINDS) + len(SEVERAL))
    order = [k for pair in itertools.product(numbers, numbers) for k in pair]
    assert (
        fed("([order, by, together]) => walked(order, by, together)", [order, by, together]) == ""
    )


WALK = """async ([start, count, seed]) => {
  let state = seed;
  const random = (n) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * n);
  };
  const now = { i: start, path: "", pin: null, dark: false }, walked = [];
  let mine = client;
  sceneView.step(scenes[now.i].nodes, 0);
  for (let k = 0; k < 120; k++) {
    const what = random(6);
    if (what < 3) { now.i = start + random(count); sceneView.step(scenes[now.i].nodes, random(3) - 1); }
    else if (what === 3) sceneView.light((now.path = ["", "x", "source", "nothing", "v"][random(5)]));
    else if (what === 4) { now.pin = sceneView.pinned ? null : now.i; sceneView.pin(); }
    else { now.dark = !now.dark; feed.theme(now.dark); }
    walked.push([what, { ...now }]);
    if (random(3) === 0) { tick(random(200)); continue; }
    await settled();
    const found = byName(seen());
    if (mine.wrong.length) return `${mine.wrong[0]} after ${JSON.stringify(walked.slice(-4))}`;
    const kept = { ...sceneView }, shown = new Map(feed.shown), wanted = await alone(now);
    if (found !== wanted) return `${JSON.stringify(walked.slice(-4))}: ${difference(found, wanted)}`;
    client = feed.client = mine; // and on from where the walk was
    Object.assign(sceneView, kept);
    feed.shown = shown;
    feed.dark = now.dark;
    labels.show(feed.shown);
  }
  return mine.nodes.size < 60 ? "" : `${mine.nodes.size} nodes are kept`;
}"""


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("first", [0, len(KINDS)], ids=["kinds", "lesson"])
def test_no_walk_through_steps_themes_emphasis_and_pins_leaves_a_trace(fed, first, seed):
    count = len(KINDS) if first == 0 else len(ALL) - len(KINDS)
    assert fed(WALK, [first, count, seed + 1]) == ""


MESSAGES = """([i, j, how]) => {
  sceneView.step(scenes[i].nodes, 0); finish();
  client.said = [];
  sceneView.step(scenes[j].nodes, how);
  finish();
  return client.said.map(({ type, name }) => [type, name]);
}"""


@pytest.mark.parametrize("by", [0, 1])
def test_what_only_moves_is_sent_as_poses_and_what_stays_is_not_sent(fed, by):
    before = len(ALL)
    after = len(ALL) + 1
    messages = fed(MESSAGES, [before, after, by])
    assert {type_ for type_, name in messages if name == "/scene/cloud"} == {
        "SetOrientationMessage",
        "SetPositionMessage",
    }
    assert not [name for _, name in messages if name not in ("/scene/cloud", "/scene/lines")]
    assert (
        next(type_ for type_, name in messages if name == "/scene/lines")
        == "SceneNodeUpdateMessage"
    )
    assert fed(MESSAGES, [after, after, by]) == []
    copy = fed.add([{path: replace(thing) for path, thing in AFTER.items()}])  # type: ignore[type-var]
    assert fed(MESSAGES, [after, copy[0], by]) == []


@pytest.mark.parametrize("thing", [Points(np.eye(3), np.zeros((3, 3), np.uint8)), Segments(ENDS)])
def test_another_number_of_points_is_another_node_and_as_many_are_changed_in_place(fed, thing):
    many = (
        Points(np.ones((7, 3)), np.zeros((7, 3), np.uint8))
        if isinstance(thing, Points)
        else Segments(ENDS[:1])
    )
    same = (
        replace(thing, p=2 * thing.p)
        if isinstance(thing, Points)
        else replace(thing, ends=2 * thing.ends)
    )
    original, other, alike = fed.add([{"n": thing}, {"n": many}, {"n": same}])
    kinds = [
        {kind for kind, _ in fed(MESSAGES, [original, k, 0]) if not kind.startswith("Set")}
        for k in (other, alike)
    ]
    assert kinds == [
        {"PointCloudMessage" if isinstance(thing, Points) else "LineSegmentsMessage"},
        {"SceneNodeUpdateMessage"},
    ]


def test_lines_are_made_anew_over_a_new_surface_but_not_from_step_to_step(fed):
    first = len(KINDS)  # whose surface has another colour in the next
    made = [
        kind for kind, name in fed(MESSAGES, [first, first + 1, 0]) if name.startswith("/scene/l")
    ]
    assert made[0] == "RemoveSceneNodeMessage"
    assert [
        name for _, name in fed(MESSAGES, [first, first + 1, 1]) if not name.startswith("/scene/v")
    ] == []


def test_what_is_hidden_is_hidden_and_comes_back(fed):
    show = """(visible) => {
      const kind = { type: "FrameMessage", fade: 1, visible, props: {} };
      feed.show(new Map([["/frame", { kind, wxyz: [1, 0, 0, 0], position: [0, 0, 0] }]]));
      return "/frame" in client.seen();
    }"""
    assert [fed(show, visible) for visible in (True, False, True)] == [True, False, True]


GLIDED = """([i, j, by, parts]) => {
  sceneView.step(scenes[i].nodes, 0); finish();
  client.said = [];
  sceneView.step(scenes[j].nodes, by);
  const poses = () => Object.entries(client.seen()).map(([name, { wxyz, position }]) => [name, [...wxyz, ...position]]);
  const at = () => ["/scene/cloud", "/scene/lines"].map((name) => Object.fromEntries(poses())[name]);
  const found = [at()], start = clock.now;
  for (const part of parts) { tick(start + 250 * part - clock.now); found.push(at()); }
  tick(); // words are placed
  return [found, clock.frames.length];
}"""


@pytest.mark.parametrize("by", [1, -1])
def test_a_step_beside_is_gone_to_evenly_and_ends_exactly_where_it_says(fed, by):
    parts = [0.2, 0.5, 0.8, 1.0]
    moments, waiting = fed(GLIDED, [len(ALL), len(ALL) + 1, by, parts])
    clouds = np.array([moment[0] for moment in moments])
    lines = np.array([moment[1] for moment in moments])
    assert waiting == 0
    assert list(clouds[-1]) == list(scenes_pose(AFTER))
    np.testing.assert_allclose(clouds[0], [1, 0, 0, 0, 0, 0, 0])
    eased = np.array([0.0, *(3 * t**2 - 2 * t**3 for t in parts)])
    turns = Slerp([0, 1], Rotation.from_matrix([np.eye(3), GOAL[:3, :3]]))(eased).as_quat(
        scalar_first=True
    )
    np.testing.assert_allclose(np.abs((clouds[:, :4] * turns).sum(1)), 1.0, atol=1e-9)
    np.testing.assert_allclose(clouds[:, 4:], eased[:, None] * GOAL[:3, 3], atol=1e-9)
    assert (lines == lines[-1]).all(), "what changes is where it belongs at once"


def scenes_pose(scene: Scene) -> tuple[float, ...]:
    """Return the pose of a scene's cloud."""
    return Maker().nodes(scene, VIEW)["/scene/cloud"][1]


def test_a_turn_takes_the_shorter_way(fed):
    """From 60 to -110 degrees, whose quaternions lie more than a quarter turn apart in four
    dimensions.
    """
    turns = [pose((0.0, 0.0, np.radians(degrees)), (0.0, 0.0, 0.0)) for degrees in (60, -110)]
    first, second = fed.add([{"cloud": replace(CLOUD, T_world_object=T)} for T in turns])
    walk = (
        "([i, j]) => { sceneView.step(scenes[i].nodes, 0); finish();"
        " sceneView.step(scenes[j].nodes, 1); tick(125); }"
    )
    fed(walk, [first, second])
    rotation = Rotation.from_quat(
        fed("() => client.seen()['/scene/cloud'].wxyz"), scalar_first=True
    )
    np.testing.assert_allclose(rotation.as_rotvec(degrees=True), (0, 0, -25), atol=1e-6)


@pytest.mark.parametrize("by", [0, 2, -3])
def test_a_jump_goes_nowhere_between(fed, by):
    moments, waiting = fed(GLIDED, [len(ALL), len(ALL) + 1, by, [0.5]])
    assert moments[0][0] == moments[1][0] == list(scenes_pose(AFTER))
    assert waiting == 0


def test_who_wants_no_motion_sees_none(fed):
    fed.page.emulate_media(reduced_motion="reduce")
    try:
        moments, _ = fed(GLIDED, [len(ALL), len(ALL) + 1, 1, [0.5]])
    finally:
        fed.page.emulate_media(reduced_motion="no-preference")
    assert moments[0][0] == list(scenes_pose(AFTER))


def test_who_goes_on_before_a_glide_ends_starts_from_where_it_is(fed):
    at = "() => [...client.seen()['/scene/cloud'].position]"
    fed(
        "([i, j]) => { sceneView.step(scenes[i].nodes, 0); finish();"
        " sceneView.step(scenes[j].nodes, 1); }",
        [len(ALL), len(ALL) + 1],
    )
    fed("() => tick(125)")
    middle = fed(at)
    np.testing.assert_allclose(middle, GOAL[:3, 3] / 2)
    fed("(i) => sceneView.step(scenes[i].nodes, -1)", len(ALL))
    assert fed(at) == middle
    fed("() => { tick(125); tick(125); tick(); }")
    assert fed(at) == [0.0, 0.0, 0.0]
    assert fed("() => clock.frames.length") == 0


def test_a_frame_that_comes_again_is_sent_everything(fed):
    both = """async (k) => {
      Object.assign(sceneView, { path: "source", pinned: pinned(k - 3) });
      feed.open(scenes[k].stage);
      feed.clicks(true);
      sceneView.step(scenes[k].nodes, 0);
      feed.theme(true);
      await settled();
      const told = () => ({ seen: byName(seen()), dark: client.dark, camera: client.camera, wrong: client.wrong,
        light: client.said.filter(({ type }) => /Lights|Environment/.test(type)).length, connected: client.connected,
        clicks: client.said.filter(({ type }) => type === "ScenePointerEnableMessage").at(-1).modifiers });
      const before = told();
      connect();
      await settled();
      return [before, told()];
    }"""
    before, after = fed(both, len(ALL) - 1)
    assert before == after
    assert after["dark"] is after["connected"] is True
    assert after["light"] == 2
    assert after["clicks"] == [None]
    assert after["wrong"] == []
    assert len(after["camera"]) == 4
    fed("() => feed.clicks(false)")


def test_another_view_moves_the_camera_and_the_same_one_does_not(fed):
    fed.add([{}], View(eye=(1.0, 1.0, 4.0), target=(0.5, 0.0, 0.0), fov_degrees=30.0))
    last = fed("() => scenes.length - 1")
    moves = """([i, j]) => {
      feed.open(scenes[i].stage); client.said = []; feed.open(scenes[j].stage);
      return client.said.filter(({ type }) => type.startsWith("SetCamera")).map(({ type }) => type);
    }"""
    assert fed(moves, [0, 0]) == []
    assert len(set(fed(moves, [0, last]))) == 4
    camera: dict[str, Any] = fed("() => client.camera")
    np.testing.assert_allclose(camera["SetCameraPositionMessage"], (1.0, 1.0, 4.0))
    np.testing.assert_allclose(camera["SetCameraLookAtMessage"], (0.5, 0.0, 0.0))
    np.testing.assert_allclose(camera["SetCameraUpDirectionMessage"], (0.0, 0.0, 1.0))
    assert camera["SetCameraFovMessage"] == pytest.approx(np.radians(30.0))
