"""What the stages look like that show one name of a turn."""

import numpy as np

from lessons.rotations.inputs import Body, Input
from lessons.rotations.names import (
    APARTS,
    ENDS,
    PITCHES,
    Named,
    Read,
    axles,
    knob_degrees,
    whole_turn,
)
from workbench.captions import degrees, share
from workbench.data.framing import ground_grid
from workbench.geometry.motions import motion
from workbench.geometry.motions.alignment import degrees_between, nearest_rotation
from workbench.geometry.motions.rotations import axis_angle_from_rotation, euler_axes
from workbench.geometry.polylines import between
from workbench.lesson import Look, say
from workbench.numerals import ROUND_OFF, fixed_row
from workbench.numerals import fixed as in_places
from workbench.scene import (
    Chart,
    Label,
    Mesh,
    Primitive,
    Role,
    Scene,
    Segments,
    Table,
    arc,
    arrows,
    circle,
    dashed,
)

X, Y, UP = np.eye(3)
ORIGIN = np.zeros(3)
RADII = (1.0, 0.86, 0.72)  # metres: the rings, from outside
DIAL = 0.55
ASIDE = np.array([-1.35, 0.0, 0.55])
SMALL = 0.5  # how large the house is within the rings
ROLES: dict[str, Role] = {"x": "x", "y": "y", "z": "z"}
GROUND = Segments(ground_grid(0.5, 0.0, 2.5), "neutral", 1, opacity=0.2, name="grid 0.5 m")
KNOB = Chart(
    "Degrees of ring for 1° of house",
    "pitch",
    "deg",
    x_range=(-90.0, 90.0),
    x_unit="deg",
    y_range=(0.0, 30.0),
)
LONG = Chart(
    "How far the house turns", "the end is turned by", "deg", x_range=(0.0, 360.0), x_unit="deg"
)
LEFT = Chart("Volume left halfway", "angle apart", "%", x_range=(0.0, 180.0), x_unit="deg")
ANGLE = Chart("Angle", unit="deg")
APART = Chart("Apart", unit="deg")
PITCH = Chart("Pitch", unit="deg")
VOLUME = Chart("Volume", unit="%")


def shown(
    path: str,
    body: Body,
    T: np.ndarray,
    *,
    color: Role = "source",
    opacity: float = 0.85,
    name: str = "",
) -> dict[str, Primitive]:
    """Return the body as a surface with its edges."""
    p = body.solid.p
    faces = body.solid.faces
    if np.linalg.det(T[:3, :3]) < 0:
        faces = faces[:, ::-1]
    edges: Role = "neutral" if color == "source" else color
    return {
        path: Mesh(p, faces, color, T, opacity, flat=True, name=name),
        f"{path} edges": lines(body, T, color=edges),
    }


def lines(body: Body, T: np.ndarray, *, color: Role, name: str = "") -> Segments:
    """Return the edges of the body alone."""
    return Segments(body.solid.lines, color, 2.5, T, name=name)


