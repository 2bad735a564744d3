"""Who is computed for next: the step that somebody waits for, then the few behind it, then
everybody's rest at rest.

Threads of their own compute runs in short slices. Of those who wait, the one who was served longest
ago comes first, so a person who asks a lot delays only themselves. A run that nobody looks at is
given up where it stands.
"""

import contextlib
import threading
import time
import traceback
from collections.abc import Callable, Hashable
from dataclasses import dataclass, field

from workbench.apart import tell_when_waiting
from workbench.run.timeline import Timeline

SLICE = 0.02
"""Seconds of computing until somebody else has a turn; a single step may take longer."""
AHEAD = 8
"""How many steps behind the one that is shown are computed at once, so that playing does not wait.
"""
REST = 0.5
"""Seconds without a wish after which the rest of a run is computed."""
BUSY = 0.02
"""Seconds between two looks at whether people wait for something else."""
NEWS = 0.2
"""Seconds between two reports of a run that grows at rest."""
STUCK = 10.0
"""Seconds that a slice may last until a thread is started in the place of the one that it holds."""
MOST_STUCK = 4


@dataclass(eq=False)
class _Job:
    """A run that is computed, and who looks at it: what they want, and how they are told of steps
    that have come.
    """

    timeline: Timeline
    wanted: dict[Hashable, int] = field(default_factory=dict)
    met: set[Hashable] = field(default_factory=set)  # who need not be told that their step is there
    moved: float = 0.0  # when somebody wanted another step
    served: float = 0.0
    said: float = 0.0
    running: bool = False

    def waiting(self, ahead: int = 0) -> list[Hashable]:
        known = len(self.timeline)
        return [asker for asker, k in self.wanted.items() if k < 0 or k + ahead >= known]


