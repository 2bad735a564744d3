"""The empty stage of a lesson: camera, world up, grid with a stated spacing, labelled axes."""

from typing import Any

import numpy as np
import viser

from workbench.lesson import Lesson, View

BACKDROPS = {False: (255, 255, 255), True: (20, 21, 23)}  # viser's canvas in the light and the dark theme
_PLANES = ("yz", "xz", "xy")


NARROWEST = 1.2  # width of a picture by its height; in a narrower one a lesson is seen from farther away
WIDEST = 1.6  # up to this width by height, what was in view stays in view in a picture that becomes narrower


class Aim:
    """Where a client's camera is put: anew when a run with another view is opened, and else left to the person."""

    def __init__(self) -> None:
        self._wanted: View | None = None
        self._usual: View | None = None
        self._set: tuple[str, View] | None = None
        self._put: tuple[View, float, np.ndarray] | None = None  # for a picture of this aspect, the eye was put there
        self._kept = NARROWEST  # width by height of what stays in view

    def lost(self) -> None:
        """Note that the client is another one."""
        self._set = self._put = None
        self._kept = NARROWEST

    def open(self, lesson: Lesson, params: Any) -> None:
        """Want the view of a run that was opened."""
        self._wanted, self._usual = lesson.view_of(params), lesson.usual_view(params)

    def show(self, client: viser.ClientHandle, lesson: Lesson, params: Any) -> None:
        """Make the stage as wanted; a run of another grid or size, which a knob led to, brings its own view."""
        own, usual = lesson.view_of(params), lesson.usual_view(params)
        wanted = self._wanted if usual == self._usual else None
        if wanted is None or (wanted.grid, wanted.grid_height) != (own.grid, own.grid_height):
            wanted = self._wanted = own
            self._usual = usual
        if self._set != (lesson.name, wanted):
            eye = self._eye(wanted, aspect_of(client))
            set_stage(client, wanted, eye)
            self._set = (lesson.name, wanted)
            self._put = wanted, aspect_of(client), eye

    def fit(self, client: viser.ClientHandle) -> None:
        """Fit the camera to a picture that has become wider or narrower, unless a person has moved it since."""
        if self._put is None:
            return
        (view, before, eye), aspect = self._put, aspect_of(client)
        away = np.linalg.norm(eye - np.array(view.target))
        if abs(aspect - before) < 0.02 or np.linalg.norm(client.camera.position - eye) > 1e-3 * away:
            return
        self._put = view, aspect, self._eye(view, aspect)
        with client.atomic():
            client.camera.position = self._put[2]
            client.camera.look_at = np.array(view.target)

    def _eye(self, view: View, aspect: float) -> np.ndarray:
        """Return where the eye is put, from which a narrower picture shows what a wider one showed."""
        self._kept = max(self._kept, min(aspect, WIDEST))
        return eye_of(view, aspect, self._kept)


def aspect_of(client: viser.ClientHandle) -> float:
    """Return the width of a client's picture by its height."""
    return client.camera.image_width / max(client.camera.image_height, 1)


def set_stage(client: viser.ClientHandle, view: View, eye: np.ndarray) -> None:
    """Put a client's grid and axes where a lesson wants them, and its camera at an eye that suits its picture."""
    add_floor(client.scene, view)
    with client.atomic():
        client.camera.up_direction = np.array(view.up)
        client.camera.position = eye
        client.camera.look_at = np.array(view.target)
        client.camera.fov = float(np.radians(view.fov_degrees))


def eye_of(view: View, aspect: float, kept: float = NARROWEST) -> np.ndarray:
    """Return the eye from which as much is seen in the width of a picture as in one of width `kept` by its height."""
    target = np.array(view.target)
    return target + max(1.0, kept / max(aspect, 0.1)) * (view.seen_from() - target)


def add_floor(scene: viser.SceneApi, view: View) -> None:
    """Draw the grid and the labelled axes of a lesson.

    What is up is the camera's affair. The scene itself is not turned: the browser would take the camera's place for one in
    the frame before the turn.
    """
    _light(scene, view)
    axis = int(np.argmax(np.abs(view.up)))
    if view.grid is None:
        scene.add_frame("/grid", show_axes=False)
    else:
        scene.add_grid(
            "/grid",
            plane=_PLANES[axis],  # type: ignore[arg-type]
            infinite_grid=True,
            cell_size=view.grid,
            section_size=5 * view.grid,
            cell_color=(205, 208, 212),
            section_color=(170, 175, 182),
            cell_thickness=0.8,
            section_thickness=1.0,
            fade_distance=40 * view.grid,
            fade_from="origin",
            position=view.grid_height * np.array(view.up),
            shadow_opacity=0.0,
        )
    length = view.grid or 0.5
    scene.add_frame(
        "/axes", show_axes=view.axes, axes_length=length, axes_radius=0.012 * length, origin_radius=0.02 * length
    )
    for name, tip in zip("xyz", np.eye(3), strict=True):
        scene.add_label(
            f"/axes/{name}",
            name,
            position=1.08 * length * tip,
            visible=view.axes,
            font_screen_scale=0.8,
            anchor="center-center",
        )


def _light(scene: viser.SceneApi, view: View) -> None:
    """Light a lesson by two lamps and a plain sky: shadows and mirrored surroundings are slow without a graphics card."""
    scene.configure_default_lights(cast_shadow=False)
    scene.configure_environment_map(hdri=None)
    scene.add_light_hemisphere(
        "/sky", sky_color=(255, 255, 255), ground_color=(165, 165, 165), intensity=2.2, position=view.up
    )
