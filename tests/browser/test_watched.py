"""A student's file drives the lesson in a real browser: report, first difference, mended,
broken.
"""

import pytest

from workbench.exercise.finding import exercises
from workbench.exercise.starter import write_starter
from workbench.exercise.watching import WatchedFile
from workbench.lesson import catalog
from workbench.run import links
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
RIGHT = TRANSPOSED.replace(
    "R = U @ Vt", "R = Vt.T @ np.diag([1, 1, np.sign(np.linalg.det(U @ Vt))]) @ U.T"
)
BROKEN = TRANSPOSED.replace("q, p =", "q, p = 1 / 0,")


PRINTING = RIGHT.replace("    q, p =", "    print('pairs:', len(p_source))\n    q, p =")


def test_a_student_s_file_is_watched(chromium, visit, tmp_path):
    file = tmp_path / "my_align_rigid.py"
    file.write_text(TRANSPOSED)
    lesson = catalog()["icp"]
    watched = WatchedFile(lesson, file)
    server = Server(links.Place(watched.lesson, lesson.params(), None), watched=watched)
    try:
        me = visit(at=server, scene=True)
        report = me.page.locator("#exercise .report")
        report.get_by_text("public 0/3 · hidden 4 not run here").wait_for()
        report.get_by_text("Your R equals the transpose of the right one").wait_for()
        me.page.locator("#bar .flag").wait_for()
        first = me.page.evaluate("page.run.mark")
        me.button("Go to the first difference").click()
        me.says("Here your run first differs from the reference")
        assert me.page.evaluate("page.k") == first
        assert me.page.locator(".tile .noted").count() >= 1
        me.act("first")
        me.page.locator("#bar .flag").click()
        me.says("Here your run first differs from the reference")
        me.page.locator(".tile", has_text="Code").click()
        assert "R = U @ Vt" in me.page.locator("#large .lines").first.inner_text()
        assert me.page.locator("#large .lines .here").count() == 1  # of the algorithm
        me.scene()
        assert any(
            path.startswith("ghost/")
            for student in server.students.values()
            for path in shown(student)
        )

        file.write_text(PRINTING)
        report.get_by_text("public 3/3 · hidden 4 not run here").wait_for()
        report.get_by_text("In this run your code printed:").wait_for()
        report.get_by_text("pairs: ").first.wait_for()
        me.page.locator("#bar .flag").wait_for(state="detached")
        assert me.button("Go to the first difference").is_disabled()
        me.page.wait_for_function(f"page.k === {first}")  # where it was before the file was saved
        assert "print(" in me.page.locator("#large .lines").first.inner_text()

        late = visit("?lesson=icp&step=2", at=server)
        late.page.locator("#exercise .report").get_by_text("public 3/3").wait_for()

        file.write_text(BROKEN)
        me.says("my_align_rigid.py, line 5: align_rigid raised ZeroDivisionError")
        assert "1 / 0" in me.page.locator("#large .here.wrong").inner_text()
        file.write_text("def align_rigid(p_target, p_source:\n")
        report.get_by_text("line 1").first.wait_for()

        file.write_text(RIGHT)
        report.get_by_text("public 3/3 · hidden 4 not run here").wait_for()
        me.page.wait_for_function(f"page.k === {first}")  # where it was before the errors
        file.unlink()
        report.get_by_text("my_align_rigid.py is gone").wait_for()

        me.page.locator("nav.top a").first.click()
        me.page.locator("li[data-card=fitting] a").click()
        me.page.locator("#exercise").get_by_text("workbench exercise").first.wait_for()
        assert me.page.locator("#exercise .report").count() == 0
        me.page.close()  # a page whose server is gone says so in its console
        late.page.close()
    finally:
        server.stop()


def test_a_run_that_does_not_call_the_function_says_so(chromium, visit, tmp_path):
    lesson = catalog()["icp"]
    watched = WatchedFile(lesson, write_starter(exercises()["point_to_plane_step"], tmp_path))
    server = Server(links.Place(watched.lesson, lesson.params(), None), watched=watched)
    try:
        me = visit(at=server)
        mine = me.page.locator("#exercise")
        me.page.locator(".report .count").wait_for()
        mine.get_by_text("This run never calls point_to_plane_step").wait_for()
        assert not mine.get_by_text("drives this lesson").is_visible()
        mine.locator("a[data-run]").click()
        mine.get_by_text("drives this lesson").wait_for()
        assert not mine.get_by_text("This run never calls").is_visible()
        assert "fit=point-to-plane" in me.page.url or "preset=plane" in me.page.url
    finally:
        server.stop()


def shown(student) -> list[str]:
    look = student.session.look() if student.session else None
    return list(look.scene) if look else []
