import io
from dataclasses import fields, is_dataclass, replace

import numpy as np
import pytest
import trimesh
import viser
from trimesh.visual import TextureVisuals
from trimesh.visual.material import PBRMaterial

from tests.fake import PHOTO, K, Params, lesson
from tests.viewer.browser_scene import Windows, all_pairs, difference
from workbench.scene import Axes, Camera, Field, Label, Mesh, Picture, Points, Segments, color_rows, in_space, same
from workbench.timeline import Timeline
from workbench.viewer.sink import ROOT, ViserSink


@pytest.fixture(scope="module")
def server():
    server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    yield server
    server.stop()


@pytest.fixture
def sink(server):
    server.scene.reset()
    return ViserSink(server.scene)


@pytest.fixture(params=["field", "classes", "measured", "role"])
def scenes(request):
    timeline = Timeline(lesson, Params(colors=request.param, wobble=request.param == "role")).complete()
    return [step.scene for step in timeline.known()]


def nodes(server) -> dict:
    """What viser holds: every node's properties and pose."""
    found = {}
    for name, handle in server.scene._handle_from_node_name.items():
        if name.startswith(ROOT):
            props = getattr(handle._impl, "props", None)
            values = {f.name: getattr(props, f.name) for f in fields(props)} if is_dataclass(props) else {}
            found[name] = values | {"wxyz": np.array(handle.wxyz), "position": np.array(handle.position)}
    return found


def alike(a, b) -> bool:
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        a, b = np.asarray(a), np.asarray(b)
        try:
            a, b = np.broadcast_arrays(a, b)
        except ValueError:
            return False
        return bool(np.allclose(a.astype(float), b.astype(float), atol=1e-5))
    return a == b


def assert_equal_nodes(a: dict, b: dict) -> None:
    assert a.keys() == b.keys()
    for name in a:
        for key in a[name]:
            assert alike(a[name][key], b[name][key]), f"{name}.{key}"


def test_showing_one_scene_after_another_leaves_exactly_the_other(server, scenes):
    for before in range(0, 6, 2):
        for after in range(6):
            server.scene.reset()
            sink = ViserSink(server.scene)
            sink.show(scenes[before])
            sink.show(scenes[after])
            got = nodes(server)
            server.scene.reset()
            ViserSink(server.scene).show(scenes[after])
            assert_equal_nodes(got, nodes(server))


MOVED = np.array([[0.0, -1, 0, 0.3], [1, 0, 0, 0.2], [0, 0, 1, 0.1], [0, 0, 0, 1]])
KINDS: list[dict] = [
    {"x": Points(np.eye(3), "source", T_world_object=MOVED)},
    {"x": Points(np.eye(3)[:2], "target")},
    {"x": Segments(np.zeros((2, 2, 3)), "source", T_world_object=MOVED)},
    {"x": Segments(np.zeros((0, 2, 3)))},
    {"x": Mesh(np.eye(3), np.array([[0, 1, 2]]), "source", MOVED)},
    {"x": Mesh(np.eye(3), np.array([[0, 1, 2]]), Field(np.arange(3.0), 0, 2, "h"))},
    {"x": Axes(MOVED)},
    {"x": Camera(K, 64, 48, MOVED, image=PHOTO)},
    {"x": Camera(K, 64, 48)},
    {"x": Camera(K, 64, 48, image=PHOTO, opacity=0.5)},
    {"x": Label("a", np.ones(3), T_world_object=MOVED)},
    {"x": Label("b", np.zeros(3))},
    {"x": Picture(PHOTO, width=0.5, T_world_object=MOVED)},
    {"x": Picture(PHOTO, width=0.5, opacity=0.5)},
    {},
]


@pytest.mark.parametrize("batch", [1, 2, 3], ids=["each sent", "two in a batch", "three in a batch"])
def test_whatever_was_at_a_path_before_leaves_nothing_in_the_browser(server, monkeypatch, batch):
    alone = []
    for scene in KINDS:
        with monkeypatch.context() as patch:
            windows, sink = Windows(server, patch), ViserSink(server.scene)
            sink.show(scene)
            alone.append(windows.send().seen(ROOT))
            sink.show({})
    windows, sink = Windows(server, monkeypatch), ViserSink(server.scene)
    for k, i in enumerate(all_pairs(len(KINDS))):
        sink.show(KINDS[i])
        if k % batch == 0:
            assert difference(windows.send().seen(ROOT), alone[i]) == "", f"{KINDS[i]} as number {k}"
        if k % 7 == 0:
            sink.repaint((255, 255, 255))


