"""A lesson whose own code fails, in a real browser: the page says where, and lives."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
import pytest

from workbench.knobs import Knob
from workbench.lesson import Lesson, Preset, Question
from workbench.run import links
from workbench.scene import Caption, Mesh, Points, Scene
from workbench.viewer.server import Server
from workbench.wire.nodes import Maker

pytestmark = pytest.mark.browser
HERE = "browser/test_author_errors.py, line "


@dataclass(frozen=True)
class Params:
    fails: Annotated[Literal["nowhere", "in run", "in draw", "in the sink"], Knob("Where")] = (
        "nowhere"
    )


def run(params: Params) -> Iterator[str]:
    yield "nowhere"
    if params.fails == "in run":
        raise KeyError("points")
    yield params.fails


def draw(state: str) -> Scene:
    if state == "in draw":
        return {"caption": Caption("Never seen"), "cloud": Points(np.zeros((3, 2)))}
    scene: Scene = {"cloud": Points(np.eye(3)), "caption": Caption(f"It fails {state}.")}
    mesh = {"refused": Mesh(np.eye(3), np.array([[0, 1, 2]]))} if state == "in the sink" else {}
    return scene | mesh


def lesson(page: str) -> Lesson:
    return Lesson(
        name="broken",
        title="Broken",
        summary="It breaks in every place.",
        page=Path(page),
        params=Params,
        run=run,
        draw=draw,
        order=1,
        presets=tuple(
            Preset(where.replace(" ", "-"), f"Fails {where}", "", Params(where), -1)  # type: ignore[arg-type]
            for where in ("nowhere", "in run", "in draw", "in the sink")
        ),
        questions=(
            Question("ratio", "How many?", lambda states: 1 / 0, lambda states: "", Params()),
        ),
    )


def test_the_page_says_where_a_lesson_fails_and_goes_on(chromium, monkeypatch, capsys):
    nodes = Maker.nodes

    def refuse(self, scene, view) -> dict:
        if "refused" in scene:
            raise TypeError("a Mesh of one face")
        return nodes(self, scene, view)

    monkeypatch.setattr(Maker, "nodes", refuse)
    server = Server(links.Place(lesson(__file__), Params(), None))
    page = chromium.new_page(viewport={"width": 1100, "height": 640})
    try:
        page.goto(server.address)
        page.frame_locator("#scene iframe").locator("canvas").first.wait_for()
        caption = page.locator("#caption")
        caption.get_by_text("It fails nowhere.").wait_for()
        for where, words in (
            ("in run", "KeyError: 'points' in `raise KeyError"),
            ("in draw", "Points.p is (n, 3), not (3, 2)"),
            ("in the sink", "TypeError: a Mesh of one face"),
        ):
            page.get_by_role("button", name=f"Fails {where}").click()
            caption.get_by_text(words).wait_for()
            assert HERE in caption.get_by_text(words).inner_text()
            page.get_by_role("button", name="Fails nowhere").click()
            caption.get_by_text("It fails nowhere.").wait_for()
        page.get_by_role("button", name="Skip and show me").click()
        page.locator("form.question output").get_by_text(f"question 'ratio': {HERE}").wait_for()
    finally:
        page.close()
        server.stop()
    stderr = capsys.readouterr().err
    assert stderr.count("workbench: lesson broken") == 4
    assert stderr.count("KeyError: 'points'") >= 2  # the traceback, and the line
    assert stderr.count("Traceback (most recent call last)") >= 4


def test_a_page_that_cannot_be_read_is_said_in_its_place_and_the_run_plays(
    chromium, capsys, tmp_path
):
    file = tmp_path / "page.md"
    file.write_text("# Broken")
    server = Server(links.Place(lesson(str(file)), Params(), None))
    file.unlink()
    page = chromium.new_page(viewport={"width": 1100, "height": 640})
    try:
        page.goto(server.address)
        page.locator("#caption").get_by_text("It fails nowhere.").wait_for()
        page.locator("article .trouble").get_by_text(
            f"lesson broken: its page {file}: No such file"
        ).first.wait_for()
    finally:
        page.close()
        server.stop()
    assert f"its page {file}" in capsys.readouterr().err
