"""Two cameras seen from above: the jump of one point on a rail, and the net of whole pixels.

Both are drawn upright, the distance upwards. Across, the drawing is stretched: that keeps lines
straight, and so the rays still cross where they do.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from lessons.disparity.inputs import Input
from workbench.captions import metres, pixels
from workbench.geometry.cameras.stereo import depth_from_disparity
from workbench.geometry.polylines import between, fan
from workbench.lesson import Look, say
from workbench.numerals import brief, length
from workbench.scene import Chart, Label, Mesh, Points, Primitive, Role, Scene, Segments, dimension

JUMPS = np.array([80, 64, 53, 45, 40, 36, 32, 28, 25, 22, 20, 18, 16, 14, 12, 10, 9, 8, 7, 6, 5, 4])
FARTHEST = 20.0  # metres: where the point stands in the last step
BOARDS = (1.0, 5.0, 20.0)  # metres
ERRORS = np.arange(-8, 9) / 8.0  # pixels
DOT = 0.03
COLUMN = 120  # of the left picture, in which the point is seen
WIDTH = 160  # pixels of a picture
RAIL = (-0.32, -0.3)  # where the left camera is drawn, metres of the drawing
# how far the right camera is drawn from it, and how long the rail
APART = 0.64
REACH = 1.4
STRIPS = {"left": -0.66, "right": -0.92}
NET = (-0.75, -1.12)
NET_APART = 1.5
NET_REACH = 2.3
NET_FAR = 30.0
JUMP = Chart("Jump over distance", "distance", "px", x_range=(0.0, 21.0), x_unit="m")
DISTANCE = Chart("Distance", unit="m")
SHIFT = Chart("Jump", unit="px")
MEASURED = Chart("Error of the jump", unit="px")


@dataclass(frozen=True, eq=False)
class Rig:
    """Two cameras side by side: focal length, pixels, times baseline, metres."""

    f_baseline: float

    def jump(self, depth: np.ndarray | float) -> np.ndarray:
        """Return the disparity of points so far away, pixels."""
        return self.f_baseline / np.asarray(depth, float)

    def depth(self, jump: np.ndarray | float) -> np.ndarray:
        """Return the distance of points that jump so far, metres."""
        return depth_from_disparity(np.asarray(jump, float), self.f_baseline, 1.0)


@dataclass(frozen=True)
class Seen:
    """A point so far away (m), and its jump (px)."""

    depth: float
    jump: float


@dataclass(frozen=True)
class Off:
    """By how much every jump is measured too large, pixels."""

    error: float


State = Seen | Off
RigLook = Look[Input, Rig, State]


def rig_of(params: Input) -> Rig:
    """Return the cameras of a run."""
    return Rig(params.focal_length * params.baseline)


def run(params: Input, rig: Rig) -> Iterator[State]:
    """Yield a point ever farther away, or ever larger errors of its jump."""
    if params.stage == "jump":
        for depth in FARTHEST * JUMPS[-1] / JUMPS:
            yield Seen(float(depth), float(rig.jump(depth)))
    else:
        yield from (Off(float(error)) for error in ERRORS)


def draw(look: RigLook) -> Scene:
    """Return the picture of one step."""
    return _jump(look, look.now) if isinstance(look.now, Seen) else _net(look, look.now)


def stand(p: np.ndarray, nearer: float = 0.0) -> np.ndarray:
    """Return points (n, 2) of the drawing in space, so much nearer to the eye."""
    p = np.asarray(p, float)
    return np.stack([p[..., 0], np.full(p.shape[:-1], -nearer), p[..., 1]], axis=-1)


def eyes(left: tuple[float, float], apart: float) -> dict[str, Primitive]:
    """Return two cameras as small triangles that look upwards, with their names."""
    scene: dict[str, Primitive] = {}
    shape = np.array([[0.0, 0.0], [-0.05, -0.09], [0.05, -0.09], [0.0, 0.0]])
    for side, x in (("left", 0.0), ("right", apart)):
        at = np.array(left) + np.array([x, 0.0])
        color: Role = "target" if side == "left" else "source"
        p = stand(at + shape, 0.01)
        scene[f"{side} eye"] = Segments(between(p[:-1], p[1:]), color, 3.0)
        name = stand(at + np.array([-0.16 if side == "left" else 0.17, -0.05]))
        scene[f"{side} eye/name"] = Label(side, name, color)
    return scene


def _jump(look: RigLook, state: Seen) -> Scene:
    rig = look.subject
    left = np.array(RAIL)
    right = left + np.array([APART, 0.0])
    p = left + np.array([0.0, REACH * state.depth / 21.0])
    depths = np.linspace(1.0, 21.0, 161)
    scene: Scene = eyes(RAIL, APART) | {
        "rail": Segments(
            stand(np.array([[left, left + np.array([0.0, REACH])]])), "neutral", 1.5, name="rail"
        ),
        "left ray": Segments(stand(np.array([[left, p]]), 0.004), "target", 3.0, name="left ray"),
        "right ray": Segments(
            stand(np.array([[right, p]]), 0.004), "source", 3.0, name="right ray"
        ),
        "point": Points(stand(p[None], 0.01), "highlight", DOT, name="the point"),
        "point/name": Label(length(state.depth), stand(p + np.array([-0.2, 0.0])), "highlight"),
        "jump/whole": JUMP.whole(depths, rig.jump(depths), "jump", "source"),
        "jump/mark": JUMP.mark(state.depth, state.jump, "the point", "source", steps="distance"),
        "distance": DISTANCE.scalar(state.depth, "distance"),
        "shift": SHIFT.scalar(state.jump, "jump"),
        "caption": say(
            "{depth} away, the point jumps by {jump}.",
            depth=metres(state.depth),
            jump=pixels(state.jump),
        ),
    }
    return scene | _strips(state.jump)


def _strips(jump: float) -> dict[str, Primitive]:
    """Return a row of either picture as a bar, with the point's mark, and the jump between."""
    scale = 2.6 / WIDTH

    def at(column: float, z: float) -> np.ndarray:
        return stand(np.array([scale * (column - WIDTH / 2), z]), 0.01)

    scene: dict[str, Primitive] = {}
    for side, column in (("left", float(COLUMN)), ("right", COLUMN - jump)):
        color: Role = "target" if side == "left" else "source"
        z = STRIPS[side]
        bar = between(at(0.0, z), at(WIDTH, z))
        tick = between(at(column, z - 0.06), at(column, z + 0.06))
        scene[f"{side} row"] = Segments(bar, color, 2.0, opacity=0.5)
        scene[f"{side} mark"] = Segments(tick, color, 8.0)
        scene[f"{side} row/name"] = Label(f"{side} picture", at(17.0, z + 0.07), color)
    z = STRIPS["right"]
    down = between(at(COLUMN, STRIPS["left"] - 0.06), at(COLUMN, z + 0.02))
    return (
        scene
        | {"same column": Segments(down, "target", 1.5, opacity=0.6)}
        | dimension(
            "jump",
            at(COLUMN - jump, z),
            at(COLUMN, z),
            aside=np.array([0.0, 0.0, -0.13]),
            color="highlight",
            text=f"d = {brief(jump)} px",
        )
    )