def draw_rings(look: Look[Input, Body, Named]) -> Scene:
    """Return three rings, each on an axle that the one outside it carries, and the house inside."""
    params = look.params
    pose = look.now
    axes = axles(params, pose.value)
    letters = list(params.order.lower())
    if params.order.islower():  # the last of fixed axes is the outermost ring
        axes = axes[::-1]
        letters = letters[::-1]
    outer, middle, inner = axes
    apart = float(np.degrees(np.arcsin(min(np.linalg.norm(np.cross(outer, inner)), 1.0))))
    amount = knob_degrees(axes)
    T = motion(pose.R, ORIGIN)
    T[:3, :3] *= SMALL
    T[:3, 3] = -0.5 * SMALL * pose.R[:, 2]
    # each ring holds the axle it hangs on and the axle that it carries
    normals = (np.cross(middle, outer), np.cross(inner, middle), pose.R @ _across(pose.R.T @ inner))
    scene: dict[str, Primitive] = shown("body", look.subject, T)
    names = ("outer", "middle", "inner")
    for k, ring in enumerate(names):
        role = ROLES[letters[k]]
        pinned = RADII[k] * axes[k]
        out = pinned * (RADII[k] + 0.24) / RADII[k]
        inward = pinned * 0.86
        scene[f"{ring} ring"] = circle(
            ORIGIN, normals[k], RADII[k], role, width=6.0, name=f"{ring} ring, axle {letters[k]}"
        )
        scene[f"{ring} axle"] = Segments(np.stack([[inward, out], [-inward, -out]]), role, 4.0 - k)
        scene[f"{ring} name"] = Label(f"{ring} axle", out * 1.05, role)
    toward = inner if inner @ outer >= 0 else -inner
    if apart > 0.5:
        about = np.cross(toward, outer)
        scene |= arc(
            "between", ORIGIN, toward, apart, about=about, radius=0.5, color="highlight", width=3
        )
    dead = np.cross(outer, middle)
    if abs(pose.value) >= 60.0:
        ends = np.stack([-1.3 * dead, 1.3 * dead])
        scene["dead"] = dashed(ends, "neutral", dash=0.05, width=4.0)
        words = "no ring turns about this" if apart < 0.5 else "hardly any ring turns about this"
        scene["dead name"] = Label(words, 1.38 * dead, "neutral")
    curve = np.array([min(knob_degrees(axles(params, float(b))), 99.0) for b in PITCHES])
    scene |= {
        "pitch": PITCH.scalar(pose.value, "pitch"),
        "apart": APART.scalar(apart, "outer and inner axle"),
        "knob/whole": KNOB.whole(PITCHES, curve, "in the worst direction", "source"),
        "caption": say(
            "The middle ring at {pitch}: the outer and the inner axle are {apart} apart.",
            pitch=degrees(pose.value),
            apart=degrees(apart),
        ),
    }
    if amount < 99.0:
        scene["knob/mark"] = KNOB.mark(pose.value, amount, "your hand", "source", steps="pitch")
    else:
        rims = np.array([-90.0, -90.0, -90.0, 90.0, 90.0])
        upright = np.array([0.0, 30.0, np.nan, 0.0, 30.0])
        scene["knob/second"] = KNOB.second(rims, upright, "no angle is enough", "neutral")
    return scene


def _across(own: np.ndarray) -> np.ndarray:
    """Return an axis of the body across the inner axle: normal to the innermost ring."""
    return np.eye(3)[int(np.argmin(np.abs(own)))]


def draw_readings(look: Look[Input, Body, Read]) -> Scene:
    """Return the house as it is meant, and its outline as it is read otherwise."""
    body = look.subject
    pose = look.now
    meant = look.now if look.before is None else look.past[0]
    T = motion(meant.R, ORIGIN)
    scene: dict[str, Primitive] = {
        "ground": GROUND,
        **_axes("fixed", np.eye(3), "xyz", reach=1.5, width=1.5),
        **_axes("carried", meant.R, "XYZ", reach=1.25, width=6.0),
        **shown("body", body, T, opacity=0.45, name=meant.name),
        "off": APART.scalar(pose.off, "from the right one", "truth"),
        "matrix": Table.of_matrix("R as read", ("x axis", "y axis", "z axis"), pose.R),
        "numbers": numbers(pose.R),
    }
    if look.before is None:
        caption = say(
            "{name} makes this house. Step on: the same numbers are read anew.", name=pose.name
        )
        return scene | {"caption": caption}
    is_same = pose.off < 1e-6
    role: Role = "truth" if is_same else "wrong"
    p = body.solid.p @ pose.R.T
    top = p[np.argmax(p[:, 2])] + 0.12 * UP
    scene |= {
        "ghost": lines(body, motion(pose.R, ORIGIN), color=role, name="as read"),
        "ghost name": Label(pose.name, top, role),
    }
    if not is_same:
        axis, _ = axis_angle_from_rotation(pose.R @ meant.R.T)
        start = axis_across(axis)
        scene["axis"] = dashed(np.stack([-0.4 * axis, 1.35 * axis]), "neutral", dash=0.04)
        scene |= arc(
            "turn", 1.15 * axis, start, pose.off, about=axis, radius=0.22, color="wrong", width=4
        )
        caption = say(
            "{name}: {off} from the right rotation.", name=pose.name, off=degrees(pose.off)
        )
        return scene | {"caption": caption}
    return scene | {"caption": say("{name}: the same rotation.", name=pose.name)}


def _axes(
    path: str, R: np.ndarray, letters: str, *, reach: float, width: float
) -> dict[str, Primitive]:
    """Return three arrows along the columns of a rotation, each with its letter at the tip."""
    tips = reach * R.T
    scene: dict[str, Primitive] = {}
    for letter, tip in zip(letters, tips, strict=True):
        role = ROLES[letter.lower()]
        scene[f"{path}/{letter}"] = arrows(ORIGIN[None], tip[None], role, head=0.1, width=width)
        scene[f"{path}/{letter} name"] = Label(letter, 1.06 * tip, role)
    return scene


