"""Who is computed for next, and what is held: laws, without a clock."""

import asyncio
import functools
import gc
import threading
import time
import weakref
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np
import pytest

from tests import fake
from tests.loops import run_apart
from workbench.knobs import Knob
from workbench.lesson import Lesson
from workbench.run.session import Session
from workbench.run.timeline import Timeline
from workbench.scene import Caption, Scene
from workbench.viewer import runs as runs_module
from workbench.viewer import scheduling
from workbench.viewer.runs import OFTEN, SharedRuns, caches, tidy
from workbench.viewer.scheduling import Scheduler


@dataclass(frozen=True)
class Params:
    """A run's number and length."""

    number: Annotated[int, Knob("Which run", 0, 1000)] = 0
    steps: Annotated[int, Knob("How long", 1, 5000)] = 200


class Steered:
    """A lesson whose steps are made when they may be, and that notes which were."""

    def __init__(self) -> None:
        self.made: list[int] = []
        self.may = threading.Semaphore(0)
        self.lesson: Lesson = replace(
            fake.lesson, params=Params, run=self._run, draw=self._draw, presets=(), questions=()
        )

    def run_of(self, number: int, steps: int = 200) -> Timeline:
        return Timeline(self.lesson, Params(number, steps))

    def _run(self, params: Params) -> Iterator[int]:
        for _ in range(params.steps):
            self.may.acquire()
            self.made.append(params.number)
            yield params.number

    @staticmethod
    def _draw(state: int) -> Scene:
        return {"caption": Caption(f"A step of run {state} was made.")}


@pytest.fixture
def steered() -> Steered:
    return Steered()


@pytest.fixture
def lone(monkeypatch) -> Iterator[Scheduler]:
    """A scheduler with one thread, and slices of one step."""
    monkeypatch.setattr(scheduling, "SLICE", 0.0)
    monkeypatch.setattr(scheduling, "REST", 0.05)
    scheduler = Scheduler(1)
    yield scheduler
    scheduler.close()


def until(holds: Callable[[], bool]) -> None:
    deadline = time.monotonic() + 60
    while not holds():
        assert time.monotonic() < deadline
        time.sleep(0.002)


def nobody() -> None:
    pass


def test_the_step_that_somebody_waits_for_comes_before_everybody_s_rest(lone, steered):
    rest = [steered.run_of(number) for number in range(5)]
    for number, run in enumerate(rest):
        lone.want(f"reader {number}", run, 0, tell=nobody)
    steered.may.release(5 + 5 * scheduling.AHEAD + 3)
    until(lambda: len(steered.made) == 5 + 5 * scheduling.AHEAD + 3)
    before = len(steered.made)
    told = threading.Event()
    lone.want("me", steered.run_of(100), 3, tell=told.set)
    steered.may.release(5)
    assert told.wait(60)
    assert steered.made[before:][:5].count(100) == 4, "one step of another's rest was being made"
    steered.may.release(10_000)


@pytest.mark.parametrize("newcomer", ["another run", "something else"])
def test_a_slice_of_everybody_s_rest_ends_with_the_step_in_which_somebody_comes(
    steered, newcomer, monkeypatch
):
    monkeypatch.setattr(scheduling, "SLICE", 60.0)
    busy = threading.Event()
    scheduler = Scheduler(1, busy=busy.is_set)
    try:
        resting = steered.run_of(1)
        scheduler.want("reader", resting, 0, tell=nobody)
        steered.may.release(3)
        until(lambda: len(resting) == 3)  # the fourth is being made, in a slice at rest
        if newcomer == "another run":
            scheduler.want("me", steered.run_of(2), 0, tell=nobody)
        else:
            busy.set()
        steered.may.release(1)
        until(lambda: len(resting) == 4)
        steered.may.release(1)
        if newcomer == "another run":
            until(lambda: len(steered.made) == 5)
            assert steered.made == [1, 1, 1, 1, 2]
        else:
            time.sleep(0.1)
            assert steered.made == [1, 1, 1, 1]
    finally:
        scheduler.leave("reader")
        steered.may.release(10_000)
        scheduler.close()


def test_who_asks_a_lot_delays_only_themselves(lone, steered):
    lone.want("greedy", steered.run_of(1), -1, tell=nobody)
    until(lambda: len(lone) == 1)
    for number in range(2, 6):
        lone.want(number, steered.run_of(number), 9, tell=nobody)
    steered.may.release(50)
    until(lambda: len(steered.made) >= 50)
    counts = [steered.made[:50].count(number) for number in range(1, 6)]
    assert max(counts) - min(counts) <= 2, counts
    steered.may.release(10_000)


def test_a_run_that_nobody_looks_at_is_given_up(lone, steered):
    run = steered.run_of(1)
    lone.want("me", run, 0, tell=nobody)
    steered.may.release(3)
    until(lambda: len(steered.made) == 3)
    lone.leave("me")
    assert len(lone) == 0
    steered.may.release(100)
    time.sleep(0.2)
    assert len(run) <= 4, "the step that was being made"


def test_at_rest_a_run_is_computed_to_its_end_and_all_who_look_are_told(lone, steered):
    steered.may.release(10_000)
    run = steered.run_of(1, 40)
    told = [threading.Event() for _ in range(3)]
    for reader, event in enumerate(told):
        lone.want(reader, run, 0, tell=event.set)
    until(lambda: run.finished)
    assert all(event.wait(60) for event in told)
    assert steered.made == [1] * 40, "each step is made once for all"
    assert not lone.want("late", run, 3, tell=nobody)
    until(lambda: len(lone) == 0)


