"""What one page is told of the run it looks at: only what it has not been told, while its scene is shown the same step."""

import json
from collections.abc import Mapping
from typing import Any

from workbench import links
from workbench.errors import AuthorError
from workbench.exercise.driven import Pair, calls_it, first_difference
from workbench.exercise.watching import Watched
from workbench.flags import show_command
from workbench.page.charts import series_of
from workbench.page.lessons import files_of, values_of
from workbench.page.steps import Steps
from workbench.session import Look, Session
from workbench.timeline import Timeline
from workbench.viewer.live_scene import LiveScene
from workbench.viewer.runs import Runs
from workbench.viewer.terminal import tell_terminal


class Telling:
    """What a page has been told, and what is new to it.

    Args:
        runs: What is shared between all pages.
        scene: The page's.

    Attributes:
        timeline: The run that the page was told of last; None where it is to be told all.
    """

    def __init__(self, runs: Runs, scene: LiveScene):
        self._runs, self._scene = runs, scene
        self.timeline: Timeline | None = None
        self._steps: Steps | None = None  # of that run
        self._sent: set[int] = set()  # numbers of things of this run that the page has
        self._told: Any = None  # what was last said of the run
        self._told_steps = 0  # up to where its series were
        self._run = 0
        self._seen: Any = None  # what the page was shown last

    def anew(self) -> None:
        """Show the step again, to whatever scene there is now."""
        self._seen = None

    def forget(self) -> None:
        """Hold no run any more."""
        self.timeline = self._steps = self._seen = None

    def show(self, session: Session, look: Look, *, redraw: bool, tell: bool, watched: Watched | None) -> list[str]:
        """Show a look in the scene, and return what the page is to be told of it.

        Args:
            session: Where the person is.
            look: What is to be seen there.
            redraw: Whether the scene is looked at again though the step is the one that was seen.
            tell: Whether the step is told again though it is that one.
            watched: A student's file that drives a lesson.
        """
        timeline = look.timeline
        if timeline.failure is not None:
            tell_terminal(AuthorError(timeline.stopped or "", timeline.failure))
        if self.timeline is not timeline or self._steps is None:
            self.timeline, self._steps = timeline, self._runs.steps(timeline)
            self._sent, self._told, self._told_steps, self._run = set(), None, 0, self._run + 1
        pinned = None if session.pinned_run is None else (id(session.pinned_run), len(session.pinned_run))
        now = self._run, look.k, look.known > 0, look.caption, pinned, self._scene.client
        new = now != self._seen
        trouble = self._scene.show(look, current=timeline is session.timeline) if new or redraw else None
        told = [self._run_told(self._steps, look, pinned, watched)]
        again = new or tell or trouble is not None
        if look.known and again:
            told.append(self._step_told(self._steps, look, trouble))
        elif not look.known and trouble is None and look.caption.text and again:
            told.append({"tell": "trouble", "text": look.caption.text})
        self._seen = now if trouble is None else None
        return [packed(message) for message in told if message is not None]

    def _run_told(self, steps: Steps, look: Look, pinned: Any, watched: Watched | None) -> dict[str, Any] | None:
        """Return what is new of the run since it was last told, None when nothing is."""
        params, lesson = look.params, look.lesson
        is_watched = watched is not None and watched.lesson is lesson
        said = {
            "name": "default" if params == lesson.params() else getattr(lesson.preset_of(params), "name", ""),
            "params": values_of(params),
            "known": look.known,
            "finished": look.finished,
            "end": steps.end(),
            "files": files_of(look.own),
            "aside": look.own is not params,
            "mark": first_difference(look.timeline.known()) if is_watched else None,
            "called": calls_it(look.timeline) if is_watched else None,
            "command": show_command(lesson, params),
            "query": links.write(links.Place(lesson, params)),
        }
        if (said, pinned) == self._told:
            return None
        new: dict[str, Any] = {"tell": "run", "run": self._run, **said}
        if self._told is None or self._told[1] != pinned:
            new["pinned"] = series_of(look.pinned_series) if pinned else None
        if self._told is None or look.known > self._told_steps:
            new |= steps.series(self._told_steps, look.known)
        self._told, self._told_steps = (said, pinned), look.known
        return new

    def _step_told(self, steps: Steps, look: Look, trouble: str | None) -> dict[str, Any]:
        step = dict(steps.step(look.k))
        if look.caption.text != step["caption"] or trouble:
            step |= {"caption": trouble or look.caption.text, "tone": "wrong" if trouble else look.caption.tone}
        wanted = [*step["shown"], step["legend"]]
        code = steps.code(look.k)
        if code is not None:
            state = look.timeline[look.k].state
            step["code"] = code | ({"wrong": state.line} if isinstance(state, Pair) and state.line else {})
            wanted.append(code["source"])
        new = {n: steps.things[n] for n in wanted if n not in self._sent}
        self._sent |= set(new)
        return {"tell": "step", "run": self._run, "k": look.k, "step": step, "things": new}


def packed(message: Mapping[str, Any]) -> str:
    """Return a message as a page takes it."""
    return json.dumps(message, ensure_ascii=False, separators=(",", ":"))