def test_how_far_a_picture_is_seen_through_is_sent(server, sink):
    sent = {}
    for opacity in (1.0, 0.5, 0.2, 1.0):
        sink.show({"x": Picture(PHOTO, width=0.5, opacity=opacity)})
        node = nodes(server)[f"{ROOT}x"]
        again = sent.setdefault(opacity, node["_data"])
        assert node["_data"] == again
    assert len(set(sent.values())) == 3


def test_an_empty_scene_leaves_nothing(server, sink, scenes):
    sink.show(scenes[2])
    assert nodes(server)
    sink.show({})
    assert not nodes(server)


class Count:
    """Counts what is sent: messages by type, and the bytes of the arrays and texts they hold."""

    def __init__(self, server, monkeypatch):
        self.names: list[str] = []
        self.bytes = 0
        interface = server.scene._websock_interface
        queue = interface.queue_message

        def counted(message, *args, **kwargs):
            self.names.append(type(message).__name__)
            self.bytes += sum(size(value) for value in vars(message).values())
            return queue(message, *args, **kwargs)

        monkeypatch.setattr(interface, "queue_message", counted)


def size(value) -> int:
    if isinstance(value, np.ndarray):
        return value.nbytes
    if isinstance(value, (bytes, str)):
        return len(value)
    if isinstance(value, dict):
        return sum(map(size, value.values()))
    if isinstance(value, (tuple, list)):
        return sum(map(size, value))
    return sum(size(getattr(value, f.name)) for f in fields(value)) if is_dataclass(value) else 8


def test_a_moved_cloud_is_sent_as_a_pose(server, sink, monkeypatch):
    p = np.random.default_rng(0).uniform(size=(20_000, 3))
    turned = np.array([[0.0, -1, 0, 0.3], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    cloud = {"source": Points(p, "source", T_world_object=np.eye(4))}
    sink.show(cloud)
    count = Count(server, monkeypatch)
    sink.show({"source": replace(cloud["source"], T_world_object=turned)})
    assert set(count.names) == {"SetOrientationMessage", "SetPositionMessage"}
    assert count.bytes < 300
    np.testing.assert_allclose(sink.handle("source").position, [0.3, 0, 0])


def test_what_stays_is_not_sent_again(server, sink, scenes, monkeypatch):
    sink.show(scenes[1])
    count = Count(server, monkeypatch)
    sink.show(scenes[1])
    sink.show({path: replace(primitive) for path, primitive in scenes[1].items()})
    assert count.names == []


def test_another_number_of_points_keeps_points_and_colours_together(server, sink):
    few, many = np.zeros((3, 3)), np.ones((7, 3))
    for p in (few, many, few):
        sink.show({"cloud": Points(p, np.zeros((len(p), 3), np.uint8))})
        assert sink.handle("cloud").points.shape == p.shape


def test_repainting_keeps_what_is_shown(sink, scenes):
    sink.show(scenes[2])
    before = sink.shown()
    sink.repaint((20, 20, 20))
    assert same(before, sink.shown())
    assert all(in_space(primitive) for primitive in before.values())


def test_a_path_below_another_does_not_move_with_it(server, sink):
    moved = np.eye(4)
    moved[:3, 3] = (5.0, 0.0, 0.0)
    p = np.zeros((1, 3))
    sink.show({"camera": Points(p, T_world_object=moved), "camera/point": Points(p, T_world_object=moved)})
    parents = {name for name in nodes(server) if any(other.startswith(name + "/") for other in nodes(server))}
    assert not parents
    np.testing.assert_allclose(sink.handle("camera/point").position, (5.0, 0.0, 0.0))


@pytest.mark.parametrize("opacity", [1.0, 0.5])
def test_a_coloured_mesh_is_matt_and_has_its_own_colours(server, sink, opacity):
    p, values = np.eye(3), np.array([0.0, 0.5, 1.0])
    mesh = Mesh(p, np.array([[0, 1, 2]]), Field(values, 0.0, 1.0, "height"), opacity=opacity)
    sink.show({"mesh": mesh})
    data = nodes(server)[ROOT + "mesh"]["glb_data"]
    (shape,) = trimesh.load_scene(io.BytesIO(data), file_type="glb").geometry.values()
    assert isinstance(shape.visual, TextureVisuals)
    material = shape.visual.material
    assert isinstance(material, PBRMaterial)
    assert (material.metallicFactor, material.doubleSided) == (0.0, True)
    assert material.alphaMode == ("BLEND" if opacity < 1 else None)
    light = shape.visual.vertex_attributes["color"][:, :3] / 255.0  # GLB colours are linear
    seen = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    np.testing.assert_allclose(255 * seen, color_rows(mesh.color, 3), atol=3)
