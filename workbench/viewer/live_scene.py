"""The scene of one page as viser's client draws it: a lesson's stage, the step that is looked at, and the way to it."""

from collections.abc import Callable

import numpy as np
import viser

from workbench.authors import Blaming
from workbench.emphasis import lit
from workbench.errors import InputError
from workbench.knobs import Pick, fields_of
from workbench.lesson import Lesson
from workbench.motion import Way, eased, way
from workbench.scene import Scene
from workbench.session import Look
from workbench.timeline import Timeline
from workbench.viewer.handles import Handles, listen_for_clicks
from workbench.viewer.sink import ViserSink
from workbench.viewer.stage import BACKDROPS, Aim
from workbench.viewer.terminal import tell_terminal

EASED = eased()


class LiveScene:
    """What one page shows of a run in space.

    Args:
        moved: Called with the values of a handle that a person moved, in viser's thread.
        clicked: Called with the ray of a click, (3,) origin and (3,) direction, in viser's thread.
    """

    def __init__(self, moved: Callable[..., None], clicked: Callable[[np.ndarray, np.ndarray], None]):
        self._moved, self._clicked = moved, clicked
        self.client: viser.ClientHandle | None = None
        self._sink: ViserSink | None = None
        self.dark = False
        self.still = False
        """Whether nothing moves on its way: the person wants it so."""
        self.wants_handles = False
        self.path = ""
        """What stands out, because somebody reads of it."""
        self.aim = Aim()
        self._staged: Lesson | None = None
        self._handles: Handles | None = None
        self._shown: tuple[Timeline, int, Scene] | None = None
        self._way: tuple[Way, Scene, int] | None = None  # its pictures, where it leads, pictures shown

    def take(self, client: viser.ClientHandle | None) -> None:
        """Draw in this client from now on; None where it has gone."""
        self.client, self._sink, self._staged, self._handles = client, None, None, None
        self._shown = self._way = None
        self.aim.lost()
        if client is not None:
            self._sink = ViserSink(client.scene, BACKDROPS[self.dark])
            self._theme(client)

            @client.camera.on_update
            async def _(_: viser.CameraHandle) -> None:
                if self.client is client:
                    self.aim.fit(client)

    def wear(self, *, dark: bool, still: bool) -> None:
        """Draw for a dark or a light page from the next picture on."""
        self.dark, self.still = dark, still
        if self.client is not None:
            self._theme(self.client)

    def show(self, look: Look, *, current: bool) -> str | None:
        """Make the scene equal to what is looked at, or begin to; return what went wrong.

        Args:
            look: What is looked at.
            current: Whether it is of the run that is wanted; else the camera waits for that.
        """
        if self.client is None or self._sink is None:
            return None
        try:
            with Blaming(f"lesson {look.lesson.name}", look.lesson.draw), self.client.atomic():
                if self._staged is not look.lesson:
                    self._set_up(look.lesson)
                if current:
                    self.aim.show(self.client, look.lesson, look.timeline.params)
                self._begin(look)
                if self._sink.backdrop != BACKDROPS[self.dark]:
                    self._sink.repaint(BACKDROPS[self.dark])
                self._show_handles(look)
        except InputError as error:
            tell_terminal(error)
            return str(error)
        finally:
            self.client.flush()
        return None

    def go_on(self, *, at_once: bool) -> bool:
        """Show the next picture of what moves, or where it ends at once; return whether there are more."""
        if self._way is None or self.client is None or self._sink is None:
            self._way = None
            return False
        on_the_way, after, shown = self._way
        ended = at_once or shown == len(EASED)
        with self.client.atomic():
            if ended:
                self._sink.show(after)
            elif shown == 0:
                self._sink.show(on_the_way.scene)
            else:
                self._sink.place({path: poses[shown] for path, poses in on_the_way.poses.items()})
        self.client.flush()
        self._way = None if ended else (on_the_way, after, shown + 1)
        return not ended

    def _begin(self, look: Look) -> None:
        """Show a step, or start on the way to it where it is the next or the one before and something only moves."""
        assert self._sink is not None
        before, self._shown = self._shown, (look.timeline, look.k, look.scene)
        self._way = None
        beside = before is not None and before[0] is look.timeline and abs(before[1] - look.k) == 1
        calm = self.still or self.path
        found = way(before[2], look.scene, EASED) if before is not None and beside and not calm else None
        if found is not None:
            self._way = (found, look.scene, 0)
        else:
            self._sink.show(lit(look.scene, self.path) if self.path else look.scene)

    def _show_handles(self, look: Look) -> None:
        assert self.client is not None
        if self._handles is not None and not self.wants_handles:
            self._handles.close()
            self._handles = None
        if self.wants_handles and self._handles is None:
            self._handles = Handles(self.client.scene, look.lesson.params, self._moved)
        if self._handles is not None:
            self._handles.show(look.params)

    def _set_up(self, lesson: Lesson) -> None:
        """Make the stage a lesson's: its handles, and clicks that set its params."""
        assert self.client is not None
        if self._handles is not None:
            self._handles.close()
            self._handles = None
        can_be_picked = any(isinstance(field.knob.by, Pick) for field in fields_of(lesson.params))
        listen_for_clicks(self.client.scene, self._clicked if can_be_picked else None)
        self._staged = lesson

    def _theme(self, client: viser.ClientHandle) -> None:
        client.gui.configure_theme(show_logo=False, show_share_button=False, dark_mode=self.dark)
