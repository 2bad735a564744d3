"""What a step says: what just happened, the number that changed, and in the end whether it is
right.
"""

import numpy as np

from lessons.coordinates.pan_tilt import Followed
from lessons.coordinates.parallels import Met, Scaled, Seen
from lessons.coordinates.placing import Cell, Placed, Ranged, Readings, Scattered, Walked
from lessons.coordinates.state import Params, State
from lessons.coordinates.voyages import Raised, Travelled
from workbench.data.places import Places
from workbench.geometry.shapes.curvilinear import Convention, Coordinates
from workbench.geometry.shapes.globe import great_circle_distance
from workbench.numerals import angle, brief, coordinates, counted, fixed, length, percent
from workbench.scene import Caption

CAP = np.radians(30.0)
CAPS_AREA = 1.0 - float(np.cos(CAP))  # of the sphere, both caps
MEANT: dict[Convention, str] = {
    "ISO": "ISO 80000-2: θ from the z axis, φ round it",
    "mathematics": "mathematics: θ round the z axis, φ from it",
    "elevation": "astronomy: azimuth round the z axis, elevation up from the ground",
}
WAYS = {  # what each coordinate does, by its name
    "x": "along x",
    "y": "along y",
    "z": "up along z",
    "ρ": "out from the axis",
    "r": "out from the origin",
    "θ": "down from the z axis",
    "φ": "round the z axis",
}
HOME = 1e-6  # metres or radians: what rounding leaves
MEASURED = 1e-3  # by which share a measured way may be off
FAR_APART = 1e4  # metres between two means


def caption(state: State) -> Caption:
    """Return the caption of a step."""
    step, params, subject = state.now, state.params, state.subject
    match step, subject:
        case Placed(), Coordinates():
            return Caption(_placed(step, subject, params))
        case Cell(), Coordinates():
            return Caption(_cell(step, subject, params))
        case Readings(), _:
            return Caption(_readings(step, params))
        case Walked(), Coordinates():
            return _walked(step, subject, state)
        case Scaled(), _:
            return Caption(_scaled(step))
        case Scattered(), _:
            return _scattered(step, state)
        case Ranged(), _:
            return _ranged(step, state)
        case Travelled(), Places():
            return _travelled(step, subject)
        case Raised(), _:
            return Caption(_raised(step, state))
        case Followed(), _:
            return _followed(step, state)
        case Met(), _:
            return _met(step, state)
        case Seen(), _:
            return Caption(_seen(step))
    raise AssertionError


def quantity(value: float, is_angle: bool) -> str:
    """Write a coordinate with its unit."""
    return angle(float(np.degrees(value))) if is_angle else length(value)


def said(c: np.ndarray, system: Coordinates) -> str:
    """Write three coordinates with their names."""
    parts = (
        f"{n} = {quantity(v, a)}" for n, v, a in zip(system.names, c, system.angles, strict=True)
    )
    return ", ".join(parts)


def _placed(placed: Placed, system: Coordinates, params: Params) -> str:
    if placed.moves is None:
        return (
            f"{params.system.capitalize()} coordinates {', '.join(system.names)}: each says how far"
            " to go from the origin to the point, on a way of its own."
        )
    name = system.names[placed.moves]
    value = quantity(float(placed.c[placed.moves]), system.angles[placed.moves])
    return f"{name} = {value}, {WAYS[name]}: the point is at {coordinates(placed.p, 2)} m."


def _cell(cell: Cell, system: Coordinates, params: Params) -> str:
    sides = zip(cell.high - cell.low, system.angles, strict=True)
    text = (
        f"A cell of {' × '.join(quantity(float(s), a) for s, a in sides)} holds"
        f" {brief(1e3 * cell.volume)} litres"
    )
    if params.system == "cartesian":
        return f"{text}, here as anywhere."
    density = "r² sin θ" if params.system == "spherical" else "ρ"
    return (
        f"{text}. One of the same sides holds less near the axis: its volume goes with {density}."
    )


def _readings(readings: Readings, params: Params) -> str:
    numbers = ", ".join(
        [brief(float(readings.numbers[0]))]
        + [angle(float(np.degrees(a))) for a in readings.numbers[1:]]
    )
    here = readings.p[params.convention]
    others = [
        length(float(np.linalg.norm(p - here)))
        for name, p in readings.p.items()
        if name != params.convention
    ]
    return (
        f"({numbers}) is this point by {MEANT[params.convention]}. By the two other conventions the"
        f" same three numbers are points {others[0]} and {others[1]} away."
    )


def turned(c: np.ndarray) -> float:
    """Return by how much an angle changed from one row to the next at most, degrees, the short way
    round.
    """
    changes = (np.diff(c) + np.pi) % (2 * np.pi) - np.pi
    return float(np.degrees(np.abs(changes).max(initial=0.0)))


