"""In a real browser a preset looks the same after other presets as on its own, tile by tile."""

import numpy as np
import pytest

from tests.browser.visits import at_rest
from workbench.lesson import catalog
from workbench.run.timeline import Timeline

pytestmark = pytest.mark.browser
APART = 25  # of 255
TRANSFORMS = catalog()["transforms"]
FIRST, *OTHERS = ("order", "mirror", "perspective", "inverse")


def opened(chromium, server):
    page = chromium.new_page(viewport={"width": 640, "height": 640})
    page.goto(f"{server.address}/?lesson=transforms&step=0")
    page.frame_locator("#scene iframe").locator("canvas[data-engine]").wait_for()
    return page


def seen(page, name: str) -> np.ndarray:
    """Choose a preset and return the pixels of its scene as soon as they stay as they are."""
    preset = TRANSFORMS.preset(name)
    step = TRANSFORMS.first_step if preset.step is None else preset.step
    caption = Timeline(TRANSFORMS, preset.params).complete()[step].caption.text
    page.locator(f"button[data-run={name}]").click()
    page.locator("#caption").get_by_text(caption, exact=True).wait_for()
    page.mouse.move(0, 0)
    return at_rest(page)


def test_presets_after_each_other_look_as_alone(chromium, server):
    page = opened(chromium, server)
    seen(page, FIRST)
    after = {name: seen(page, name) for name in OTHERS}
    page.close()
    for name in OTHERS:
        page = opened(chromium, server)
        alone = seen(page, name)
        page.close()
        others = [np.abs(alone - after[other]).max() for other in OTHERS if other != name]
        assert min(others) > 2 * APART, "what is compared would look the same for another preset"
        assert np.abs(alone - after[name]).max() < APART, name
