"""What is written is what viser's own scene API says: of every primitive, of the stage, and of the
default runs of all lessons; `python -m tests.wire.test_writer` compares all presets.
"""

import io
import itertools
import json
import sys
from typing import Any

import imageio.v3 as iio
import numpy as np
import pytest
import trimesh
from PIL import Image

from tests.wire.kinds import KINDS
from tests.wire.listener import Listener
from workbench.lesson import View, catalog
from workbench.machinery.images import plain_png
from workbench.run.timeline import Timeline
from workbench.scene import Scene
from workbench.wire.glb import glb_of
from workbench.wire.nodes import Maker, Node
from workbench.wire.writer import as_jpeg, as_png

STEPS = 4
"""So many steps of a run are compared, evenly over it: its first and its last among them."""
VIEWS = (View(), View(axes=False, grid=None), View(up=(0.0, -1.0, 0.0), grid=0.1, grid_height=2.0))
PIXELS = "_data"


def said(node: Node) -> tuple[Any, Any]:
    """What is said of a node, its arrays by their content; the bytes of a picture are left out:
    viser takes OpenCV where it is installed.
    """
    kind, pose = node
    told = json.loads(kind.text)
    if PIXELS in told["props"]:
        told["props"] = {key: v for key, v in told["props"].items() if key != PIXELS}
    return told, pose


class Both:
    """Makes nodes by viser and by the writer."""

    def __init__(self) -> None:
        self.viser = Maker(Listener)
        self.ours = Maker()


def assert_alike(scene: Scene, view: View, both: Both) -> None:
    theirs = both.viser.nodes(scene, view)
    mine = both.ours.nodes(scene, view)
    assert list(mine) == list(theirs)
    for name, node in theirs.items():
        assert said(mine[name]) == said(node), name


@pytest.mark.parametrize("scene", KINDS, ids=range(len(KINDS)))
def test_a_primitive_is_written_as_viser_says_it(scene):
    assert_alike(scene, VIEWS[1], Both())


@pytest.mark.parametrize("view", VIEWS, ids=range(len(VIEWS)))
def test_a_stage_is_written_as_viser_says_it(view):
    both = Both()
    assert_alike({}, view, both)
    plain = [
        [{key: v for key, v in told.items() if key != "owner"} for told in maker.stage(view).light]
        for maker in (both.viser, both.ours)
    ]
    assert json.loads(json.dumps(plain[0])) == json.loads(json.dumps(plain[1]))


def assert_run_alike(lesson: Any, params: Any) -> None:
    steps = Timeline(lesson, params).complete().known()
    both = Both()
    for k in sorted({round(k) for k in np.linspace(0, len(steps) - 1, STEPS)}):
        assert_alike(steps[k].scene, lesson.view_of(params), both)


@pytest.mark.parametrize("name", catalog())
def test_a_lessons_default_run_is_written_as_viser_says_it(name):
    lesson = catalog()[name]
    assert_run_alike(lesson, lesson.params())


def test_a_glb_is_what_trimeshs_own_reader_takes_it_for():
    rng = np.random.default_rng(0)
    p = rng.normal(size=(5, 3)).astype(np.float32)
    faces = np.array([[0, 1, 2], [2, 3, 4]])
    colors = rng.integers(0, 256, (5, 4)).astype(np.uint8)
    scene: Any = trimesh.load(
        trimesh.util.wrap_as_stream(glb_of(p, faces, colors)), file_type="glb", process=False
    )
    (mesh,) = scene.geometry.values()
    np.testing.assert_array_equal(mesh.vertices, p)
    np.testing.assert_array_equal(mesh.faces, faces)
    np.testing.assert_array_equal(mesh.visual.vertex_attributes["color"], colors)
    assert (mesh.visual.material.metallicFactor, mesh.visual.material.doubleSided) == (0.0, True)


@pytest.mark.parametrize("shape", [(7, 5), (7, 5, 3), (1, 1), (2, 300, 3)])
def test_a_png_without_pillow_is_the_same_picture_to_pillow(shape):
    image = np.random.default_rng(0).integers(0, 256, shape).astype(np.uint8)
    np.testing.assert_array_equal(np.array(Image.open(io.BytesIO(plain_png(image)))), image)


def test_a_picture_is_encoded_as_by_a_viser_without_opencv():
    image = np.random.default_rng(0).integers(0, 256, (40, 60, 3)).astype(np.uint8)
    assert as_jpeg(image) == ("jpeg", iio.imwrite("<bytes>", image, extension=".jpeg", quality=75))
    assert as_png(image) == ("png", plain_png(image))


if __name__ == "__main__":
    for lesson in catalog().values():
        for run in itertools.chain(["default"], (preset.name for preset in lesson.presets)):
            assert_run_alike(lesson, lesson.run_params(run))
        sys.stdout.write(f"{lesson.name}: {len(lesson.presets) + 1} runs alike\n")