def _walked(walk: Walked, system: Coordinates, state: State) -> Caption:
    c = walk.c[:, system.names.index("φ")] if "φ" in system.names else np.zeros(len(walk.c))
    if not state.last:
        text = f"A straight walk past the axis: {said(walk.c[-1], system)}."
        if len(c) == 1 or "φ" not in system.names:
            return Caption(text)
        step = length(float(np.linalg.norm(walk.p[-1] - walk.p[-2])))
        return Caption(f"{text} This step of {step} changed φ by {angle(turned(c[-2:]))}.")
    miss = float(walk.misses.max())
    if not miss < HOME:
        return Caption(
            f"Put back from their coordinates, places of the walk are up to {length(miss)} off. It"
            " is wrong.",
            "wrong",
        )
    text = "The walk is over, and its coordinates put every place back where it was: right."
    if "φ" not in system.names:
        return Caption(f"{text} None of them changed faster than the walk.", "good")
    return Caption(
        f"{text} One step of {length(float(np.linalg.norm(walk.p[-1] - walk.p[-2])))} changed φ by"
        f" {angle(turned(c))}.",
        "good",
    )


def _scaled(ray: Scaled) -> str:
    if ray.mean_h is not None and ray.other_h is not None:
        a, b, mean = (v[:3] / v[3] for v in (ray.p_h, ray.other_h, ray.mean_h))
        return (
            f"Vectors with w = {brief(float(ray.p_h[3]))} and w = {brief(float(ray.other_h[3]))},"
            f" averaged entry by entry: that is {length(float(np.linalg.norm(mean - (a + b) / 2)))}"
            " from the middle of the two points. Divide by w first."
        )
    w = float(ray.p_h[3])
    v = coordinates(ray.p_h, 2)
    if w == 0:
        return (
            f"{v}, w = 0: no point has this name, but a direction has. It is the point at infinity"
            " that way."
        )
    p = ray.p_h[:3] / w
    return (
        f"{v} names the point {coordinates(p, 2)} m: {length(float(np.linalg.norm(p)))} from the"
        " origin."
    )


def in_caps(p: np.ndarray) -> float:
    """Return the share of points of the unit sphere within 30° of a pole."""
    return float((np.abs(p[:, 2]) > np.cos(CAP)).mean())


def _scattered(dots: Scattered, state: State) -> Caption:
    if not state.last:
        how = "θ and φ are" if state.params.even == "angle" else "z and φ are"
        return Caption(
            f"{counted(len(dots.p), 'point')} on the unit sphere: {how} drawn evenly. Compare poles"
            " and equator."
        )
    share = in_caps(dots.p)
    sigma = np.sqrt(CAPS_AREA * (1 - CAPS_AREA) / len(dots.p))
    text = (
        f"{percent(share, 1)} of the points lie within 30° of a pole, in {percent(CAPS_AREA, 1)} of"
        " the area"
    )
    if abs(share - CAPS_AREA) < 4 * sigma:
        return Caption(f"{text}: even, but for chance, and right.", "good")
    return Caption(
        f"{text}: drawn evenly in θ, they are not even on the sphere. It is wrong.", "wrong"
    )


def _ranged(radar: Ranged, state: State) -> Caption:
    sigma = angle(state.params.bearing_noise)
    off = length(float(np.linalg.norm(radar.mean - radar.true)))
    text = (
        f"{counted(len(radar.p), 'measurement')}, bearings with σ = {sigma}: their mean is {off}"
        " from the point"
    )
    if not state.last:
        return Caption(f"{text}.")
    expected = length(float(np.linalg.norm(radar.expected - radar.true)))
    debiased = length(float(np.linalg.norm(radar.debiased - radar.true)))
    return Caption(f"{text}; theory says {expected}. Divided by exp(−σ²/2) it is {debiased} off.")


def kilometres(metres: float) -> str:
    """Write a way over a globe."""
    return f"{fixed(metres / 1e3, 0)} km"


def _travelled(trip: Travelled, places: Places) -> Caption:
    start = places.names[0]
    end = places.names[-1]
    if trip.means is not None:
        text = (
            f"The mean of the latitudes and longitudes is {kilometres(trip.apart)} from the middle"
            " of the places"
        )
        if trip.apart < FAR_APART:
            return Caption(f"{text}: here it is right.", "good")
        return Caption(f"{text}. It is wrong.", "wrong")
    if trip.share == 0:
        return Caption(
            f"{start} to {end}: one goes straight on the map, latitude and longitude changing"
            " evenly, the other along the great circle."
        )
    if not abs(trip.circle_length / (trip.share * direct(places)) - 1) < MEASURED:
        measured = (
            kilometres(trip.circle_length) if np.isfinite(trip.circle_length) else "no number"
        )
        return Caption(
            f"So far {measured} along the great circle, by your measure;"
            f" {kilometres(trip.share * direct(places))} were gone. It is wrong.",
            "wrong",
        )
    text = (
        f"{kilometres(trip.circle_length)} along the great circle,"
        f" {kilometres(trip.straight_length)} straight on the map"
    )
    if trip.share < 1:
        return Caption(f"So far {text}.")
    share = trip.straight_length / trip.circle_length - 1
    more = percent(share, 1) if 1e-3 < share < 1 else percent(share)
    return Caption(f"{start} to {end}: {text}, {more} more.")


