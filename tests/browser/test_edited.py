"""A lesson is edited while it is open in a real browser: same inputs and step, new code and text;
or what is wrong.
"""

import shutil
from pathlib import Path

import pytest

from tests.browser.visits import at_rest
from workbench.authoring.reloading import Edited
from workbench.lesson import catalog
from workbench.run import links
from workbench.run.loading import load
from workbench.viewer.server import Server

pytestmark = pytest.mark.browser
CIRCLE = Path(__file__).resolve().parents[1] / "authors" / "circle"


def save(file: Path, old: str, new: str) -> None:
    text = file.read_text(encoding="utf-8")
    assert old in text
    file.write_text(text.replace(old, new), encoding="utf-8")


def test_a_lesson_is_edited_while_it_is_open(visit, tmp_path, capfd):
    folder = Path(
        shutil.copytree(CIRCLE, tmp_path / "circle", ignore=shutil.ignore_patterns("__pycache__"))
    )
    lesson = load(folder)
    server = Server(links.Place(lesson, lesson.params(), None), edited=Edited(folder, lesson))
    try:
        me = visit("?lesson=circle&arc=60&step=2", at=server, scene=True)
        other = visit("?lesson=circle&arc=60&points=41&step=0", at=server)
        me.says("Gauss-Newton step 2 gives radius 1.045 m")
        other.says("The algebraic fit of 41 points")
        me.scene()
        at_rest(me.page)  # the camera of the lesson has come
        me.page.evaluate(
            "void (feed.aim = () => { throw new Error('the camera stays where a person put it') })"
        )

        save(folder / "draw.py", "Gauss-Newton step", "Step of Gauss-Newton")
        save(folder / "page.md", "# A circle through points", "# Through points a circle")
        save(folder / "state.py", "5, 200)", "5, 300)")
        me.says("Step of Gauss-Newton 2 gives radius 1.045 m")
        me.page.get_by_role("heading", name="Through points a circle").wait_for()
        me.page.wait_for_function("$('#drawer input[aria-label^=Points]').max === '300'")
        me.page.locator("#this-run").get_by_role("button", name="Copy link").wait_for()
        other.says("The algebraic fit of 41 points")
        assert list(server.lessons) == [*catalog(), "circle"]

        save(folder / "draw.py", "def outline", "def (outline")
        told = "circle/draw.py, line 32: SyntaxError"
        me.page.locator("#notice").get_by_text(told).wait_for()
        me.act("back")  # the lesson before goes on
        me.says("Step of Gauss-Newton 1")
        me.act("next")
        me.page.locator("#notice").get_by_text(told).wait_for()
        late = visit(at=server)
        late.page.locator("#notice").get_by_text(told).wait_for()
        assert told in capfd.readouterr().err

        save(folder / "draw.py", "def (outline", "def outline")
        me.page.locator("#notice").wait_for(state="hidden")
        me.says("Step of Gauss-Newton 2 gives radius 1.045 m")
        me.page.get_by_role("button", name="Answer").first.wait_for()
        for visitor in (me, other, late):
            visitor.page.close()  # a page whose server is gone asks for it
    finally:
        server.stop()
