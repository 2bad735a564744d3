"""Recordings in Rerun's web viewer, in a real browser: looked at.

The viewer spends ten seconds on its shaders without a graphics card, however small the picture: one
page serves all tests, in a browser of its own. It draws all the time, so nobody waits for it long.
"""

import io
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tests.recording.test_compare import files as files
from workbench.recording.replay import ReplayServer
from workbench.scene import PALETTE, Role

pytestmark = pytest.mark.browser
WIDTH, HEIGHT = 1000, 690
GIVEN_UP = 240.0  # seconds after which a picture is not looked at again


class Window:
    """A page with the viewer: its picture, what goes wrong, and whom it talks to."""

    def __init__(self, chromium, address: str, folder: Path):
        self.folder = folder
        self.trouble: list[str] = []
        self.page = chromium.new_page(viewport={"width": WIDTH, "height": HEIGHT})
        self.page.on("response", lambda answer: self._local(answer.url, address))
        self.page.on("pageerror", lambda error: self.trouble.append(str(error)))
        self.page.goto(address)
        self.page.locator("#note").wait_for(state="detached")

    def _local(self, url: str, address: str) -> None:
        if not url.startswith((address, "data:", "blob:")):
            self.trouble.append(f"answered by {url}")

    def open(self, file: Path) -> None:
        """Open one more recording, which is then the one that is shown."""
        self.page.route(f"**/{file.name}", lambda route: route.fulfill(path=file))
        self.page.evaluate(
            "name => viewer.add_receiver(new URL(name, location.href).href)", f"/{file.name}"
        )

    def picture(self) -> np.ndarray:
        return np.asarray(Image.open(io.BytesIO(self.page.screenshot())).convert("RGB")).astype(int)

    def until(self, holds: Callable[[np.ndarray], bool], key: str = "") -> np.ndarray:
        """Return the first picture of which something holds; a key is pressed now and then until
        it does, for a viewer that is slow to draw may lose one.
        """
        end = time.monotonic() + GIVEN_UP
        look = 0
        while True:
            picture = self.picture()
            if holds(picture):
                return picture
            if time.monotonic() > end:
                last = self.folder / "last.png"
                Image.fromarray(picture.astype(np.uint8)).save(last)
                raise AssertionError(f"the picture never came to show what it should: {last}")
            # the viewer sleeps until something happens
            self.page.mouse.move(WIDTH - 60, HEIGHT - 14 + look % 2)
            if key and look % 8 == 0:
                self.page.keyboard.press(key)
            self.page.wait_for_timeout(250)
            look += 1


@pytest.fixture(scope="module")
def window(chromium, fake_file, tmp_path_factory) -> Iterator[Window]:
    with (
        ReplayServer({fake_file.name: fake_file}, "fake", port=0) as replay,
        chromium.another() as browser,
    ):
        window = Window(browser, replay.address, tmp_path_factory.mktemp("looks"))
        yield window
        window.page.close()


def near(picture: np.ndarray, role: Role, tolerance: int = 40) -> int:
    """Return how many pixels are about a role's colour (shading and thin lines change it a
    little).
    """
    return int((np.abs(picture - np.array(PALETTE[role])).max(-1) < tolerance).sum())


def scene_of(picture: np.ndarray) -> np.ndarray:
    return picture[40:410, :595]


def curves_of(picture: np.ndarray) -> np.ndarray:
    return picture[40:-40, 605:]


def cursor_column(picture: np.ndarray) -> int:
    """Return the column of the time cursor in the timeline at the bottom: its darkest one."""
    return int(np.argmin(picture[-26:-4, 325 : WIDTH - 100].sum(-1).mean(0)))


def shows_a_run(picture: np.ndarray) -> bool:
    scene, curves = scene_of(picture), curves_of(picture)
    return (
        min(near(scene, "truth"), near(scene, "target")) > 100
        and min(near(curves, "truth"), near(curves, "source")) > 50
        and len(np.unique(scene.reshape(-1, 3), axis=0)) > 500  # a picture, not a note of an error
    )


def shows_two_scenes(picture: np.ndarray) -> bool:
    left, right = scene_of(picture)[:250, :300], scene_of(picture)[:250, 300:]
    return min(near(left, "truth"), near(right, "truth")) > 50


def test_a_recording_opens_with_its_scene_and_curves_and_steps_on(window):
    picture = window.until(shows_a_run)
    assert not shows_two_scenes(picture)
    cursor = cursor_column(picture)
    window.until(lambda seen: cursor_column(seen) > cursor + 20, "ArrowRight")
    assert window.trouble == []


def test_two_recordings_open_side_by_side(window, files):
    window.open(files[2])
    window.until(shows_two_scenes)
    assert window.trouble == []
