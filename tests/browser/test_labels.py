"""Words stand where their places are seen, and the camera is put where a view wants it, in frames
of any width.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.browser.feeding import Fed
from workbench.lesson import View
from workbench.scene import Label, Scene

pytestmark = pytest.mark.browser
RNG = np.random.default_rng(11)
SIZE = (800, 500)
FOV = np.radians(45.0)
BARE = View(eye=(2.0, -2.0, 1.5), axes=False, grid=None)
WORDS = """() => Object.fromEntries([...labels.words].map(([name, word]) => {
  const { x, y, width, height } = word.getBoundingClientRect(), frame = $("#labels").getBoundingClientRect();
  return [name.replace("/scene/", ""), word.hidden ? null : [x - frame.x, y - frame.y, width, height]];
}))"""


@pytest.fixture(scope="module")
def fed(chromium) -> Iterator[Fed]:
    fed = Fed(chromium)
    yield fed
    fed.close()


@pytest.fixture(autouse=True)
def wide(fed) -> None:
    """Begin each test with a wide frame that nothing was shown in."""
    fed("([w, h]) => Object.assign($('#scene').style, { width: `${w}px`, height: `${h}px` })", SIZE)
    fed("() => { feed.keeps = NARROWEST; feed.stage = null; connect(); }")


def show(fed: Fed, scene: Scene, view: View = BARE) -> None:
    (k,) = fed.add([scene], view)
    fed("(k) => { feed.open(scenes[k].stage); sceneView.step(scenes[k].nodes, 0); finish(); }", k)


def seen_from(eye: np.ndarray, target: np.ndarray, up: np.ndarray) -> np.ndarray:
    """Return the rotation from the camera's frame (x right, y down, z forward) to the world."""
    forward = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(forward, up) / np.linalg.norm(np.cross(forward, up))
    return np.column_stack([right, np.cross(forward, right), forward])


def pixel(
    p: np.ndarray, eye: np.ndarray, R: np.ndarray, *, fov: float, size: Any = SIZE
) -> tuple[float, float, float]:
    """Return column, row and depth of a point of the world in a picture of so many pixels."""
    x, y, z = R.T @ (p - eye)
    focal = size[1] / 2 / np.tan(fov / 2)
    return size[0] / 2 + focal * x / z, size[1] / 2 + focal * y / z, z


def test_a_word_stands_over_its_place_from_wherever_it_is_seen(fed):
    p = np.array([0.3, -0.2, 0.4])
    show(fed, {"w": Label("word", p)})
    script = "(camera) => { feed.hear({ type: 'ViewerCameraMessage', ...camera }); finish(); }"
    hidden = 0
    for _ in range(40):
        eye, target, up = RNG.normal(size=(3, 3)) * ((3,), (2,), (1,))
        fov = RNG.uniform(0.4, 1.4)
        R = seen_from(eye, target, up)
        q = Rotation.from_matrix(R).as_quat(scalar_first=True) * RNG.choice([-1, 1])
        fed(script, {"wxyz": q.tolist(), "position": eye.tolist(), "fov": fov})
        u, v, z = pixel(p, eye, R, fov=fov)
        box = fed(WORDS)["w"]
        if z <= 0 or not (-50 < u < 850 and -50 < v < 550):
            assert box is None, "behind the camera, or out of the picture"
            hidden += 1
            continue
        left, top, width, height = box
        if 0 <= u <= SIZE[0]:  # what is in the picture is not cut off at its edge
            u = np.clip(u, width / 2, SIZE[0] - width / 2)
        assert left + width / 2 == pytest.approx(u, abs=0.51)
        assert top + height + 2 == pytest.approx(v, abs=0.51)
    assert 3 < hidden < 35


@pytest.mark.parametrize("words", [8, 60])
def test_words_are_not_cut_off_at_the_edge_of_a_narrow_picture(fed, words):
    fed("() => { $('#scene').style.width = '390px'; }")
    show(fed, {"w": Label(" ".join(["words"] * words), np.array([0.3, 0.3, 0.0]))})
    left, _, width, height = fed(WORDS)["w"]
    assert left >= 0
    assert left + width <= 390
    assert (height > 30) == (words == 60), "what is longer than the picture is wide has more lines"


