"""A server that is gone comes back under open pages in a real browser: they go on at their place,
and are calm meanwhile.
"""

import numpy as np
import pytest

from tests import fake
from tests.browser.visits import at_rest
from tests.viewer.test_serving import running
from workbench.lesson import catalog
from workbench.run import links
from workbench.run.timeline import Timeline
from workbench.viewer.server import Server

pytestmark = pytest.mark.browser
APART = 25  # of 255
LESSON = catalog()["icp"]
SHORT = """{
  const later = window.setTimeout;
  window.setTimeout = (act, ms = 0, ...rest) => {
    if (ms < 2000 || ms === 10000) return later(act, ms, ...rest);
    sessionStorage.waits = `${sessionStorage.waits ?? ""} ${ms / 1000}`;
    return sessionStorage.waits.split(" ").length > 8 ? 0 : later(act, 0, ...rest);
  };
}"""
"""Notes how long a page waits for its next try, in seconds, and does not wait so long; after the
eighth it tries no more.
"""


def test_a_page_goes_on_at_its_step_when_its_server_was_killed_and_is_there_again(chromium):
    params = LESSON.preset("far").params
    caption = Timeline(LESSON, params).complete()[3].caption.text
    page = chromium.new_page(viewport={"width": 1100, "height": 640}, reduced_motion="reduce")
    errors = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.on(
        "console", lambda message: errors.append(message.text) if message.type == "error" else None
    )
    with running("--port", "0") as (process, address):
        page.goto(f"{address}/?lesson=icp&step=1")
        page.frame_locator("#scene iframe").locator("canvas[data-engine]").wait_for()
        page.locator("button[data-run=far]").click()
        page.wait_for_function("page.run && page.run.name === 'far' && page.run.finished")
        page.evaluate("page.seek(3)")
        page.locator("#caption").get_by_text(caption, exact=True).wait_for()
        place = page.url
        assert "start_angle" in place
        assert "step=3" in place
        before = at_rest(page)
        assert np.ptp(before) > 2 * APART, "a scene is seen"
        page.evaluate("window.here = true, $('#article').scrollTop = 300")
        assert errors == []
        process.kill()
        page.locator("#caption").get_by_text("This page tries to reach it").wait_for()
        # what is known can be looked at, and where it was left is where it goes on
        page.evaluate("page.seek(2)")
        page.evaluate("page.seek(3)")
        process.wait()
    with running("--port", address.rpartition(":")[2]) as (_, again):
        assert again == address
        page.wait_for_function(
            "window.here === undefined && typeof page === 'object' && page.run && page.run.finished"
        )
        page.locator("#caption").get_by_text(caption, exact=True).wait_for()
        page.frame_locator("#scene iframe").locator("canvas[data-engine]").wait_for()
        errors.clear()  # in vain it asked for what was gone
        assert page.url == place
        assert page.evaluate("page.k") == 3
        assert page.evaluate("$('#article').scrollTop") == 300
        # its last parts come late
        assert any(np.abs(at_rest(page) - before).max() < APART for _ in range(5))
        page.locator("[data-act=next]").click()
        page.wait_for_function("page.k === 4")
        page.context.close()
    assert errors == []


def test_a_server_that_wants_another_link_is_said_until_it_was_opened(chromium):
    server = Server(host="0.0.0.0")
    page = chromium.new_page(viewport={"width": 800, "height": 600})
    try:
        page.goto(f"{server.address}&lesson=icp&step=2")
        page.wait_for_function("page.k === 2")
        page.evaluate("window.here = true")
        server.stop()
        server = Server(host="0.0.0.0", port=server.port)
        page.locator("#caption").get_by_text("wants its new link").wait_for()
        assert page.evaluate("window.here")
        assert page.context.request.get(server.address).ok
        page.wait_for_function(
            "window.here === undefined && typeof page === 'object' && page.k === 2"
        )
    finally:
        page.context.close()
        server.stop()


def test_a_page_that_is_given_and_then_refused_asks_ever_more_seldom(chromium, server):
    page = chromium.new_page(viewport={"width": 800, "height": 600})
    page.add_init_script(SHORT)
    page.route_web_socket("**/live?*", lambda socket: socket.close(code=4409))
    page.goto(f"{server.address}/?lesson=icp")
    # the first is empty
    page.wait_for_function("(sessionStorage.waits ?? '').split(' ').length > 8")
    waits = np.array(page.evaluate("sessionStorage.waits").split(), float)[:8]
    least = np.minimum(60.0, 2.0 ** np.arange(1, 9))
    assert np.all(waits >= least)
    assert np.all(waits <= 1.5 * least)
    page.context.close()


def test_nothing_is_asked_while_nobody_looks(chromium, server):
    page = chromium.new_page(viewport={"width": 800, "height": 600})
    page.goto(f"{server.address}/?lesson=icp")
    asked = page.evaluate("""() => {
      let asked = 0, hidden = true;
      const counts = [], seen = () => document.dispatchEvent(new Event("visibilitychange"));
      Object.defineProperty(document, "hidden", { get: () => hidden });
      returning.ask = () => asked++;
      for (const act of [() => returning.soon(), seen, () => { hidden = false; seen(); }, seen]) {
        act();
        counts.push(asked);
      }
      return counts;
    }""")
    assert asked == [0, 0, 1, 1]
    page.context.close()


def test_an_own_file_is_put_aside_by_an_answer_and_said_to_be_gone_with_its_server(
    chromium, tmp_path
):
    np.save(tmp_path / "mine.npy", np.eye(3))
    server = Server(links.Place(fake.lesson, fake.Params()))
    page = chromium.new_page(viewport={"width": 1100, "height": 640})
    try:
        page.goto(server.address)
        page.wait_for_function("page.run && page.run.finished")
        line, caption = page.locator("#aside"), page.locator("#caption")
        page.locator("input[type=file]").set_input_files(tmp_path / "mine.npy")
        caption.get_by_text(" 3 points").wait_for()
        page.evaluate("$('form.question [value=skip]').click()")
        line.get_by_text(
            "This run is of the lesson's own data. A preset or Reset (R) goes back to yours."
        ).wait_for()
        caption.get_by_text("200 points").wait_for()
        page.keyboard.press("r")
        caption.get_by_text(" 3 points").wait_for()
        assert line.text_content() == ""
        server.stop()
        server = Server(links.Place(fake.lesson, fake.Params()), port=server.port)
        line.get_by_text("Files that were handed over went with the server.").wait_for()
        caption.get_by_text("200 points").wait_for()
    finally:
        page.context.close()
        server.stop()
