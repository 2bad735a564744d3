"""What a page is told of a run that it looks at, in texts: only what it has not got."""

from collections.abc import Mapping
from typing import Any

from workbench.page.lessons import values_of
from workbench.page.steps import Steps
from workbench.run import links
from workbench.run.links import show_command
from workbench.run.timeline import Timeline
from workbench.story.names import run_name


class RunUpdates:
    """What a page has been told of one run, and what is new to it.

    Args:
        number: The number of the run, of all that this page was told of.
        steps: The data of its steps.
    """

    def __init__(self, number: int, steps: Steps):
        self.number = number
        self.steps = steps
        self._sent: set[int] = set()  # numbers of things of this run that the page has
        self._told: Any = None  # what was last said of the run
        self._told_steps = 0  # up to where its series were

    @property
    def timeline(self) -> Timeline:
        """The run."""
        return self.steps.timeline

    def run(
        self, params: Any, *, known: int, finished: bool, more: Mapping[str, Any]
    ) -> dict[str, Any] | None:
        """Return what is new of the run since it was last told, None when nothing is.

        Args:
            params: Those that are wanted.
            known: How many steps there are.
            finished: Whether these are all.
            more: What is said besides.
        """
        timeline = self.timeline
        lesson = timeline.lesson
        told = {
            "name": run_name(lesson, params),
            "params": values_of(params),
            "known": known,
            "finished": finished,
            "end": self.steps.end(),
            "places": self.steps.places(),
            "idle": timeline.idle(),
            "command": show_command(lesson, params),
            "query": links.write(links.Place(lesson, params)),
            **more,
        }
        if told == self._told:
            return None
        new: dict[str, Any] = {"tell": "run", "run": self.number, **told}
        if self._told is None or known > self._told_steps:
            new |= self.steps.series(self._told_steps, known)
        self._told = told
        self._told_steps = known
        return new

    def step(self, k: int, more: Mapping[str, Any], wrong: int = 0) -> dict[str, Any]:
        """Return a known step, and what it needs that the page has not got.

        Args:
            k: Its index.
            more: What is said in place of its own, such as another caption.
            wrong: The line of a student's file where it went wrong, 0 where none is known.
        """
        step = {**self.steps.step(k), **more}
        wanted = self.steps.wanted(step)
        code = self.steps.code(k)
        if code is not None:
            step["code"] = code | ({"wrong": wrong} if wrong else {})
            wanted.append(code["source"])
        new = {n: self.steps.things[n] for n in wanted if n not in self._sent}
        self._sent |= set(new)
        return {"tell": "step", "run": self.number, "k": k, "step": step, "things": new}