def test_a_word_goes_out_of_the_way_of_the_page_s_buttons(fed):
    scene = {"w": Label("word", np.zeros(3))}
    show(fed, scene)
    left, top, width, height = fed(WORDS)["w"]
    fed(
        """([x, y, w, h]) => {
          const tools = element("div", { id: "tools" });
          tools.style = `left:${x}px;top:${y}px;right:auto;bottom:auto;width:${w}px;height:${h}px`;
          $("#scene").append(tools);
        }""",
        [left - 5, top - 5, width + 10, height + 10],
    )
    show(fed, scene)
    moved_left, moved_top, *_ = fed(WORDS)["w"]
    fed("() => $('#tools').remove()")
    assert moved_left == left
    assert moved_top + height <= top - 5 or moved_top >= top + height + 5
    show(fed, scene)
    assert fed(WORDS)["w"][:2] == [left, top]


def test_a_word_that_stays_is_centred_at_its_place_and_others_go_out_of_its_way(fed):
    nearer = 0.2 * np.array(BARE.eye)
    show(
        fed,
        {
            "a": Label("244", np.zeros(3), stays=True),
            "b": Label("67", np.array([0.02, 0.0, 0.0]), stays=True),
            "word": Label("word", nearer),
        },
    )
    R = seen_from(BARE.seen_from(), np.array(BARE.target), np.array(BARE.up))
    boxes = fed(WORDS)
    for name, p in (("a", np.zeros(3)), ("b", np.array([0.02, 0.0, 0.0]))):
        u, v, _ = pixel(p, BARE.seen_from(), R, fov=np.radians(BARE.fov_degrees))
        left, top, width, height = boxes[name]
        assert left + width / 2 == pytest.approx(u, abs=0.51)
        assert top + height / 2 == pytest.approx(v, abs=0.51)
    u, v, _ = pixel(nearer, BARE.seen_from(), R, fov=np.radians(BARE.fov_degrees))
    _, top, _, height = boxes["word"]
    assert abs(top + height + 2 - v) > height / 2, "it would cover them where it belongs"
    assert top + height <= boxes["a"][1] or top >= boxes["a"][1] + boxes["a"][3]


@pytest.mark.parametrize("up", [(0.0, 0.0, 1.0), (0.0, -1.0, 0.0), (1.0, 0.0, 0.0)])
@pytest.mark.parametrize("eye", [(2.0, -2.0, 1.5), (-0.5, 0.2, -3.0), (0.1, 4.0, 0.0)])
def test_before_the_client_tells_its_camera_it_is_that_of_the_view(fed, eye, up):
    view = View(eye=eye, target=(0.1, 0.0, 0.2), up=up, grid=0.5, fov_degrees=60.0)
    show(fed, {"w": Label("word", np.zeros(3))}, view)
    R = seen_from(view.seen_from(), np.array(view.target), np.array(up))
    boxes = fed(WORDS)
    for name, p in (
        ("w", np.zeros(3)),
        ("/axis/x", np.array([0.54, 0, 0])),
        ("/axis/z", np.array([0, 0, 0.54])),
    ):
        u, _, z = pixel(p, view.seen_from(), R, fov=np.radians(60.0))
        assert z > 0
        left, _, width, _ = boxes[name]
        assert left + width / 2 == pytest.approx(u, abs=0.51)


def test_what_is_behind_the_camera_is_hidden(fed):
    eye = np.array(BARE.eye)
    show(
        fed,
        {"ahead": Label("a", -0.5 * eye), "behind": Label("b", 1.5 * eye), "at": Label("c", eye)},
    )
    boxes = fed(WORDS)
    assert boxes["ahead"] is not None
    assert boxes["behind"] is boxes["at"] is None


def test_words_at_one_place_do_not_cover_each_other(fed):
    for count in (2, 3, 5):
        show(fed, {f"w{i}": Label(f"word {i}", np.zeros(3)) for i in range(count)})
        boxes = list(fed(WORDS).values())
        assert len(boxes) == count
        for i, (x, y, w, h) in enumerate(boxes):
            for u, v, c, r in boxes[:i]:
                assert not (x < u + c and u < x + w and y < v + r and v < y + h)
    show(fed, {"near": Label("n", 0.2 * np.array(BARE.eye)), "far": Label("f", np.zeros(3))})
    boxes = fed(WORDS)
    u, v, _ = pixel(
        np.zeros(3),
        np.array(BARE.eye),
        seen_from(np.array(BARE.eye), np.zeros(3), np.array(BARE.up)),
        fov=FOV,
    )
    left, top, width, height = boxes["near"]
    assert (left + width / 2, top + height + 2) == pytest.approx((u, v), abs=0.51), (
        "the nearer one stays at its place"
    )


