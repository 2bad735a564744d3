"""`workbench picture`: what is in a still, that it is the same twice, and one line for what cannot
be.
"""

import io
import re
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from PIL import Image, ImageColor

from tests import fake
from workbench.cli import main
from workbench.lesson import catalog
from workbench.picture import letters
from workbench.picture.asking import Asked
from workbench.picture.making import WholeRun, pictured
from workbench.picture.sheet import Style, image_of, svg_of
from workbench.picture.theme import theme
from workbench.rendering.shapes import Discs, Strokes, shapes_of

SVG = "{http://www.w3.org/2000/svg}"
FAKE = str(Path(fake.__file__))
ICP = "icp"


def quiet(*_) -> None:
    pass


@pytest.fixture(scope="module")
def icp() -> WholeRun:
    lesson = catalog()[ICP]
    return WholeRun.of(lesson, lesson.params(), quiet)


def told(capsys) -> str:
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    return err


@pytest.mark.parametrize("kind", ["png", "svg", "webp"])
def test_two_runs_write_equal_bytes(tmp_path, kind):
    files = [tmp_path / f"{i}.{kind}" for i in range(2)]
    for file in files:
        assert main(["picture", FAKE, "--step", "1", "--width", "300", "-o", str(file)]) == 0
    first, second = (file.read_bytes() for file in files)
    assert first == second
    assert len(first) > 1000


def test_a_picture_has_the_width_and_the_ground_that_are_asked_for(icp):
    for dark in (False, True):
        for width in (160, 500):
            image = image_of(
                icp.moment(3, Style(width=width, dark=dark)), Style(width=width, dark=dark)
            )
            assert image.width == width
            assert image.getpixel((0, 0)) == ImageColor.getrgb(theme(dark=dark).paper)


def test_the_dark_ground_is_that_of_the_page_and_of_its_scene():
    looks = (Path(letters.STATIC) / "looks.js").read_text(encoding="utf-8")
    grounds = re.search(r"BACKDROPS = \{ false: \[(.*?)\], true: \[(.*?)\] \}", looks)
    assert grounds is not None
    for dark, ground in enumerate(grounds.groups()):
        rgb = tuple(int(value) for value in ground.split(","))
        assert ImageColor.getrgb(theme(dark=bool(dark)).paper) == rgb


def test_an_svg_has_a_circle_for_each_point_and_a_line_for_each_segment(icp):
    style = Style(width=700, chart=False)
    moment = icp.moment(3, style)
    # goes beyond
    inside = {path: primitive for path, primitive in moment.scene.items() if path != "grid"}
    moment = replace(moment, scene=inside)
    root = ElementTree.fromstring(svg_of(moment, style))
    (vectors,) = (group for group in root.iter(f"{SVG}g") if group.get("class") == "vectors")
    shapes = shapes_of(moment.scene)
    points = sum(len(shape.p) for shape in shapes if isinstance(shape, Discs))
    lines = sum(len(shape.ends) for shape in shapes if isinstance(shape, Strokes))
    assert len(list(vectors.iter(f"{SVG}circle"))) == points > 0
    assert len(list(vectors.iter(f"{SVG}line"))) == lines > 0


def test_an_svg_has_its_surfaces_as_one_picture_and_its_words_as_text():
    lesson = catalog()["curvature"]
    style = Style(width=500)
    run = WholeRun.of(lesson, lesson.params(), quiet)
    root = ElementTree.fromstring(svg_of(run.moment(0, style), style))
    assert len(list(root.iter(f"{SVG}image"))) == 1
    words = " ".join("".join(text.itertext()) for text in root.iter(f"{SVG}text"))
    assert run.timeline[0].caption.text.split()[0] in words
    assert any(group.get("class") == "chart" for group in root.iter(f"{SVG}g"))


def test_a_picture_without_chart_and_caption_is_lower(icp):
    heights = [
        image_of(icp.moment(3, style), style).height
        for style in (
            Style(width=400),
            Style(width=400, chart=False),
            Style(width=400, chart=False, caption=False),
        )
    ]
    assert heights[0] > heights[1] > heights[2] >= 250


def test_words_have_letters_for_greek_arrows_and_powers():
    for text in ("R = 12°", "θ → λ₁", "m⁻²", "−3 ≤ × ± …"):
        assert letters.width(text, 16) > 8
    assert [which for which, _ in letters._runs("a→b")] == [0, 1, 0]
    image = Image.new("L", (60, 40))
    letters.write(image, (5, 30), "θ", size=30, weight=letters.PLAIN, ink="#ffffff")
    assert np.asarray(image).max() > 200


def test_lines_of_words_fit_and_lose_none():
    text = "A caption that is longer than one line of the picture is broken at its spaces."
    lines = letters.lines(text, 16, 200)
    assert " ".join(lines) == text
    assert max(letters.width(line, 16) for line in lines) <= 200


