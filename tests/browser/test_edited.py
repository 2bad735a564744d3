"""A lesson is edited while it is open in a real browser: same inputs and step, new code and text; or what is wrong."""

import shutil
from pathlib import Path

import pytest

from workbench import links
from workbench.authoring.reloading import Edited
from workbench.lesson import catalog
from workbench.loading import load
from workbench.viewer.server import Server

pytestmark = pytest.mark.browser
CIRCLE = Path(__file__).resolve().parents[1] / "authors" / "circle"


def save(file: Path, old: str, new: str) -> None:
    text = file.read_text(encoding="utf-8")
    assert old in text
    file.write_text(text.replace(old, new), encoding="utf-8")


def test_a_lesson_is_edited_while_it_is_open(chromium, tmp_path, capfd):
    folder = Path(shutil.copytree(CIRCLE, tmp_path / "circle", ignore=shutil.ignore_patterns("__pycache__")))
    lesson = load(folder)
    app = App(links.Place(lesson, lesson.params(), None), port=0, edited=Edited(folder, lesson))
    page = chromium.new_page(viewport={"width": 1400, "height": 800})
    other = chromium.new_page(viewport={"width": 1400, "height": 800})
    try:
        page.goto(f"{app.address}/?lesson=circle&arc=60&step=2")
        other.goto(f"{app.address}/?lesson=circle&arc=60&points=41&step=0")
        caption = page.locator(".wb-caption")
        caption.get_by_text("Gauss-Newton step 2 gives radius 1.045 m").wait_for()
        other.locator(".wb-caption").get_by_text("The algebraic fit of 41 points").wait_for()

        save(folder / "draw.py", "Gauss-Newton step", "Step of Gauss-Newton")
        save(folder / "page.md", "# A circle through points", "# Through points a circle")
        caption.get_by_text("Step of Gauss-Newton 2 gives radius 1.045 m").wait_for()
        page.get_by_role("heading", name="Through points a circle").wait_for()
        other.locator(".wb-caption").get_by_text("The algebraic fit of 41 points").wait_for()
        assert list(app.lessons) == [*catalog(), "circle"]

        save(folder / "draw.py", "def outline", "def (outline")
        caption.get_by_text("circle/draw.py, line 28: SyntaxError").wait_for()
        late = chromium.new_page()
        late.goto(app.address)
        late.locator(".wb-caption").get_by_text("circle/draw.py, line 28: SyntaxError").wait_for()
        late.close()
        assert "circle/draw.py, line 28: SyntaxError" in capfd.readouterr().err

        save(folder / "draw.py", "def (outline", "def outline")
        caption.get_by_text("Step of Gauss-Newton 2 gives radius 1.045 m").wait_for()
    finally:
        page.close()
        other.close()
        app.stop()
