"""In a real browser a preset looks the same after other presets as on its own, tile by tile."""

import io

import numpy as np
import pytest
from PIL import Image

from workbench.lesson import catalog
from workbench.timeline import Timeline

pytestmark = pytest.mark.browser
MOST = 200  # pictures
APART = 25  # of 255
ALIKE = 6  # pictures in a row that are the same: surfaces are decoded beside the frames
TRANSFORMS = catalog()["transforms"]
FIRST, *OTHERS = ("conventions", "mirror", "perspective", "inverse")


def opened(chromium, server):
    page = chromium.new_page(viewport={"width": 640, "height": 640})
    page.goto(f"{server.address}/?lesson=transforms")
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
    view = page.locator("#view").bounding_box()
    between = {"x": view["x"] + 10, "y": view["y"] + 40, "width": view["width"] - 20, "height": view["height"] - 90}
    before, alike = b"", 0
    for _ in range(MOST):
        page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        now = page.screenshot(clip=between)
        alike = alike + 1 if now == before else 0
        if alike == ALIKE:
            return blurred(Image.open(io.BytesIO(now)).convert("RGB"))
        before = now
    raise AssertionError("the scene does not come to rest")


def blurred(image: Image.Image) -> np.ndarray:
    """The means over tiles of ten pixels: the grid's thin lines are not drawn the same twice."""
    return np.asarray(image.resize((image.width // 10, image.height // 10), Image.Resampling.BOX)).astype(int)


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