def test_a_step_counts_from_the_end_too(tmp_path, capsys):
    files = [tmp_path / name for name in ("a.png", "b.png")]
    run = WholeRun.of(fake.lesson, fake.lesson.params(), quiet)
    n = len(run.timeline)
    for file, step in zip(files, ("-1", str(n - 1)), strict=True):
        assert main(["picture", FAKE, "--step", step, "--width", "200", "-o", str(file)]) == 0
    assert files[0].read_bytes() == files[1].read_bytes()
    capsys.readouterr()
    assert main(["picture", FAKE, "--step", str(n), "-o", str(tmp_path / "c.png")]) == 2
    assert f"0 to {n - 1}" in told(capsys)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["-o", "x.bmp"], ".png, .svg or .webp"),
        (["-o", "x"], ".png, .svg or .webp"),
        (["-o", "x.png", "--width", "100"], "160 to 3840"),
        (["-o", "x.png", "--width", "4000"], "160 to 3840"),
        (["-o", "x.png", "--from", "1"], "are of a film"),
        (["-o", "x.gif", "--step", "1"], "--from and --to"),
        (["-o", "x.gif", "--seconds", "0"], "0.1 to 120"),
        (["-o", "x.gif", "--seconds", "inf"], "0.1 to 120"),
        (["-o", "x.gif", "--from", "999"], "the run has"),
        (["-o", "folder", "--scenes", "--width", "4000"], "160 to 3840"),
        (["-o", "folder", "--scenes", "--step", "1"], "a story says its steps"),
        (["-o", "folder", "--scenes", "--captions", "beside"], "beside films"),
        (["-o", "x.gif", "--width", "3840", "--seconds", "100"], "too many"),
        (["-o", "x.png", "--captions", "beside"], "beside films"),
        (["-o", "x.png", "--captions", "loud"], "picture, beside, none"),
        (["-o", "x.png", "--as", "svg"], "is of --scenes"),
        (["-o", "folder", "--scenes", "--as", "gif"], "png, svg"),
        (["-o", "missing/x.png"], "no such folder"),
        (["-o", "folder", "--scenes"], "has no story"),
    ],
)
def test_what_cannot_be_is_one_line_and_writes_nothing(
    words, message, tmp_path, *, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    assert main(["picture", FAKE, *words]) == 2
    assert message in told(capsys)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["-o", "x.png", "--step", "5000"], "--step 5000: a run has 5000 steps at most"),
        (["-o", "x.png", "--step", "-5001"], "5000 steps at most"),
        (["-o", "x.gif", "--from", "9999"], "--from 9999: a run has"),
        (["-o", "x.gif", "--to", "9999"], "--to 9999: a run has"),
        (["-o", "x.gif", "--to", "400", "--width", "3840"], "too many for .gif"),
        (["-o", "x.webp", "--from", "-400", "--to", "-1", "--width", "3840"], "too many for .webp"),
        (["-o", "x.gif", "--from", "9", "--to", "0", "--seconds", "90", "--width", "3840"], "many"),
    ],
)
def test_what_is_known_before_the_run_is_said_before_it(
    words, message, *, tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(WholeRun, "of", lambda *_: pytest.fail("the run was computed"))
    assert main(["picture", FAKE, *words]) == 2
    assert message in told(capsys)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "words", [["x.png", "--step", "999"], ["x.gif", "--from", "0", "--to", "9"]]
)
def test_a_step_beyond_the_end_is_said_before_anything_is_drawn(
    words, *, tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("workbench.picture.making.image_of", lambda *_: pytest.fail("was drawn"))
    monkeypatch.setattr("workbench.picture.making.png_of", lambda *_: pytest.fail("was drawn"))
    assert main(["picture", FAKE, "-o", *words]) == 2
    n = len(WholeRun.of(fake.lesson, fake.lesson.params(), quiet).timeline)
    assert f"the run has {n} steps: 0 to {n - 1}" in told(capsys)


def test_a_file_that_is_there_stays_without_force(tmp_path, capsys):
    file = tmp_path / "x.png"
    file.write_bytes(b"mine")
    words = ["picture", FAKE, "--width", "200", "-o", str(file)]
    assert main(words) == 2
    assert "exists already; --force" in told(capsys)
    assert file.read_bytes() == b"mine"
    assert main([*words, "--force"]) == 0
    assert file.read_bytes()[:4] == b"\x89PNG"


def test_a_param_that_has_the_name_of_an_option_has_its_lesson_before_it(tmp_path, capsys):
    assert main(["picture", "representations", "--help"]) == 0
    assert "--representations-width" in capsys.readouterr().out
    assert main(["record", "representations", "--help"]) == 0
    assert "--representations-width" not in capsys.readouterr().out


def test_the_same_from_python_leaves_nothing_where_it_fails(tmp_path):
    out = tmp_path / "a.png"
    files = pictured(
        fake.lesson, fake.lesson.params(), out, asked=Asked(style=Style(width=200)), progress=quiet
    )
    assert files == [out]
    assert Image.open(io.BytesIO(out.read_bytes())).width == 200


def test_a_long_line_ends_where_it_was_measured():
    text = "With 16 times as many vertices the error of K from angles goes from 27 % to 746 %."
    image = Image.new("L", (1200, 60), 0)
    letters.write(image, (10, 40), text, size=25.7, weight=letters.PLAIN, ink="#ffffff")
    end = 10 + letters.width(text, 25.7)
    assert abs(int(np.flatnonzero(np.asarray(image).max(axis=0))[-1]) - end) < 6
