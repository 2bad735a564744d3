"""One run as a replay: the 3D scene as viser's own export, and all that stands beside it as plain data."""

import re

import numpy as np

from workbench.errors import InputError
from workbench.timeline import Timeline
from workbench.viewer.inner import Inner
from workbench.viewer.sink import ViserSink
from workbench.viewer.stage import add_floor

_DATA = re.compile(r'window\.__VISER_EMBED_DATA__="([^"]*)"')


class Renderer:
    """A viser server that nobody can connect to, through which runs are exported one after the other."""

    def __init__(self) -> None:
        self._inner = Inner()
        self._server = self._inner.viser

    def __enter__(self) -> "Renderer":
        return self

    def __exit__(self, *exception: object) -> None:
        """Stop the server."""
        self._inner.stop()

    def scene(self, timeline: Timeline) -> tuple[str, str]:
        """Return the 3D scene of a run: viser's page without its data, and the data, base64.

        The page holds the data's place as `window.__VISER_EMBED_DATA__=""`. Step k stands from second k to second k + 1.
        """
        view = timeline.lesson.view_of(timeline.params)
        self._server.scene.reset()
        camera = self._server.initial_camera
        camera.position, camera.look_at, camera.up, camera.fov = (
            view.seen_from(),
            view.target,
            view.up,
            float(np.radians(view.fov_degrees)),
        )
        add_floor(self._server.scene, view)
        sink = ViserSink(self._server.scene)
        sink.show(timeline[0].scene)
        serializer = self._server.get_scene_serializer()
        serializer.insert_sleep(1.0)
        for step in list(timeline.known())[1:]:
            sink.show(step.scene)
            serializer.insert_sleep(1.0)
        page = serializer.as_html()
        found = _DATA.search(page)
        if found is None:
            raise InputError("this version of viser exports another kind of page than the workbench can take apart")
        return page[: found.start(1)] + page[found.end(1) :], found.group(1)
