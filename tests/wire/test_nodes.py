"""Of equal content equal keys, of what only moves a pose alone, and the colours and places that a
scene states.
"""

import gc
import io
import itertools
import json
import threading
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation
from trimesh.visual import TextureVisuals
from trimesh.visual.material import PBRMaterial

from tests import fake
from tests.fake import PHOTO, K
from tests.wire.kinds import ENDS, FACE, KINDS, MOVED, SHEARED
from tests.wire.reading import Reader
from workbench.lesson import View
from workbench.run.timeline import Timeline
from workbench.scene import (
    PALETTE,
    Camera,
    Classes,
    Field,
    Label,
    Mesh,
    Picture,
    Points,
    Scene,
    Segments,
    color_rows,
)
from workbench.wire.nodes import SCENE, Maker, Node
from workbench.wire.packing import PageWire
from workbench.wire.primitives import AT_ORIGIN, wxyz_of

VIEW = View(axes=False, grid=None)
RNG = np.random.default_rng(7)
TURN = st.floats(-np.pi, np.pi)


def shown(scene: Scene, maker: Maker | None = None) -> dict[str, Node]:
    """Return the nodes of a scene alone, by what follows `/scene/`."""
    nodes = (maker or Maker()).nodes(scene, VIEW)
    return {
        name.removeprefix(SCENE): node for name, node in nodes.items() if name.startswith(SCENE)
    }


def props_of(scene: Scene, name: str = "x") -> dict[str, Any]:
    """Return the properties of a node as a page has them."""
    reader = Reader()
    head = reader.read(PageWire(Maker()).step({}, scene, VIEW))
    return reader.nodes(head["nodes"])[SCENE + name]["props"]


def world(p: np.ndarray, pose: Any) -> np.ndarray:
    """Return points of a node's frame in the world."""
    return Rotation.from_quat(pose[:4], scalar_first=True).apply(p) + pose[4:]


@pytest.mark.parametrize("k", range(len(KINDS)))
def test_equal_content_has_an_equal_key_and_other_content_another(k):
    copy = {path: replace(primitive) for path, primitive in KINDS[k].items()}  # type: ignore[type-var]
    original = shown(KINDS[k])
    other = shown(copy)
    assert {name: (kind.key, pose) for name, (kind, pose) in original.items()} == {
        name: (kind.key, pose) for name, (kind, pose) in other.items()
    }
    for kind, _ in original.values():
        assert json.loads(kind.text).keys() <= {"type", "props", "fade", "visible"}
        assert len({array.key for array in kind.arrays}) == len(
            {array.data for array in kind.arrays}
        )
    maker = Maker()
    made = [
        frozenset((name, kind.key, pose) for name, (kind, pose) in shown(scene, maker).items())
        for scene in KINDS
    ]
    assert [i for i, nodes in enumerate(made) if nodes == made[k] and nodes] == (
        [k] if made[k] else []
    )


def test_every_kind_says_how_opaque_it_is_and_is_drawn_in_full_colours():
    for scene in KINDS:
        for path, primitive in scene.items():
            opacity = primitive.opacity  # type: ignore[union-attr]
            full = shown({path: replace(primitive, opacity=1.0)})  # type: ignore[type-var]
            for name, (kind, _) in shown(scene).items():
                content = json.loads(kind.text)
                assert content.pop("fade", 1) == opacity
                assert content == json.loads(full[name][0].text), (
                    "the page mixes colours, and nobody before it"
                )


@pytest.mark.parametrize(
    "primitive",
    [
        Points(RNG.uniform(size=(20_000, 3)), "source", T_world_object=np.eye(4)),
        Segments(RNG.uniform(size=(5_000, 2, 3)), T_world_object=np.eye(4)),
        Mesh(RNG.uniform(size=(9, 3)), FACE, Field(np.arange(9.0), 0, 9, "h"), np.eye(4)),
        Camera(K, 64, 48, np.eye(4), image=PHOTO),
        Picture(PHOTO, width=0.5, T_world_object=np.eye(4)),
    ],
    ids=lambda primitive: type(primitive).__name__,
)
def test_what_moves_keeps_its_kind_and_is_sent_as_a_pose(primitive):
    wire, maker = PageWire(), Maker()
    moved = replace(primitive, T_world_object=MOVED)
    before, after = shown({"x": primitive}, maker), shown({"x": moved}, maker)
    assert {name: kind.key for name, (kind, _) in before.items()} == {
        name: kind.key for name, (kind, _) in after.items()
    }
    np.testing.assert_allclose(
        after["x"][1], (np.sqrt(0.5), 0, 0, np.sqrt(0.5), *MOVED[:3, 3]), atol=1e-12
    )
    wire.step({}, {"x": primitive}, VIEW)
    message = wire.step({}, {"x": moved}, VIEW)
    assert Reader().read(message)["arrays"] == []
    assert len(message) < len(wire.step({}, {}, VIEW)) + 300


