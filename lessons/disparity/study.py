"""The stages of one knob: the map at all windows, at all prices of a jump, or the shadow at all
baselines.
"""

import functools
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from lessons.disparity.above import eyes, stand
from lessons.disparity.inputs import Input
from lessons.disparity.matching import OTHER_COSTS
from lessons.disparity.pairs import SIZE, Pictures, taken
from lessons.disparity.row import DOT, FACING, LAYER
from lessons.disparity.swept import (
    PRICED,
    PRICES,
    WINDOWS,
    smoothed,
    wrong_at_price,
    wrong_over_windows,
)
from lessons.disparity.truth import judged
from workbench.algorithms.stereo.cost_volume import CostVolume, sad_cost_volume
from workbench.captions import fixed as decimals
from workbench.captions import metres, number, pixels, share
from workbench.data.views.stereo import StereoPair, shares_hidden
from workbench.geometry.cameras.stereo import StereoCamera
from workbench.geometry.motions import motion
from workbench.geometry.polylines import fan
from workbench.lesson import Look, say
from workbench.numerals import percent
from workbench.scene import (
    PALETTE,
    Chart,
    Field,
    Label,
    Mesh,
    Picture,
    Points,
    Primitive,
    Role,
    Scene,
    Segments,
)

BASELINES = (0.05, 0.075, 0.1, 0.125, 0.15, 0.175, 0.2, 0.25, 0.3)
NOISES: dict[float, Role] = {4.0: "target", 8.0: "wrong"}
CALLED = {"repeated pattern": "stripes", "plain wall": "bare wall", "spheres": "balls"}
UNCERTAIN = 0.5  # pixels: the error of a jump for which depths are judged

# metres: the distances in the scene of posts
POST = 1.1
WALL = 3.0

# of the two pictures: how far aside, and how wide
SIDE = 0.83
WIDTH = 1.56
EYES = (0.66, -0.95)
APART = 0.5
REACH = 1.75
OF_WINDOW = Chart(
    "Wrong pixels and window", "side of the window", "%", x_range=(0.0, 22.0), x_unit="px"
)
OF_PRICE = Chart(
    "Wrong pixels and price", "price of a jump, in usual costs", "%", x_range=(0.0, 4.0)
)
OF_BASELINE = Chart(
    "Hidden pixels and depth error",
    "distance between the cameras",
    "%",
    x_range=(0.04, 0.31),
    x_unit="m",
)
WRONG = Chart("Wrong pixels", unit="%")
HIDDEN = Chart("Hidden pixels", unit="%")
BAND = Chart("Width of the band", unit="px")
SIDE_TURNED = Chart("Side of the window", unit="px")
PRICE_TURNED = Chart("Price of a jump")
BASELINE_TURNED = Chart("Distance between the cameras", unit="m")


@dataclass(frozen=True, eq=False)
class Tried:
    """A knob at one of its values, the map found then (NaN: not sought), and two shares of it.

    Attributes:
        value: The window (px), the price (usual costs), or the baseline (m).
        disparity: The map, pixels.
        share: Of the pixels that both see, those over 1 px off; or of all, those that are hidden.
        sigma: With a baseline: the part of itself by which half a pixel moves the wall's depth.
        wrong: With a price: the wrong pixels (%) of each scene of PRICED at this price.
    """

    value: float
    disparity: np.ndarray
    share: float
    sigma: float = math.nan
    wrong: Mapping[str, float] = field(default_factory=dict)


StudyLook = Look[Input, Pictures, Tried]


def run(
    params: Input, pictures: Pictures, cost_volume: CostVolume = sad_cost_volume
) -> Iterator[Tried]:
    """Yield the knob at one value after the other."""
    if params.stage == "baselines":
        for baseline in BASELINES:
            pair = _with(params, baseline)
            yield Tried(baseline, _true(pair), hidden(pair), _sigma(pair.camera))
        return
    compare = OTHER_COSTS.get(params.cost, cost_volume)
    most = pictures.max_disparity
    for value in WINDOWS if params.stage == "windows" else PRICES:
        window, price = (value, 0.0) if params.stage == "windows" else (params.window, value)
        cost = compare(pictures.left, pictures.right, most, int(window))
        disparity = smoothed(cost, price).astype(np.float32)
        off = judged(pictures, disparity)[0]
        wrong = (
            {name: wrong_at_price(name, params.seed, price) for name in PRICED}
            if params.stage == "penalties" and math.isfinite(off)
            else {}
        )
        yield Tried(float(value), disparity, off, wrong=wrong)


def _scene(params: Input) -> str:
    return "posts" if params.scene == "Motorcycle" else params.scene


