"""What the stages look like in which a hand turns one number of a map."""

import numpy as np

from lessons.transforms.drawing import GROUND, above, front, lines, shown
from lessons.transforms.hands import SHEARS, SLOPES, TURNS, Held, fronts, moved_by, upright_edges
from lessons.transforms.inputs import Body, Input
from workbench.captions import degrees, fixed, metres
from workbench.geometry.motions import angle_between
from workbench.geometry.motions.affine import transform
from workbench.geometry.polylines import between, segments
from workbench.lesson import Look, say
from workbench.numerals import coordinates, length
from workbench.numerals import fixed as in_places
from workbench.scene import (
    Caption,
    Chart,
    Color,
    Field,
    Label,
    Mesh,
    Primitive,
    Role,
    Scene,
    Segments,
    Table,
    arc,
    arrows,
    dashed,
    dimension,
)

UP = np.array([0.0, 0.0, 1.0])
AXES: tuple[Role, Role, Role] = ("x", "y", "z")
LIFT = 0.012  # metres: what lies on the ground is drawn so high over it
CUBE = np.array([1.05, -0.35, 0.0])  # where the unit cube stands, beside the house
LONG = 1.3  # times: how long the arrows to the front are drawn
HIGHEST = 3.2  # metres: so high the prolonged edges are drawn
APART = Chart(
    "Distance between the houses", "angle of the turn", "m", x_range=(0.0, 180.0), x_unit="deg"
)
MISSED = Chart("Miss of (Rᵀ, −t)", "angle of the turn", "m", x_range=(0.0, 180.0), x_unit="deg")
FACTOR = Chart("What the shear multiplies", "shear", "×", (-1.5, 1.5), y_range=(0.6, 2.0))
MEET = Chart(
    "Where the upright edges meet", "s", "m", (0.0, 0.6), x_unit="1/m", y_range=(0.0, 10.0)
)
ANGLE = Chart("Angle", unit="deg")
SHARE = Chart("Share", unit="%")
SLOPE = Chart("s", unit="1/m")
SHEARED = Chart("Shear")
DET = Chart("det T")
LEAN = Chart("Lean", unit="deg")
HEIGHT = Chart("Meeting", unit="m")
RATIO = Chart("Length")


def draw(look: Look[Input, Body, Held]) -> Scene:
    """Return the picture of one value of the number under the hand."""
    scene = {"ground": GROUND} | DRAWINGS[look.params.stage](look)
    return scene | {
        "matrix": Table.of_matrix("T", ("x axis", "y axis", "z axis", "origin"), look.now.T)
    }


def _columns(look: Look[Input, Body, Held]) -> dict[str, Primitive]:
    """Return the house on its three arrows, and the recipe of one vertex along them."""
    body = look.subject
    T = look.now.T
    point = look.subject.followed(look.params.point)
    p = body.solid.p[point]
    steps = np.vstack([np.zeros(3), np.cumsum(T[:3, :3] * p, axis=1).T])
    det = float(np.linalg.det(T[:3, :3]))
    lean = float(np.degrees(angle_between(T[:3, 2], UP)))
    scene: dict[str, Primitive] = {
        **shown("body", body, T, opacity=0.55),
        "vertex": Label(f"vertex {point}", steps[-1] + 0.06 * UP, "highlight"),
        "det": DET.scalar(det, "det T"),
        "share": SHARE.scalar(look.now.value, "share"),
        "lean": LEAN.scalar(lean, "lean"),
        "caption": _where_arrows_go(look, lean, det),
    }
    for k, role in enumerate(AXES):
        column = T[:3, k]
        scene[f"{role} arrow"] = arrows(
            np.zeros((1, 3)), column[None], role, head=0.12, width=8, name=f"where {role} goes"
        )
        out = column + 0.17 * column / max(_size(column), 1e-6)
        scene[f"{role} name"] = Label(f"{role} → {coordinates(column, 2)}", out, role)
        scene[f"{role} part"] = Segments(segments(steps[k : k + 2]), role, 4.0)
    return scene