@pytest.mark.parametrize(
    "T", [None, np.eye(4), MOVED, SHEARED, np.diag([-1.0, 1, 1, 1]), np.diag([2.0, 2, 2, 1])]
)
def test_points_stand_where_their_motion_puts_them_rigid_or_not(T):
    p = RNG.normal(size=(5, 3))
    M = np.eye(4) if T is None else T
    things = {
        "points": Points(p, T_world_object=T),
        "lines": Segments(p[:4].reshape(2, 2, 3), T_world_object=T),
        "mesh": Mesh(p, FACE, T_world_object=T),
        "word": Label("here", p[0], T_world_object=T),
    }
    reader = Reader()
    nodes = reader.nodes(reader.read(PageWire(Maker()).step({}, things, VIEW))["nodes"])
    for name, key, wanted in (
        ("points", "points", p),
        ("lines", "points", p[:4]),
        ("mesh", "vertices", p),
    ):
        node = nodes[SCENE + name]
        p_world = world(node["props"][key].reshape(-1, 3), node["pose"])
        np.testing.assert_allclose(p_world, wanted @ M[:3, :3].T + M[:3, 3], atol=1e-5)
    np.testing.assert_allclose(
        nodes[SCENE + "word"]["pose"], (1, 0, 0, 0, *(M[:3, :3] @ p[0] + M[:3, 3]))
    )
    if T is SHEARED:
        assert nodes[SCENE + "points"]["pose"] == list(AT_ORIGIN)


@given(st.tuples(TURN, TURN, TURN))
def test_a_quaternion_is_that_of_its_rotation(turn):
    R = Rotation.from_rotvec(turn).as_matrix()
    q = np.array(wxyz_of(R))
    assert np.isclose(np.linalg.norm(q), 1.0, atol=1e-12)
    assert q[np.abs(q).argmax()] > 0
    np.testing.assert_allclose(Rotation.from_quat(q, scalar_first=True).as_matrix(), R, atol=1e-12)


def test_half_turns_have_one_too():
    for diagonal in [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]:
        assert sorted(np.abs(wxyz_of(np.diag(np.array(diagonal, float))))) == [0.0, 0.0, 0.0, 1.0]
    for axis in RNG.normal(size=(200, 3)):
        for angle in (np.pi, np.pi - 1e-9, np.pi + 1e-9, 1e-9):
            R = Rotation.from_rotvec(angle * axis / np.linalg.norm(axis)).as_matrix()
            R_back = Rotation.from_quat(wxyz_of(R), scalar_first=True).as_matrix()
            np.testing.assert_allclose(R_back, R, atol=1e-9)


def test_a_coloured_mesh_is_matt_and_has_its_own_colours():
    values = np.array([0.0, 0.5, 1.0])
    mesh = Mesh(np.eye(3), FACE, Field(values, 0.0, 1.0, "height"))
    glb = props_of({"x": mesh})["glb_data"].tobytes()
    (shape,) = trimesh.load_scene(io.BytesIO(glb), file_type="glb").geometry.values()
    assert isinstance(shape.visual, TextureVisuals)
    material = shape.visual.material
    assert isinstance(material, PBRMaterial)
    assert (material.metallicFactor, material.doubleSided, material.alphaMode) == (0.0, True, None)
    light = shape.visual.vertex_attributes["color"][:, :3] / 255.0  # GLB colours are linear
    seen = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    np.testing.assert_allclose(255 * seen, color_rows(mesh.color, 3), atol=3)


def test_colours_are_one_for_all_or_one_for_each_and_for_both_ends():
    two = Classes(np.array([0, 1]), ("truth", "wrong"), ("a", "b"))
    each = np.array([PALETTE["truth"], PALETTE["wrong"]])
    np.testing.assert_array_equal(
        props_of({"x": Segments(ENDS, "source")})["colors"], PALETTE["source"]
    )
    np.testing.assert_array_equal(
        props_of({"x": Segments(ENDS, two)})["colors"], np.repeat(each, 2, axis=0).ravel()
    )
    np.testing.assert_array_equal(
        props_of({"x": Points(np.eye(3)[:2], two)})["colors"], each.ravel()
    )
    np.testing.assert_array_equal(
        props_of({"x": Points(np.eye(3), "target")})["colors"], PALETTE["target"]
    )


