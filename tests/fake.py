"""A small lesson for tests that shows every primitive of `workbench.scene` and has a knob of every
kind.

What its run holds, so that a sink can be held to it: a cloud and a mesh that move by their pose
alone, a mesh that is stretched by a 4x4 that is no rigid motion, things that appear late, vanish
and come back, all four ways to colour, NaN in fields, scalars and curves, pictures in space and
beside it, and one caption of each tone.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from workbench.errors import InputError
from workbench.knobs import Gizmo, Knob, Pick
from workbench.lesson import Choice, Lesson, Preset, Question, View
from workbench.scene import (
    PALETTE,
    PRIMITIVES,
    Axes,
    Camera,
    Caption,
    Classes,
    Color,
    Curve,
    Field,
    Label,
    Mesh,
    Picture,
    Points,
    Scalar,
    Scene,
    Segments,
    Table,
)
from workbench.tracing import traced

Turn = Callable[[float], np.ndarray]
"""turn(angle in radians) -> T_world_source."""

CORNERS = np.array([[x, y, z] for x in (-0.2, 0.2) for y in (-0.2, 0.2) for z in (-0.2, 0.2)])
FACES = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],  # noqa: E501
     [1, 5, 7], [1, 7, 3]]
)  # fmt: skip
K = np.array([[40.0, 0.0, 31.5], [0.0, 40.0, 23.5], [0.0, 0.0, 1.0]])
PHOTO = np.stack(
    np.broadcast_arrays(np.arange(0, 256, 4)[None, :], np.arange(0, 240, 5)[:, None], 90), -1
).astype("u1")
LOOKING_DOWN = np.array([[1.0, 0, 0, 0], [0, -1, 0, -1.2], [0, 0, -1, 1.2], [0, 0, 0, 1]])


@dataclass(frozen=True)
class Params:
    """One knob of every kind."""

    angle: Annotated[float, Knob("How far the cloud turns", 0, 180, unit="deg")] = 90.0
    steps: Annotated[int, Knob("How many steps the run has", 1, 5000)] = 6
    points: Annotated[int, Knob("How many points the cloud has", 1, 100_000)] = 200
    wobble: Annotated[bool, Knob("Move the points themselves too, so that no pose will do")] = False
    colors: Annotated[
        Literal["role", "field", "classes", "measured"], Knob("How the cloud is coloured")
    ] = "field"
    place: Annotated[
        tuple[float, float, float], Knob("Where the target is", -2, 2, unit="m", by=Gizmo())
    ] = (0.5, 0, 0)
    pixel: Annotated[
        tuple[int, int], Knob("The chosen pixel", 0, 63, unit="px", by=Pick("plane"))
    ] = (10, 20)
    scan: Annotated[Path | None, Knob("A .npy file of points (n, 3) instead of the made ones")] = (
        None
    )
    trouble: Annotated[
        Literal["none", "input", "crash"], Knob("How the run fails at its third step")
    ] = "none"
    seed: Annotated[int, Knob("Which points are made", 0, 99)] = 0


@dataclass(frozen=True, eq=False)
class State:
    """The cloud where it is now."""

    k: int
    p_source: np.ndarray
    p_target: np.ndarray
    T_world_source: np.ndarray
    error: float
    colors: str
    pixel: tuple[int, int]


def turn_about_z(angle: float) -> np.ndarray:
    """Return the turn by `angle` radians about the world's z axis."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])


@traced
def approach(
    p_source: np.ndarray, p_target: np.ndarray, params: Params, *, turn: Turn
) -> Iterator[State]:
    """Turn the source step by step until it lies on the target."""
    for k in range(params.steps):
        share = k / max(params.steps - 1, 1)
        T_world_source = turn(np.deg2rad(params.angle) * share)
        if params.trouble == "input" and k == 2:
            raise InputError("step 2 met a bad file")
        if params.trouble == "crash" and k == 2:
            raise RuntimeError("a\nbug")
        moved = p_source + 0.01 * np.sin(k) if params.wobble else p_source
        yield State(k, moved, p_target, T_world_source, 1.0 - share, params.colors, params.pixel)


def run(params: Params, *, turn: Turn = turn_about_z) -> Iterator[State]:
    """Yield the cloud at each of its places."""
    rng = np.random.default_rng(params.seed)
    p_source = rng.uniform(-0.5, 0.5, (params.points, 3))
    if params.scan is not None:
        try:
            p_source = np.load(params.scan)
        except (OSError, ValueError) as error:
            raise InputError(f"{params.scan}: not a .npy file of points") from error
    yield from approach(p_source, p_source * 0.5 + np.array(params.place), params, turn=turn)


def colors_of(state: State) -> Color:
    """Return the colour of the cloud, in the way that was asked for."""
    x = state.p_source[:, 0]
    if state.colors == "field":
        return Field(np.where(x > 0.45, np.nan, x), -0.5, 0.5, "Offset in x", "m", "diverging")
    if state.colors == "classes":
        return Classes((x > 0.01 * state.k).astype(int), ("source", "wrong"), ("inlier", "outlier"))
    if state.colors == "measured":
        return np.clip(state.p_source * 255 + 128, 0, 255).astype(np.uint8)
    return "source"