def _where_arrows_go(look: Look[Input, Body, Held], lean: float, det: float) -> Caption:
    """Say how far z leans and what that makes of the volume; where z stays, where x and y go."""
    if look.params.z_tip == (0.0, 0.0, 1.0):
        x, y = (coordinates(column, 2) for column in look.now.T[:3, :2].T)
        return say("x goes to {x}, and y to {y}.", x=x, y=y)
    return say("z leans by {lean}. The volume is × {det}.", lean=degrees(lean), det=fixed(det, 2))


def _size(v: np.ndarray) -> float:
    return float(np.linalg.norm(v))


def _order(look: Look[Input, Body, Held]) -> dict[str, Primitive]:
    """Return both houses, and the two paths of their origins."""
    body = look.subject
    state = look.now
    t = moved_by(look.params)
    origin = state.T[:3, 3]
    other = state.T_other[:3, 3]
    apart = _size(origin - other)
    radius = _size(t[:2])
    gaps = 2.0 * radius * np.sin(np.radians(TURNS) / 2.0)
    scene: dict[str, Primitive] = {
        **shown("start", body, np.eye(4), color="target", opacity=0.12),
        **shown("body", body, state.T, name="turned, then moved"),
        **shown("other", body, state.T_other, color="highlight", name="moved, then turned"),
        "move": arrows(
            np.array([[0.0, 0.0, LIFT]]), origin[None] + LIFT * UP, "source", head=0.1, width=3
        ),
        "apart": APART.whole(TURNS, gaps, "distance between the houses", "source"),
        "apart mark": APART.mark(state.value, apart, "your hand", "source", steps="angle"),
        "distance": Chart("Distance", unit="m").scalar(apart, "distance"),
        "angle": ANGLE.scalar(state.value, "angle"),
        "caption": say(
            "Turned by {angle}: the two houses are {apart} apart.",
            angle=degrees(state.value),
            apart=metres(apart),
        ),
    }
    if state.value and radius:
        at = np.array([0.0, 0.0, LIFT])
        scene |= arc("in place", at, t, state.value, about=UP, radius=0.75, color="source", width=3)
        scene |= arc(
            "swing", at, t, state.value, about=UP, radius=radius, color="highlight", text=""
        )
    if apart:
        aside = 0.95 * (origin + other) / max(_size(origin + other), 1e-9)
        if _size(origin + other) < 1e-6:
            aside = np.array([0.0, -0.6, 0.0])
        scene |= dimension(
            "gap", origin + LIFT * UP, other + LIFT * UP, aside=aside, color="neutral"
        )
    return scene


def _undo(look: Look[Input, Body, Held]) -> dict[str, Primitive]:
    """Return the house that was moved, and where the right and the wrong inverse take it."""
    body = look.subject
    state = look.now
    t = moved_by(look.params)
    p_wrong = state.T_other[:3, 3]
    p_right = state.T[:3, 3]
    missed = _size(p_wrong)
    turn = np.radians(state.value)
    R = np.array([[np.cos(turn), -np.sin(turn), 0.0], [np.sin(turn), np.cos(turn), 0.0], UP])
    T_moved = np.eye(4)
    T_moved[:3, :3] = R
    T_moved[:3, 3] = t
    back = R.T @ t
    at = LIFT * UP
    scene: dict[str, Primitive] = {
        **shown("start", body, np.eye(4), color="target", opacity=0.12),
        **shown("body", body, T_moved, opacity=0.45, name="after the motion"),
        "undo/right": lines(body, state.T, color="truth", width=3.0),
        **shown("undo/wrong", body, state.T_other, color="wrong", opacity=0.5, name="by (Rᵀ, −t)"),
        "undo/slide": dashed(
            np.stack([t + at, at]), "truth", dash=0.05, width=3, name="by (Rᵀ, −Rᵀt)"
        ),
        "undo/wrong slide": arrows(back[None] + at, p_wrong[None] + at, "wrong", head=0.1, width=3),
        "move": arrows(at[None], t[None] + at, "source", head=0.1, width=3),
        "missed": MISSED.whole(
            TURNS, 2.0 * _size(t[:2]) * np.sin(np.radians(TURNS) / 2.0), "miss", "wrong"
        ),
        "missed mark": MISSED.mark(state.value, missed, "your hand", "wrong", steps="angle"),
        "miss": Chart("Distance", unit="m").scalar(missed, "miss", "wrong"),
        "right miss": Chart("Distance", unit="m").scalar(_size(p_right), "left by ours", "truth"),
        "angle": ANGLE.scalar(state.value, "angle"),
    }
    if state.value and _size(t[:2]):
        scene |= arc(
            "undo/turn back",
            at,
            t,
            -state.value,
            about=UP,
            radius=_size(t[:2]),
            color="wrong",
            width=3,
        )
    if missed > 0.05:
        aside = 0.62 * np.cross(UP, p_wrong) / missed
        text = f"misses by {length(missed)}"
        ends = at, p_wrong + at
        scene |= dimension("undo/miss", *ends, aside=aside, color="wrong", text=text)
    undone = bool(np.abs(state.T - np.eye(4)).max() < 1e-9)
    words = "Turned by {angle}, then moved: (Rᵀ, −t) misses the start by {missed}."
    if not undone:
        words = "Turned by {angle}, then moved: the given inverse does not come home. "
        words += "(Rᵀ, −t) misses by {missed}."
    caption = say(
        words,
        tone="info" if undone else "wrong",
        angle=degrees(state.value),
        missed=metres(missed),
    )
    return scene | {"caption": caption}


