"""How things look: mixed with the page's backdrop, seen through, as ghosts, standing out; in closed
form.
"""

import io
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import trimesh
from PIL import Image

from tests.browser.feeding import Fed
from tests.fake import K
from tests.wire.kinds import ENDS, FACE, GREEN, MOVED, SMALL
from workbench.scene import (
    PALETTE,
    Axes,
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

pytestmark = pytest.mark.browser
# of viser's canvas, in the light and in the dark
BACKDROPS = {False: (255, 255, 255), True: (20, 21, 23)}
TWO = Classes(np.array([0, 1]), ("truth", "wrong"), ("a", "b"))
HEIGHT = Field(np.arange(3.0), 0.0, 2.0, "h")


@pytest.fixture(scope="module")
def fed(chromium) -> Iterator[Fed]:
    fed = Fed(chromium)
    yield fed
    fed.close()


SHOWN = """async ([k, path, pin, dark]) => {
  Object.assign(sceneView, { nodes: scenes[k].nodes, path, pinned: pinned(pin) });
  feed.theme(dark);
  sceneView.again();
  await settled();
  const listed = (value) => (ArrayBuffer.isView(value) ? [...value] : value);
  return Object.fromEntries(Object.entries(client.seen()).map(([name, { props, ...more }]) => [name,
    { ...more, ...Object.fromEntries(Object.entries(props).map(([key, value]) => [key, listed(value)])) }]));
}"""


def shown(
    fed: Fed, scene: Scene, *, path: str = "", pin: Scene | None = None, dark: bool = False
) -> dict[str, Any]:
    """Return what a client has of a scene, by name: properties, arrays as lists, and places."""
    numbers = fed.add([scene, *([] if pin is None else [pin])])
    return fed(SHOWN, [numbers[0], path, None if pin is None else numbers[1], dark])


def mixed(rgb: Any, opacity: float, dark: bool) -> np.ndarray:
    share = opacity**0.6 if dark else opacity  # the eye sees less of a faint thing in the dark
    return np.floor(
        share * np.asarray(rgb, float) + (1 - share) * np.array(BACKDROPS[dark]) + 0.5
    ).astype(int)


def as_light(rgb: np.ndarray) -> np.ndarray:
    level = rgb / 255.0
    return 255.0 * np.where(level <= 0.04045, level / 12.92, ((level + 0.055) / 1.055) ** 2.4)


@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("opacity", [0.0, 0.3, 0.6, 1.0])
def test_what_is_faded_is_mixed_with_the_backdrop_of_the_page(fed, opacity, dark):
    scene: Scene = {
        "one": Points(np.eye(3), "source", opacity=opacity),
        "each": Points(np.eye(3), GREEN, opacity=opacity),
        "line": Segments(ENDS, "target", opacity=opacity),
        "lines": Segments(ENDS, TWO, opacity=opacity),
        "axes": Axes(opacity=opacity),
        "camera": Camera(K, 64, 48, color="truth", opacity=opacity),
        "mesh": Mesh(np.eye(3), FACE, "target", opacity=opacity),
        "word": Label("w", np.zeros(3), opacity=opacity),
    }
    nodes = {
        name.removeprefix("/scene/"): node for name, node in shown(fed, scene, dark=dark).items()
    }
    arrows = [PALETTE[axis] for axis in ("x", "y", "z")]
    for name, rgb in (("one", PALETTE["source"]), ("each", GREEN), ("axes", arrows)):
        np.testing.assert_array_equal(
            np.reshape(nodes[name]["colors"], (-1, 3)), np.atleast_2d(mixed(rgb, opacity, dark))
        )
    for name, rgb in (("line", PALETTE["target"]), ("camera", PALETTE["truth"])):
        # one for all is sRGB
        np.testing.assert_array_equal(nodes[name]["colors"], mixed(rgb, opacity, dark))
    ends = np.repeat([PALETTE["truth"], PALETTE["wrong"]], 2, axis=0)
    np.testing.assert_allclose(  # one for each end is linear light
        np.reshape(nodes["lines"]["colors"], (-1, 3)),
        as_light(mixed(ends, opacity, dark)),
        atol=0.5,
    )
    assert nodes["mesh"]["opacity"] == (opacity if opacity < 1 else None)
    assert nodes["mesh"]["color"] == list(PALETTE["target"])
    assert fed("() => labels.words.get('/scene/word').style.opacity") == f"{opacity:g}"


def test_only_what_is_faded_is_sent_again_where_the_light_changes(fed):
    faded = Points(np.eye(3), "source", opacity=0.5)
    full = Points(np.eye(3), "source")
    shown(fed, {"faded": faded, "full": full, "mesh": Mesh(np.eye(3), FACE, HEIGHT, opacity=0.5)})
    messages = fed(
        "() => { client.said = []; feed.theme(true); return client.said.map(({ type, name }) =>"
        " [type, name]); }"
    )
    assert messages == [
        ["ThemeConfigurationMessage", None],
        ["SceneNodeUpdateMessage", "/scene/faded"],
    ]
    assert fed("() => feed.client.said.at(-1).updates.points === undefined"), "its colours alone"


@pytest.mark.parametrize("opacity", [0.0, 0.35, 0.8])
def test_a_coloured_surface_that_is_seen_through_is_a_file_that_others_read(fed, opacity):
    mesh = Mesh(np.eye(3), FACE, HEIGHT, opacity=opacity)
    opaque = bytes(shown(fed, {"m": replace(mesh, opacity=1.0)})["/scene/m"]["glb_data"])
    glb = bytes(shown(fed, {"m": mesh})["/scene/m"]["glb_data"])
    words = np.frombuffer(glb, "<u4")
    assert (words[0], words[2], words[4]) == (0x46546C67, len(glb), 0x4E4F534A)
    assert words[3] % 4 == 0 == len(glb) % 4
    start = 20 + int(words[3])
    length, kind = np.frombuffer(glb[start : start + 8], "<u4")
    assert (kind, start + 8 + length) == (0x004E4942, len(glb))
    (faded,), (before,) = (
        trimesh.load_scene(io.BytesIO(file), file_type="glb").geometry.values()
        for file in (glb, opaque)
    )
    assert faded.visual.material.alphaMode == "BLEND"
    assert before.visual.material.alphaMode is None
    colors, own = (surface.visual.vertex_attributes["color"] for surface in (faded, before))
    np.testing.assert_array_equal(colors[:, 3], round(255 * opacity))
    np.testing.assert_array_equal(colors[:, :3], own[:, :3])
    np.testing.assert_allclose(255 * (own[:, :3] / 255), as_light(color_rows(HEIGHT, 3)), atol=0.51)
    np.testing.assert_array_equal(faded.vertices, np.eye(3))
    np.testing.assert_array_equal(faded.faces, FACE)


@pytest.mark.parametrize("opacity", [0.25, 0.5])
@pytest.mark.parametrize("name", ["/scene/p", "/scene/p/image"])
def test_a_faded_picture_comes_as_one_that_is_seen_through(fed, opacity, name):
    thing = Picture(SMALL, width=0.5) if name == "/scene/p" else Camera(K, 64, 48, image=SMALL)
    opaque = shown(fed, {"p": thing})[name]
    node = shown(fed, {"p": replace(thing, opacity=opacity)})[name]
    assert node["_format"] == "png"
    image, before = (Image.open(io.BytesIO(bytes(picture["_data"]))) for picture in (node, opaque))
    assert (image.mode, image.size) == ("RGBA", SMALL.shape[1::-1])
    rgba = np.asarray(image).astype(int)
    np.testing.assert_allclose(rgba[:, :, 3], 255 * opacity, atol=1)
    assert np.abs(rgba[:, :, :3] - np.asarray(before.convert("RGB")).astype(int)).mean() < 3
    same = ("position", "wxyz", "render_width", "render_height")
    assert [node[key] for key in same] == [opaque[key] for key in same]


ROOM: Scene = {
    "source/points": Points(np.eye(3), "source"),
    "source/normals": Segments(ENDS, "truth"),
    "source/faint": Points(np.eye(3), "source", opacity=0.2),
    "sources": Points(np.eye(3), "other"),
    "camera": Camera(K, 64, 48, image=SMALL),
    "box": Mesh(np.eye(3), FACE, "target"),
    "name": Label("here", np.zeros(3)),
}


def test_what_is_read_of_stands_out_and_the_rest_steps_back(fed):
    plain = shown(fed, ROOM)
    seen = shown(fed, ROOM, path="source")
    assert seen.keys() == plain.keys()
    points, normals, faint = (
        seen[f"/scene/source·{name}"] for name in ("points", "normals", "faint")
    )
    assert points["point_size"] == pytest.approx(1.6 * 0.01)
    assert points["colors"] == list(PALETTE["source"])
    assert normals["thickness"] == pytest.approx(2 * 1.5)
    np.testing.assert_array_equal(faint["colors"], mixed(PALETTE["source"], 0.8, False))
    other = seen["/scene/sources"]  # begins alike, is another
    np.testing.assert_array_equal(other["colors"], mixed(PALETTE["other"], 0.3, False))
    assert other["point_size"] == plain["/scene/sources"]["point_size"]
    assert seen["/scene/box"]["opacity"] == pytest.approx(0.3)
    assert seen["/scene/camera/image"]["_format"] == "png"
    assert fed("() => labels.words.get('/scene/name').style.opacity") == "1", (
        "words say what is seen"
    )
    for name in plain:
        if not name.startswith("/scene/"):
            assert {**seen[name], "made": 0} == {**plain[name], "made": 0}, "the stage"
    whole = shown(fed, ROOM, path="camera")
    assert whole["/scene/camera"]["thickness"] == 2 * plain["/scene/camera"]["thickness"]
    assert whole["/scene/camera/image"]["_format"] == plain["/scene/camera/image"]["_format"], (
        "its picture is a part of it"
    )


@pytest.mark.parametrize(
    "path", ["sour", "caption", "source/points/x", "source·", "/", "camera/image/x"]
)
def test_a_name_of_nothing_changes_nothing(fed, path):
    (k,) = fed.add([ROOM])
    assert fed("([k, path]) => lit(scenes[k].nodes, path) === scenes[k].nodes", [k, path])


def ghosts(fed: Fed, scene: Scene, pin: Scene, *, dark: bool = False) -> dict[str, Any]:
    """Return the ghosts of a pinned scene behind another, by what follows `/ghost/`."""
    nodes = shown(fed, scene, pin=pin, dark=dark)
    return {
        name.removeprefix("/ghost/"): node
        for name, node in nodes.items()
        if name.startswith("/ghost/")
    }


EVERY: Scene = {
    "points": Points(np.eye(3), "source"),
    "lines": Segments(ENDS, "truth", 2.0),
    "mesh": Mesh(np.eye(3), FACE, "target", opacity=0.5),
    "height": Mesh(np.eye(3), FACE, HEIGHT),
    "axes": Axes(),
    "camera": Camera(K, 64, 48, image=SMALL),
    "picture": Picture(SMALL, width=0.5),
    "word": Label("w", np.ones(3)),
}
MOVED_ALL: Scene = {path: replace(thing, T_world_object=MOVED) for path, thing in EVERY.items()}  # type: ignore[type-var]


def test_what_is_at_its_place_has_no_ghost_however_it_is_coloured(fed):
    copy = {path: replace(thing) for path, thing in EVERY.items()}  # type: ignore[type-var]
    other = copy | {
        "points": Points(np.eye(3), GREEN, opacity=0.5),
        "lines": Segments(ENDS, TWO, 2.0),
        "mesh": Mesh(np.eye(3), FACE, "wrong"),
        "height": Mesh(np.eye(3), FACE, Field(np.arange(3.0), 0.0, 9.0, "h")),
        "camera": Camera(K, 64, 48, color="wrong"),
    }
    assert ghosts(fed, EVERY, copy) == ghosts(fed, other, EVERY) == ghosts(fed, EVERY, other) == {}


@pytest.mark.parametrize("dark", [False, True])
def test_what_is_elsewhere_has_a_fine_and_pale_ghost_where_it_was(fed, dark):
    nodes = ghosts(fed, MOVED_ALL, EVERY, dark=dark)
    assert nodes.keys() == {
        "points",
        "lines",
        "mesh",
        "height",
        "axes",
        "camera",
    }, "no words, no pictures"
    assert all(
        (node["wxyz"], node["position"]) == ([1, 0, 0, 0], [0, 0, 0]) for node in nodes.values()
    )
    np.testing.assert_array_equal(nodes["points"]["colors"], mixed(PALETTE["source"], 0.25, dark))
    np.testing.assert_array_equal(nodes["lines"]["colors"], mixed(PALETTE["truth"], 0.25, dark))
    assert nodes["points"]["point_size"] == pytest.approx(0.4 * 0.01)
    assert nodes["lines"]["thickness"] == pytest.approx(0.6 * 2.0)
    assert nodes["mesh"]["opacity"] == pytest.approx(0.25 * 0.5)
    (surface,) = trimesh.load_scene(
        io.BytesIO(bytes(nodes["height"]["glb_data"])), file_type="glb"
    ).geometry.values()
    np.testing.assert_array_equal(surface.visual.vertex_attributes["color"][:, 3], 64)


def test_what_is_gone_has_a_ghost_and_of_a_camera_its_frustum_alone(fed):
    assert ghosts(fed, {}, EVERY).keys() == EVERY.keys() - {"word"}
    bare = {"camera": Camera(K, 64, 48)}
    assert ghosts(fed, bare, {"camera": EVERY["camera"]}) == {}


def test_what_has_another_shape_has_a_ghost(fed):
    p = np.eye(3) + 0.1
    others: Scene = {
        "points": Points(p, "source"),
        "lines": Segments(ENDS[:1], "truth"),
        "mesh": Mesh(p, FACE, "target"),
        "height": Mesh(p, FACE, HEIGHT),
        "axes": Axes(length=1.0),
    }
    assert ghosts(fed, EVERY, others).keys() == others.keys()


def test_a_ghost_stays_while_steps_go_by(fed):
    steps = [
        {"points": replace(EVERY["points"], T_world_object=T)} for T in (None, MOVED, MOVED @ MOVED)
    ]  # type: ignore[type-var]
    numbers = list(fed.add(steps))  # type: ignore[arg-type]
    walk = """async ([first, ...others]) => {
      Object.assign(sceneView, { nodes: scenes[first].nodes, path: "", pinned: null });
      sceneView.pin(true);
      const found = [];
      for (const k of [...others, first]) {
        sceneView.step(scenes[k].nodes, 1); finish();
        found.push(client.seen()["/ghost/points"]?.position ?? null);
      }
      sceneView.pin(false);
      return found;
    }"""
    assert fed(walk, numbers) == [[0, 0, 0], [0, 0, 0], None]
