"""The runs of all pages: computed in turn, their data made once for everybody, all within one bound
of memory.
"""

import asyncio
import gc
import queue
import sys
import threading
import weakref
from collections.abc import Callable, Iterable
from typing import Any, TypeVar

from workbench.lesson import Lesson
from workbench.machinery.memory import give_back
from workbench.page.steps import Steps
from workbench.run.timeline import Timeline, Timelines
from workbench.scene import arrays
from workbench.viewer.scheduling import Scheduler
from workbench.wire.nodes import Maker

Result = TypeVar("Result")

MOST_BYTES = 3 * 2**29
"""What runs, their steps' data and lessons' caches may hold together."""
OFTEN, RARELY = 10, 100
"""Collections of young garbage until one of all: Python's own, and a server's that has no rest."""


class Crew:
    """A few threads that do one kind of work, and end with the program whatever holds them up."""

    def __init__(self, name: str, threads: int):
        self._work: queue.SimpleQueue[Any] = queue.SimpleQueue()
        self._threads = threads
        for _ in range(threads):
            threading.Thread(target=self._run, name=name, daemon=True).start()

    async def do(self, function: Callable[..., Result], *args: Any) -> Result:
        """Return what a function returns, called in one of the threads."""
        loop = asyncio.get_running_loop()
        answer: asyncio.Future[Result] = loop.create_future()
        self._work.put((loop, answer, function, args))
        return await answer

    def is_behind(self) -> bool:
        """Tell whether something waits for a thread."""
        return not self._work.empty()

    def close(self) -> None:
        """Do nothing more than what was begun."""
        for _ in range(self._threads):
            self._work.put(None)

    def _run(self) -> None:
        while (task := self._work.get()) is not None:
            loop, answer, function, args = task
            del task
            if answer.cancelled():
                continue
            result, error = None, None
            try:
                result = function(*args)
            except Exception as raised:
                error = raised
            except BaseException as raised:  # a lesson that wants to end the program
                error = RuntimeError(repr(raised))
            try:
                loop.call_soon_threadsafe(_settle, answer, result, error)
            except RuntimeError:
                return  # the server has stopped
            del loop, answer, function, args, result, error


def _settle(answer: asyncio.Future, result: Any, error: Exception | None) -> None:
    if answer.done():
        return
    if error is not None:
        answer.set_exception(error)
    else:
        answer.set_result(result)


class SharedRuns:
    """What the pages of a server share.

    `stepping` shows a step that somebody waits for, of the run that their page shows already;
    `showing` the first step of another, which costs several times as much, and how a run has grown:
    who only steps does not wait for who moves knobs, nor for who looks on, nor for who comes, whose
    page `opening` makes. `asking` answers, `keeping` makes recordings and pictures.

    Args:
        most_bytes: What runs, their steps' data and lessons' caches may hold together. Runs that
            nobody looks at go first, then lessons' caches, then the runs of pages where nothing was
            done for longest.
        threads: How many compute.
    """

    def __init__(self, most_bytes: int = MOST_BYTES, threads: int = 2):
        self.timelines = Timelines(most_bytes=most_bytes)
        self.maker = Maker()
        self.stepping, self.showing = Crew("stepping", 2), Crew("showing", 2)
        self.opening, self.asking = Crew("opening", 1), Crew("asking", 1)
        self.keeping = Crew("keeping", 1)
        awaited = (self.stepping, self.showing, self.opening)
        self.scheduler = Scheduler(threads, busy=lambda: any(crew.is_behind() for crew in awaited))
        self._most_bytes = most_bytes
        self._steps: weakref.WeakKeyDictionary[Timeline, Steps] = weakref.WeakKeyDictionary()
        self._lock = threading.Lock()

    def steps(self, timeline: Timeline) -> Steps:
        """Return the data of a run's steps, the same for all who ask."""
        with self._lock:
            steps = self._steps.get(timeline)
            if steps is None:
                steps = self._steps[timeline] = Steps.weakly(timeline)
            return steps

    def close(self) -> None:
        """End the threads; what is computed now is given up."""
        self.scheduler.close()
        self.stepping.close()
        self.showing.close()
        self.opening.close()
        self.asking.close()
        self.keeping.close()

    def held(self, lessons: Iterable[Lesson]) -> int:
        """Return the bytes of all runs, of what is sent of them, and of these lessons' caches; each
        array counts once.
        """
        owned: dict[int, int] = {}
        for timeline in self.timelines.alive():
            owned |= timeline.owned()
        for cached in caches(lessons):
            owned |= {id(array): array.nbytes for array in _cached_arrays(cached)}
        with self._lock:
            data = sum(steps.bytes for steps in self._steps.values())
        return sum(owned.values()) + data + self.maker.held()

    def let_go(self, lessons: Iterable[Lesson]) -> None:
        """Keep no run and no lesson's cache any more."""
        while self.timelines.drop():
            pass
        for cached in caches(lessons):
            cached.cache_clear()
        gc.collect()
        give_back()

    def make_room(self, lessons: Iterable[Lesson], sleepers: Iterable[Callable[[], bool]]) -> int:
        """Let go of what is needed least until all is within the bound; return what is held then.

        Args:
            lessons: Those that are served.
            sleepers: Let go of the run of one page each, in this order, and tell whether they did.
        """
        lessons = tuple(lessons)
        freed = False
        # arrays that two runs share are counted twice
        at_most = self.timelines.bytes + self.maker.held()
        if at_most < self._most_bytes // 2:
            return at_most
        while (held := self.held(lessons)) > self._most_bytes and self.timelines.drop():
            freed = True
        if held > self._most_bytes:
            for cached in caches(lessons):
                cached.cache_clear()
            held = self.held(lessons)
            freed = True
        for sleep in sleepers:
            if held <= self._most_bytes:
                break
            if sleep():
                held = self.held(lessons)
                freed = True
        if freed:
            give_back()
        return held


def caches(lessons: Iterable[Lesson]) -> list[Any]:
    """Return the caches (`functools.lru_cache`) of the modules that lessons are made of."""
    homes = {
        lesson.params.__module__.rpartition(".")[0] or lesson.params.__module__
        for lesson in lessons
    }
    by_id: dict[int, Any] = {}
    for name, module in tuple(sys.modules.items()):
        if name in homes or name.rpartition(".")[0] in homes:
            for value in tuple(vars(module).values()):
                if callable(getattr(value, "cache_clear", None)) and callable(
                    getattr(value, "cache_info", None)
                ):
                    by_id[id(value)] = value
    return list(by_id.values())


def _cached_arrays(cached: Any) -> Iterable[Any]:
    """Walk through the arrays that a cache holds, as far as they can be seen."""
    for held in gc.get_referents(cached):
        for array in arrays(held):
            owner = array
            while owner.base is not None and type(owner.base) is type(owner):
                owner = owner.base
            yield owner


def settle() -> None:
    """Keep what is there now out of every collection of garbage, and make those of all the rest
    rare: with many runs, one takes a tenth of a second, in which all threads stand still.

    For a process that is a server and nothing else, and that calls `tidy` while nobody waits.
    """
    gc.collect()
    gc.freeze()
    gc.set_threshold(*gc.get_threshold()[:2], RARELY)


def tidy() -> None:
    """Collect all garbage, where Python by itself would have done so."""
    if gc.get_count()[2] > OFTEN:
        gc.collect()