def axis_across(axis: np.ndarray) -> np.ndarray:
    """Return some direction across an axis."""
    return np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])


def numbers(R: np.ndarray) -> Table:
    """Show a rotation's axis, angle and quaternion; of what is none, those of the nearest one."""
    R = nearest_rotation(R)
    axis, radians = axis_angle_from_rotation(R)
    half = 0.5 * radians
    q = np.append(np.cos(half), np.sin(half) * axis)
    rows = (
        ("axis", fixed_row(axis, 2) if radians > ROUND_OFF else "any"),
        ("angle", f"{in_places(np.degrees(radians), 1)}°"),
        ("quaternion w, x, y, z", fixed_row(q, 2)),
    )
    return Table("The rotation, in other numbers", ("name", "numbers"), rows)


def draw_chain(look: Look[Input, Body, Named]) -> Scene:
    """Return the turns one by one in grey, and the one turn that comes to the same in green."""
    params = look.params
    body = look.subject
    pose = look.now
    p = body.p_followed(params.point)
    n, _ = whole_turn(params)
    here = pose.R @ p
    centre = (n @ p) * n
    radius = float(np.linalg.norm(p - centre))
    turn = np.radians(pose.value)
    terms = np.stack(
        [np.cos(turn) * p, np.sin(turn) * np.cross(n, p), (1.0 - np.cos(turn)) * (n @ p) * n]
    )
    chained = np.vstack([ORIGIN, np.cumsum(terms, axis=0)])
    scene: dict[str, Primitive] = {
        "ground": GROUND,
        **shown("body", body, motion(pose.R, ORIGIN), opacity=0.4),
        "start": lines(body, np.eye(4), color="target", name="before"),
        "axis": dashed(np.stack([-0.3 * n, 1.5 * n]), "truth", dash=0.05, width=3, name="the axis"),
        "circle": circle(centre, n, radius, "truth", opacity=0.4),
        "radius": Segments(np.stack([[centre, here]]), "truth", 2.0),
        "corner": Label(f"vertex {min(params.point, len(body.solid.p) - 1)}", here + 0.07 * UP),
        "terms/1": arrows(chained[[0]], chained[[1]], "highlight", name="cos θ · p"),
        "terms/2": arrows(chained[[1]], chained[[2]], "source", name="sin θ · n × p"),
        "terms/3": arrows(chained[[2]], chained[[3]], "target", name="(1 − cos θ) (n · p) n"),
        "angle": ANGLE.scalar(pose.value, "angle"),
        "matrix": Table.of_matrix("R", ("x axis", "y axis", "z axis"), pose.R),
        "numbers": numbers(pose.R),
        "caption": say(
            "The one turn has gone {angle}.",
            angle=degrees(pose.value),
        ),
    }
    if pose.value > 1e-9:
        at = {"about": n, "radius": radius, "color": "truth", "width": 6.0}
        scene |= arc("one turn", centre, p - centre, pose.value, **at)
    for k, (about, angle) in enumerate(steps_of(params)):
        middle = (about @ p) * about
        reach = float(np.linalg.norm(p - middle))
        if angle and reach > 1e-9:
            at = {"about": about, "radius": reach, "color": "neutral", "width": 3.0}
            scene |= arc(f"turn {k + 1}", middle, p - middle, angle, **at)
        p = _turned(p, about, angle)
    return scene


def steps_of(params: Input) -> list[tuple[np.ndarray, float]]:
    """Return axis and degrees of each of the three turns, in the world."""
    angles = np.radians(params.angles)
    turns = []
    for k in range(3):
        done = np.where(np.arange(3) < k, angles, 0.0)
        letter = np.eye(3)["xyz".index(params.order[k].lower())]
        about = letter if params.order.islower() else euler_axes(done, params.order)[k]
        turns.append((about, float(params.angles[k])))
    return turns


def _turned(p: np.ndarray, about: np.ndarray, angle: float) -> np.ndarray:
    turn = np.radians(angle)
    return (
        np.cos(turn) * p
        + np.sin(turn) * np.cross(about, p)
        + (1.0 - np.cos(turn)) * (about @ p) * about
    )


