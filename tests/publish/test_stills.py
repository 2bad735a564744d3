"""Pictures of a page for paper: which there are, what they show, and that they come and go with
their runs.
"""

import base64
import io
import re
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from PIL import Image

from tests import fake
from tests.publish.conftest import TINY
from tests.story.hill import lesson as hill
from workbench.lesson import View, catalog
from workbench.picture.sheet import _legend
from workbench.picture.stills import _index, still_svg, stills_of, with_stills
from workbench.picture.theme import theme
from workbench.publish import site
from workbench.run.timeline import Timeline
from workbench.story import has_story, story_of

SVG = "{http://www.w3.org/2000/svg}"
TOLD = [name for name, lesson in catalog().items() if has_story(lesson)]


@pytest.fixture(scope="module")
def told(tmp_path_factory) -> Path:
    out = tmp_path_factory.mktemp("stills") / "site"
    site.publish(out, [hill], recordings="none")
    return out


def test_every_scene_has_a_picture_and_a_chart(told):
    page = (told / "hill" / "index.html").read_text(encoding="utf-8")
    story = story_of(hill, "site")
    assert story is not None
    scenes = re.findall(r'<section class="scene" id="(\w+)".*?</section>', page, re.DOTALL)
    assert scenes == [scene.name for scene in story.scenes if not scene.is_turn]
    parts = re.findall(r'<section class="scene".*?</section>', page, re.DOTALL)
    for part in parts:
        (file,) = re.findall(r'<figure class="still"><img src="([\w/.-]+)" loading="lazy"', part)
        svg = ElementTree.parse(told / "hill" / file).getroot()
        (image,) = svg.iter(f"{SVG}image")
        data = base64.b64decode(image.attrib["href"].partition(",")[2])
        picture = np.asarray(Image.open(io.BytesIO(data)).convert("RGBA"))
        assert picture.shape == (500, 800, 4)
        assert picture[..., 3].any()
        assert list(svg.iter(f"{SVG}polyline")), "the chart"
    assert (told / "hill" / "stills").is_dir()


def test_an_experiment_has_a_picture_and_its_line(tmp_path):
    lesson = replace(fake.lesson, presets=fake.lesson.presets[:1], questions=())
    site.publish(tmp_path, [lesson], recordings="none")
    page = (tmp_path / "fake" / "index.html").read_text(encoding="utf-8")
    preset = lesson.presets[0]
    figures = re.findall(r'<img src="stills/(\w+)\.svg"[^>]*><figcaption><b>([^<]*)</b>', page)
    assert figures == [("default", "The default run."), (preset.name, f"{preset.title}.")]
    site.publish(tmp_path, [replace(lesson, presets=())], recordings="none")
    assert [file.name for file in (tmp_path / "fake" / "stills").iterdir()] == ["default.svg"]


def test_a_picture_that_is_gone_is_made_again(out, rendered):
    (out / "fake" / "stills" / "default.svg").unlink()
    site.publish(out, [TINY])
    assert rendered == ["fake/default"]
    assert (out / "fake" / "stills" / "default.svg").stat().st_size > 1000


@pytest.mark.parametrize("name", TOLD)
def test_a_story_s_pictures_are_of_runs_that_its_page_has(name):
    lesson = catalog()[name]
    runs = {"default", *(named.name for named in (*lesson.presets, *lesson.questions))}
    stills = stills_of(lesson)
    story = story_of(lesson, "site")
    assert story is not None
    assert {still.place.run for still in stills} <= runs
    assert len({still.file for still in stills}) == len(stills)
    assert len(stills) == len([scene for scene in story.scenes if not scene.is_turn])
    page = with_stills(story, stills).html
    assert page.count('<figure class="still">') == len(stills)
    assert page.count("</section>") == story.html.count("</section>")


def test_what_is_hidden_is_not_in_the_picture():
    (still,) = stills_of(replace(TINY))
    timeline = Timeline(TINY, TINY.params()).complete()
    from workbench.publish.runs import run_data, runs_of

    data = run_data(TINY, runs_of(TINY)[0], timeline)
    whole = still_svg(TINY, still, timeline, run=data)
    everything = tuple({path.split("/")[0] for path in timeline[0].scene})
    bare = replace(still, place=replace(still.place, hide=everything))
    assert len(still_svg(TINY, bare, timeline, run=data)) < 0.5 * len(whole)
    away = replace(TINY, view=View(eye=(0.0, -90.0, 50.0), target=(0.0, 0.0, 0.0)))
    assert still_svg(away, still, timeline, run=data) != whole


@pytest.mark.parametrize(
    ("step", "end", "k"),
    [
        *((0, None, 0), (3, None, 3), (99, None, 9), (-1, 4, 9), (-2, None, 8)),
        *(("stop", 4, 4), ("stop", None, 9), ("stop-1", 4, 3), ("stop-99", 4, 0)),
    ],
)
def test_a_step_is_found_as_the_page_finds_it(step, end, k):
    assert _index(step, 10, end) == k


def test_a_legend_has_its_colours_and_its_bars_on_lines_that_fit():
    from workbench.page.legend import bar_html, legend_html
    from workbench.scene import Field, Points

    p = np.zeros((1, 3))
    bar = Field(np.zeros(1), 0.0, 2.0, "Height <z>", "m")
    scene = {f"a{i}": Points(p, "source", name=f"a name & number {i}") for i in range(9)}
    html = legend_html({**scene, "b": Points(p, bar)}, None)
    assert bar_html(bar) in html
    svg, below = _legend({**scene, "b": Points(p, bar)}, 640, 100, colors=theme(dark=False))
    root = ElementTree.fromstring(f"<svg>{svg}</svg>")
    texts = list(root.iter("text"))
    words = ["".join(text.itertext()) for text in texts]
    assert words[8:] == ["a name & number 8", "Height <z>: 0", "2 m"]
    rows = sorted({float(text.attrib["y"]) for text in texts})
    assert len(rows) == 3
    assert below > rows[-1]
    ends = [float(text.attrib["x"]) + 7 * len(w) for text, w in zip(texts, words, strict=True)]
    assert max(ends) < 660
    assert len(list(root.iter("stop"))) == 9


def test_the_bar_of_logarithms_says_the_numbers_they_are_of():
    from workbench.page.legend import bar_of
    from workbench.scene import Field

    bar = bar_of(Field(np.array([0.0]), -3.0, 1.0, "log₁₀ error", "m"))
    assert (bar.title, bar.low, bar.high, bar.unit) == ("error", "0.001", "10", "m")
