"""The live page in a real browser, as a student uses it."""

import re

import pytest

from workbench import open_recording
from workbench.lesson import catalog
from workbench.timeline import Timeline

pytestmark = pytest.mark.browser

DARK = "[data-mantine-color-scheme=dark]"


class Student:
    """One browser window on the workbench, and what a student does in it."""

    def __init__(self, chromium, app, query: str = "", width: int = 1100, height: int = 640):
        self.context = chromium.new_context(viewport={"width": width, "height": height})
        self.context.grant_permissions(["clipboard-read", "clipboard-write"], origin=app.address)
        self.page = self.context.new_page()
        self.trouble: list[str] = []
        self.page.on("console", lambda m: self.trouble.append(m.text) if m.type == "error" else None)
        self.page.on("pageerror", lambda error: self.trouble.append(str(error)))
        self.page.on("request", lambda r: self._local(r.url, app))
        self.address = app.address
        self.go(query)

    def _local(self, url: str, app) -> None:
        if not url.startswith((app.address, f"ws://127.0.0.1:{app.port}", "data:", "blob:")):
            self.trouble.append(f"asked for {url}")

    def go(self, query: str) -> None:
        self.page.goto(self.address + "/" + query)
        self.page.wait_for_selector("canvas[data-engine]")

    def button(self, name: str):
        return self.page.get_by_role("button", name=name, exact=True).first

    def click(self, name: str) -> None:
        self.button(name).click()
        self.page.wait_for_timeout(60)  # the browser passes on one event per 50 ms

    def caption(self, text: str) -> None:
        self.page.locator(".wb-caption", has_text=text).wait_for()

    def step_label(self, pattern: str) -> None:
        self.page.get_by_text(re.compile(pattern)).first.wait_for()

    def said(self) -> str:
        return self.page.locator(".wb-caption").first.inner_text()

    def knob(self, label: str):
        row = f'//label[normalize-space(.)="{label}"]/ancestor::div[contains(@class,"mantine-Flex-root")][1]'
        return self.page.locator(row).locator("input[type=text], input:not([type])").first

    def close(self) -> None:
        self.context.close()


@pytest.fixture
def student(chromium, app):
    windows: list[Student] = []

    def enter(query: str = "", **size: int) -> Student:
        windows.append(Student(chromium, app, query, **size))
        return windows[-1]

    yield enter
    for window in windows:
        trouble = window.trouble
        window.close()
        assert trouble == []


@pytest.fixture(scope="module")
def default_run() -> Timeline:
    lesson = catalog()["icp"]
    return Timeline(lesson, lesson.params()).complete()