def _net(look: RigLook, state: Off) -> Scene:
    rig = look.subject
    scene: Scene = eyes(NET, NET_APART) | _rays(rig)
    moved = {}
    for depth in BOARDS:
        jump = float(rig.jump(depth))
        if jump <= 1.0:
            continue
        corners = [_crossing(rig, *pair) for pair in _corners(jump)]
        scene[f"cell/{depth:g}"] = Mesh(
            stand(np.array(corners), 0.004),
            fan(4),
            "highlight",
            opacity=0.25,
            name="one pixel of either picture" if depth == BOARDS[-1] else "",
        )
        measured = moved[depth] = float(rig.depth(jump + state.error))
        at = _crossing(rig, 0.0, jump + state.error)
        scene[f"board/{depth:g}"] = Points(stand(at[None], 0.01), "source", DOT)
        scene[f"board/{depth:g} name"] = Label(
            f"{length(measured)}", stand(at + np.array([-0.23, 0.0])), "source"
        )
    scene["error"] = MEASURED.scalar(state.error, "error")
    if FARTHEST not in moved:
        return scene | {
            "caption": say("Every jump is made {error} larger.", error=pixels(state.error))
        }
    jump = float(rig.jump(FARTHEST))
    measured = moved[FARTHEST]
    chart = Chart("Depth over jump", "measured jump", "m", x_unit="px")
    around = np.linspace(max(jump - 1.1, 0.5 * jump), jump + 1.1, 91)
    tangent = FARTHEST - FARTHEST / jump * (around - jump)
    words = "With an error of {error} the far board seems {found} away."
    return scene | {
        "measured": SHIFT.scalar(jump + state.error, "measured jump"),
        "depth/whole": chart.whole(around, rig.depth(around), "Z = f B / d", "source"),
        "depth/tangent": chart.second(around, tangent, "its tangent at the true jump"),
        "depth/mark": chart.mark(
            jump + state.error, measured, "measured", "source", steps="measured jump"
        ),
        "found": DISTANCE.scalar(measured, "distance found", "truth"),
        "caption": say(words, error=pixels(state.error), found=metres(measured)),
    }


def _corners(jump: float) -> list[tuple[float, float]]:
    """Return the rays that bound a pixel: how far right in the left picture, and the jump."""
    return [(0.5, jump + 1.0), (0.5, jump), (-0.5, jump - 1.0), (-0.5, jump)]


def _crossing(rig: Rig, column: float, jump: float) -> np.ndarray:
    """Return where in the drawing two rays cross, of a left column beside the middle one."""
    depth = min(float(rig.depth(jump)), 1.5 * NET_FAR)
    across = NET_APART * column * depth / rig.f_baseline
    return np.array(NET) + np.array([across, NET_REACH * depth / NET_FAR])


def _rays(rig: Rig) -> dict[str, Primitive]:
    """Return the rays between neighbouring pixels of both cameras, as far as they meet."""
    left = []
    right = []
    for column in np.arange(-1.5, 2.0):
        depth = min(NET_FAR, rig.f_baseline * 1.2 / max(column, 1e-9))
        left.append([(0.0, 0.0), (column * depth / rig.f_baseline, depth)])
    for column in np.arange(1.5, 24.0):
        depth = min(NET_FAR, rig.f_baseline * 1.15 / column)
        right.append([(1.0, 0.0), (1.0 - column * depth / rig.f_baseline, depth)])
    scene: dict[str, Primitive] = {}
    for path, rays in (("left rays", left), ("right rays", right)):
        role: Role = "target" if path == "left rays" else "source"
        ends = np.array(NET) + np.array(rays) * [NET_APART, NET_REACH / NET_FAR]
        scene[path] = Segments(stand(ends), role, 1.2, opacity=0.6, name="rays between two pixels")
    return scene