def _with(params: Input, baseline: float) -> StereoPair:
    """Return the scene's pair with another baseline."""
    noise = params.noise
    seed = params.seed
    return taken(_scene(params), params.focal_length, baseline, noise=noise, seed=seed)


def _true(pair: StereoPair) -> np.ndarray:
    assert pair.disparity is not None
    return pair.disparity.astype(np.float32)


def hidden(pair: StereoPair) -> float:
    """Return the share of left pixels that the right camera does not see."""
    assert pair.visible is not None
    return 1.0 - float(pair.visible.mean())


@functools.lru_cache(maxsize=16)
def hidden_over_baselines(scene: str, camera: StereoCamera) -> np.ndarray:
    """Return `hidden` at each of BASELINES; else the cameras are as the one given."""
    return shares_hidden(scene, [replace(camera, baseline=B) for B in BASELINES], SIZE)


def _sigma(camera: StereoCamera) -> float:
    return WALL / (camera.f * camera.baseline) * UNCERTAIN


def draw(look: StudyLook) -> Scene:
    """Return the picture of one value."""
    if look.params.stage == "baselines":
        return _of_baseline(look)
    return _of_window(look) if look.params.stage == "windows" else _of_price(look)


def _picture(image: np.ndarray, title: str, x: float, *, width: float = WIDTH) -> Picture:
    """Return a picture upright before the eye."""
    h, w = image.shape[:2]
    return Picture(image, title, min(width, 1.5 * w / h), motion(FACING, np.array([x, 0.0, 0.05])))


def _named(picture: Picture, words: str, color: Role = "neutral") -> Label:
    w, h = picture.size
    return Label(words, picture.places(np.array([w / 2, -0.04 * h])), color)


def maps(look: StudyLook) -> dict[str, Primitive]:
    """Return the left picture beside the map, with its wrong pixels marked."""
    pictures = look.subject
    state = look.now
    pair = pictures.pair
    field = Field(state.disparity, 0.0, float(pictures.max_disparity), "Disparity", "px")
    shown = field.rgb().copy()
    words = "map of the jumps"
    if pair.disparity is not None and pair.visible is not None:
        off = np.abs(state.disparity - pair.disparity) > 1.0
        shown[off & pair.visible] = PALETTE["wrong"]
        shown[~pair.visible] = 128
        words = f"map: {percent(state.share, 1)} wrong (orange-red), hidden grey"
    left = _picture(pair.left, "left picture", -SIDE)
    right = _picture(shown, "map", SIDE)
    spot = left.places(np.array([pictures.pixel]), 2 * LAYER)
    return {
        "left/picture": left,
        "left/name": _named(left, "left picture", "target"),
        "left/edge": Segments(left.border(LAYER), "target", 2.5),
        "left/pixel": Points(spot, "highlight", 0.6 * DOT),
        "map/picture": right,
        "map/name": _named(right, words),
    }


def _of_window(look: StudyLook) -> Scene:
    state = look.now
    pictures = look.subject
    scene = maps(look)
    left = scene["left/picture"]
    assert isinstance(left, Picture)
    half = state.value / 2
    middle = np.array(pictures.pixel)
    box = left.box(middle - half, middle + half, 2 * LAYER)
    scene["left/window"] = Segments(box, "highlight", 3.0, name="the window")
    scene["window"] = SIDE_TURNED.scalar(state.value, "window")
    scene["wrong"] = WRONG.scalar(100 * state.share, "wrong pixels", "truth")
    window = pixels(state.value)
    if not math.isfinite(state.share):
        return scene | {"caption": say("A window of {window} on a side.", window=window)}
    if look.params.scene != "Motorcycle" and look.params.left is None:
        for noise, role in NOISES.items():
            curve = wrong_over_windows(look.params.scene, noise, look.params.seed)
            words = f"noise of {noise:.0f} grey levels"
            scene[f"windows/{noise:.0f}"] = OF_WINDOW.whole(
                np.array(WINDOWS, float), curve, words, role
            )
    scene["windows/mark"] = OF_WINDOW.mark(
        state.value, 100 * state.share, "here", "source", steps="window"
    )
    return scene | {
        "caption": say(
            "A window of {window} on a side: {wrong} of the pixels are wrong.",
            window=window,
            wrong=share(state.share, 1),
        )
    }