def draw(state: State) -> Scene:
    """Show every primitive there is."""
    k = state.k
    error = state.error
    n = len(state.p_source)
    pull = np.diag([1.0, 1.0, 1.0 + 0.3 * k, 1.0])
    pull[:3, 3] = (-1.0, 0.0, 0.0)
    depth = np.add.outer(np.linspace(1, 2, 48), np.linspace(0, 1, 64) * 0.1 * k)
    depth[:4, :4] = np.nan
    x = np.linspace(0.0, 10.0, 21)
    scene = {
        "source": Points(
            state.p_source, colors_of(state), 0.02, state.T_world_source, name="source"
        ),
        "target": Points(state.p_target, "target", 0.01, opacity=0.6, name="target"),
        "box": Mesh(
            CORNERS, FACES, "source", state.T_world_source, opacity=0.4, flat=True, name="box"
        ),
        "pulled": Mesh(
            CORNERS, FACES, Field(CORNERS[:, 2], 0.0, 0.2, "Height", "m"), pull, name="pulled box"
        ),
        "wire": Mesh(CORNERS * 1.2, FACES, "neutral", wireframe=True, name="wire box"),
        "frame": Axes(state.T_world_source, 0.3, name="source frame"),
        "camera": Camera(K, 64, 48, LOOKING_DOWN, 0.4, PHOTO, "truth", name="camera"),
        "eye": Camera(K, 64, 48, turn_about_z(1.0) @ LOOKING_DOWN, 0.2, name="eye"),
        "word": Label("source · 90°", np.array([0.0, 0.0, 0.7]), "source", state.T_world_source),
        "plane": Picture(PHOTO[:, :, 0], "photo", 0.6, LOOKING_DOWN, opacity=0.8),
        "beside/depth": Picture(Field(depth, 1.0, 2.0, "Depth", "m"), "Depth"),
        "beside/photo": Picture(PHOTO, "Photo"),
        "error": Scalar(error, "Distance", "error", "m", "source"),
        "truth": Scalar(error / 2 if k else np.nan, "Error to truth", "error", "m", "truth"),
        "cost": Scalar(10.0 ** (-k), "Cost", "cost", "", "highlight", log=True),
        "basin": Curve(
            x, (x - k) ** 2, "cost", "Basin", "shift in px", "cost", "source", marks=(float(k),)
        ),
        "known": Curve(
            x,
            np.where(x > 5, np.nan, x),
            "known part",
            "Basin",
            "shift in px",
            "cost",
            "truth",
            "dots",
        ),
        "bars": Curve(
            x,
            np.abs(np.sin(x + k)),
            "count",
            "Histogram",
            "distance in m",
            "points",
            "target",
            "bars",
        ),
        "matrix": Table("T_world_source", ("a", "b"), ((f"{k}", "½ | x"), ("-1", f"{error:.2f}"))),
        "caption": Caption(
            f"Step {k}: {n:,} points turned, distance {error:.3f} m.",
            ("info", "wrong", "good")[min(k, 2)],
        ),
    }
    if k % 2 == 0:
        ends = np.stack([state.p_target[:20], state.p_target[:20] * 0.9], 1)
        scene["pairs"] = Segments(ends, "correspondence", 2.0, name="pairs")
    if k >= 2:
        scene["late"] = Segments(
            CORNERS[:4].reshape(2, 2, 3), Classes(np.array([0, 1]), ("truth", "wrong"), ("a", "b"))
        )
    return scene


HERE = Path(__file__).parent
lesson = Lesson(
    name="fake",
    title="Every primitive",
    summary="A cloud turns; every primitive is in the picture.",
    page=HERE / "fake.md",
    params=Params,
    run=run,
    draw=draw,
    order=1,
    view=View(eye=(2.5, -2.5, 2.0)),
    presets=(
        Preset(
            "half",
            "Half a turn",
            "The cloud turns by 180 degrees and ends upside down.",
            Params(angle=180.0),
        ),
        Preset(
            "short",
            "Two steps",
            "Nothing appears late, since the run ends before.",
            Params(steps=2),
            step=1,
        ),
        Preset(
            "classes", "Inliers", "The cloud has two classes with names.", Params(colors="classes")
        ),
    ),
    questions=(
        Question(
            "end",
            "How far is the cloud at the end?",
            lambda states: states[-1].error,
            lambda states: "It arrives.",
            Params(),
            unit="m",
            tolerance=0.01,
            wrong=((0.9, 1.1, "That is where it starts."),),
        ),
        Question(
            "which",
            "Which is larger?",
            lambda states: 1,
            lambda states: "The second is.",
            Params(),
            choices=(Choice("the first", why="It only looks larger."), "the second"),
        ),
    ),
)


def test_nothing_is_left_out() -> None:
    """Hold the fake lesson to its promise; collected where a test module imports it."""
    shown = {type(primitive) for k in range(3) for primitive in draw(_state(k)).values()}
    assert shown == set(PRIMITIVES)
    assert {"source", "target"} <= set(PALETTE)


def _state(k: int) -> State:
    p = np.zeros((4, 3))
    return State(k, p, p, np.eye(4), 0.5, "field", (0, 0))