def test_while_people_wait_for_something_else_only_what_is_waited_for_is_computed(steered):
    busy = threading.Event()
    busy.set()
    scheduler = Scheduler(1, busy=busy.is_set)
    try:
        steered.may.release(10_000)
        run = steered.run_of(1, 40)
        told = threading.Event()
        scheduler.want("me", run, 3, tell=told.set)
        assert told.wait(60)
        for _ in range(20):
            with scheduler._changed:
                scheduler._changed.notify_all()
            time.sleep(0.002)
        assert len(run) == 4
        busy.clear()
        until(lambda: run.finished)
    finally:
        scheduler.close()


@pytest.mark.parametrize("name", ["showing", "opening"])
def test_while_pictures_of_other_runs_wait_a_step_is_shown_and_nothing_is_computed_at_rest(name):
    runs = SharedRuns(threads=1)
    held = threading.Event()
    crew = getattr(runs, name)

    async def asked() -> None:
        expensive = [asyncio.create_task(crew.do(held.wait, 60)) for _ in range(9)]
        while not crew.is_behind():
            await asyncio.sleep(0.001)
        assert await runs.stepping.do(lambda: "a step") == "a step"
        assert runs.scheduler._busy()
        held.set()
        await asyncio.gather(*expensive)
        assert not runs.scheduler._busy()

    try:
        run_apart(asked())
    finally:
        runs.close()


def test_a_lesson_that_ends_the_program_ends_its_own_run(lone, steered):
    def leaving(params: Params) -> Iterator[int]:
        yield 1
        raise KeyboardInterrupt if params.number else SystemExit

    lesson = replace(steered.lesson, run=leaving)
    for number in (0, 1):
        run = Timeline(lesson, Params(number))
        lone.want("me", run, -1, tell=nobody)
        until(lambda run=run: run.finished)
        assert ("KeyboardInterrupt" if number else "SystemExit") in (run.stopped or "")
    steered.may.release(10)
    run = steered.run_of(7, 5)
    lone.want("me", run, -1, tell=nobody)
    until(lambda: run.finished)


def test_a_step_that_holds_a_thread_up_is_worked_around(lone, steered, monkeypatch):
    monkeypatch.setattr(scheduling, "STUCK", 0.05)
    stuck = steered.run_of(1)
    lone.want("unlucky", stuck, 0, tell=nobody)
    time.sleep(0.1)
    other = Timeline(fake.lesson, fake.Params())
    lone.want("me", other, -1, tell=nobody)
    until(lambda: lone.relieve() or other.finished)
    steered.may.release(10_000)


@functools.lru_cache(maxsize=4)
def cached(number: int) -> np.ndarray:
    return np.full(1_000_000, number)


def test_memory_counts_runs_their_data_and_lessons_caches_each_array_once():
    runs = SharedRuns(most_bytes=10**9)
    try:
        cached.cache_clear()
        run = runs.timelines.get(fake.lesson, fake.Params())
        run.complete()
        only = runs.held([])
        assert only == sum(run.owned().values()) > 0
        data = runs.steps(run)
        assert runs.steps(run) is data, "the same for all who ask"
        for k in range(len(run)):
            data.step(k)
        assert runs.held([]) > only + 1000
        here = replace(fake.lesson, params=Params, presets=(), questions=())
        assert cached in caches([here])
        before = runs.held([here])
        for n in (1, 2):
            cached(n)
        assert runs.held([here]) - before == 2 * 8_000_000
    finally:
        cached.cache_clear()
        runs.close()


def test_all_garbage_is_collected_where_enough_has_come_together():
    class Held:
        pass

    held = Held()
    held.itself = held  # type: ignore[attr-defined]
    gc.collect()  # which makes it old
    gone = weakref.ref(held)
    del held
    tidy()
    assert gone() is not None
    for _ in range(OFTEN + 1):
        gc.collect(1)
    assert gone() is not None, "of old garbage that looks at none"
    tidy()
    assert gone() is None


def test_room_is_made_by_what_is_needed_least(monkeypatch):
    trimmed = []
    monkeypatch.setattr(runs_module, "give_back", lambda: trimmed.append(True))
    runs = SharedRuns(most_bytes=10**9)
    try:
        sessions = [Session(fake.lesson, runs.timelines) for _ in range(3)]
        for angle, session in enumerate(sessions):
            session.change(angle=float(angle), points=50_000)
            session.timeline.complete()
            assert session.look() is not None
        runs.timelines.get(fake.lesson, fake.Params(points=50_000)).complete()  # nobody's any more
        each = min(sum(run.owned().values()) for run in runs.timelines.alive() if run.bytes)
        runs._most_bytes = int(2.5 * each)

        def sleeper(session: Session) -> Callable[[], bool]:
            return lambda: session.let_go() is None

        gone = weakref.ref(sessions[0].timeline), weakref.ref(sessions[1].timeline)
        held = runs.make_room([], [sleeper(session) for session in sessions])
        gc.collect()
        assert held <= runs._most_bytes
        assert gone[0]() is None
        assert gone[1]() is not None, "no more than must be"
        assert trimmed
        sessions[0].take_up()
        sessions[0].timeline.complete()
        look = sessions[0].look()
        assert look is not None
        assert look.params.angle == 0.0
    finally:
        runs.close()