def _of_price(look: StudyLook) -> Scene:
    last = look.now
    scene = maps(look)
    scene["price"] = PRICE_TURNED.scalar(last.value, "price")
    scene["wrong"] = WRONG.scalar(100 * last.share, "wrong pixels", "truth")
    price = decimals(last.value, 1)
    if not math.isfinite(last.share):
        return scene | {"caption": say("A jump costs {price} usual costs.", price=price)}
    tried = [*look.past, last]
    top = max(100 * tried[0].share, *tried[0].wrong.values())  # no price is as bad as none
    chart = replace(OF_PRICE, y_range=(0.0, 1.05 * top + 0.1))
    for name, role in PRICED.items():
        curve = np.full(len(PRICES), math.nan)
        curve[: len(tried)] = [step.wrong[name] for step in tried]
        scene[f"prices/{name}"] = chart.whole(np.array(PRICES), curve, CALLED[name], role)
    scene["prices/mark"] = chart.mark(last.value, 100 * last.share, "here", "source", steps="price")
    return scene | {
        "caption": say(
            "A jump costs {price} usual costs: {wrong} of the pixels are wrong.",
            price=price,
            wrong=share(last.share, 1),
        )
    }


def _of_baseline(look: StudyLook) -> Scene:
    state = look.now
    params = look.params
    pair = _with(params, state.value)
    shown = pair.left.copy()
    assert pair.visible is not None
    shown[~pair.visible] = PALETTE["wrong"]
    left = _picture(shown, "left picture", -SIDE)
    here = state.value
    x = np.array(BASELINES)
    behind = hidden_over_baselines(_scene(params), replace(pair.camera, baseline=BASELINES[0]))
    errors = np.array([_sigma(replace(pair.camera, baseline=B)) for B in BASELINES])
    scene: Scene = {
        "left/picture": left,
        "left/name": _named(
            left, f"left picture: {percent(state.share, 1)} hidden (orange-red)", "target"
        ),
        "left/edge": Segments(left.border(LAYER), "target", 2.5),
        **shadow(look),
        "baseline": BASELINE_TURNED.scalar(here, "baseline"),
        "hidden": HIDDEN.scalar(100 * state.share, "hidden", "wrong"),
        "sigma": HIDDEN.scalar(100 * state.sigma, "error of the depth", "target"),
        "trade/hidden": OF_BASELINE.whole(x, 100 * behind, "hidden, of all pixels", "wrong"),
        "trade/sigma": OF_BASELINE.whole(x, 100 * errors, "½ px, of the wall's depth", "target"),
        "trade/mark": OF_BASELINE.mark(here, 100 * state.share, "here", "wrong", steps="baseline"),
        "caption": say(
            "Cameras {baseline} apart: {hidden} hidden, and half a pixel is {sigma} of the wall's"
            " depth.",
            baseline=metres(here),
            hidden=share(state.share, 1),
            sigma=share(state.sigma, 1),
        ),
    }
    return scene


def shadow(look: StudyLook) -> dict[str, Primitive]:
    """Return both cameras, a post and the wall from above, and what of the wall only the left
    camera sees.

    Across, the drawing is stretched.
    """
    params = look.params
    state = look.now
    if params.scene != "posts":
        return {}
    fB = params.focal_length * state.value
    jumps = fB / POST, fB / WALL
    wide = APART * state.value / BASELINES[-1]
    foot = np.array(EYES)

    def at(x: float, z: float) -> np.ndarray:
        return foot + np.array([x, REACH * z / WALL])

    edge = at(0.16, POST)
    behind_left = foot + (edge - foot) * WALL / POST
    eye = foot + np.array([wide, 0.0])
    behind_right = eye + (edge - eye) * WALL / POST
    corners = np.array([edge, behind_right, behind_left])
    between_them = (behind_left + behind_right) / 2
    return eyes(EYES, wide) | {
        "wall": Segments(
            stand(np.array([[at(-0.4, WALL), at(0.9, WALL)]])), "neutral", 4.0, name="wall"
        ),
        "post": Segments(
            stand(np.array([[edge, edge + np.array([0.3, 0.0])]]), 0.01),
            "neutral",
            7.0,
            name="post",
        ),
        "left ray": Segments(
            stand(np.array([[foot, behind_left]])), "target", 2.5, name="left ray"
        ),
        "right ray": Segments(
            stand(np.array([[eye, behind_right]])), "source", 2.5, name="right ray"
        ),
        "shadow": Mesh(stand(corners, 0.004), fan(3), "wrong", opacity=0.35, name="seen by one"),
        "shadow/name": Label(
            f"left camera only: {number(jumps[0] - jumps[1])} px",
            stand(between_them + np.array([0.0, 0.1])),
            "wrong",
        ),
        "band": BAND.scalar(jumps[0] - jumps[1], "width of the band", "wrong"),
    }