def _shear(look: Look[Input, Body, Held]) -> dict[str, Primitive]:
    """Return the house, its edges in the colour of how much longer they are, and the unit cube."""
    body = look.subject
    state = look.now
    ends = body.solid.lines
    sheared = transform(state.T, ends.reshape(-1, 3)).reshape(-1, 2, 3)
    ratio = _lengths(sheared) / _lengths(ends)
    color: Color = Field(ratio, 0.5, 1.5, "length of the edges", "×")
    upright = float(np.hypot(1.0, state.value))
    corner = np.array([-0.5, -0.36, 0.0])
    bent = float(np.degrees(np.arctan(state.value)))
    cube = _cube()
    box = transform(state.T, cube.reshape(-1, 3)).reshape(-1, 2, 3) + CUBE
    det = float(np.linalg.det(state.T[:3, :3]))
    scene: dict[str, Primitive] = {
        "body": Mesh(body.solid.p, body.solid.faces, "source", state.T, 0.35, flat=True),
        "edges": Segments(sheared, color, 5.0),
        **arc(
            "corner",
            corner,
            np.array([1.0, 0.0, 0.0]),
            90.0 - bent,
            about=np.array([0.0, -1, 0]),
            radius=0.25,
            color="highlight",
        ),
        "cube": Segments(box, "neutral", 3.0, name="the unit cube, sheared"),
        "cube name": Label(
            f"volume × {in_places(det, 2)}", box.reshape(-1, 3).mean(axis=0), "neutral"
        ),
        "det": DET.scalar(det, "det T"),
        "shear": SHEARED.scalar(state.value, "shear"),
        "upright": RATIO.scalar(upright, "upright edges"),
        "corner angle": Chart("Corner", unit="deg").scalar(90.0 - bent, "corner"),
        "caption": say(
            "Sheared by {shear}: upright edges × {upright}, the corner has {corner}.",
            shear=fixed(state.value, 2),
            upright=fixed(upright, 2),
            corner=degrees(90.0 - bent),
        ),
        "factor/upright": FACTOR.whole(SHEARS, np.hypot(1.0, SHEARS), "upright edges", "source"),
        "factor/roof": FACTOR.whole(SHEARS, roof(SHEARS), "left slope of the roof", "highlight"),
        "factor/volume": FACTOR.second(SHEARS, np.ones(len(SHEARS)), "volume", "truth"),
        "factor/mark": FACTOR.mark(state.value, upright, "your hand", "source", steps="shear"),
    }
    return scene


def roof(s: np.ndarray) -> np.ndarray:
    """Return how many times as long the left slope of the house's roof is under a shear s."""
    return np.hypot(0.65 + 0.4 * s, 0.4) / np.hypot(0.65, 0.4)


def _cube() -> np.ndarray:
    """Return the edges (12, 2, 3) of the cube of half a metre."""
    corners = 0.5 * np.array([[i & 1, i >> 1 & 1, i >> 2] for i in range(8)], float)
    pairs = [(i, i | bit) for i in range(8) for bit in (1, 2, 4) if not i & bit]
    return corners[np.array(pairs)]


