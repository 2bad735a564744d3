"""What one step looks like, stage by stage."""

import numpy as np

from lessons.coordinates.captions import CAP, CAPS_AREA, caption, in_caps, quantity
from lessons.coordinates.flat import met, ranged, seen
from lessons.coordinates.pan_tilt import Followed
from lessons.coordinates.parallels import Met, Scaled, Seen
from lessons.coordinates.placing import Cell, Placed, Ranged, Readings, Scattered, Walked
from lessons.coordinates.state import State
from lessons.coordinates.voyages import Raised, Travelled
from workbench.data.places import Places
from workbench.data.shapes.surfaces import sphere
from workbench.geometry.cameras import intrinsics
from workbench.geometry.motions import motion
from workbench.geometry.polylines import at_height, between, circle, fan, segments, sphere_rings
from workbench.geometry.shapes.curvilinear import Coordinates, cartesian_from_spherical, cell_edges
from workbench.geometry.shapes.globe import Ellipsoid, graticule, parallel, units_of_places
from workbench.numerals import angle, fixed
from workbench.scene import (
    Camera,
    Chart,
    Classes,
    Label,
    Mesh,
    Points,
    Primitive,
    Role,
    Scene,
    Segments,
    Table,
)

WALK = Chart("Along the walk", "x along the walk (m)", "°")
WALK_LENGTHS = Chart("Along the walk", "x along the walk (m)", "m")
CELLS = Chart("Points by polar angle", "θ (°)", "points in 10°")
IN_CAPS = Chart("Within 30° of a pole", unit="% of the points")
MAP = Chart("Map", "longitude (°)", "latitude (°)")
WAY = Chart("Way so far", unit="km")
LATITUDES = Chart("Plumb line less line to the centre", "latitude (°)", "°")
RATES = Chart("How fast it turns", unit="°/s")
ANGLES = Chart("Pan and tilt", unit="°")
ORIGIN = np.zeros(3)
RINGS = Segments(sphere_rings(ORIGIN, 1.0), "neutral", 1, opacity=0.4)
AXIS = Segments(
    np.array([[[0.0, 0.0, -1.2], [0.0, 0.0, 1.2]]]), "z", 3, opacity=0.7, name="the axis"
)
FLAT = Ellipsoid(1.0, 0.35)  # how flat a planet is drawn
BALL = sphere(1500)
# land and sea: nothing to tell apart
PALE = np.tile(np.array([222, 228, 236], np.uint8), (len(BALL.p), 1))
GRATICULE = graticule(15)
K = intrinsics(60.0, 31.5, 23.5)


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    step, subject = state.now, state.subject
    scene: dict[str, Primitive] = {"caption": caption(state)}
    match step:
        case Placed() | Cell() | Readings() | Walked():
            assert isinstance(subject, Coordinates)
            return scene | _point(state, subject)
        case Scaled():
            return scene | _scaled(step)
        case Scattered():
            return scene | _scattered(step)
        case Travelled():
            assert isinstance(subject, Places)
            return scene | _travelled(step, subject)
        case Raised():
            return scene | _raised(step)
        case Followed():
            return scene | _followed(step)
        case Ranged():
            return scene | ranged(step)
        case Met():
            return scene | met(step)
        case Seen():
            return scene | seen(state, step)


def _point(state: State, system: Coordinates) -> dict[str, Primitive]:
    step = state.now
    p = np.array(state.params.point)
    scene: dict[str, Primitive] = {"frame": RINGS, "axis": AXIS}
    if not isinstance(step, Walked):
        scene["point"] = Points(p[None], "target", 0.03, name="the point")
    if isinstance(step, Placed):
        if step.moves:  # the first goes straight out and sweeps nothing
            swept = np.vstack([ORIGIN, step.path])
            scene["swept"] = Mesh(
                swept, fan(len(swept)), "source", opacity=0.6, name="swept by the ray to it"
            )
        if step.moves is not None:
            scene["path"] = Segments(
                segments(step.path), "source", 4, name="its coordinates, one after the other"
            )
        scene["place"] = Points(step.p[None], "source", 0.025, name="so far")
        scene["numbers"] = _table("So far", system, step.c)
    elif isinstance(step, Cell):
        scene["cell"] = Segments(
            cell_edges(system, step.low, step.high), "source", 3, name="a cell"
        )
        rows = (
            ("with the density", fixed(step.solid[0], 2)),
            ("sides alone", fixed(step.solid[1], 2)),
        )
        body = "unit ball" if state.params.system == "spherical" else "solid 2 m wide"
        scene["solid"] = Table(
            f"Cells of a {body} (m³)", ("", "sum"), (*rows, ("true", fixed(system.volume, 2)))
        )
    elif isinstance(step, Readings):
        others = [name for name in step.p if name != state.params.convention]
        q = np.stack([step.p[name] for name in others])
        scene["ray"] = Segments(between(ORIGIN, p), "source", 3)
        scene["others"] = Points(q, "wrong", 0.03, name="by other conventions")
        scene["other rays"] = Segments(between(ORIGIN, q), "wrong", 2, opacity=0.6)
        for name, where in (*zip(others, q, strict=True), (state.params.convention, p)):
            color = "wrong" if name in others else "source"
            scene[f"name/{name}"] = Label(name, where + np.array([0.0, 0.0, 0.08]), color)
    elif isinstance(step, Walked):
        scene |= _walked(step, system)
    return scene


