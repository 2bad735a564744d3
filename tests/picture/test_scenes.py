"""A story as slides, and the words over a scene: in order, in place, and not over one another."""

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest
from PIL import Image

from tests import fake
from tests.story.hill import lesson as hill
from workbench.errors import InputError
from workbench.picture.asking import Asked
from workbench.picture.labels import labels_svg
from workbench.picture.making import scene_files
from workbench.picture.sheet import Style
from workbench.picture.stills import stills_of
from workbench.picture.theme import theme
from workbench.rendering.lens import Lens
from workbench.rendering.shapes import Word
from workbench.view import View

ASKED = Asked(style=Style(width=300))


def quiet(*_) -> None:
    pass


def test_a_story_has_a_slide_for_each_scene_in_order(tmp_path):
    out = tmp_path / "slides"
    files = scene_files(hill, out, ASKED, force=False, progress=quiet)
    assert sorted(out.iterdir()) == files
    assert [file.name[:3] for file in files] == [
        f"{i:02d}-" for i in range(1, len(stills_of(hill)) + 1)
    ]
    for file in files:
        with Image.open(file) as image:
            assert image.width == 300
    before = files[0].read_bytes()
    with pytest.raises(InputError, match="exists already"):
        scene_files(hill, out, ASKED, force=False, progress=quiet)
    scene_files(hill, out, ASKED, force=True, progress=quiet)
    assert files[0].read_bytes() == before


def test_slides_are_vectors_where_asked_to(tmp_path):
    asked = replace(ASKED, slides="svg")
    files = scene_files(hill, tmp_path, asked, force=False, progress=quiet)
    assert len(files) == len(stills_of(hill))
    for file in files:
        root = ElementTree.parse(file).getroot()
        assert file.suffix == ".svg"
        assert root.tag == "{http://www.w3.org/2000/svg}svg"
        assert root.get("width") == "300"


def test_slides_need_a_story_and_a_folder(tmp_path):
    with pytest.raises(InputError, match="has no story"):
        scene_files(fake.lesson, tmp_path, ASKED, force=False, progress=quiet)
    file = tmp_path / "file"
    file.touch()
    with pytest.raises(InputError, match="is not a folder"):
        scene_files(hill, file, ASKED, force=False, progress=quiet)


def boxes(words: list[Word]) -> np.ndarray:
    lens = Lens.of(View(eye=(0.0, -5.0, 0.0)), (400, 250))
    root = ElementTree.fromstring(f"<g>{labels_svg(words, lens, theme(dark=False))}</g>")
    names = ("x", "y", "width", "height")
    rows = [[float(rect.attrib[name]) for name in names] for rect in root.iter("rect")]
    return np.array(rows).reshape(-1, 4)


def test_words_at_one_place_do_not_cover_each_other():
    rects = boxes([Word(text=f"word {i}", p=np.zeros(3)) for i in range(4)])
    assert len(rects) == 4
    tops = np.sort(rects[:, 1])
    assert (np.diff(tops) >= rects[0, 3] - 0.1).all()


def test_a_word_that_stays_is_centred_at_its_place_and_others_go_out_of_its_way():
    near, a, b = boxes(
        [
            Word(text="near", p=np.array([0.0, -1.0, 0.0])),
            Word(text="244", p=np.zeros(3), stays=True),
            Word(text="67", p=np.array([0.02, 0.0, 0.0]), stays=True),
        ]
    )[[2, 0, 1]]
    assert a[1] + a[3] / 2 == pytest.approx(125, abs=0.06)
    assert b[1] == a[1]
    assert near[1] + near[3] <= a[1] + 0.1 or near[1] >= a[1] + a[3] - 0.1


def test_a_word_at_the_side_is_whole_and_one_outside_is_left_out():
    (box,) = boxes([Word(text="a long word at the side", p=np.array([3.25, 0.0, 0.0]))])
    assert box[0] + box[2] <= 400.1
    assert len(boxes([Word(text="away", p=np.array([9.0, 0.0, 0.0]))])) == 0
    assert len(boxes([Word(text="behind", p=np.array([0.0, -9.0, 0.0]))])) == 0
