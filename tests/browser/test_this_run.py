"""What can be done with the run that is open, in a real browser: a recording, a link, the command,
and playing it.
"""

import pytest

from tests import fake
from workbench import open_recording
from workbench.cli import main
from workbench.lesson import catalog
from workbench.numerals import brief, length
from workbench.run import links
from workbench.run.timeline import Timeline
from workbench.viewer.server import Server

pytestmark = pytest.mark.browser


def copied(me) -> str:
    return me.page.evaluate("navigator.clipboard.readText()")


def test_the_run_is_handed_out_as_a_recording_a_link_and_a_command(visit, tmp_path, monkeypatch):
    lesson = catalog()["transforms"]
    me = visit("?lesson=transforms&angles=40,20,60&step=2")
    run = Timeline(lesson, lesson.params(angles=(40.0, 20.0, 60.0))).complete()
    me.says(run[2].caption.text)
    me.button("Copy link").click()
    me.page.locator("#this-run output", has_text="copied").wait_for()
    assert copied(me) == f"{me.address}/?lesson=transforms&angles=40,20,60&step=2"
    me.act("next")
    me.says(run[3].caption.text)
    me.page.keyboard.press("c")
    me.page.wait_for_function(
        "navigator.clipboard.readText().then((text) => text.endsWith('step=3'))"
    )
    me.button("Copy command").click()
    me.page.locator("#this-run output", has_text="command is copied").wait_for()
    opened: list = []
    monkeypatch.setattr(
        "workbench.viewer.serving.serve", lambda lesson, params, *_, **__: opened.append(params)
    )
    assert main(copied(me).split()[1:]) == 0
    assert opened == [run.params]
    for preset, name in (
        (None, "transforms.rrd"),
        (lesson.presets[0], f"transforms-{lesson.presets[0].name}.rrd"),
    ):
        if preset is not None:
            me.page.keyboard.press("1")
            me.page.wait_for_function(f"page.run.name === '{preset.name}'")
        with me.page.expect_download() as download:
            me.button("Download recording").click()
        assert download.value.suggested_filename == name
        download.value.save_as(tmp_path / name)
        recording = open_recording(tmp_path / name)
        assert recording.complete
        assert recording.preset == (None if preset is None else preset.name)
    assert open_recording(tmp_path / "transforms.rrd").params["angles"] == [40.0, 20.0, 60.0]
    me.page.evaluate(
        "void (navigator.clipboard.writeText = () => Promise.reject(new Error('not here')))"
    )
    me.button(
        "Copy link"
    ).click()  # where the browser copies nothing, it is there to be copied by hand
    assert me.page.get_by_label("To be copied").input_value() == me.page.evaluate("thisRun.link()")


def test_a_run_that_fails_is_said_and_not_recorded(visit):
    server = Server(links.Place(fake.lesson, fake.Params(steps=1)))
    try:
        me = visit(at=server)
        me.page.wait_for_function("page.run && page.run.finished")
        student = next(iter(server.students.values()))
        assert student.session is not None
        student.session.timeline._steps.clear()
        me.button("Download recording").click()
        me.page.locator("#this-run output", has_text="no step").wait_for()
        assert "422" in me.errors.pop()
        assert me.button("Download recording").is_enabled()
        me.page.close()  # a page whose server is gone asks for it
    finally:
        server.stop()


def test_playing_waits_for_steps_to_come_stops_at_the_end_and_starts_anew_from_there(visit):
    me = visit("?lesson=fitting")
    me.page.wait_for_function("page.run && page.run.finished")
    last = me.page.evaluate("page.known() - 1")
    me.page.locator("#speed").select_option("8")
    me.act("first")
    me.page.wait_for_function("page.k === 0")
    # the rest is still being computed
    me.page.evaluate("page.run.finished = false, page.run.known = 3")
    me.act("play")
    me.page.wait_for_function("page.k === 2")
    # time for three steps
    me.page.evaluate("new Promise((later) => setTimeout(later, 3 * 1000 / 8))")
    assert me.page.evaluate("[transport.playing, page.k]") == [True, 2]
    me.page.evaluate(f"page.run.finished = true, page.run.known = {last + 1}")
    me.page.wait_for_function(f"page.k === {last} && !transport.playing")
    me.act("play")
    me.page.wait_for_function(f"page.k < {last} && transport.playing")


TYPED = {"4.8": 4.8, " 4,8 ": 4.8, "−3": -3.0, "1e-3": 0.001, "0": 0, ".5": 0.5}
NO_NUMBERS = ("", "  ", "four", "inf", "nan", "1,000.5", "1" * 400, "0x10")


def test_a_number_is_read_as_people_type_it_and_an_empty_answer_is_none(visit):
    me = visit("?lesson=fitting")
    me.page.wait_for_function("page.step()")
    read = {
        text: me.page.evaluate("text => numberIn(text) ?? null", text)
        for text in (*TYPED, *NO_NUMBERS)
    }
    assert read == TYPED | dict.fromkeys(NO_NUMBERS)
    lengths = [
        sign * digits * 10.0**power
        for power in range(-11, 8)
        for digits in (1.0, 2.4549, 9.996)
        for sign in (1, -1)
    ]
    assert me.page.evaluate("all => all.map(length)", lengths) == [
        length(metres) for metres in lengths
    ]
    values = [0.3125, -2.125, 0.371500004, 0.3714996, 9.995, 82_389.27, 0.0625]
    assert me.page.evaluate("all => all.map(number)", values) == [brief(value) for value in values]
    number = me.page.locator("form.question", has=me.page.locator("input[inputmode=decimal]")).first
    number.get_by_role("button", name="Answer").click()
    number.get_by_text("Type a number first, or skip.").wait_for()
    chosen = me.page.locator("form.question", has=me.page.locator("input[type=radio]")).first
    chosen.get_by_role("button", name="Answer").click()
    chosen.get_by_text("Choose an answer first, or skip.").wait_for()