def _table(title: str, system: Coordinates, c: np.ndarray) -> Table:
    rows = (quantity(float(v), is_angle) for v, is_angle in zip(c, system.angles, strict=True))
    return Table(title, ("", "value"), tuple(zip(system.names, rows, strict=True)))


def _walked(walk: Walked, system: Coordinates) -> dict[str, Primitive]:
    scene: dict[str, Primitive] = {
        "walk": Points(walk.p, "target", 0.014, name="the walk"),
        "ray": Segments(between(ORIGIN, walk.p[-1]), "source", 3, name="to here"),
        "shadow": Segments(
            between(ORIGIN, walk.p[-1] * [1.0, 1.0, 0.0]),
            "source",
            2,
            opacity=0.6,
            name="its direction below",
        ),
        "drop": Segments(between(walk.p[-1] * [1.0, 1.0, 0.0], walk.p[-1]), "correspondence", 1.5),
        "here": _table("Here", system, walk.c[-1]),
    }
    roles = ("target", "other", "source")
    for name, values, is_angle, role in zip(
        system.names, walk.c.T, system.angles, roles, strict=True
    ):
        if is_angle or not any(system.angles):
            chart = WALK if is_angle else WALK_LENGTHS
            scene[f"along {name}"] = chart.curve(
                walk.p[:, 0], np.degrees(values) if is_angle else values, name, role
            )
    return scene


def _scaled(ray: Scaled) -> dict[str, Primitive]:
    v = ray.p_h[:3]
    scene: dict[str, Primitive] = {"frame": RINGS}
    scene["ray"] = Segments(
        between(ORIGIN, 3.0 * v), "correspondence", 2, name="all points of this direction"
    )
    if ray.mean_h is not None and ray.other_h is not None:
        p, q, mean = (h[:3] / h[3] for h in (ray.p_h, ray.other_h, ray.mean_h))
        scene["two"] = Points(np.stack([p, q]), "target", 0.03, name="two points")
        scene["line"] = Segments(between(p, q), "correspondence", 2)
        scene["middle"] = Points((p + q)[None] / 2, "truth", 0.03, name="their middle")
        scene["mean"] = Points(mean[None], "wrong", 0.03, name="mean of the vectors")
        return scene
    w = float(ray.p_h[3])
    if w and np.linalg.norm(v / w) <= 3.0:
        scene["point"] = Points(v[None] / w, "source", 0.035, name="the point")
    else:
        scene["arrow"] = Segments(
            between(ORIGIN, 3.0 * v / np.linalg.norm(v)), "source", 4, name="beyond the picture"
        )
    names = zip("xyzw", ray.p_h, strict=True)
    scene["numbers"] = Table(
        "The vector", ("", "value"), tuple((name, fixed(float(value), 2)) for name, value in names)
    )
    return scene


def _scattered(dots: Scattered) -> dict[str, Primitive]:
    near = np.abs(dots.p[:, 2]) > np.cos(CAP)
    if len(dots.p) < 1000:
        radius = 0.02
    elif len(dots.p) < 6000:
        radius = 0.012
    else:
        radius = 0.008
    edges = np.arange(0.0, 181.0, 10.0)
    expected = len(dots.p) * -np.diff(np.cos(np.radians(edges))) / 2
    rims = np.concatenate([parallel(polar) for polar in (CAP, np.pi - CAP)])
    polar = np.degrees(np.arccos(np.clip(dots.p[:, 2], -1.0, 1.0)))
    return {
        "ball": Mesh(0.985 * BALL.p, BALL.faces, PALE),
        "rims": Segments(rims, "highlight", 3, name="30° from a pole"),
        "points": Points(
            dots.p,
            Classes.marking(near, "source", "near a pole", others=("target", "elsewhere")),
            radius,
            name="points",
        ),
        "drawn": CELLS.histogram(polar, edges, "drawn"),
        "even": CELLS.curve((edges[1:] + edges[:-1]) / 2, expected, "even on the sphere", "truth"),
        "share": IN_CAPS.scalar(100 * in_caps(dots.p), "drawn"),
        "area": IN_CAPS.scalar(100 * CAPS_AREA, "of the area", "truth"),
    }


