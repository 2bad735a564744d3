"""A student's file drives the lesson in a real browser: report, first difference, mended, broken."""

import pytest

from workbench import links
from workbench.exercise.watching import Watched
from workbench.lesson import catalog
from workbench.viewer.server import Server

pytestmark = pytest.mark.browser
TRANSPOSED = """import numpy as np


def align_rigid(p_target, p_source):
    q, p = p_target.mean(0), p_source.mean(0)
    U, _, Vt = np.linalg.svd((p_source - p).T @ (p_target - q))
    R = U @ Vt
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, q - R @ p
    return T
"""
RIGHT = TRANSPOSED.replace("R = U @ Vt", "R = Vt.T @ np.diag([1, 1, np.sign(np.linalg.det(U @ Vt))]) @ U.T")
BROKEN = TRANSPOSED.replace("q, p =", "q, p = 1 / 0,")


def test_a_student_s_file_is_watched(chromium, tmp_path):
    file = tmp_path / "my_align_rigid.py"
    file.write_text(TRANSPOSED)
    lesson = catalog()["icp"]
    watched = Watched(lesson, file)
    app = App(links.Place(watched.lesson, lesson.params(), None), port=0, watched=watched)
    errors: list[str] = []
    page = chromium.new_page(viewport={"width": 1100, "height": 640})
    page.on("console", lambda message: errors.append(message.text) if message.type == "error" else None)
    page.on("pageerror", lambda error: errors.append(str(error)))
    try:
        page.goto(app.address)
        page.get_by_role("tab", name="Exercise").click()
        report, caption = page.locator(".wb-report"), page.locator(".wb-caption")
        report.get_by_text("public 0/3 · hidden 4 not run here").wait_for()
        report.get_by_text("Your R equals the transpose of the right one").wait_for()
        page.get_by_role("button", name="Go to the first difference").click()
        caption.get_by_text("Here your run first differs from the reference").wait_for()
        page.get_by_text("first difference", exact=True).wait_for()

        file.write_text(RIGHT)
        report.get_by_text("public 3/3 · hidden 4 not run here").wait_for()
        page.get_by_text("first difference", exact=True).wait_for(state="detached")

        late = chromium.new_page()
        late.goto(app.address)
        late.get_by_role("tab", name="Exercise").click()
        late.locator(".wb-report").get_by_text("public 3/3").wait_for()
        late.close()

        file.write_text(BROKEN)
        caption.get_by_text("my_align_rigid.py, line 5: align_rigid raised ZeroDivisionError").wait_for()
        file.write_text("def align_rigid(p_target, p_source:\n")
        report.get_by_text("line 1").first.wait_for()
        assert errors == []
    finally:
        page.close()
        app.stop()