class Scheduler:
    """Computes what is wanted, by threads that end with the program.

    Args:
        threads: How many compute; all but one may compute what nobody waits for.
        busy: Tells whether people wait for something else that this process does; then nothing is
            computed at rest.
    """

    def __init__(self, threads: int = 2, busy: Callable[[], bool] = lambda: False):
        self._busy = busy
        self._jobs: dict[Timeline, _Job] = {}
        self._of: dict[Hashable, tuple[_Job, Callable[[], None]]] = {}
        self._turns: dict[Hashable, float] = {}  # when somebody was served last
        self._changed = threading.Condition()
        self._resting = 0  # threads that compute what nobody waits for
        self._threads = threads
        self._stuck = 0
        self._open = True
        self._began: dict[threading.Thread, float] = {}
        tell_when_waiting(self)
        for _ in range(threads):
            self._start_thread()

    def want(
        self, asker: Hashable, timeline: Timeline, k: int, *, tell: Callable[[], None]
    ) -> bool:
        """Compute a run up to step k (negative: to its end) for somebody, in place of what they
        wanted before.

        Returns whether there is anything to compute; else nobody is told.

        Args:
            asker: Who wants it.
            timeline: The run.
            k: The step.
            tell: Called in another thread when steps have come; must not block.
        """
        with self._changed:
            before = self._of.get(asker)
            if (
                before is not None
                and before[0].timeline is timeline
                and before[0].wanted.get(asker) == k
            ):
                self._of[asker] = before[0], tell
                return True
            self._forget(asker)
            if timeline.finished:
                return False
            job = self._jobs.setdefault(timeline, _Job(timeline))
            job.wanted[asker], job.moved = k, time.monotonic()
            if 0 <= k < len(timeline):
                job.met.add(asker)
            self._of[asker] = job, tell
            self._turns.setdefault(asker, 0.0)
            self._changed.notify()
            return True

    def leave(self, asker: Hashable) -> None:
        """Want nothing more for somebody."""
        with self._changed:
            self._forget(asker)
            self._turns.pop(asker, None)

    def close(self) -> None:
        """Compute nothing more."""
        with self._changed:
            self._open = False
            self._changed.notify_all()

    def __len__(self) -> int:
        """Return how many runs are being computed or wait for it."""
        return len(self._jobs)

    def _forget(self, asker: Hashable) -> None:
        before = self._of.pop(asker, None)
        if before is not None:
            job = before[0]
            job.wanted.pop(asker, None)
            job.met.discard(asker)
            if not job.wanted:
                self._jobs.pop(job.timeline, None)

    def _start_thread(self) -> None:
        threading.Thread(target=self._work, name="computing", daemon=True).start()

    def _work(self) -> None:
        while self._one_slice():
            pass

    def _one_slice(self) -> bool:
        """Compute for a slice when there is something to compute; False when this thread is to
        end.
        """
        here = threading.current_thread()
        with self._changed:
            while (turn := self._next()) is None and self._open:
                self._changed.wait(self._patience())
            if turn is None or not self._open:
                return False
            job, calm = turn
            job.running, self._began[here] = True, time.monotonic()
            self._resting += calm
        self._slice(job, calm)
        with self._changed:
            self._resting -= calm
            late = time.monotonic() - self._began.pop(here) > STUCK
            told = self._served(job)
            self._changed.notify()
        for tell in told:
            with contextlib.suppress(RuntimeError):  # whoever it was has gone
                tell()
        return not (late and self._one_too_many())

    def _next(self) -> tuple[_Job, bool] | None:
        """Return the run whose turn it is, and whether nobody waits for it."""
        free = [job for job in self._jobs.values() if not job.running]
        waiting = [
            (min(self._turns.get(asker, 0.0) for asker in asking), i)
            for i, job in enumerate(free)
            if (asking := job.waiting())
        ]
        if waiting:
            return free[min(waiting)[1]], False
        if self._resting >= max(1, self._threads - 1) or self._busy():
            return None
        clock = time.monotonic()
        ahead = [job for job in free if job.waiting(AHEAD)]
        rest = ahead or [job for job in free if clock - job.moved >= REST]
        return (min(rest, key=lambda job: job.served), True) if rest else None

    def _patience(self) -> float | None:
        """Return the seconds until something may be due that nobody reports."""
        clock = time.monotonic()
        due = [job.moved + REST - clock for job in self._jobs.values() if not job.running]
        if not due or self._resting >= max(1, self._threads - 1):
            return None
        return BUSY if self._busy() else max(0.001, min(due))

    def _slice(self, job: _Job, calm: bool) -> None:
        timeline = job.timeline
        end = time.perf_counter() + SLICE
        awaited = [k for k in tuple(job.wanted.values()) if k >= len(timeline)]
        nearest = min(awaited, default=None)
        try:
            while job.wanted and timeline.extend() and time.perf_counter() < end:
                if nearest is not None and len(timeline) > nearest:
                    break  # somebody's step has come
                if calm and self._pressing():
                    break  # somebody has come who waits
        except BaseException as error:  # whatever a lesson raises ends its own run only
            timeline.give_up(f"lesson {timeline.lesson.name}: {error!r}", traceback.format_exc())

    def _pressing(self) -> bool:
        """Tell whether somebody waits, for a run or for something else."""
        with self._changed:
            return self._busy() or any(
                job.waiting() for job in self._jobs.values() if not job.running
            )

    def _served(self, job: _Job) -> list[Callable[[], None]]:
        """Note that a run had its turn; return whom to tell of it."""
        clock = time.monotonic()
        known = len(job.timeline)
        finished = job.timeline.finished
        job.running = False
        job.served = clock
        arrived = {asker for asker, k in job.wanted.items() if 0 <= k < known} - job.met
        job.met |= arrived
        for asker in job.wanted:
            self._turns[asker] = clock
        news = finished or clock - job.said >= NEWS
        job.said = clock if news else job.said
        told = [
            self._of[asker][1] for asker in (job.wanted if news else arrived) if asker in self._of
        ]
        if finished:
            for asker in tuple(job.wanted):
                self._forget(asker)
        return told

    def _one_too_many(self) -> bool:
        """Tell whether this thread's place was taken while it was held up."""
        with self._changed:
            if self._stuck > 0:
                self._stuck -= 1
                return True
            return False

    def stands_still(self) -> None:
        """Let another thread compute in the place of this one, which is about to wait for something
        else.
        """
        here = threading.current_thread()
        with self._changed:
            if self._began.get(here, -STUCK) > 0 and self._stuck < MOST_STUCK:
                self._began[
                    here
                ] = -STUCK  # counts as one that is held up, and ends when it is done
                self._stuck += 1
                self._start_thread()

    def relieve(self) -> None:
        """Start a thread for each that a single step holds up, a few at most; to be called now and
        then.
        """
        with self._changed:
            clock = time.monotonic()
            held = sum(clock - began > STUCK for began in self._began.values())
            while self._stuck < min(held, MOST_STUCK):
                self._stuck += 1
                self._start_thread()