def _travelled(trip: Travelled, places: Places) -> dict[str, Primitive]:
    turn = np.radians(-90.0 - _middle(places)[1])
    T = motion(
        np.array([[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]]),
        ORIGIN,
    )
    names, degrees = places.names, places.degrees
    ways: dict[str, tuple[np.ndarray, Role, str]] = {
        "straight": (trip.straight, "wrong", "straight on the map"),
        "circle": (trip.circle, "truth", "great circle"),
    }
    scene: dict[str, Primitive] = {
        "ball": Mesh(0.985 * BALL.p, BALL.faces, PALE, T),
        "grid": Segments(GRATICULE, "neutral", 1, T, opacity=0.5),
        "places": Points(1.004 * units_of_places(degrees), "target", 0.02, T, name="places"),
    }
    for k in {0, len(names) - 1} if len(names) > 12 else range(len(names)):
        scene[f"name/{k}"] = Label(names[k], 1.08 * units_of_places(degrees[[k]])[0], "target", T)
    for path, (way, role, name) in ways.items():
        p = units_of_places(way)
        if len(p) > 1:
            scene[path] = Segments(1.006 * segments(p), role, 4, T, name=name)
        longitude = np.degrees(np.unwrap(np.radians(way[:, 1]))) if path == "circle" else way[:, 1]
        scene[f"map {path}"] = MAP.curve(longitude, way[:, 0], name, role)
    scene["map places"] = MAP.dots(degrees[:, 1], degrees[:, 0], "places", "target")
    if trip.means is not None:
        p = 1.01 * units_of_places(trip.means)
        scene["mean"] = Points(p[:1], "wrong", 0.035, T, name="mean of the numbers")
        scene["middle"] = Points(p[1:], "truth", 0.035, T, name="middle of the places")
    else:
        scene["way"] = WAY.scalar(trip.straight_length / 1e3, "straight on the map", "wrong")
        scene["great"] = WAY.scalar(trip.circle_length / 1e3, "great circle", "truth")
    return scene


def _middle(places: Places) -> np.ndarray:
    p = units_of_places(places.degrees).mean(axis=0)
    return np.degrees([np.arctan2(p[2], np.hypot(p[0], p[1])), np.arctan2(p[1], p[0])])


def _raised(arc: Raised) -> dict[str, Primitive]:
    """Return the meridian of a planet, drawn flatter than it is, with both lines at the latitude
    reached.
    """
    latitude = arc.latitude[-1:]
    rho, z = FLAT.meridian(latitude)[0]
    p = np.array([rho, 0.0, z])
    turn = np.linspace(-np.pi, np.pi, 145)
    outline = FLAT.meridian(turn)
    foot = p - (z / np.sin(latitude[0]) if z > 0 else 0.35) * np.array(
        [np.cos(latitude[0]), 0.0, np.sin(latitude[0])]
    )
    up = p + 0.3 * np.array([np.cos(latitude[0]), 0.0, np.sin(latitude[0])])
    apart = np.degrees(arc.latitude - arc.geocentric)
    return {
        "meridian": Segments(
            segments(np.insert(outline, 1, 0.0, axis=1)),
            "neutral",
            2,
            name="a meridian, drawn flatter",
        ),
        "equator": Segments(np.array([[[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]]), "neutral", 1.5),
        "pole": Segments(np.array([[[0.0, 0.0, -0.65], [0.0, 0.0, 0.65]]]), "neutral", 1.5),
        "place": Points(p[None], "target", 0.025, name="a place"),
        "plumb": Segments(np.stack([foot, up])[None], "source", 4, name="plumb line"),
        "centre": Segments(between(ORIGIN, p), "other", 4, name="line to the centre"),
        "difference": LATITUDES.curve(np.degrees(arc.latitude), apart, "difference"),
    }


def _followed(mount: Followed) -> dict[str, Primitive]:
    c, s = np.cos(mount.pan), np.sin(mount.pan)
    n = cartesian_from_spherical(np.array([[1.0, np.pi / 2 - mount.tilt, mount.pan]]))[0]
    right = np.array([s, -c, 0.0])
    T_world_camera = motion(np.column_stack([right, np.cross(n, right), n]), ORIGIN)
    track = np.array([[[-18.0, mount.p[1], mount.p[2]], [18.0, mount.p[1], mount.p[2]]]])
    return {
        "ring": Segments(segments(at_height(4.0 * circle())), "neutral", 2, name="pan axis"),
        "pan": Segments(between(ORIGIN, 4.0 * np.array([c, s, 0.0])), "source", 5, name="pan"),
        "camera": Camera(K, 64, 48, T_world_camera, 3.0, color="source", name="camera"),
        "track": Segments(track, "neutral", 1.5, name="way of the target"),
        "zenith": Segments(
            between(ORIGIN, np.array([0.0, 0.0, 12.0])), "z", 1.5, opacity=0.6, name="zenith"
        ),
        "sight": Segments(between(ORIGIN, mount.p), "correspondence", 2, name="line of sight"),
        "target": Points(mount.p[None], "target", 0.4, name="target"),
        "pan rate": RATES.scalar(abs(float(np.degrees(mount.pan_rate))), "pan axis", log=True),
        "sight rate": RATES.scalar(
            float(np.degrees(mount.sight_rate)), "line of sight", "truth", log=True
        ),
        "pan angle": ANGLES.scalar(float(np.degrees(mount.pan)), "pan"),
        "tilt angle": ANGLES.scalar(float(np.degrees(mount.tilt)), "tilt", "other"),
        "moment": Table(
            "Now",
            ("", "value"),
            (
                ("time", f"{fixed(mount.time, 3)} s"),
                ("pan", angle(float(np.degrees(mount.pan)))),
                ("tilt", angle(float(np.degrees(mount.tilt)))),
            ),
        ),
    }
