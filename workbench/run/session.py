"""One person's place in the course: which lesson, which params, which step. Knows no viewer;
playing is the page's own.

A viewer calls the verbs (`seek`, `change`, ...), lets `compute` run somewhere off its event loop
while `pending`, and shows what `look` returns. The latest wish wins: `compute` gives up a run as
soon as another one is wanted.
"""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from workbench import knobs
from workbench.errors import AuthorError, InputError
from workbench.lesson import Lesson
from workbench.run.timeline import Timeline, Timelines
from workbench.scene import Caption, Scene


@dataclass(frozen=True, eq=False, kw_only=True)
class Shown:
    """What a person sees now.

    Args:
        lesson, params: The lesson and the params that are wanted (the picture may still be of the
            run before).
        own: The params that name the person's own files, where they have any; those of `params`, or
            put aside.
        k, known: The step that is shown, and how many steps there are so far.
        finished: Whether all steps are known.
        scene: The step's scene.
        caption: The step's caption, or what went wrong.
    """

    lesson: Lesson
    params: Any
    own: Any
    timeline: Timeline
    k: int
    known: int
    finished: bool
    scene: Scene
    caption: Caption


class Session:
    """A place in a lesson, and the verbs that move it.

    Args:
        lesson: The lesson that is open.
        timelines: Where runs are kept; share one between the sessions of a server.
        slots: Functions that replace keyword arguments of the lesson's run (a student's); such runs
            are not shared.

    Attributes:
        params: What is wanted.
        timeline: The run of these params.
        message: What the person gave that could not be used, or None.
    """

    def __init__(
        self,
        lesson: Lesson,
        timelines: Timelines | None = None,
        slots: Mapping[str, Callable] | None = None,
    ):
        self.lesson = lesson
        self.slots = dict(slots or {})
        self.timelines = Timelines() if timelines is None else timelines
        self.message: str | None = None
        # the run whose picture stays until the wanted one has a first step
        self._shown: Timeline | None = None
        self._last_k = 0
        # params with the person's own files, while a run without them is open
        self._aside: Any = None
        self.params = lesson.params()
        self.timeline = self._run(self.params)
        self._start(f"lesson {lesson.name}", lesson.opens)

    # what is wanted -------------------------------------------------------------------------------

    def open(self, lesson: Lesson, params: Any = None, step: int | None = None) -> None:
        """Go to a lesson, at these params and this step (negative counts from the end).

        In the same lesson, params that name no files put a person's own ones aside: the next preset
        or reset has them.

        Raises:
            InputError: If the params are not the lesson's; nothing has changed then.
        """
        params = lesson.validated(params if params is not None else lesson.params())
        other = lesson is not self.lesson
        if other or knobs.names_files(params):
            self._aside = None
        elif knobs.names_files(self.params):
            self._aside = self.params
        self.lesson = lesson
        self.message = None
        if other:
            self._shown = None
            self.slots = {}
        self._go(params)
        if step is None and params == lesson.params():
            self._start(f"lesson {lesson.name}", lesson.opens)
        else:
            self._want(lesson.first_step if step is None else step)

    def go_on(self, lesson: Lesson, params: Any, own: Any = None) -> None:
        """Go on in another version of the lesson, at the step that is wanted.

        Args:
            lesson: That version.
            params: What is wanted of it.
            own: What the attribute `own` is in it; None where nothing is put aside.

        Raises:
            InputError: If the params are not the lesson's; nothing has changed then.
        """
        wanted = self._wanted
        self.open(lesson, params)
        self._aside = self._still_aside(own)
        self._want(wanted)

    def change(self, /, **values: Any) -> None:
        """Set params; numbers out of range go to the nearer end. What cannot be used becomes the
        caption, no more.

        Own files that are put aside come back with another one, and one that is set to None is
        forgotten.
        """
        base, aside = self.params, self._aside
        try:
            if aside is not None:
                files = {
                    name: value
                    for name, value in values.items()
                    if name in knobs.paths_of(self.lesson.params)
                }
                aside = knobs.make(self.lesson.params, files, base=aside)
                base = knobs.with_own_files(base, aside) if any(files.values()) else base
            params = knobs.make(self.lesson.params, values, base=base, clamp=True)
            given = [name for name in knobs.paths_of(self.lesson.params) if values.get(name)]
            params = knobs.showing(params, given, kept=values)
        except InputError as error:
            self.message = knobs.in_words(str(error), self.lesson.params)
            return
        self.message = None
        if params != self.params:
            at_end = (
                self.timeline.finished
                and self._wanted >= len(self.timeline) - 1
                and len(self.timeline) > 0
            )
            self._go(params)
            self._want(-1 if at_end else self._wanted)
        self._aside = self._still_aside(aside)

    def reset(self) -> None:
        """Go back to the default run; own files stay open, and those put aside come back."""
        self.open(self.lesson, knobs.with_own_files(self.lesson.params(), self.own))

    def use_preset(self, name: str) -> None:
        """Open a preset of the lesson; own files stay open, and those put aside come back."""
        preset = self.lesson.preset(name)
        self.open(self.lesson, knobs.with_own_files(preset.params, self.own))
        step = self.lesson.first_step if preset.step is None else preset.step
        self._start(f"lesson {self.lesson.name}, preset {name!r}", step)

    @property
    def own(self) -> Any:
        """The params that name the person's own files, if they have any: what is wanted, or what is
        put aside.
        """
        return self.params if self._aside is None else self._aside

    def let_go(self) -> None:
        """Hold the run no longer, to make room; what is shown stays until `take_up` or another
        wish.
        """
        self.timeline = Timeline(self.lesson, self.params, self.slots)
        self._shown = None

    def take_up(self) -> None:
        """Hold the run of the wanted params again, after `let_go`; its steps may have to be
        computed anew.
        """
        self.timeline = self._run(self.params)

    # moving in time -------------------------------------------------------------------------------

    @property
    def step(self) -> int:
        """The step that can be shown now: the wanted one, or the nearest that is known."""
        last = len(self.timeline) - 1
        if self._wanted >= 0:
            return max(0, min(self._wanted, last))
        return max(0, last + 1 + self._wanted) if self.timeline.finished else max(0, last)

    def seek(self, k: Any) -> None:
        """Go to step k; beyond the end means the last step, what is no number is ignored."""
        if isinstance(k, bool) or not isinstance(k, (int, float)) or k != k:
            return
        self._want(max(0, int(min(k, 1e9))))

    def forward(self) -> None:
        """Go one step on."""
        self.seek(self.step + 1)

    def back(self) -> None:
        """Go one step back: a look-up."""
        self.seek(self.step - 1)

    def first(self) -> None:
        """Go to the first step."""
        self.seek(0)

    def last(self) -> None:
        """Go to the last step, as soon as it is known."""
        self._want(-1)

    @property
    def wanted(self) -> int:
        """The step that is wanted, known or not; negative counts from the end."""
        return self._wanted

    # computing and looking ------------------------------------------------------------------------

    @property
    def pending(self) -> bool:
        """Whether steps of the wanted run are still to be computed."""
        return not self.timeline.finished

    def compute(self, seconds: float) -> None:
        """Compute steps of the wanted run for about so long, at least one; return early when
        another run is wanted.
        """
        timeline = self.timeline
        end = time.perf_counter() + seconds
        while timeline is self.timeline and timeline.extend() and time.perf_counter() < end:
            pass

    def look(self) -> Shown | None:
        """Return what is to be seen now; None when there is nothing yet. The picture of the run
        before stays meanwhile.
        """
        timeline = self.timeline
        if len(timeline):
            k = self.step
            self._shown = timeline
        elif self._shown is not None and self._shown.lesson is self.lesson and len(self._shown):
            timeline = self._shown
            k = min(self._last_k, len(self._shown) - 1)
        else:
            return self._blank() if timeline.finished or self.message else None
        self._last_k = k
        step = timeline[k]
        return Shown(
            lesson=self.lesson,
            params=self.params,
            own=self.own,
            timeline=timeline,
            k=k,
            known=len(timeline),
            finished=timeline.finished,
            scene=step.scene,
            caption=self._trouble(k) or step.caption,
        )

    def _still_aside(self, own: Any) -> Any:
        """Return params as what is put aside: None where what is wanted names files, or they name
        none themselves.
        """
        return (
            None
            if own is None or knobs.names_files(self.params) or not knobs.names_files(own)
            else own
        )

    def _go(self, params: Any) -> None:
        self.params, self.timeline = params, self._run(params)

    def _run(self, params: Any) -> Timeline:
        return (
            Timeline(self.lesson, params, self.slots)
            if self.slots
            else self.timelines.get(self.lesson, params)
        )

    def _want(self, step: int) -> None:
        self._wanted = step
        self._opens = None

    def _start(self, owner: str, step: int) -> None:
        """Go to the step at which an author lets a run open; `owner` is told if it turns out that
        there is none.
        """
        self._wanted = step
        self._opens = (owner, step)

    def _trouble(self, k: int) -> Caption | None:
        if self.message is not None:
            return Caption(self.message, "wrong")
        if self._opens is not None:
            try:
                self.timeline.opening(*self._opens)
            except AuthorError as error:
                return Caption(str(error), "wrong")
        ended = self.timeline.stopped
        if ended is not None and (not len(self.timeline) or k == len(self.timeline) - 1):
            return Caption(ended, "wrong")
        return None

    def _blank(self) -> Shown:
        text = self.message or self.timeline.stopped or ""
        return Shown(
            lesson=self.lesson,
            params=self.params,
            own=self.own,
            timeline=self.timeline,
            k=0,
            known=0,
            finished=True,
            scene={},
            caption=Caption(text, "wrong"),
        )