def direct(places: Places) -> float:
    """Return how far the last place is from the first, metres."""
    return float(great_circle_distance(places.degrees[:1], places.degrees[-1:])[0])


def _raised(arc: Raised, state: State) -> str:
    k = int(arc.apart.argmax()) if state.last else -1
    plumb, centre = float(np.degrees(arc.latitude[k])), float(np.degrees(arc.geocentric[k]))
    text = f"the plumb line rises by {angle(plumb)}, the line to the centre by {fixed(centre, 3)}°:"
    text += (
        f" {fixed(plumb - centre, 3)}° less, {kilometres(float(arc.apart[k]))} along the ground."
    )
    if state.last:
        return f"At the pole both are 90°. Between, they differ most where {text}"
    return f"{state.params.planet}: {text}"


def per_second(rate: float) -> str:
    """Write a rate of turning."""
    degrees = abs(float(np.degrees(rate)))
    return f"{fixed(degrees, 0) if degrees >= 100 else brief(degrees)}°/s"


def _followed(mount: Followed, state: State) -> Caption:
    if not mount.off < HOME:
        off = angle(float(np.degrees(mount.off)))
        return Caption(
            f"Pan {angle(float(np.degrees(mount.pan)))}: the camera looks {off} past the target. It"
            " is wrong.",
            "wrong",
        )
    if state.last:
        return Caption(
            "The target was in the middle all the time: right. For that the pan axis turned with"
            f" {per_second(mount.pan_peak)} at its fastest, the line of sight with"
            f" {per_second(mount.sight_peak)}.",
            "good",
        )
    pan, tilt = (angle(float(np.degrees(a))) for a in (mount.pan, mount.tilt))
    return Caption(
        f"Pan {pan}, tilt {tilt}: the pan axis turns with {per_second(mount.pan_rate)}, the line of"
        f" sight with {per_second(mount.sight_rate)}."
    )


def lies_on_both(meeting: Met) -> bool:
    """Tell whether the vector is a point of both lines."""
    with np.errstate(all="ignore"):
        off = (
            meeting.lines
            @ meeting.x_h
            / np.linalg.norm(meeting.lines, axis=1)
            / np.linalg.norm(meeting.x_h)
        )
    return bool((np.abs(off) < HOME).all())


def _met(meeting: Met, state: State) -> Caption:
    if not lies_on_both(meeting):
        return Caption(
            f"{coordinates(meeting.x_h, 3)} is no point of both lines. It is wrong.", "wrong"
        )
    x, y, w = meeting.x_h / np.abs(meeting.x_h).max()
    degrees = angle_of(meeting)
    tilt = float(meeting.H[2, 0])
    if tilt:
        where = f"({brief(x / w)}, {fixed(y / w, 2)}) m" if w else "infinity still"
        text = (
            f"A homography with h₃₁ = {brief(tilt)} takes infinity to the horizon x ="
            f" {brief(1 / tilt)} m, and the meeting to {where}. The cross-ratio stays"
            f" {brief(meeting.cross_ratio)}, lengths as 3 : 1 become {brief(meeting.ratio)} : 1."
        )
        return (
            Caption(f"{text} Both lines still go through it: right.", "good")
            if state.last
            else Caption(text)
        )
    vector = f"({', '.join(brief(float(v)) for v in (x, y, w))})"
    if w == 0:
        return Caption(
            f"Parallel lines: l × l′ is the vector {vector}. Its w is 0: a point at infinity, and"
            " no error."
        )
    return Caption(
        f"Lines at {degrees}: l × l′ is the vector {vector}, the point"
        f" {far(abs(float(np.hypot(x, y) / w)))} away."
    )


def angle_of(meeting: Met) -> str:
    """Write the angle between the lines, however small."""
    degrees = float(np.degrees(meeting.angle))
    return (
        f"{brief(degrees)}°"
        if degrees >= 0.001
        else f"{counted(round(1e6 * degrees), 'millionth')} of a degree"
    )


def far(metres: float) -> str:
    """Write how far away a meeting is."""
    return length(metres) if metres < 1e6 else f"{brief(metres / 1e3, 2)} km"


def _seen(view: Seen) -> str:
    return (
        f"The eye is {brief(view.times)} half-depths away: the near side looks {percent(view.near)}"
        f" too large, the far side {percent(-view.far)} too small. Parallel rays show both in one"
        " size."
    )