def test_play_step_back_knob_preset_question_link_code_theme_and_reload(student, default_run):
    texts = [step.caption.text for step in default_run.known()]
    me = student("?lesson=icp&step=2")
    me.caption(texts[2])
    me.click("Next")
    me.caption(texts[3])
    me.click("Back")
    me.caption(texts[2])
    me.click("First")
    me.caption(texts[0])
    me.click("Last")
    me.caption(texts[-1])
    me.click("First")
    me.click("Play")
    me.button("Pause").wait_for()
    me.caption(texts[2])
    me.click("Pause")
    me.button("Play").wait_for()

    # keys: N, P, End
    me.page.locator("canvas[data-engine]").hover()
    me.click("First")
    me.caption(texts[0])
    me.page.keyboard.press("n")
    me.caption(texts[1])
    me.page.keyboard.press("p")
    me.caption(texts[0])
    me.page.keyboard.press("End")
    me.caption(texts[-1])

    # the marked line of code is the line at which the step was yielded
    me.click("First")
    me.page.keyboard.press("n")
    me.caption(texts[1])
    me.page.get_by_role("tab", name="Code").click()
    moment = default_run[1].moment
    assert moment is not None
    me.page.wait_for_selector(f'img[data-line="{moment.line}"]', state="attached")
    lines, first = moment.source
    marked = me.page.locator(f'.wb-code [data-line="{moment.line - first}"]')
    assert lines[moment.line - first].strip() in marked.inner_text()
    assert "rgba(204, 121, 167" in marked.evaluate("e => getComputedStyle(e).backgroundColor")

    # a knob changes the run; a pinned run stays
    me.click("Pin this run")
    me.button("Unpin").wait_for()
    me.page.get_by_role("tab", name="Parameters").click()
    knob = me.knob("Start angle (deg)")
    knob.fill("60")
    knob.press("Enter")
    me.page.wait_for_url(re.compile("start_angle=60"))
    me.click("Reset")
    me.button("Pin this run").wait_for()

    # a preset
    me.page.get_by_role("tab", name="Presets").click()
    preset = catalog()["icp"].presets[1]
    me.click(preset.title)
    me.page.wait_for_url(re.compile(r"\?lesson=icp&\w+="))

    # a question is answered, and remembered after a reload, as is the theme
    me.page.get_by_role("tab", name="Lesson").click()
    question = next(q for q in catalog()["icp"].questions if q.choices)
    me.click(question.choices[0])
    states = Timeline(catalog()["icp"], question.params).states()
    me.page.locator(".wb-result", has_text=question.why(states)[:40]).wait_for()
    me.click("Theme")
    me.page.wait_for_selector(DARK, state="attached")
    here = me.page.url
    me.page.reload()
    me.page.wait_for_selector(DARK, state="attached")
    me.page.locator(".wb-result", has_text=f"You answered: {question.choices[0]}").wait_for()
    assert me.page.url == here


def test_every_lesson_opens_from_the_course_page_and_from_each_other(student):
    me = student()
    lessons = list(catalog().values())
    me.button(f"Open {lessons[-1].title}").wait_for()
    for lesson in lessons:
        me.click(f"Open {lesson.title}")
        me.page.wait_for_url(re.compile(f"lesson={lesson.name}"))
        me.caption(Timeline(lesson, lesson.params()).complete()[lesson.first_step].caption.text)
        me.page.locator("math").first.wait_for()
        me.page.get_by_role("tab", name="Course").click()
        me.page.locator(".wb-done").first.wait_for()


def test_two_browsers_have_a_place_each_and_a_link_to_it(student, default_run):
    one, two = student("?lesson=icp&step=1"), student("?lesson=icp&step=3")
    one.caption(default_run[1].caption.text)
    two.caption(default_run[3].caption.text)
    one.click("Last")
    one.caption(default_run[-1].caption.text)
    two.caption(default_run[3].caption.text)
    two.click("Copy link")
    two.page.get_by_text("Link to this step copied").wait_for()
    assert two.page.evaluate("navigator.clipboard.readText()") == two.address + "/?lesson=icp&step=3"


def test_a_link_that_cannot_be_used_is_a_message_and_the_page_lives(student):
    me = student("?lesson=icp&start_angle=9999")
    me.page.get_by_text("a number from").first.wait_for()
    me.button(f"Open {catalog()['icp'].title}").click()
    me.page.wait_for_selector(".wb-caption")


def test_the_current_run_is_handed_out_as_a_recording(student, tmp_path):
    me = student("?lesson=transforms&angles=40,20,60&step=2")
    me.step_label(r"Step 2 of")
    with me.page.expect_download() as download:
        me.button("Download recording").click()
    assert download.value.suggested_filename == "transforms.rrd"
    download.value.save_as(tmp_path / "transforms.rrd")
    recording = open_recording(tmp_path / "transforms.rrd")
    assert recording.complete
    assert (recording.lesson, recording.params["angles"]) == ("transforms", [40.0, 20.0, 60.0])


def test_a_phone_shows_caption_and_controls(student, default_run):
    me = student("?lesson=icp&step=2", width=390, height=844)
    me.caption(default_run[2].caption.text)
    box = me.page.locator(".wb-caption").first.bounding_box()
    assert box is not None
    assert box["x"] >= 0
    assert box["width"] > 300
    me.click("Next")
    me.caption(default_run[3].caption.text)