def draw_names(look: Look[Input, Body, Named]) -> Scene:
    """Return the circle of half angles with q and −q on it, and the house that they turn."""
    body = look.subject
    pose = look.now
    half = 0.5 * pose.value
    tips = {name: _on_dial(angle) for name, angle in (("q", half), ("−q", half + 180.0))}
    scene: dict[str, Primitive] = {
        "ground": GROUND,
        "start": lines(body, np.eye(4), color="target", name="before"),
        **shown("body", body, motion(pose.R, ORIGIN), opacity=0.7),
        "dial": circle(ASIDE, -Y, DIAL, "neutral", name="half angles"),
        "start name": Label("q₀", ASIDE + 1.15 * (_on_dial(0.0) - ASIDE), "target"),
        "hands": Segments(
            between(ASIDE, np.stack([_on_dial(0.0), *tips.values()])), "neutral", 2.0
        ),
        "angle": ANGLE.scalar(pose.value, "angle"),
        "to q": LONG.whole(ENDS, ENDS, "to q", "truth"),
        "to −q": LONG.whole(ENDS, 360.0 - ENDS, "to −q", "wrong"),
        "mark": LONG.mark(pose.value, pose.value, "your hand", "truth", steps="angle"),
        "numbers": numbers(pose.R),
        "caption": say(
            "q is {half} away, −q {other} the other way round.",
            half=degrees(half),
            other=degrees(180.0 - half),
        ),
    }
    for name, tip in tips.items():
        scene[f"{name} name"] = Label(name, ASIDE + 1.17 * (tip - ASIDE), "highlight")
    at = {"about": -Y, "width": 5.0}
    if half:
        scene |= arc("near/dial", ASIDE, X, half, radius=0.8 * DIAL, color="truth", **at)
        scene |= arc(
            "near/house", 0.02 * UP, -Y, pose.value, about=UP, radius=0.75, color="truth", width=3.0
        )
    if half < 180.0:
        scene |= arc("far/dial", ASIDE, X, half - 180.0, radius=0.62 * DIAL, color="wrong", **at)
        scene |= arc(
            "far/house",
            0.02 * UP,
            -Y,
            pose.value - 360.0,
            about=UP,
            radius=0.95,
            color="wrong",
            width=3.0,
        )
    return scene


def _on_dial(angle: float) -> np.ndarray:
    turn = np.radians(angle)
    return ASIDE + DIAL * (np.cos(turn) * X + np.sin(turn) * UP)


def draw_mean(look: Look[Input, Body, Named]) -> Scene:
    """Return the house under the mean of the entries, before the one under the right mean."""
    params = look.params
    body = look.subject
    state = look.now
    M = state.R
    apart = state.value
    left = 100.0 * abs(float(np.linalg.det(M)))
    turn = np.radians(0.5 * apart)
    R = np.array([[np.cos(turn), -np.sin(turn), 0.0], [np.sin(turn), np.cos(turn), 0.0], UP])
    p = body.p_followed(params.point)
    centre = p[2] * UP
    first = p
    last = R @ R @ p
    expected = 100.0 * np.cos(np.radians(0.5 * APARTS)) ** 2
    mean = M @ p
    scene: dict[str, Primitive] = {
        "ground": GROUND,
        **shown("body", body, motion(M, ORIGIN), name="mean of the entries"),
        "right": lines(body, motion(R, ORIGIN), color="truth", name="the right mean"),
        "circle": circle(centre, UP, float(np.linalg.norm((p - centre)[:2])), "truth"),
        "chord": Segments(np.stack([[first, last]]), "wrong", 3.0, name="from image to image"),
        "images": Segments(between(centre, np.stack([first, last])), "neutral", 1.5),
        "mean name": Label("mean", mean + 0.1 * UP, "wrong"),
        "x arrow": arrows(ORIGIN[None], 1.05 * M[None, :, 0], "x", head=0.1, width=6),
        "y arrow": arrows(ORIGIN[None], 1.05 * M[None, :, 1], "y", head=0.1, width=6),
        "apart": APART.scalar(apart, "apart"),
        "volume": VOLUME.scalar(left, "volume"),
        "left": LEFT.whole(APARTS, expected, "volume left", "wrong"),
        "left mark": LEFT.mark(apart, left, "your hand", "wrong", steps="apart"),
        "matrix": Table.of_matrix("mean of the entries", ("x axis", "y axis", "z axis"), M),
        "off": Chart("Nearest rotation", unit="deg").scalar(
            degrees_between(nearest_rotation(M), R) if left > 1e-6 else np.nan, "off"
        ),
        "caption": say(
            "{apart} apart, halfway {left} of the volume is left.",
            apart=degrees(apart),
            left=share(left / 100.0),
        ),
    }
    return scene