def test_no_segments_and_no_points_are_no_node_and_what_stands_beside_is_none():
    assert shown({"x": Segments(np.zeros((0, 2, 3)))}) == {}
    assert shown({"x": Points(np.zeros((0, 3)))}) == {}
    beside = {
        path: primitive
        for path, primitive in fake.draw(fake._state(0)).items()
        if path.startswith("beside/")
    }
    assert beside
    assert shown(beside) == {}


def test_a_path_below_another_does_not_move_with_it():
    moved = np.eye(4)
    moved[:3, 3] = (5.0, 0.0, 0.0)
    p = np.zeros((1, 3))
    nodes = shown(
        {"camera": Points(p, T_world_object=moved), "camera/point": Points(p, T_world_object=moved)}
    )
    assert len(nodes) == 2
    assert not [
        (name, other)
        for name, other in itertools.permutations(nodes, 2)
        if other.startswith(name + "/")
    ]
    assert {pose[4:] for _, pose in nodes.values()} == {(5.0, 0.0, 0.0)}


def test_a_camera_with_an_image_is_a_frustum_and_its_picture():
    assert list(shown({"x": Camera(K, 64, 48, MOVED)})) == ["x"]
    nodes = shown({"x": Camera(K, 64, 48, MOVED, depth=2.0, image=PHOTO)})
    assert list(nodes) == ["x", "x/image"]
    assert [json.loads(kind.text)["type"] for kind, _ in nodes.values()] == [
        "LineSegmentsMessage",
        "ImageMessage",
    ]
    middle = np.linalg.inv(K) @ (31.5, 23.5, 1.0)  # of the pixels, whose first one is centred at 0
    np.testing.assert_allclose(nodes["x/image"][1], (1, 0, 0, 0, *(2.0 * middle)), atol=1e-9)
    size = json.loads(nodes["x/image"][0].text)["props"]
    assert (size["render_width"], size["render_height"]) == pytest.approx(
        (2.0 * 64 / 40, 2.0 * 48 / 40)
    )
    grey = shown({"x": Camera(K, 64, 48, MOVED, image=PHOTO[:, :, 0])})
    assert list(grey) == ["x", "x/image"]


def test_what_nobody_shows_any_more_is_let_go():
    maker = Maker()
    timeline = Timeline(fake.lesson, fake.Params(wobble=True)).complete()
    kept = timeline[0].scene
    shown(kept, maker)
    alone = maker.held()
    for k in range(len(timeline)):
        shown(timeline[k].scene, maker)
    assert maker.held() > 2 * alone > 0
    del timeline
    gc.collect()
    assert maker.held() == alone
    del kept
    gc.collect()
    assert maker.held() == 0


def test_making_nodes_leaves_nothing_to_a_collection_of_garbage():
    maker = Maker()
    scene = Timeline(fake.lesson, fake.Params()).complete()[0].scene
    gc.collect()
    gc.disable()
    try:
        assert len(shown(scene, maker)) > 1
        assert gc.collect() == 0, "arrays would be held until then"
    finally:
        gc.enable()


def test_who_asks_at_the_same_time_gets_the_same():
    timeline = Timeline(fake.lesson, fake.Params(steps=4, colors="classes")).complete()
    scenes = [step.scene for step in timeline.known()]
    alone = [
        [(name, kind.key, pose) for name, (kind, pose) in Maker().nodes(s, View()).items()]
        for s in scenes
    ]
    maker = Maker()
    results = []
    together = threading.Barrier(8)

    def ask(first: int) -> None:
        together.wait()
        for k in range(len(scenes)):
            at = (first + k) % len(scenes)
            nodes = maker.nodes(scenes[at], View())
            results.append((at, [(name, kind.key, pose) for name, (kind, pose) in nodes.items()]))

    threads = [threading.Thread(target=ask, args=(i,)) for i in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(results) == 8 * len(scenes)
    assert all(nodes == alone[at] for at, nodes in results)
    again = [maker.nodes(scene, View()) for scene in scenes]
    assert all(
        maker.nodes(s, View())[name][0] is kind
        for s, nodes in zip(scenes, again, strict=True)
        for name, (kind, _) in nodes.items()
    )
