"""The empty stage of a lesson: light, camera, world up, grid with a stated spacing, axes with their
names.
"""

from typing import TYPE_CHECKING, Any

import numpy as np

from workbench.lesson import Lesson, View

if TYPE_CHECKING:
    import viser

_PLANES = ("yz", "xz", "xy")


class Aim:
    """Which view a page's camera is put to: that of a run that was opened; what a knob leads to
    keeps it where it fits.
    """

    def __init__(self) -> None:
        self._wanted: View | None = None
        self._usual: View | None = None

    def open(self, lesson: Lesson, params: Any) -> None:
        """Want the view of a run that was opened."""
        self._wanted, self._usual = lesson.view_of(params), lesson.usual_view(params)

    def view(self, lesson: Lesson, params: Any) -> View:
        """Return the view in which a run is shown; one of another grid or size brings its own."""
        own, usual = lesson.view_of(params), lesson.usual_view(params)
        wanted = self._wanted if usual == self._usual else None
        if wanted is None or (wanted.grid, wanted.grid_height) != (own.grid, own.grid_height):
            wanted = self._wanted = own
            self._usual = usual
        return wanted


def length_of_axes(view: View) -> float:
    """Return how long the world's axes are drawn, metres."""
    return view.grid or 0.5


def axis_names(view: View) -> list[tuple[str, np.ndarray]]:
    """Return the names of the world's axes, each with its place (3,); none where the axes are
    hidden.
    """
    if not view.axes:
        return []
    return list(zip("xyz", 1.08 * length_of_axes(view) * np.eye(3), strict=True))


def camera_of(view: View) -> dict[str, Any]:
    """Return where a view is seen from, as a page takes it: metres, and the height of the picture
    as an angle, radians.
    """
    return {
        "eye": [float(x) for x in view.seen_from()],
        "target": [float(x) for x in view.target],
        "up": [float(x) for x in view.up],
        "fov": float(np.radians(view.fov_degrees)),
    }


def add_stage(scene: "viser.SceneApi", view: View) -> None:
    """Add light, grid and axes of a view to a scene of viser.

    What is up is the camera's affair. The scene itself is not turned: the browser would take the
    camera's place for one in the frame before the turn.
    """
    _add_light(scene, view)
    if view.grid is not None:
        _add_grid(scene, view, view.grid)
    if view.axes:
        length = length_of_axes(view)
        scene.add_frame(
            "/axes", axes_length=length, axes_radius=0.012 * length, origin_radius=0.02 * length
        )


def _add_grid(scene: "viser.SceneApi", view: View, spacing: float) -> None:
    scene.add_grid(
        "/grid",
        plane=_PLANES[int(np.argmax(np.abs(view.up)))],  # type: ignore[arg-type]
        infinite_grid=True,
        cell_size=spacing,
        section_size=5 * spacing,
        cell_color=(205, 208, 212),
        section_color=(170, 175, 182),
        cell_thickness=0.8,
        section_thickness=1.0,
        fade_distance=40 * spacing,
        fade_from="origin",
        position=view.grid_height * np.array(view.up),
        shadow_opacity=0.0,
    )


def _add_light(scene: "viser.SceneApi", view: View) -> None:
    """Light a lesson by two lamps and a plain sky: shadows and mirrored surroundings are slow
    without a graphics card.
    """
    scene.configure_default_lights(cast_shadow=False)
    scene.configure_environment_map(hdri=None)
    scene.add_light_hemisphere(
        "/sky",
        sky_color=(255, 255, 255),
        ground_color=(165, 165, 165),
        intensity=2.2,
        position=view.up,
    )
