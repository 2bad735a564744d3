"""A recording in Rerun's web viewer, in a real browser: looked at."""

import io

import numpy as np
import pytest
from PIL import Image

from tests.recording.test_compare import files as files
from workbench.recording.replay import Replay
from workbench.scene import PALETTE

pytestmark = pytest.mark.browser
SIZE = (1000, 640)  # software rendering pays for every pixel


class Look:
    """A page with the viewer: its picture, and whom it talks to."""

    def __init__(self, chromium, address: str):
        self.page = chromium.new_page(viewport={"width": SIZE[0], "height": SIZE[1]})
        self.foreign: list[str] = []
        self.errors: list[str] = []
        self.page.on("response", lambda answer: self._note(answer.url, address))
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.goto(address)
        self.page.locator("#note").wait_for(state="detached", timeout=120_000)

    def _note(self, url: str, address: str) -> None:
        if not url.startswith((address, "data:", "blob:")):
            self.foreign.append(url)

    def until(self, holds, seconds: float = 60.0) -> np.ndarray:
        """Return the first picture of which something holds, or fail with the last one kept in memory."""
        for _ in range(int(seconds * 2)):
            picture = np.asarray(Image.open(io.BytesIO(self.page.screenshot())).convert("RGB")).astype(int)
            if holds(picture):
                return picture
            self.page.wait_for_timeout(500)
        Image.fromarray(picture.astype(np.uint8)).save("/tmp/x/fail.png")
        raise AssertionError("the picture never came to show what it should")


def near(picture: np.ndarray, role: str, tolerance: int = 40) -> np.ndarray:
    """Return which pixels are about a role's colour (shading and thin lines change it a little)."""
    return (np.abs(picture - np.array(PALETTE[role])).max(-1)) < tolerance  # type: ignore[index]


def scene_of(picture: np.ndarray) -> np.ndarray:
    return picture[40:380, :595]


def curves_of(picture: np.ndarray) -> np.ndarray:
    return picture[40:-40, 605:]


def test_a_recording_opens_with_its_scene_and_curves(chromium, fake_file):
    with Replay({"fake.rrd": fake_file}, "fake", port=0) as replay:
        look = Look(chromium, replay.address)
        picture = look.until(
            lambda seen: (
                near(scene_of(seen), "truth").sum() > 100
                and near(scene_of(seen), "target").sum() > 100
                and near(curves_of(seen), "truth").sum() > 50
                and near(curves_of(seen), "source").sum() > 50
            )
        )
        assert len(np.unique(scene_of(picture).reshape(-1, 3), axis=0)) > 500  # a picture, not a note of an error
        cursor = cursor_column(picture)
        look.page.mouse.move(SIZE[0] - 60, SIZE[1] - 14)
        look.page.keyboard.press("ArrowRight")
        look.until(lambda seen: cursor_column(seen) > cursor + 20)
        assert look.foreign == []
        assert look.errors == []
        look.page.close()


def test_two_recordings_open_side_by_side(chromium, files):
    with Replay({"both.rrd": files[2]}, "both", port=0) as replay:
        look = Look(chromium, replay.address)
        look.until(
            lambda seen: all(
                near(half, "truth").sum() > 50 for half in (scene_of(seen)[:250, :300], scene_of(seen)[:250, 300:])
            )
        )
        assert look.foreign == []
        look.page.close()


def cursor_column(picture: np.ndarray) -> int:
    """Return the column of the time cursor in the timeline at the bottom: its darkest one."""
    strip = picture[-26:-4, 325 : SIZE[0] - 100].sum(-1).mean(0)
    return int(np.argmin(strip))
