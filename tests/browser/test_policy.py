"""A page under the server's own policy: nothing that it does, or viser's client in it, is refused
by the browser.
"""

import pytest

from workbench.lesson import catalog
from workbench.run.timeline import Timeline

pytestmark = pytest.mark.browser


def test_nothing_of_a_page_is_refused_and_nothing_is_asked_of_another_host(chromium, server):
    lesson = catalog()["pinhole"]
    run = Timeline(lesson, lesson.params()).complete()
    page = chromium.new_page(viewport={"width": 800, "height": 600}, bypass_csp=False)
    messages, asked = [], []
    page.on(
        "console",
        lambda message: (
            messages.append(message.text) if message.type in ("error", "warning") else None
        ),
    )
    page.on("pageerror", lambda error: messages.append(str(error)))
    page.on("request", lambda request: asked.append(request.url))
    page.goto(f"{server.address}/?lesson=pinhole&step=2")
    page.locator("#count").get_by_text(f" / {len(run) - 1}").wait_for()
    page.locator("[data-act=last]").click()
    page.locator("#caption").get_by_text(run[-1].caption.text, exact=True).wait_for()
    page.frame_locator("#scene iframe").locator("canvas[data-engine]").wait_for()
    for i in range(page.locator("#tiles .tile").count()):
        page.locator("#tiles .tile").nth(i).dispatch_event("click")
    for name in ("#theme", "#set", "#help"):
        page.locator(name).dispatch_event("click")
    values = page.evaluate("page.run.series.map((one) => one.values.length)")
    assert values == [len(run)] * len(run.series()), "they came in parts"
    refused = [text for text in messages if "Content Security Policy" in text or "Refused" in text]
    assert refused == []
    assert {url for url in asked if not url.startswith((server.address, "data:", "blob:"))} == set()
    page.close()


def test_another_site_shows_no_live_page_in_a_frame(chromium, server):
    page = chromium.new_page(bypass_csp=False)
    page.goto("data:text/html,<p>another site</p>")
    page.set_content(f'<iframe src="{server.address}/?lesson=icp"></iframe>')
    refused = page.frame_locator("iframe").locator("html")
    refused.wait_for(state="attached")
    inside = page.main_frame.child_frames[0]
    inside.wait_for_load_state()
    assert inside.url.startswith("chrome-error:")
    page.close()