def _lengths(ends: np.ndarray) -> np.ndarray:
    return np.linalg.norm(np.diff(ends, axis=1)[:, 0], axis=1)


def _shift(look: Look[Input, Body, Held]) -> dict[str, Primitive]:
    """Return the moved house, its front as a direction, and as a place."""
    body = look.subject
    state = look.now
    right, taken = fronts(state.T)
    p_door = transform(state.T, body.p_door[None])
    off = float(np.degrees(angle_between(right, taken)))
    shift = _size(state.T[:3, 3])
    scene: dict[str, Primitive] = {
        "start": lines(body, np.eye(4), color="target"),
        **shown("body", body, state.T, opacity=0.12),
        "start name": above("start", body, np.eye(4), color="target"),
        "path": dashed(np.stack([LIFT * UP, state.T[:3, 3] + LIFT * UP]), "neutral", dash=0.05),
        "wrong front": arrows(
            p_door, p_door + LONG * taken, "wrong", head=0.12, width=6, name="taken with w = 1"
        ),
        "wrong name": Label("w = 1", p_door[0] + (LONG + 0.12 / _size(taken)) * taken, "wrong"),
        "front": front(body, state.T, size=LONG, width=6),
        "front name": Label("w = 0", p_door[0] + (LONG + 0.12) * right, "highlight"),
        "error": Chart("Error", unit="deg").scalar(off, "error", "wrong"),
        "share": SHARE.scalar(state.value, "share"),
        "caption": say(
            "Moved by {shift}: the arrow with w = 1 is {off} off.",
            shift=metres(shift),
            off=degrees(off),
        ),
    }
    if off > 1.0:
        about = np.cross(right, taken)
        scene |= arc("off", p_door[0], right, off, about=about, radius=0.6, color="wrong", width=3)
    return scene


def _divide(look: Look[Input, Body, Held]) -> dict[str, Primitive]:
    """Return the body divided by w, its upright edges prolonged to where they meet."""
    body = look.subject
    state = look.now
    feet_and_tops = upright_edges(body)
    ends = transform(state.T, feet_and_tops.reshape(-1, 3)).reshape(-1, 2, 3)
    unit = np.diff(ends, axis=1)[:, 0] / _lengths(ends)[:, None]
    apart = float(np.degrees(np.arccos(np.clip(unit @ unit.T, -1.0, 1.0))).max())
    high = np.inf if state.value == 0 else 1.0 / state.value
    with np.errstate(divide="ignore"):
        rising = 1.0 / SLOPES
    drawn = SLOPES > 0.09
    up_to = min(high, HIGHEST)
    reach = ends[:, 0] + unit * ((up_to - ends[:, 0, 2]) / unit[:, 2])[:, None]
    scene: dict[str, Primitive] = {
        **shown("body", body, state.T),
        "start": lines(body, np.eye(4), color="target"),
        "prolonged": Segments(between(ends[:, 0], reach), "highlight", 2.5, name="upright edges"),
        "s": SLOPE.scalar(state.value, "s"),
        "apart": Chart("Angle", unit="deg").scalar(apart, "upright edges apart"),
        "height": HEIGHT.scalar(high if np.isfinite(high) else np.nan, "meeting"),
        "meet": MEET.whole(SLOPES[drawn], rising[drawn], "height of the meeting", "highlight"),
    }
    if drawn[np.argmin(np.abs(SLOPES - state.value))]:
        scene["meet mark"] = MEET.mark(state.value, high, "your hand", "highlight", steps="s")
    if up_to == high:
        p = np.array([0.0, 0.0, high])
        scene["apex"] = Label(f"(0, 0, {length(high)})", p + 0.06 * UP, "highlight")
    if state.value == 0:
        return scene | {"caption": say("Divided by w = 1: nothing changes.")}
    return scene | {
        "caption": say(
            "Divided by w = 1 + {s} z: the upright edges are up to {apart} apart.",
            s=fixed(state.value, 2),
            apart=degrees(apart),
        )
    }


DRAWINGS = {
    "columns": _columns,
    "order": _order,
    "undo": _undo,
    "shear": _shear,
    "shift": _shift,
    "divide": _divide,
}