def test_text_is_text(fed):
    text = '<img src=x onerror="window.hit = 1"><b>&amp; \u00b7'
    show(fed, {"w": Label(text, np.zeros(3))})
    assert fed("() => $('#labels').firstChild.textContent") == text
    assert fed("() => $('#labels').firstChild.childElementCount") == 0
    assert fed("() => window.hit ?? 0") == 0


def test_a_word_changes_goes_and_comes_with_its_step(fed):
    all_words = "() => [...$('#labels').children].map((one) => one.textContent)"
    for text in ("one", "two"):
        show(fed, {"w": Label(text, np.zeros(3))})
        assert fed(all_words) == [text]
    show(fed, {})
    assert fed(all_words) == []
    show(fed, {"w": Label("three", np.zeros(3), opacity=0.25)})
    assert fed(all_words) == ["three"]
    assert fed("() => $('#labels').firstChild.style.opacity") == "0.25"


def test_a_word_glides_with_what_it_names(fed):
    ends = np.array([[-0.5, 0.0, 0.0], [0.5, 0.0, 0.4]])
    first, second = fed.add([{"w": Label("w", p)} for p in ends], BARE)
    eye = np.array(BARE.eye)
    R = seen_from(eye, np.zeros(3), np.array(BARE.up))
    show(fed, {})
    fed("(k) => { sceneView.step(scenes[k].nodes, 0); finish(); }", first)
    fed("(k) => sceneView.step(scenes[k].nodes, 1)", second)
    for milliseconds, p in ((125, ends.mean(0)), (125, ends[1])):
        fed("(time) => { tick(time); tick(); }", milliseconds)
        left, _, width, _ = fed(WORDS)["w"]
        assert left + width / 2 == pytest.approx(pixel(p, eye, R, fov=FOV)[0], abs=0.51)


CAMERA = (
    "() => { const { SetCameraPositionMessage: eye, SetCameraFovMessage: fov } = client.camera;"
    " return [eye, fov]; }"
)


@pytest.mark.parametrize("first", [2.0, 1.6, 1.4, 1.2, 0.6])
def test_a_narrower_frame_shows_as_much_in_its_width_and_the_eye_stays(fed, first):
    resize = (
        "(aspect) => { $('#scene').style.width = `${Math.round(500 * aspect)}px`; feed.fit();"
        " finish(); }"
    )
    fed(resize, first)
    show(fed, {"w": Label("w", np.zeros(3))})
    keeps = max(1.2, min(first, 1.6))
    for aspect in (first, 2.5, 1.6, 1.3, 1.0, 0.6, 0.4, 1.1, 2.0):
        keeps = max(keeps, min(aspect, 1.6))  # what was in view once stays in view
        fed("() => { client.said = []; }")
        fed(resize, aspect)
        eye, fov = fed(CAMERA)
        np.testing.assert_allclose(eye, BARE.eye)
        assert {
            message["type"] for message in fed("() => client.said.map(({ type }) => ({ type }))")
        } == {"SetCameraFovMessage"}
        if aspect >= keeps:
            assert fov == pytest.approx(FOV)
        else:
            assert np.tan(fov / 2) * aspect == pytest.approx(np.tan(FOV / 2) * keeps)
        assert fed("() => labels.camera.fov") == pytest.approx(fov)


def test_a_frame_that_becomes_narrow_is_seen_to_by_itself(fed):
    show(fed, {})
    fed("() => { $('#scene').style.width = '300px'; }")
    fed.page.wait_for_function("client.camera.SetCameraFovMessage > 0.9", polling=20)
    assert np.tan(fed(CAMERA)[1] / 2) * 0.6 == pytest.approx(np.tan(FOV / 2) * 1.6)


def test_in_a_narrow_frame_words_stand_where_the_scene_is_drawn_from_the_first(fed):
    fed("() => { $('#scene').style.width = '300px'; }")
    p = np.array([0.4, 0.4, 0.0])
    show(fed, {"w": Label("word", p)})
    _, fov = fed(CAMERA)
    assert fov > FOV
    eye = np.array(BARE.eye)
    u, _, _ = pixel(
        p, eye, seen_from(eye, np.zeros(3), np.array(BARE.up)), fov=fov, size=(300, 500)
    )
    left, _, width, _ = fed(WORDS)["w"]
    assert left + width / 2 == pytest.approx(u, abs=0.51)


def test_a_frame_that_has_no_size_yet_is_told_finite_numbers(fed):
    fed("() => { Object.assign($('#scene').style, { width: '0', height: '0' }); }")
    show(fed, {"w": Label("w", np.zeros(3))})
    assert np.isfinite(fed(CAMERA)[1])
    assert 0 < fed(CAMERA)[1] < np.pi
