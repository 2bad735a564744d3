"""A hand on the scene: it draws a handle, and clicks on what may be picked."""

from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from tests.browser.homes import Home
from workbench.knobs import Gizmo, ParamField
from workbench.scene import Picture
from workbench.viewer.connection import PageConnection


def drag(home: Home, field: ParamField, turn: int) -> None:
    """Draw at the end of a handle's longest arrow; where it is missed, the camera turns, and it is
    elsewhere.
    """
    assert isinstance(field.knob.by, Gizmo)
    place = np.array(home.ask("name => page.run.params[name]", field.name)[:3])
    start = on_screen(home, place)
    ways = on_screen(home, place + 0.6 * field.knob.by.size * np.eye(3)) - start
    way = sorted(ways, key=np.linalg.norm)[-1 - turn % 2]
    home.page.mouse.move(*(start + way))
    home.page.mouse.down()
    for far in (10, 20, 30):
        home.page.mouse.move(*(start + (1 + far / np.linalg.norm(way)) * way))
    home.page.mouse.up()


def student(home: Home) -> PageConnection:
    return home.server.students[home.ask("document.body.dataset.token")]


def click(home: Home, path: str, turn: int) -> None:
    home.page.mouse.click(*another_point(home, path, turn))


def another_point(home: Home, path: str, turn: int) -> np.ndarray:
    """Return where, on the screen, a part of what is at a path is that a click may mean: one off
    its middle.
    """
    session = student(home).session
    look = None if session is None else session.look()
    assert look is not None
    thing: Any = look.scene[path]
    T = np.eye(4) if thing.T_world_object is None else thing.T_world_object
    p = (
        np.array([[0.23, 0.1, 0.0]]) * (thing.width or 1.0)
        if isinstance(thing, Picture)
        else thing.p
    )
    places = on_screen(home, p[:200] @ T[:3, :3].T + T[:3, 3])
    box = home.find("#scene").bounding_box()
    middle = np.array([box["x"] + 0.5 * box["width"], box["y"] + 0.55 * box["height"]])
    order = np.argsort(np.linalg.norm(places - middle, axis=1))
    return places[order[turn % len(order)]]


def on_screen(home: Home, p_world: np.ndarray) -> np.ndarray:
    """Return where points of the scene (..., 3) are in the window, by the camera of viser's
    client.
    """
    camera = home.ask("labels.camera")
    box = home.find("#scene").bounding_box()
    w, x, y, z = camera["wxyz"]
    xyz = (p_world - np.array(camera["position"])) @ Rotation.from_quat(
        [x, y, z, w]
    ).as_matrix()  # right, down, ahead
    scale = 0.5 * box["height"] / np.tan(0.5 * camera["fov"])
    middle = np.array([box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"]])
    return middle + scale * xyz[..., :2] / xyz[..., 2:]
