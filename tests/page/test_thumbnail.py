"""The small picture of a lesson: what stands where, in which colour, and that it stays small."""

import io

import numpy as np
import pytest
from PIL import Image

from tests import fake
from tests.runs import finished
from workbench.lesson import View, catalog
from workbench.page.thumbnail import picture_of, thumbnail
from workbench.run.timeline import Timelines
from workbench.scene import PALETTE, Points, Segments
from workbench.story import story_of

# at 4 m it sees 4 m of height
VIEW = View(eye=(0.0, -4.0, 0.0), target=(0.0, 0.0, 0.0), fov_degrees=53.130102)


class Kept(Timelines):
    """The runs that all tests share."""

    def get(self, lesson, params):
        return finished(lesson.name, params)


def pixels(data: bytes) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(data)).convert("RGBA")).astype(int)


def middle_of(picture: np.ndarray, role: str) -> tuple[float, float]:
    """Return column and row of what has a role's colour."""
    near = np.abs(picture[..., :3] - PALETTE[role]).max(-1) < 30  # type: ignore[index]
    rows, columns = np.nonzero(near & (picture[..., 3] > 200))
    return columns.mean(), rows.mean()


def test_what_is_right_is_right_and_what_is_up_is_up():
    # the whole picture
    frame = np.array([[[-3.2, 0, -2.0], [3.2, 0, -2.0]], [[-3.2, 0, 2.0], [3.2, 0, 2.0]]])
    T_world_moved = np.eye(4)
    T_world_moved[:3, 3] = (-1.6, 0.0, -1.0)
    scene = {
        "frame": Segments(frame, "neutral"),
        "right": Points(np.array([[1.6, 0.0, 0.0]]), "source", 0.2),
        "up": Points(np.array([[0.0, 0.0, 1.0]]), "truth", 0.2),
        "moved": Points(np.zeros((1, 3)), "target", 0.2, T_world_moved),
    }
    picture = pixels(picture_of(scene, VIEW))
    assert picture.shape == (300, 480, 4)
    assert middle_of(picture, "source") == pytest.approx((360, 150), abs=4)
    assert middle_of(picture, "truth") == pytest.approx((240, 75), abs=4)
    assert middle_of(picture, "target") == pytest.approx((120, 225), abs=4)


def test_the_nearer_hides_the_farther_and_what_is_behind_the_eye_is_left_out():
    scene = {
        "near": Points(np.array([[0.0, -1.0, 0.0]]), "source", 0.3),
        "far": Points(np.array([[0.0, 1.0, 0.0], [0.0, -5.0, 0.0]]), "target", 0.3),
    }
    picture = pixels(picture_of(scene, VIEW))
    assert np.abs(picture[150, 240, :3] - PALETTE["source"]).max() < 20


def test_a_told_lesson_is_seen_where_its_story_begins():
    story = story_of(catalog()["pairs"], "live")
    assert story is not None
    place = story.scenes[0].beats[0]
    lesson = catalog()["pairs"]
    begun = finished("pairs", lesson.preset(place.run).params)[int(place.step)].scene
    assert thumbnail(lesson, Kept()) == picture_of(begun, lesson.views[place.view])


@pytest.mark.parametrize(
    "lesson", [fake.lesson, *catalog().values()], ids=lambda lesson: lesson.name
)
def test_every_lesson_has_a_picture_that_is_small_and_shows_something(lesson):
    data = thumbnail(lesson, None if lesson is fake.lesson else Kept())
    assert len(data) < 40_000
    shown = pixels(data)[..., 3] > 96  # faint lines too
    tall, wide = (np.ptp(np.flatnonzero(shown.any(axis=axis))) for axis in (1, 0))
    spans = tall > 0.5 * shown.shape[0] and wide > 0.5 * shown.shape[1]
    assert shown.mean() > (0.01 if spans else 0.02), "a drawing of lines covers less, but is large"
